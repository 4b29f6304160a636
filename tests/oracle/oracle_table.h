/* A table once more, in double, from the bytes of its file alone: what the run time's density, area, Lambda, G1
 * and D are to be, computed straight from their definition and sharing no code with src/. Slow and plain: no
 * guides, windows or prefix sums, every mass is added up cell by cell.
 *
 * True is the function of the very numbers that were given. The numbers of the file are exact; wi need not be
 * unit, it is the direction that counts; so does that of wm, whatever the rounding of its length; roughness is
 * alpha times the f64 scale of the file. So no conditioning of the input excuses an error: a wm whose
 * slope is 1e-6 has that slope to all its digits. Only where the density jumps (a radial knot may be a jump of D;
 * the seam between the azimuths towards wi and away from it) may an input within two ulps of the jump have the
 * value of its other side.
 *
 * With  n = (wm.x/ax, wm.y/ay, wm.z) = (X cos a, X sin a, Z)  in the frame whose x axis is that of
 * (ax wi.x, ay wi.y) = s (cos, sin),  c = wi.z:
 *
 *     s X cos a = wi.x wm.x + wi.y wm.y,      s X sin a = ax wi.x wm.y/ay - ay wi.y wm.x/ax,
 *     density   = (azimuth per radian) (radius per xi) Z^3 / (X width ax ay wm.z^3),      dR = width/Z^2 dxi. */
#ifndef TESTS_ORACLE_ORACLE_TABLE_H
#define TESTS_ORACLE_ORACLE_TABLE_H

#include <stddef.h>

typedef struct oracle_wedge {
    size_t cells, rows, knots;
    double *q, *row_y, *aspect_p, *aspect_r;
    double *mass, *density; /* row by row; each row's mass is 1 */
    double *knot_y, *area, *slope, *curve;
} oracle_wedge;

typedef struct oracle_table {
    double scale;
    size_t count; /* radial cells */
    double *x, *z, *f0, *f1, *mu0, *mu1;
    double total0, total1; /* integrals of P22 R dR and P22 R^2 dR */
    oracle_wedge above, below;
    double *numbers; /* where all of them are */
} oracle_table;

/* Reads a file; 0 after a message if it is no table of version 3. */
int oracle_table_read(oracle_table *t, const char *path);
void oracle_table_free(oracle_table *t);

/* What is asked; any lengths. */
typedef struct oracle_query {
    double wi[3], alpha[2], wm[3];
} oracle_query;

/* The density per steradian in value[0], and in value[1...] what it is on the other side of each jump, and of
 * both, within two ulps. Returns how many values there are. */
enum { ORACLE_SIDES = 6 };
size_t oracle_table_densities(const oracle_table *t, const oracle_query *q, double value[ORACLE_SIDES]);

/* The least and the largest density, or with `ndf` D, where the slope or the cut is 2^-50 less or more: where
 * they change by 1e-5 between these, no arithmetic in double could place the normal any better. */
void oracle_table_blur(const oracle_table *t, const oracle_query *q, int ndf, double range[2]);

/* A(wi), Lambda, G1; D(wm), with the value on the other side of a knot within two ulps as above. */
double oracle_table_area(const oracle_table *t, const oracle_query *q);
double oracle_table_lambda(const oracle_table *t, const oracle_query *q);
double oracle_table_g1(const oracle_table *t, const oracle_query *q);
size_t oracle_table_ndfs(const oracle_table *t, const oracle_query *q, double value[ORACLE_SIDES]);

/* ---- the parts ---- */

/* A place among the radial knots: the cell, and xi and 1 - xi there, each exact where it is small. */
typedef struct oracle_place {
    size_t cell;
    double xi, eta;
} oracle_place;

/* Where the slope X/Z lies; `aside` is -1 or 1 for the end of the cell before or behind that is within two ulps,
 * 0 for the cell itself. Returns 0 if there is none. */
int oracle_table_place(const oracle_table *t, double x, double z, int aside, oracle_place *at);

/* f of a cell by its cubic, before it is held above 0; eta = 1 - xi. */
double oracle_table_cubic(const oracle_table *t, size_t cell, double xi, double eta);

/* Half a wedge's mass per (s + |c|), at y in [0, 1]. */
double oracle_wedge_mass(const oracle_wedge *w, double y);

/* The rational quadratic density of a cell (Gregory & Delbourgo 1982) at xi, eta = 1 - xi. */
double oracle_rational(double e0, double e1, double mass, double xi, double eta);

#endif
