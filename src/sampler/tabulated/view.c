#include "sampler/tabulated/view.h"

#include "sampler/frame.h"
#include "sampler/nearest.h"
#include "sampler/tabulated/inverse.h"
#include "sampler/tabulated/law.h"

/* In double, where float does not do: below the horizon, along z, at extremes. The mass below may underflow, so `wedge`
 * is its part of the whole there. */
VNDF_RARE vndf_stretched_view stretched_exactly(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi)
{
    vndf_stretched w = vndf_stretch(wi, ax, ay, VNDF_LENGTH_SUM);
    vndf_heading to = vndf_heading_of(&w);
    vndf_stretched_view stretched = {(float)w.s, (float)w.c, (float)to.cosine, (float)to.sine, 0, 0, 0};
    double mass = vndf_wedge_mass(vndf_wedge_of(d, w.c), vndf_wedge_y(w.s, w.c));
    double front = w.c >= 0.0 ? w.c * (d->f0_total * VNDF_QUARTER_TURN) + w.s * d->f1_total : 0.0;
    stretched.front = (float)front;
    stretched.area = (float)(2.0 * (front + mass));
    stretched.wedge = w.c >= 0.0 ? (float)mass : w.s > 0.0 ? 1.0f : 0.0f;
    return stretched;
}

/* The view for roughness times the table's scale: in double, and as draws use it in float. */
static vndf_view view_scaled(const vndf_distribution *d, double ax, double ay, float x, float y, vndf_vec3 wi)
{
    lanes_m trusted = 1;
    vndf_stretched_view stretched = vndf_stretched_view_at(d, x * wi.x, y * wi.y, wi.z, &trusted);
    vndf_view view;
    if (!trusted)
        stretched = stretched_exactly(d, ax, ay, wi);
    vndf_table_view_put(&view, d, ax, ay, x, y, wi, &stretched);
    return view;
}

vndf_view vndf_table_view_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi)
{
    return view_scaled(d, ax, ay, (float)ax, (float)ay, wi);
}

vndf_view vndf_table_view_exactly(const vndf_surface *surface, vndf_vec3 wi)
{
    double ax, ay;
    if (!vndf_surface_scaled(surface, &ax, &ay) || !vndf_is_usable_direction(wi))
        return vndf_invalid_view();
    float scale = vndf_unit_scale_float(surface->distribution); /* lanes have no double */
    float x = scale > 0.0f ? surface->alpha_x * scale : (float)ax;
    float y = scale > 0.0f ? surface->alpha_y * scale : (float)ay;
    return view_scaled(surface->distribution, ax, ay, x, y, wi);
}

void vndf_table_view_set(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    const vndf_distribution *d = surface->distribution;
    vndf_stretched_view stretched;
    float x, y;
    if (vndf_table_stretches(surface, wi, &x, &y, &stretched))
        vndf_table_view_put(view, d, surface->alpha_x * d->scale, surface->alpha_y * d->scale, x, y, wi,
                            &stretched);
    else
        *view = vndf_table_view_exactly(surface, vndf_packed(wi));
}

/* ---- inverse ---- */

/* What inverse.h finds for a view that draws in float. */
static vndf_inverse inverse_of(const vndf_view *view, vndf_vec3 wm)
{
    const struct vndf_table_view *of = &view->of.table;
    const vndf_inverse_view w = {of->s, of->c, of->front, of->wedge};
    const vndf_inverse_frame frame = {view->ax, view->ay, of->cos_phi, of->sin_phi};
    vndf_turned n = vndf_turned_of(&frame, wm.x, wm.y, wm.z);
    vndf_inverse none = {0.0, 0.0, 0, 0};
    if (!view->trusted || !vndf_turned_is_valid(&n))
        return none;
    return n.x >= 0.0 ? vndf_inverse_in_front(view->distribution, &w, &n)
                      : vndf_inverse_in_wedge(view->distribution, &w, &n);
}

/* The same by the exact tier, for every view. Returns whether the numbers are sure. */
VNDF_RARE int invert_exactly(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    vndf_frame frame = vndf_table_frame(view);
    int sure = vndf_engine_invert(view, vndf_to_unit(&frame, wm), u1, u2);
    *u1 = vndf_clamp_unit(*u1);
    *u2 = vndf_clamp_unit(*u2);
    return sure;
}

/* Where some steps of 2^-24 matter and wi sees wm, the search finds numbers that really give wm. */
void vndf_table_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    vndf_inverse inverse = inverse_of(view, wm);
    *u1 = (float)inverse.u1;
    *u2 = (float)inverse.u2;
    int sure = inverse.trusted ? inverse.sure : invert_exactly(view, wm, u1, u2);
    if (!sure && vndf_exact_dot(view->wi, wm) > 0.0)
        vndf_nearest(view, wm, u1, u2);
}
