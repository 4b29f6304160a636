/* Bounded visible normals of GGX; ggx.c has the mathematics and draws for any direction, ggx_draw.h in float
 * where that is trusted. */
#ifndef VNDF_SAMPLER_BOUNDED_GGX_H
#define VNDF_SAMPLER_BOUNDED_GGX_H

#include "sampler/bounded/disc.h"

void vndf_bound_ggx(const vndf_view *view, struct vndf_ggx_bounds *bounds);
vndf_bounded vndf_bounded_ggx(const vndf_view *view, const struct vndf_ggx_bounds *bounds, float u1, float u2);
vndf_bounded_factors vndf_bounded_ggx_at(const vndf_view *view, const struct vndf_ggx_bounds *bounds,
                                         vndf_normal wm, double facing);

/* The first two where float is not good enough. */
void vndf_bound_ggx_exactly(const vndf_view *view, struct vndf_ggx_bounds *bounds);
vndf_bounded vndf_bounded_ggx_exactly(const vndf_view *view, const struct vndf_ggx_bounds *bounds, float u1,
                                      float u2);

#endif
