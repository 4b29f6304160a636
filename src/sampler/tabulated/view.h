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

/* vndf_view_from as far as float does: what is plain and ready is valid, and nothing else has to be looked at. */
VNDF_INLINE int vndf_table_view_try(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    const vndf_distribution *d = surface->distribution;
    float scale = vndf_unit_scale_float(d), x = surface->alpha_x * scale, y = surface->alpha_y * scale;
    lanes_m ready = 1;
    vndf_aim aim = vndf_aim_at(d, x * wi.x, y * wi.y, wi.z, &ready);
    if (!(ready & vndf_trusts_scale(x, y, aim.c)))
        return 0;
    double exact = vndf_unit_scale(d);
    vndf_table_view_put(view, d, surface->alpha_x * exact, surface->alpha_y * exact, x, y, wi, &aim);
    return 1;
}

VNDF_INLINE vndf_view vndf_table_view_from(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_view view;
    if (!vndf_table_view_try(&view, surface, wi))
        return vndf_table_view_exactly(surface, vndf_packed(wi));
    return view;
}

/* The same in place. */
void vndf_table_view_set(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi);

#endif
#endif
