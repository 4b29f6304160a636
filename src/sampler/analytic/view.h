/* The calls on a view of a closed form; view.c hands over. Uniform numbers are in [0, 1]. */
#ifndef VNDF_SAMPLER_ANALYTIC_VIEW_H
#define VNDF_SAMPLER_ANALYTIC_VIEW_H

#include "sampler/analytic/ggx_draw.h"
#include "vndf.h"

/* vndf_view_from. */
vndf_view vndf_beckmann_view_from(const vndf_surface *surface, vndf_vec3 wi);

/* The same of any closed form where float does not do, or for what is invalid. */
vndf_view vndf_closed_view_carefully(const vndf_surface *surface, vndf_vec3 wi);

/* Where float does: in the caller, as a call costs a tenth of it. */
VNDF_INLINE vndf_view vndf_ggx_view_of(const vndf_surface *surface, vndf_vec3 wi, const vndf_ggx_incidence *w)
{
    vndf_view view = {.distribution = surface->distribution,
                      .wi = wi,
                      .alpha_x = w->ax,
                      .alpha_y = w->ay,
                      .ax = w->ax,
                      .ay = w->ay,
                      .plain = 1,
                      .closed = {w->x, w->y, w->c, w->q, w->spread}};
    return view;
}

/* The same in place, but for what GGX does not read. */
VNDF_INLINE void vndf_ggx_view_set(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi,
                                   const vndf_ggx_incidence *w)
{
    view->distribution = surface->distribution;
    view->wi.x = wi.x;
    view->wi.y = wi.y;
    view->wi.z = wi.z;
    view->alpha_x = w->ax;
    view->alpha_y = w->ay;
    view->ax = w->ax;
    view->ay = w->ay;
    view->plain = 1;
    view->closed[0] = w->x;
    view->closed[1] = w->y;
    view->closed[2] = w->c;
    view->closed[3] = w->q;
    view->closed[4] = w->spread;
}

/* Gives a view its direction as that of a table has it, but s^2 + c^2 = 1: what unit problems are given. */
void vndf_closed_turn(vndf_view *view);

/* vndf_sample of a valid view, and the same where densities in float are known not to do. */
vndf_vec3 vndf_ggx_view_sample(const vndf_view *view, float u1, float u2, float *pdf);
vndf_vec3 vndf_beckmann_view_sample(const vndf_view *view, float u1, float u2, float *pdf);
vndf_vec3 vndf_closed_sample_carefully(const vndf_view *view, float u1, float u2, float *pdf);

/* vndf_invert of a valid view, wm.z >= 0, but for clamping. */
void vndf_closed_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2);

#endif
