/* What a table is made from: strips of a profile, cells of strips, knots where cells end; and numbers of all cells,
 * shares below the horizon, areas.
 *
 * Units and symbols are those of src/table/table.h: f = 2 pi R P22 of mass 1, x = R/(1 + R), z = 1/(1 + R), a
 * direction (s, 0, c) with s + |c| = 1, rho = |c|/s. In a cell the law is W(R) f/R with a polynomial W of the
 * direction; a cell is drawn as a rational density (Gregory & Delbourgo) with the exact mass and the densities at
 * both ends per unit of its coordinate xi (kernel/law.h). Masses are those of the projected area: they add up to it. */
#ifndef VNDF_FIT_DRAFT_H
#define VNDF_FIT_DRAFT_H

#include "fit/profile/profile.h"
#include "table/table.h"

/* ---- strips ----
 *
 * The measure f dR of a profile: what knots are chosen among, cells are summed from and laws are compared with. A strip
 * is so narrow that two points in it stand for all of its f. */

/* Slopes nearer than this part of themselves count as one: normals of floats hardly tell them apart. */
#define VNDF_GRAIN 0x1p-20

/* From its edge to that of the next, t = R - edge. */
typedef struct vndf_strip {
    double edge;
    double m0, m1, m2, m4; /* integrals of f/R, t f/R, t^2 f/R and f/R^4 */
    double f, along;       /* of f and of R f */
    double p0, p1;         /* P22 inside both ends */
    double r[2], mass[2];  /* two points: f dR = mass */
    int gathered;          /* all of it stands at one place */
} vndf_strip;

typedef struct vndf_strips {
    size_t count;
    vndf_strip *at; /* edges ascend from 0, as floats do; at[count] has an infinite one */
    size_t *first;  /* those of knots, and behind them the count */
} vndf_strips;

/* About as many as a table of so many cells needs; some end at these knots, which ascend from 0. 0 if there is no
 * memory; free them either way. */
int vndf_strips_from(vndf_strips *strips, const vndf_profile *profile, const float *knot, size_t knots,
                     size_t cells);
void vndf_strips_free(vndf_strips *strips);

/* ---- cells ---- */

/* x grows by h from the left knot; in the tail cell z falls as (1 - xi)^power, to 0. The numbers are the table's. */
typedef struct vndf_cell {
    double r, x, z, h;
    double power; /* 0: not the tail */
    double g0, g1, m0, m1, m2, cube;
} vndf_cell;

/* The cell of strips `first` to `end` - 1 and its numbers. Where less than floats can hold is in a cell, it gets a
 * little that is even. */
vndf_cell vndf_cell_measure(const vndf_profile *profile, const vndf_strips *strips, size_t first, size_t end,
                            unsigned squarings);

/* Where a cell is, without its numbers. */
vndf_cell vndf_cell_between(double from, double to, unsigned squarings);

/* xi of a slope in the cell. */
double vndf_cell_place(const vndf_cell *cell, double r);

/* What is drawn in a cell: its mass, and the densities per unit of xi at its ends. */
typedef struct vndf_drawn {
    double mass, d0, d1;
} vndf_drawn;

/* For W = w1 R^2 + w0 R. */
vndf_drawn vndf_drawn_by(const vndf_cell *cell, double w1, double w0);

/* From below the horizon, for a cell beyond rho or at rho: W = (R - rho) (b0 R + b1 (R - rho)). */
vndf_drawn vndf_drawn_below(const vndf_cell *cell, double rho, double b0, double b1);

/* The mass that is drawn before xi. */
static inline double vndf_drawn_before(const vndf_drawn *d, double xi)
{
    double w = xi * (1 - xi), under = d->mass + (d->d0 + d->d1 - 2 * d->mass) * w;
    return under > 0 ? d->mass * (d->mass * xi * xi + d->d0 * w) / under : 0;
}

/* The mass that is drawn per xi. */
static inline double vndf_drawn_density(const vndf_drawn *d, double xi)
{
    double w = xi * (1 - xi), under = d->mass + (d->d0 + d->d1 - 2 * d->mass) * w;
    return d->mass * d->mass * (d->d1 * xi * xi + 2 * d->mass * w + d->d0 * (1 - xi) * (1 - xi)) / (under * under);
}

/* ---- knots ----
 *
 * They are as far apart as an error of cells allows, which is chosen so that there are as many as wanted (knots.c). */

/* What is known at an edge of a strip. */
typedef struct vndf_rim {
    double z;        /* 1/(1 + R) */
    double s1, s2;   /* integrals of (R - edge) f and of (R - edge)^2 f/R beyond it */
    vndf_area area;  /* from the direction with this rho, s + c = 1, */
    int known, stop; /* if it was asked for; whether a knot has to stand there */
} vndf_rim;

typedef struct vndf_knots {
    const vndf_profile *profile;
    unsigned squarings;
    vndf_strips strips;
    vndf_rim *rim;
    double *xi;                    /* of the edges in the cell at hand */
    size_t first, last, deep;      /* edges: of the least and largest knot; of the largest rho that counts below */
    unsigned least, count;         /* how few knots there can be, how many there are, */
    size_t at[VNDF_CELLS_MAX + 1]; /* and their edges */
} vndf_knots;

/* For up to `most` knots. 0 if there is no memory; free them either way. */
int vndf_knots_from(vndf_knots *knots, const vndf_profile *profile, unsigned most);
void vndf_knots_free(vndf_knots *knots);

/* Places at most `count` knots, but no more than errors are worth. */
void vndf_knots_place(vndf_knots *knots, unsigned count);

/* The areas for rho at an edge. */
const vndf_area *vndf_knots_area(vndf_knots *knots, size_t edge);

/* ---- tables ---- */

/* The table on these knots, but for its texts, its certificate and what vndf_table_fill fills; NULL if there is no
 * memory. */
vndf_distribution *vndf_draft_from(vndf_knots *knots, unsigned moments);

/* Puts the floors of a certificate; 0 if there is no memory. */
int vndf_floor_measure(vndf_certificate *to, const vndf_profile *profile, unsigned moments);

/* How good a table is (certificate.c); 0 if there is no memory. */
int vndf_certificate_measure(vndf_certificate *certificate, const vndf_distribution *table,
                             const vndf_profile *profile);

#endif
