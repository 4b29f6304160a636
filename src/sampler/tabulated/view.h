/* Views of tables. */
#ifndef VNDF_SAMPLER_TABULATED_VIEW_H
#define VNDF_SAMPLER_TABULATED_VIEW_H

#include "math/vector.h"
#include "sampler/surface.h"
#include "sampler/tabulated/stretched_view.h"

#if VNDF_LANES == 1

/* Writes each member once and by itself: a read soon after must not wait for a wider store. */
VNDF_INLINE void vndf_table_view_put(vndf_view *view, const vndf_distribution *d, double ax, double ay, float x,
                                     float y, vndf_vec3 wi, const vndf_stretched_view *stretched)
{
    view->distribution = d;
    view->wi.x = wi.x;
    view->wi.y = wi.y;
    view->wi.z = wi.z;
    view->alpha_x = ax;
    view->alpha_y = ay;
    view->ax = x;
    view->ay = y;
    view->trusted = vndf_trusts_scale(x, y, stretched->c);
    view->of.table.s = stretched->s;
    view->of.table.c = stretched->c;
    view->of.table.cos_phi = stretched->cos_phi;
    view->of.table.sin_phi = stretched->sin_phi;
    view->of.table.front = stretched->front;
    view->of.table.wedge = stretched->wedge;
    view->of.table.area = stretched->area;
    view->of.table.spread = stretched->area * (x * y);
}

/* The view of a usable direction for roughness times the table's scale. */
vndf_view vndf_table_view_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi);

/* vndf_view_from where float does not do, or the input is invalid. */
vndf_view vndf_table_view_exactly(const vndf_surface *surface, vndf_vec3 wi);

/* Roughness times scale, and the stretched view. Returns whether float is trusted; then the view is valid, and the
 * caller checks nothing else. */
VNDF_INLINE int vndf_table_stretches(const vndf_surface *surface, vndf_vec3 wi, float *x, float *y,
                                     vndf_stretched_view *stretched)
{
    const vndf_distribution *d = surface->distribution;
    float scale = vndf_unit_scale_float(d);
    lanes_m trusted = 1;
    *x = surface->alpha_x * scale;
    *y = surface->alpha_y * scale;
    *stretched = vndf_stretched_view_at(d, *x * wi.x, *y * wi.y, wi.z, &trusted);
    return trusted & vndf_trusts_scale(*x, *y, stretched->c);
}

VNDF_INLINE vndf_view vndf_table_view_from(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_stretched_view stretched;
    vndf_view view;
    float x, y;
    if (!vndf_table_stretches(surface, wi, &x, &y, &stretched))
        return vndf_table_view_exactly(surface, wi);
    double scale = vndf_unit_scale(surface->distribution);
    vndf_table_view_put(&view, surface->distribution, surface->alpha_x * scale, surface->alpha_y * scale, x, y, wi,
                        &stretched);
    return view;
}

/* The same in place. */
void vndf_table_view_set(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi);

#endif
#endif
