/* What GGX answers to sampler/law.h; A(-|w|) = S^2/(2 (L + U)), S the part of the stretched direction across, U along z
 * and L its length. */
#ifndef VNDF_SAMPLER_ANALYTIC_GGX_LAW_H
#define VNDF_SAMPLER_ANALYTIC_GGX_LAW_H

#include "math/vector.h"
#include "sampler/all_normals/slope.h"
#include "sampler/analytic/ggx_draw.h"
#include "sampler/analytic/view.h"
#include "sampler/analytic_density.h"
#include "sampler/tabulated/density.h"

/* ---- for one or for lanes ---- */

VNDF_INLINE doubles vndf_ggx_area_below(doubles across, doubles up)
{
    doubles across2 = across * across;
    return 0.5 * across2 / (doubles_root(across2 + up * up) + up);
}

/* a^3/(pi Q^2) over A = (L + U)/2, or S^2/(2 (L + U)) below the horizon. */
VNDF_INLINE doubles vndf_ggx_visible(const vndf_query *g, doubles facing)
{
    doubles a = g->wi.ax * g->wi.ay, x = g->wi.ay * g->x, y = g->wi.ax * g->y, z = a * g->z;
    doubles q = x * x + y * y + z * z, across = vndf_direction_across(&g->wi), s2 = across * across;
    doubles sum = doubles_root(s2 + g->wi.z * g->wi.z) + doubles_abs(g->wi.z);
    doubles_m below = doubles_less(g->wi.z, doubles_set(0.0)), seen = doubles_less(doubles_set(0.0), s2);
    doubles part = q * q * doubles_pick(below, s2, sum * sum);
    doubles visible = 2.0 * vndf_inverse_pi * (a * a * a) * (facing * sum) / part;
    return doubles_pick(doubles_without(below, seen), doubles_set(0.0), visible); /* straight down sees nothing */
}

/* A(w) for a unit w = (wx, wy, wz), wz > 0: 2 A = wz + |(ax wx, ay wy, wz)|; relative error below 2e-6. Where *trusted
 * is 0 it has to be computed otherwise. */
VNDF_INLINE lanes_f vndf_ggx_area_above(lanes_f ax, lanes_f ay, lanes_f wx, lanes_f wy, lanes_f wz,
                                        lanes_m *trusted)
{
    lanes_f x = ax * wx, y = ay * wy, across2 = x * x + y * y;
    *trusted = lanes_less(across2, lanes_set(VNDF_TRUST_GGX_ACROSS2));
    return 0.5f * (wz + lanes_root(across2 + wz * wz));
}

/* The same of the direction of a view. Clears *trusted where float is not trusted with the view. */
VNDF_INLINE lanes_f vndf_ggx_seen_area(lanes_f ax, lanes_f ay, lanes_f wx, lanes_f wy, lanes_f wz,
                                       lanes_m *trusted)
{
    lanes_m ready;
    vndf_ggx_incidence w = vndf_ggx_incidence_from(ax, ay, wx, wy, wz);
    lanes_f area = vndf_ggx_area_above(ax, ay, wx, wy, wz, &ready);
    *trusted = lanes_both(*trusted, lanes_both(ready, w.trusted));
    return area;
}

#if VNDF_LANES == 1

/* ---- views ---- */

/* A trusted one. */
VNDF_INLINE void vndf_ggx_view_put(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi,
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
    view->trusted = 1;
    view->of.ggx.x = w->x;
    view->of.ggx.y = w->y;
    view->of.ggx.c = w->c;
    view->of.ggx.q = w->q;
    view->of.ggx.spread = w->spread;
}

/* vndf_view_from; inline, since a call would be a tenth of its cost. */
VNDF_INLINE vndf_view vndf_ggx_view_from(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_ggx_incidence w = vndf_ggx_incidence_from(surface->alpha_x, surface->alpha_y, wi.x, wi.y, wi.z);
    if (!w.trusted)
        return vndf_analytic_view_exactly(surface, vndf_packed(wi));
    vndf_view view;
    vndf_ggx_view_put(&view, surface, wi, &w);
    return view;
}

/* The same in place. */
VNDF_INLINE void vndf_ggx_view_set(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_ggx_incidence w = vndf_ggx_incidence_from(surface->alpha_x, surface->alpha_y, wi.x, wi.y, wi.z);
    if (w.trusted)
        vndf_ggx_view_put(view, surface, wi, &w);
    else
        vndf_analytic_view_set_exactly(view, surface, vndf_packed(wi));
}

/* vndf_sample of a valid view, and the same where float is known not to be trusted. */
vndf_vec3 vndf_ggx_view_sample(const vndf_view *view, float u1, float u2, float *pdf);
vndf_vec3 vndf_ggx_view_sample_exactly(const vndf_view *view, float u1, float u2, float *pdf);

/* vndf_invert of a valid view, wm.z >= 0. */
void vndf_ggx_view_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2);

/* ---- all normals ---- */

VNDF_INLINE vndf_slope vndf_ggx_slope(float u)
{
    float rest = 1.0f - u, z = sqrtf(rest > VNDF_LEAST_REST ? rest : VNDF_LEAST_REST);
    vndf_slope r = {sqrtf(u), z, 0.318309886f * z, u < 1.0f};
    return r;
}

#endif
#endif
