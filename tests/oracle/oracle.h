/* Slow references for the tests, in double and sharing no code with src/: the distributions they use, written out once
 * more.
 *
 * The unit problem: incident direction (s, 0, c) of any length, roughness 1. Slopes in polar form (r, a) with normals ~
 * (r cos a, r sin a, 1), so that the visible density in slope area is P22(r) max(0, c + s r cos a) / A(s, c). */
#pragma once

#include "oracle/oracle_table.h"
#include "vndf_build.h"

/* The shapes, in the order of oracle_get; that of a table is ORACLE_COUNT. */
enum { ORACLE_GGX, ORACLE_BECKMANN, ORACLE_STUDENT, ORACLE_LAPLACE, ORACLE_MEASURED, ORACLE_HAZE };
enum { ORACLE_RING = ORACLE_HAZE + 1, ORACLE_DISC, ORACLE_COUNT };

typedef struct oracle {
    const char *name; /* how the builder gets it: a family, or a formula of slopes */
    int shape;
    const oracle_table *table; /* its slopes are over the median; it has a shape and a table alone */
    int rough;                 /* a ring or a jump: ten times the error is allowed */
    double norm;               /* P22 = norm times the shape, integral P22 r dr = 1/(2 pi) */
} oracle;

oracle oracle_get(size_t index);

/* A family or a formula of slopes, and its table of at most max_bytes (0: the default). NULL, and `error` says why;
 * of a table a line is printed where that is NULL. Free with vndf_source_free and vndf_free. */
vndf_source *oracle_source(const char *text, vndf_error *error);
vndf_distribution *oracle_build(const char *text, size_t max_bytes, vndf_certificate *claim, vndf_error *error);

/* A table of tables/ by its name without .vndf, or NULL after printing why. Free with vndf_free. */
vndf_distribution *oracle_shipped(const char *name);

double oracle_p22(const oracle *o, double r);

/* integral over slopes of P22 max(0, c + s r cos a), s and c of any length, of tables and closed forms. GGX: Walter et
 * al. 2007, equation 33, Lambda = (sqrt(1 + 1/a^2) - 1)/2, a = 1/(alpha tan). Beckmann: equation 25, Lambda = (erf(a) -
 * 1)/2 + exp(-a^2)/(2 a sqrt(pi)) (both from Heitz 2014), written as areas. */
double oracle_area(const oracle *o, double s, double c);

/* ---- surfaces ---- */

/* Slopes s = M u + mean, u of a distribution: D, area, and both visible densities, true (max(0, wi.wm) D/A) and drawn.
 * Directions count, not their lengths. */
typedef struct oracle_surface {
    oracle of;                             /* what u is */
    double xx, xy, yx, yy, mean_x, mean_y; /* of a table times its scale */
} oracle_surface;

/* The matrix and the mean slope of `shape`; its distribution is not read. */
oracle_surface oracle_surface_from(const oracle *of, const vndf_surface *shape);

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

/* ---- for tests ---- */

/* A matrix with these singular values, turned before and after. */
vndf_surface oracle_turned(const vndf_distribution *d, double a, double b, double before, double after);

/* wi at theta and phi in degrees; exactly horizontal at 90. */
vndf_vec3 oracle_direction(double theta, double phi);

/* Whether a test program is to do its part `index`: without arguments every part, else the one whose number or
 * name is its first argument. mutants.py asks for single parts. */
int oracle_wanted(int arguments, char **argument, size_t index, const char *name);
