/* The public calls on a view: stretch, turn, hand over to the engine or a closed form, and back.
 *
 * Normals of the unit problem n = (X cos a, X sin a, Z) and real ones are related by
 *     wm ~ (alpha_x n'_x, alpha_y n'_y, n_z),  n' = n turned by the azimuth of the stretched direction,
 * and a solid angle at wm by the Jacobian L^3-like factors noted at each use. */
#include <string.h>

#include "math/vector.h"
#include "sampler/beckmann.h"
#include "sampler/engine.h"
#include "sampler/ggx.h"
#include "sampler/surface.h"
#include "table/table.h"

static int is_usable_direction(vndf_vec3 w)
{
    float m = vndf_max_abs(w);
    return m > 0.0f && m < HUGE_VALF && w.x == w.x && w.y == w.y && w.z == w.z; /* max_abs may pass over a NaN */
}

/* (alpha_x wi.x, alpha_y wi.y, wi.z) in polar form, exact for the smallest parts: azimuth, and s + |c| = 1
 * for the engine or s^2 + c^2 = 1 for the closed forms. */
static void stretch(vndf_view *view)
{
    float x = view->alpha_x * view->wi.x, y = view->alpha_y * view->wi.y, z = view->wi.z;
    float across = vndf_length2(x, y), per_across = across > 0.0f ? 1.0f / across : 0.0f;
    int table = view->distribution->kind == VNDF_KIND_TABLE;
    view->per_length = 1.0f / (table ? across + fabsf(z) : vndf_length2(across, z));
    view->s = across * view->per_length;
    view->c = z * view->per_length + 0.0f; /* -0 becomes +0: the horizon is seen from above */
    view->cos_phi = across > 0.0f ? x * per_across : 1.0f;
    view->sin_phi = y * per_across;
}

/* The parts that every kind of distribution shares; 0 if anything is invalid. */
static int begin_view(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    float square = vndf_dot(wi, wi), ax, ay;
    if (!vndf_surface_scaled(surface, &ax, &ay) || (!vndf_is_plain(square) && !is_usable_direction(wi)))
        return 0;
    view->distribution = surface->distribution;
    view->wi = vndf_normalize(wi);
    view->alpha_x = ax;
    view->alpha_y = ay;
    view->per_alpha_x = 1.0f / ax;
    view->per_alpha_y = 1.0f / ay;
    stretch(view);
    return 1;
}

vndf_view vndf_view_from(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_view view;
    if (!begin_view(&view, surface, wi)) {
        memset(&view, 0, sizeof view);
        return view;
    }
    if (view.distribution->kind == VNDF_KIND_TABLE)
        vndf_engine_view(&view);
    else
        view.area = vndf_unit_area(view.distribution, view.s, view.c);
    return view;
}

/* wm taken back to the unit problem in the turned frame: not of unit length. */
static vndf_vec3 to_unit(const vndf_view *view, vndf_vec3 wm)
{
    float x = wm.x * view->per_alpha_x, y = wm.y * view->per_alpha_y;
    vndf_vec3 n = {view->cos_phi * x + view->sin_phi * y, view->cos_phi * y - view->sin_phi * x, wm.z};
    return n;
}

/* The real normal of one of the unit problem: not of unit length. */
static vndf_vec3 from_unit(const vndf_view *view, vndf_vec3 n)
{
    vndf_vec3 wm = {view->alpha_x * (view->cos_phi * n.x - view->sin_phi * n.y),
                    view->alpha_y * (view->sin_phi * n.x + view->cos_phi * n.y), n.z};
    return wm;
}

/* A normal that rounding has turned away from wi is turned back by about one unit in the last place; where
 * even that fails (wi within rounding of straight down) the horizontal normal towards wi is taken. */
static vndf_vec3 facing(const vndf_view *view, vndf_vec3 wm)
{
    for (float step = 1.2e-7f; step < 1e-5f && !(vndf_dot(view->wi, wm) > 0.0f); step *= 4.0f) {
        vndf_vec3 moved = {wm.x + step * view->wi.x, wm.y + step * view->wi.y, wm.z + step * view->wi.z};
        moved.z = moved.z > 0.0f ? moved.z : 0.0f;
        wm = vndf_normalize(moved);
    }
    if (vndf_dot(view->wi, wm) > 0.0f || (view->wi.x == 0.0f && view->wi.y == 0.0f))
        return wm;
    vndf_vec3 level = {view->wi.x, view->wi.y, 0.0f};
    return vndf_normalize(level);
}

