/* Bounded visible normals of Beckmann; beckmann.c has the mathematics. */
#ifndef VNDF_SAMPLER_BOUNDED_BECKMANN_H
#define VNDF_SAMPLER_BOUNDED_BECKMANN_H

#include "sampler/bounded/disc.h"

void vndf_bound_beckmann(const vndf_view *view, struct vndf_beckmann_bounds *bounds);
vndf_bounded vndf_bounded_beckmann(const vndf_view *view, const struct vndf_beckmann_bounds *bounds, float u1,
                                   float u2);
vndf_bounded_factors vndf_bounded_beckmann_at(const vndf_view *view, const struct vndf_beckmann_bounds *bounds,
                                              vndf_normal wm, double facing);

#endif
