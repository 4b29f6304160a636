/* Views of tables. */
#ifndef VNDF_SAMPLER_TABULATED_VIEW_H
#define VNDF_SAMPLER_TABULATED_VIEW_H

#include "math/vector.h"
#include "sampler/surface.h"
#include "sampler/tabulated/aim.h"

#if VNDF_LANES == 1

/* Members are written once, each by itself: what is read soon after must not wait for wider stores. */
VNDF_INLINE void vndf_table_view_put(vndf_view *view, const vndf_distribution *d, double ax, double ay, float x,
                                     float y, vndf_vec3 wi, const vndf_aim *aim)
{
    view->distribution = d;
    view->wi.x = wi.x;
    view->wi.y = wi.y;
    view->wi.z = wi.z;
    view->alpha_x = ax;
    view->alpha_y = ay;
    view->ax = x;
    view->ay = y;
    view->plain = vndf_trusts_scale(x, y, aim->c);
    view->of.table.s = aim->s;
    view->of.table.c = aim->c;
    view->of.table.cos_phi = aim->cos_phi;
    view->of.table.sin_phi = aim->sin_phi;
    view->of.table.front = aim->front;
    view->of.table.wedge = aim->wedge;
    view->of.table.area = aim->area;
    view->of.table.spread = aim->area * (x * y);
}

/* Of a usable direction, for roughness times the table's scale. */
vndf_view vndf_table_view_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi);

/* vndf_view_from where float does not do, or for what is invalid. */
vndf_view vndf_table_view_exactly(const vndf_surface *surface, vndf_vec3 wi);

/* Roughness as it is drawn with, and the aim; whether float does. Then the view is valid, and nothing else has to be
 * looked at. */
VNDF_INLINE int vndf_table_aims(const vndf_surface *surface, vndf_vec3 wi, float *x, float *y, vndf_aim *aim)
{
    const vndf_distribution *d = surface->distribution;
    float scale = vndf_unit_scale_float(d);
    lanes_m ready = 1;
    *x = surface->alpha_x * scale;
    *y = surface->alpha_y * scale;
    *aim = vndf_aim_at(d, *x * wi.x, *y * wi.y, wi.z, &ready);
    return ready & vndf_trusts_scale(*x, *y, aim->c);
}

VNDF_INLINE vndf_view vndf_table_view_from(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_aim aim;
    vndf_view view;
    float x, y;
    if (!vndf_table_aims(surface, wi, &x, &y, &aim))
        return vndf_table_view_exactly(surface, wi);
    double scale = vndf_unit_scale(surface->distribution);
    vndf_table_view_put(&view, surface->distribution, surface->alpha_x * scale, surface->alpha_y * scale, x, y, wi,
                        &aim);
    return view;
}

/* The same in place. */
void vndf_table_view_set(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi);

#endif
#endif
