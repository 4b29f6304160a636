/* Views of closed forms: in float where that is trusted (ggx_draw.h, beckmann_draw.h), else from doubles. A view holds
 * the numbers that drawing in float reads, and no others: doubles are formed from wi and the roughness each time. The
 * closed forms share these functions. */
#ifndef VNDF_SAMPLER_ANALYTIC_VIEW_H
#define VNDF_SAMPLER_ANALYTIC_VIEW_H

#include "sampler/frame.h"

#if VNDF_LANES == 1

/* vndf_view_from of a surface with a distribution where float is not trusted, or of an invalid one. */
vndf_view vndf_analytic_view_exactly(const vndf_surface *surface, vndf_vec3 wi);

/* The same in place. */
void vndf_analytic_view_set_exactly(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi);

/* A normal that rounding has turned away from wi, turned back. */
vndf_vec3 vndf_analytic_turned_back(const vndf_frame *frame, vndf_vec3 wm);

/* Turns a normal of the unit problem into one of the view. */
VNDF_INLINE vndf_vec3 vndf_analytic_normal(const vndf_frame *f, vndf_vec3 n)
{
    vndf_vec3 wm = vndf_normalize(vndf_from_unit(f, n));
    if (!(vndf_exact_dot(f->wi, wm) > 0.0))
        wm = vndf_analytic_turned_back(f, vndf_packed(wm));
    return wm;
}

#endif
#endif
