/* The public calls on a view: stretch, turn, and hand over to the engine or a closed form. */
#include "math/vector.h"
#include "sampler/tabulated/aim.h"
#include "sampler/analytic/view.h"
#include "sampler/tabulated/theory.h"
#include "sampler/frame.h"
#include "sampler/analytic/density.h"
#include "sampler/nearest.h"
#include "sampler/stretch.h"
#include "sampler/surface.h"

/* From doubles, where it cannot be had in float: below the horizon, along z, at extremes. */
VNDF_RARE vndf_aim aim_exactly(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi)
{
    vndf_stretched w = vndf_stretch(wi, ax, ay, 1);
    double across = sqrt(w.x * w.x + w.y * w.y), per = across > 0.0 ? 1.0 / across : 0.0;
    vndf_aim aim = {(float)w.s, (float)w.c, across > 0.0 ? (float)(w.x * per) : 1.0f, (float)(w.y * per), 0, 0, 0};
    double mass = vndf_wedge_mass(vndf_wedge_of(d, w.c), vndf_wedge_y(w.s, w.c));
    double front = w.c >= 0.0 ? w.c * (d->f0_total * VNDF_QUARTER_TURN) + w.s * d->f1_total : 0.0;
    aim.front = (float)front;
    aim.area = (float)(2.0 * (front + mass));
    aim.wedge = w.c >= 0.0 ? (float)mass : w.s > 0.0 ? 1.0f : 0.0f; /* its part below: the mass may underflow */
    return aim;
}

/* Of a table. Members are written once, each by itself: what is read soon after must not wait for wider stores. */
VNDF_INLINE vndf_view view_of(const vndf_distribution *d, double ax, double ay, float x, float y, vndf_vec3 wi,
                              vndf_aim aim)
{
    vndf_view view = {d,
                      wi,
                      ax,
                      ay,
                      x,
                      y,
                      vndf_trusts_scale(x, y, aim.c),
                      {0.0f},
                      aim.s,
                      aim.c,
                      aim.cos_phi,
                      aim.sin_phi,
                      aim.front,
                      aim.wedge,
                      aim.area,
                      aim.area * (x * y)};
    return view;
}

/* For roughness times the table's scale, as it is and as it is drawn with. */
static vndf_view view_scaled(const vndf_distribution *d, double ax, double ay, float x, float y, vndf_vec3 wi)
{
    lanes_m ready = 1;
    vndf_aim aim = vndf_aim_at(d, x * wi.x, y * wi.y, wi.z, &ready);
    return view_of(d, ax, ay, x, y, wi, ready ? aim : aim_exactly(d, ax, ay, wi));
}

vndf_view vndf_view_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi)
{
    return view_scaled(d, ax, ay, (float)ax, (float)ay, wi);
}

/* Whatever comes in. */
VNDF_RARE vndf_view view_carefully(const vndf_surface *surface, vndf_vec3 wi)
{
    double ax, ay;
    if (!vndf_surface_scaled(surface, &ax, &ay) || !vndf_is_usable_direction(wi))
        return vndf_invalid_view();
    if (surface->distribution->kind != VNDF_KIND_TABLE)
        return vndf_closed_view_carefully(surface, wi);
    float scale = vndf_unit_scale_float(surface->distribution); /* lanes have no double */
    float x = scale > 0.0f ? surface->alpha_x * scale : (float)ax;
    float y = scale > 0.0f ? surface->alpha_y * scale : (float)ay;
    return view_scaled(surface->distribution, ax, ay, x, y, wi);
}

vndf_view vndf_view_bare(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_view view = {.wi = wi};
    if (vndf_surface_scaled(surface, &view.alpha_x, &view.alpha_y) && vndf_is_usable_direction(wi))
        view.distribution = surface->distribution;
    return view;
}

/* What is plain and ready is valid: nothing else has to be looked at. */
vndf_view vndf_view_from(const vndf_surface *surface, vndf_vec3 wi)
{
    if (!surface || !surface->distribution)
        return vndf_invalid_view();
    const vndf_distribution *d = surface->distribution;
    if (d->kind == VNDF_KIND_GGX) {
        vndf_ggx_incidence w = vndf_ggx_aim(surface->alpha_x, surface->alpha_y, wi.x, wi.y, wi.z);
        return w.plain ? vndf_ggx_view_of(surface, wi, &w) : view_carefully(surface, wi);
    }
    if (d->kind == VNDF_KIND_BECKMANN)
        return vndf_beckmann_view_from(surface, wi);
    float scale = vndf_unit_scale_float(d), x = surface->alpha_x * scale, y = surface->alpha_y * scale;
    lanes_m ready = 1;
    vndf_aim aim = vndf_aim_at(d, x * wi.x, y * wi.y, wi.z, &ready);
    if (!(ready & vndf_trusts_scale(x, y, aim.c)))
        return view_carefully(surface, wi);
    double exact = vndf_unit_scale(d);
    return view_of(d, surface->alpha_x * exact, surface->alpha_y * exact, x, y, wi, aim);
}

