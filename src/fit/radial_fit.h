/* Cells of the radial table for a profile. Knots are given by the canonical slope R in [0, inf]. */
#ifndef VNDF_FIT_RADIAL_FIT_H
#define VNDF_FIT_RADIAL_FIT_H

#include "fit/profile/profile.h"
#include "fit/refine.h"
#include "table/table.h"

/* A knot as the table holds it: floats with x + z = 1, and their slope. */
typedef struct vndf_fit_knot {
    float x, z;
    double r; /* x/z, infinite at the horizon */
    int jump; /* P jumps here: either cell takes the value on its side */
} vndf_fit_knot;

typedef struct vndf_radial_fit {
    const vndf_profile *profile;
    double below; /* weight of errors that only views from below the horizon see, */
    double fade;  /* and how it falls with what they see: power of vndf_profile_fade */
    double *jump; /* slopes where P jumps, ascending */
    size_t jump_count;
} vndf_radial_fit;

/* 0 if there is no memory. */
int vndf_radial_fit_from(vndf_radial_fit *fit, const vndf_profile *profile);
void vndf_radial_fit_free(vndf_radial_fit *fit);

vndf_fit_knot vndf_fit_knot_at(const vndf_radial_fit *fit, double r);

/* Halfway between two slopes in R/(1 + R): a vndf_interval_middle. */
double vndf_fit_middle(double a, double b);

/* f0, f1, mu0, mu1 of the cell between two knots; the cubic never falls below 0. */
vndf_radial_cell vndf_fit_cell(const vndf_radial_fit *fit, vndf_fit_knot a, vndf_fit_knot b);

/* A bound of what the cell from R = a to b adds to the total variation: together with the others where all normals
 * are drawn, alone where the cut below the horizon lies in it. A vndf_interval_error with a vndf_radial_fit. */
vndf_interval_miss vndf_fit_cell_error(double a, double b, void *fit);

#endif
