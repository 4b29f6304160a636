/* Closed forms: views and samples in float where that is plain (ggx_draw.h), else from doubles. A view holds what
 * drawing in float takes and nothing else: what doubles take is made of wi and the roughness, as they were given,
 * each time. */
#include "sampler/analytic/view.h"

#include "math/vector.h"
#include "sampler/all_normals/all_normals.h"
#include "sampler/analytic/beckmann.h"
#include "sampler/analytic/beckmann_draw.h"
#include "sampler/frame.h"
#include "sampler/analytic/ggx.h"
#include "sampler/analytic/ggx_draw.h"
#include "sampler/stretch.h"
#include "sampler/surface.h"

/* ---- views ---- */

vndf_view vndf_closed_view_carefully(const vndf_surface *surface, vndf_vec3 wi)
{
    double ax, ay;
    if (!vndf_surface_scaled(surface, &ax, &ay) || !vndf_is_usable_direction(wi))
        return vndf_invalid_view();
    vndf_view view = {.distribution = surface->distribution,
                      .wi = wi,
                      .alpha_x = ax,
                      .alpha_y = ay,
                      .ax = surface->alpha_x,
                      .ay = surface->alpha_y};
    return view;
}

vndf_view vndf_beckmann_view_from(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_beckmann_incidence w = vndf_beckmann_aim(surface->alpha_x, surface->alpha_y, wi.x, wi.y, wi.z);
    if (!w.plain)
        return vndf_closed_view_carefully(surface, wi);
    vndf_view view = {
        .distribution = surface->distribution,
        .wi = wi,
        .alpha_x = w.ax,
        .alpha_y = w.ay,
        .ax = w.ax,
        .ay = w.ay,
        .plain = 1,
        .closed = {w.cos_phi, w.sin_phi, w.bound, w.line, w.tail, w.spread, w.near, w.p0, w.p1, w.p2, w.p3, w.p4}};
    return view;
}

void vndf_closed_turn(vndf_view *view)
{
    vndf_stretched w = vndf_stretched_of(view);
    double across = sqrt(w.x * w.x + w.y * w.y), per = across > 0.0 ? 1.0 / across : 0.0;
    view->s = (float)w.s;
    view->c = (float)w.c;
    view->cos_phi = across > 0.0 ? (float)(w.x * per) : 1.0f;
    view->sin_phi = (float)(w.y * per);
}

static vndf_view turned(const vndf_view *view)
{
    vndf_view unit = *view;
    vndf_closed_turn(&unit);
    return unit;
}

/* ---- the inverse ---- */

void vndf_closed_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    vndf_view unit = turned(view);
    vndf_normal n = vndf_normal_to_unit(&unit, wm);
    if (view->distribution->kind == VNDF_KIND_GGX)
        vndf_ggx_invert(unit.s, unit.c, n, u1, u2);
    else
        vndf_beckmann_invert(unit.s, unit.c, n, u1, u2);
}

/* ---- sampling ---- */

/* Below the horizon: wm.z is above `highest`, where wi sees nothing, by a few roundings of its own. It is lowered,
 * or where that would show in the length, what is across raised: a step that is small only beside 1 would leave
 * the lobe of a Beckmann. */
static vndf_vec3 turn_below(vndf_vec3 wi, vndf_vec3 wm, double highest)
{
    double factor = wm.z / highest * (1.0 + 0x1.8p-23);
    vndf_vec3 wide = {(float)(wm.x * factor), (float)(wm.y * factor), wm.z};
    if (wm.z > 0.75f && factor > 1.0 + 0x1.8p-22 && vndf_exact_dot(wi, wide) > 0.0)
        return wide;
    wm.z = fminf(wm.z, (float)(highest * (1.0 - 0x1p-23)));
    return wm;
}

/* A normal that rounding has turned away, turned back. */
static vndf_vec3 turn_closed(const vndf_view *unit, vndf_vec3 wm)
{
    double level = (double)unit->wi.x * wm.x + (double)unit->wi.y * wm.y, highest = level / -(double)unit->wi.z;
    if (unit->wi.z < 0.0f && highest > wm.z * (1.0 - 0x1p-21))
        wm = turn_below(unit->wi, wm, highest);
    return vndf_exact_dot(unit->wi, wm) > 0.0 ? wm : vndf_turn_to_face(unit, wm);
}

vndf_vec3 vndf_closed_sample_carefully(const vndf_view *view, float u1, float u2, float *pdf)
{
    if (view->wi.x == 0.0f && view->wi.y == 0.0f && view->wi.z > 0.0f && view->distribution->kind == VNDF_KIND_GGX)
        return vndf_sample_all(view->distribution, view->alpha_x, view->alpha_y, u1, u2, pdf); /* the same there */
    vndf_view unit = turned(view);
    vndf_vec3 n = view->distribution->kind == VNDF_KIND_GGX ? vndf_ggx_sample(unit.s, unit.c, u1, u2)
                                                            : vndf_beckmann_sample(unit.s, unit.c, u1, u2);
    vndf_vec3 wm = vndf_normalize(vndf_from_unit(&unit, n));
    if (!(vndf_exact_dot(view->wi, wm) > 0.0))
        wm = turn_closed(&unit, wm);
    if (pdf)
        *pdf = vndf_pdf(view, wm);
    return wm;
}

vndf_vec3 vndf_ggx_view_sample(const vndf_view *view, float u1, float u2, float *pdf)
{
    vndf_ggx_incidence w = vndf_ggx_incidence_of(view);
    lanes_m plain;
    vndf_drawn n = vndf_ggx_draw(&w, u1, u2, &plain);
    if (!plain)
        return vndf_closed_sample_carefully(view, u1, u2, pdf);
    if (pdf)
        *pdf = n.density;
    return vndf_vec3_of(n.x, n.y, n.z);
}

vndf_vec3 vndf_beckmann_view_sample(const vndf_view *view, float u1, float u2, float *pdf)
{
    vndf_beckmann_incidence w = vndf_beckmann_incidence_of(view);
    lanes_m plain;
    vndf_beckmann_place at = vndf_beckmann_step(&w, vndf_beckmann_first(&w, u1), u1);
    vndf_drawn n = vndf_beckmann_normal(&w, &at, vndf_beckmann_second(u2), vndf_beckmann_middle(u1, u2), &plain);
    if (!plain)
        return vndf_closed_sample_carefully(view, u1, u2, pdf);
    if (pdf)
        *pdf = n.density;
    return vndf_vec3_of(n.x, n.y, n.z);
}