/* Dv of a valid view; facing = wi . wm > 0. */
VNDF_INLINE float visible_facing(const vndf_view *view, vndf_vec3 wm)
{
    vndf_given g = vndf_given_of(view, wm);
    return vndf_density_from(vndf_visible_of(view->distribution, &g, vndf_exact_dot(view->wi, wm)));
}

/* Whether wm is a normal that wi sees. */
VNDF_INLINE int is_facing(const vndf_view *view, vndf_vec3 wm)
{
    return view->distribution && wm.z >= 0.0f && vndf_exact_dot(view->wi, wm) > 0.0;
}

/* GGX is so fast that the copy would show. */
void vndf_view_set(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    if (surface->distribution->kind == VNDF_KIND_GGX) {
        vndf_ggx_incidence w = vndf_ggx_aim(surface->alpha_x, surface->alpha_y, wi.x, wi.y, wi.z);
        if (w.plain) {
            vndf_ggx_view_set(view, surface, wi, &w);
            return;
        }
    }
    *view = vndf_view_from(surface, wi);
}

vndf_vec3 vndf_sample_carefully(const vndf_view *view, float u1, float u2, float *pdf)
{
    u1 = vndf_clamp_unit(u1);
    u2 = vndf_clamp_unit(u2);
    if (view->distribution->kind == VNDF_KIND_TABLE)
        return vndf_engine_sample_carefully(view, u1, u2, pdf);
    return vndf_closed_sample_carefully(view, u1, u2, pdf);
}

vndf_vec3 vndf_sample(const vndf_view *view, float u1, float u2, float *pdf)
{
    u1 = vndf_clamp_unit(u1);
    u2 = vndf_clamp_unit(u2);
    if (!view->distribution) {
        vndf_vec3 up = {0.0f, 0.0f, 1.0f};
        if (pdf)
            *pdf = 0.0f;
        return up;
    }
    if (view->distribution->kind == VNDF_KIND_GGX)
        return vndf_ggx_view_sample(view, u1, u2, pdf);
    if (view->distribution->kind == VNDF_KIND_BECKMANN)
        return vndf_beckmann_view_sample(view, u1, u2, pdf);
    return vndf_engine_sample(view, u1, u2, pdf);
}

float vndf_pdf(const vndf_view *view, vndf_vec3 wm)
{
    if (!is_facing(view, wm))
        return 0.0f;
    if (view->distribution->kind == VNDF_KIND_TABLE)
        return vndf_engine_pdf(view, wm);
    return vndf_positive(visible_facing(view, wm));
}

/* Of a table. Where some steps of 2^-24 matter and wi sees wm, u is what gives it, not what should. */
static void invert_table(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    int sure = vndf_engine_invert(view, vndf_to_unit(view, wm), u1, u2);
    *u1 = vndf_clamp_unit(*u1);
    *u2 = vndf_clamp_unit(*u2);
    if (!sure && vndf_exact_dot(view->wi, wm) > 0.0)
        vndf_nearest(view, wm, u1, u2);
}

void vndf_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    *u1 = *u2 = 0.0f;
    if (!view->distribution || !(wm.z >= 0.0f) || !vndf_is_usable_direction(wm))
        return;
    if (view->distribution->kind == VNDF_KIND_TABLE) {
        invert_table(view, wm, u1, u2);
        return;
    }
    vndf_closed_invert(view, wm, u1, u2);
    *u1 = vndf_clamp_unit(*u1);
    *u2 = vndf_clamp_unit(*u2);
}

float vndf_visible(const vndf_view *view, vndf_vec3 wm)
{
    if (!is_facing(view, wm))
        return 0.0f;
    float visible = visible_facing(view, wm);
    return view->distribution->kind == VNDF_KIND_TABLE ? visible : vndf_positive(visible);
}
