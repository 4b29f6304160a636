/* Views of closed forms: in float where that is plain (ggx_draw.h, beckmann_draw.h), else from doubles. A view holds
 * what drawing in float takes and nothing else: what doubles take is made of wi and the roughness, as they were
 * given, each time. Here is what the closed forms share. */
#ifndef VNDF_SAMPLER_ANALYTIC_VIEW_H
#define VNDF_SAMPLER_ANALYTIC_VIEW_H

#include "sampler/frame.h"

#if VNDF_LANES == 1

/* vndf_view_from of a surface with a distribution where float does not do, or for what is invalid. */
vndf_view vndf_analytic_view_exactly(const vndf_surface *surface, vndf_vec3 wi);

/* The same in place. */
void vndf_analytic_view_set_exactly(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi);

/* A normal that rounding has turned away from wi, turned back. */
vndf_vec3 vndf_analytic_turned_back(const vndf_frame *frame, vndf_vec3 wm);

/* The normal of one that was drawn in the unit problem. */
VNDF_INLINE vndf_vec3 vndf_analytic_normal(const vndf_frame *f, vndf_vec3 n)
{
    vndf_vec3 wm = vndf_normalize(vndf_from_unit(f, n));
    if (!(vndf_exact_dot(f->wi, wm) > 0.0))
        wm = vndf_analytic_turned_back(f, vndf_packed(wm));
    return wm;
}

#endif
#endif
