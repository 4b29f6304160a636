/* Slow references for the tests, in double and sharing no code with src/: the distributions they use, written
 * out once more, with quadrature of their own (tanh-sinh panels; Takahasi & Mori, "Double exponential
 * formulas for numerical integration", Publ. RIMS Kyoto 9, 1974).
 *
 * The unit problem: incident direction (s, 0, c) of any length, roughness 1. Slopes in polar form (r, a) with
 * normals ~ (r cos a, r sin a, 1), so that the visible density in slope area is
 * P22(r) max(0, c + s r cos a) / A(s, c). */
#ifndef TESTS_ORACLE_ORACLE_H
#define TESTS_ORACLE_ORACLE_H

#include <stddef.h>

#include "vndf_build.h"

typedef struct oracle {
    const char *name;          /* how the builder gets it: a family, or a formula of slopes */
    double (*shape)(double r); /* P22 up to a factor */
    double breaks[2];          /* slopes where it jumps or has a kink, ascending; 0: none */
    double peak, reach;        /* slopes below and beyond which less than 1e-12 of the mass lies */
    int rough;                 /* a ring or a jump: ten times the error is allowed */
    double norm;               /* P22 = norm shape, integral P22 r dr = 1/(2 pi) */
} oracle;

/* In the order of oracle_get. */
enum {
    ORACLE_GGX,
    ORACLE_BECKMANN,
    ORACLE_STUDENT,
    ORACLE_LAPLACE,
    ORACLE_MEASURED,
    ORACLE_HAZE,
    ORACLE_RING,
    ORACLE_DISC,
    ORACLE_COUNT
};

oracle oracle_get(size_t index);

/* A family or a formula of slopes, and its table of at most max_bytes (0: the default). NULL, and `error` says why;
 * of a table a line is printed where that is NULL. Free with vndf_source_free and vndf_free. */
vndf_source *oracle_source(const char *text, vndf_error *error);
vndf_distribution *oracle_build(const char *text, size_t max_bytes, vndf_certificate *claim, vndf_error *error);

/* A table of tables/ by its name without .vndf, or NULL after printing why. Free with vndf_free. */
vndf_distribution *oracle_shipped(const char *name);

double oracle_p22(const oracle *o, double r);

/* integral over slopes of P22 max(0, c + s r cos a): relative error below 1e-9 where it exceeds 1e-200. */
double oracle_area(const oracle *o, double s, double c);

/* wi at theta and phi in degrees; exactly horizontal at 90. */
vndf_vec3 oracle_direction(double theta, double phi);

/* Whether a test program is to do its part `index`: without arguments every part, else the one whose number or
 * name is its first argument. test_mutants.cmake asks for single parts. */
int oracle_wanted(int arguments, char **argument, size_t index, const char *name);

#endif
