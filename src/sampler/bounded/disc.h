/* What the bounded laws share (bounded.h): the disc of normals that reflect wi to above the horizon. */
#ifndef VNDF_SAMPLER_BOUNDED_DISC_H
#define VNDF_SAMPLER_BOUNDED_DISC_H

#include "sampler/closed.h"

/* A normal, its density per steradian within [FLT_MIN, FLT_MAX], and `kept` in [FLT_MIN, 1]: the density is that
 * of vndf_pdf over it, to 1e-5. */
typedef struct vndf_bounded {
    vndf_vec3 wm;
    float density, kept;
} vndf_bounded;

/* The two factors of the density (2) of a normal in the disc. */
typedef struct vndf_bounded_factors {
    double visible, kept;
} vndf_bounded_factors;

/* The normal of one that was drawn, of any length: turned into the disc if rounding has put it outside. */
vndf_vec3 vndf_disc_normal(const vndf_view *view, vndf_normal drawn);

/* The density of a normal in the disc, and the sample that it is. */
double vndf_bounded_density(vndf_bounded_factors at);
vndf_bounded vndf_bounded_from(vndf_vec3 wm, vndf_bounded_factors at);

#endif
