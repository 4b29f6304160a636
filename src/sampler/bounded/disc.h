/* The disc of normals that reflect wi to above the horizon (bounded.h): all bounded laws use it. */
#ifndef VNDF_SAMPLER_BOUNDED_DISC_H
#define VNDF_SAMPLER_BOUNDED_DISC_H

#include "sampler/analytic_density.h"

/* A normal, its density per steradian within [FLT_MIN, FLT_MAX], and `inside_mass`, the part of the visible normals of
 * its line that reflect to above the horizon, in [FLT_MIN, 1]: the density is that of vndf_pdf over it, to 1e-5. */
typedef struct vndf_bounded {
    vndf_vec3 wm;
    float density, inside_mass;
    float weight; /* of a table as for vndf_sample_weight; 0 where it is not known */
} vndf_bounded;

/* The two factors of the density (2) of a normal in the disc. */
typedef struct vndf_bounded_factors {
    double visible, inside_mass;
} vndf_bounded_factors;

/* Rounds a drawn normal of any length, and turns it into the disc if rounding has put it outside. */
vndf_vec3 vndf_disc_normal(const vndf_view *view, vndf_normal drawn);

/* The density of a normal in the disc, and the sample that it is. */
double vndf_bounded_density(vndf_bounded_factors at);
vndf_bounded vndf_bounded_from(vndf_vec3 wm, vndf_bounded_factors at);

#endif
