/* What the files of bounded GGX share: ggx.c has the mathematics and any direction, ggx_draw.h
 * those of plain size, in float. */
#ifndef VNDF_SAMPLER_BOUNDED_GGX_H
#define VNDF_SAMPLER_BOUNDED_GGX_H

#include "sampler/bounded/bounded.h"

/* What of a direction is in `bounds`, unless it is plain: the part of psi in front; kept over those of the roots,
 * in front and in the wedge; where u1 begins and the part of it that tangents leave, 1 for all. */
enum { VNDF_GGX_FRONT, VNDF_GGX_IN_FRONT, VNDF_GGX_IN_WEDGE, VNDF_GGX_BEGIN, VNDF_GGX_SPAN };

void vndf_bounds_ggx_carefully(const vndf_view *view, double bounds[VNDF_BOUNDS]);
vndf_bounded vndf_bounded_ggx_carefully(const vndf_view *view, const double bounds[VNDF_BOUNDS], float u1,
                                        float u2);

#endif
