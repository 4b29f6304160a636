/* A table of format 5 once more, in double, from its bytes alone: what it draws, its D and its area, straight from
 * the definition and sharing no code with src/. Slow and plain: masses are added up cell by cell.
 *
 * The unit problem: slopes R of median 1, incident direction (s, 0, c), s >= 0, rho = |c|/s. In cell i, from knot R_i
 * to R_(i+1), a law is W(R) f/R dR with a polynomial W; it has the mass that the moments of the cell give, and
 * between the densities of both ends it runs as a rational quadratic (Gregory & Delbourgo 1982). Given R, the azimuth
 * has the density (c + s R cos a)+. A surface has slopes M u + mean, u of the table. */
#pragma once

#include "vndf.h"

typedef struct oracle_table {
    double scale;
    size_t cells, moments, squarings;
    double *knot, *g0, *g1, *m0, *m1, *m2, *cube, *b0, *b1, *area,
        *slope;      /* cells + 1 each; of cube zeros if moments < 4 */
    double *numbers; /* where all of them are */
} oracle_table;

/* Of a loaded or built table, from the bytes of its file; 0 after a message if they are none of format 5. */
int oracle_table_of(oracle_table *t, const vndf_distribution *distribution);
void oracle_table_free(oracle_table *t);

/* ---- one direction ---- */

/* Masses are those of the drawn law times its area; `first` is the cell of the switch, or below the horizon that of
 * rho, which begins at `part` of it. */
typedef struct oracle_law {
    const oracle_table *t;
    double s, c, rho, w[4], part, part_mass;
    size_t first;
    double drawn, area; /* projected areas: the drawn one, and the public one */
} oracle_law;

/* s and c of any length; areas are per that length. */
oracle_law oracle_law_from(const oracle_table *t, double s, double c);

/* The density of slopes (R, azimuth from wi), per area of the slope plane. */
double oracle_law_density(const oracle_law *law, double r, double azimuth);

/* P22 of the table, at canonical slope R. */
double oracle_table_p22(const oracle_table *t, double r);

/* integral over the circle of max(0, c + s cos a). */
double oracle_circle(double c, double s);
