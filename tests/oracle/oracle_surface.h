/* A surface with slopes s = M u + mean, u of a table, a closed form or a formula of oracle.h, in double: D, area, and
 * both visible densities, true (max(0, wi.wm) D/A) and drawn. Directions count, not their lengths. */
#ifndef TESTS_ORACLE_ORACLE_SURFACE_H
#define TESTS_ORACLE_ORACLE_SURFACE_H

#include "oracle/oracle.h"
#include "oracle/oracle_table.h"

typedef enum oracle_kind {
    ORACLE_KIND_GGX,
    ORACLE_KIND_BECKMANN,
    ORACLE_KIND_TABLE,
    ORACLE_KIND_FORMULA
} oracle_kind;

/* What u is. */
typedef struct oracle_slopes {
    oracle_kind kind;
    const oracle_table *table;
    const oracle *formula;
} oracle_slopes;

typedef struct oracle_surface {
    oracle_slopes of;
    double xx, xy, yx, yy, mean_x, mean_y; /* of a table times its scale */
} oracle_surface;

/* The matrix and the mean slope of `shape`; its distribution is not read. */
oracle_surface oracle_surface_from(oracle_slopes of, const vndf_affine *shape);

/* The unit problem: wi stretched is (s, 0, c), and (x, y) its unit part across, which azimuths are counted from. */
typedef struct oracle_look {
    double s, c, x, y;
} oracle_look;
oracle_look oracle_look_from(const oracle_surface *surface, const double wi[3]);

double oracle_surface_ndf(const oracle_surface *surface, const double wm[3]);
double oracle_surface_area(const oracle_surface *surface, const double w[3]);

/* The area of what is drawn, by which mixtures share; of the closed forms and formulas the true one. */
double oracle_surface_drawn_area(const oracle_surface *surface, const double w[3]);

/* The density per steradian with which wm is drawn; of the closed forms and formulas the true one. */
double oracle_surface_drawn(const oracle_surface *surface, const double wi[3], const double wm[3]);
double oracle_surface_visible(const oracle_surface *surface, const double wi[3], const double wm[3]);

#endif