/* W = (direction . normal) of the engine for the unit normal wm, where `scale` brings its image in the unit problem to
 * X + Z = 1. It comes from wm as it was rounded, so that sample and pdf agree up to the very cut. */
static float weight(const vndf_view *view, vndf_vec3 wm, float scale)
{
    return vndf_dot(view->wi, wm) * scale * view->per_length;
}

/* The engine's density per steradian: dwm = ax ay X Z^2 dR da / scale^3. */
static float per_steradian(const vndf_view *view, float density, float scale)
{
    return density * (scale * view->per_alpha_x) * (scale * view->per_alpha_y) * scale;
}

static vndf_vec3 sample_closed(const vndf_view *view, float u1, float u2, float *pdf)
{
    vndf_vec3 n = view->distribution->kind == VNDF_KIND_GGX ? vndf_ggx_sample(view->s, view->c, u1, u2)
                                                             : vndf_beckmann_sample(view->s, view->c, u1, u2);
    vndf_vec3 wm = vndf_normalize(from_unit(view, n));
    if (!(vndf_dot(view->wi, wm) > 0.0f))
        wm = facing(view, wm);
    if (pdf)
        *pdf = vndf_visible(view, wm);
    return wm;
}

static vndf_vec3 sample_table(const vndf_view *view, float u1, float u2, float *pdf)
{
    vndf_engine_draw draw;
    vndf_engine_sample(view, u1, u2, &draw);
    vndf_vec3 stretched = from_unit(view, draw.normal);
    float length = sqrtf(vndf_dot(stretched, stretched)); /* from 1e-18 to 1e18 */
    vndf_vec3 wm = vndf_scale(stretched, 1.0f / length);
    float w = weight(view, wm, length);
    if (!(w > 0.0f)) {
        wm = facing(view, wm);
        if (pdf)
            *pdf = vndf_pdf(view, wm);
    } else if (pdf)
        *pdf = per_steradian(view, vndf_engine_drawn(&draw, w), length);
    return wm;
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
    if (view->distribution->kind == VNDF_KIND_TABLE)
        return sample_table(view, u1, u2, pdf);
    return sample_closed(view, u1, u2, pdf);
}

float vndf_pdf(const vndf_view *view, vndf_vec3 wm)
{
    if (!view->distribution || !(wm.z >= 0.0f) || !(vndf_dot(view->wi, wm) > 0.0f))
        return 0.0f;
    if (view->distribution->kind != VNDF_KIND_TABLE)
        return vndf_visible(view, wm);
    vndf_vec3 n = to_unit(view, wm);
    float scale = 1.0f / (vndf_length2(n.x, n.y) + n.z);
    return per_steradian(view, vndf_engine_density(view, n, weight(view, wm, scale)), scale);
}

void vndf_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    *u1 = *u2 = 0.0f;
    if (!view->distribution || !(wm.z >= 0.0f) || !is_usable_direction(wm))
        return;
    vndf_vec3 n = to_unit(view, wm);
    if (view->distribution->kind == VNDF_KIND_GGX)
        vndf_ggx_invert(view->s, view->c, vndf_normalize(n), u1, u2);
    else if (view->distribution->kind == VNDF_KIND_BECKMANN)
        vndf_beckmann_invert(view->s, view->c, vndf_normalize(n), u1, u2);
    else
        vndf_engine_invert(view, n, u1, u2);
    *u1 = vndf_clamp_unit(*u1);
    *u2 = vndf_clamp_unit(*u2);
}

float vndf_visible(const vndf_view *view, vndf_vec3 wm)
{
    float facing_cos = view->distribution ? vndf_dot(view->wi, wm) : 0.0f;
    if (!(wm.z >= 0.0f) || !(facing_cos > 0.0f) || !(view->area > 0.0f))
        return 0.0f;
    return vndf_ndf_scaled(view->distribution, view->alpha_x, view->alpha_y, wm) * (facing_cos * view->per_length / view->area);
}
