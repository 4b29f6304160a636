/* Views of closed forms: in float where that is plain (ggx_draw.h, beckmann_draw.h), else from doubles. A view holds
 * what drawing in float takes and nothing else: what doubles take is made of wi and the roughness, as they were
 * given, each time. Here is what the closed forms share. */
#ifndef VNDF_SAMPLER_ANALYTIC_VIEW_H
#define VNDF_SAMPLER_ANALYTIC_VIEW_H

#include "vndf.h"

/* vndf_view_from where float does not do, or for what is invalid. */
vndf_view vndf_closed_view_carefully(const vndf_surface *surface, vndf_vec3 wi);

struct vndf_frame; /* sampler/frame.h */

/* The normal of one that was drawn in the unit problem, turned back to wi where rounding has turned it away. */
vndf_vec3 vndf_closed_normal(const struct vndf_frame *frame, vndf_vec3 n);

#endif
