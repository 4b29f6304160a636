/* The public calls on a view: stretch, turn, and hand over to the engine or a closed form. */
#include "math/vector.h"
#include "sampler/aim.h"
#include "sampler/beckmann.h"
#include "sampler/engine.h"
#include "sampler/frame.h"
#include "sampler/ggx.h"
#include "sampler/ggx_draw.h"
#include "sampler/stretch.h"
#include "sampler/surface.h"

/* Not zero, infinite or NaN: squares of floats neither overflow nor vanish in double. */
static int is_usable_direction(vndf_vec3 w)
{
    double square = (double)w.x * w.x + (double)w.y * w.y + (double)w.z * w.z;
    return square > 0.0 && square < HUGE_VAL;
}

static vndf_view invalid_view(void)
{
    vndf_view view = {0};
    return view;
}

/* From doubles, where it cannot be had in float: below the horizon, along z, at extremes. */
VNDF_RARE vndf_aim aim_exactly(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi)
{
    vndf_stretched w = vndf_stretch(wi, ax, ay, d->kind == VNDF_KIND_TABLE);
    double across = sqrt(w.x * w.x + w.y * w.y), per = across > 0.0 ? 1.0 / across : 0.0;
    vndf_aim aim = {(float)w.s, (float)w.c, across > 0.0 ? (float)(w.x * per) : 1.0f, (float)(w.y * per), 0, 0, 0};
    if (d->kind != VNDF_KIND_TABLE) {
        aim.area = d->kind == VNDF_KIND_GGX ? vndf_ggx_area(aim.s, aim.c) : 0.0f; /* Beckmann: of its law */
        return aim;
    }
    double mass = vndf_wedge_mass(vndf_wedge_of(d, w.c), vndf_wedge_y(w.s, w.c));
    double front = w.c >= 0.0 ? w.c * (d->f0_total * VNDF_QUARTER_TURN) + w.s * d->f1_total : 0.0;
    aim.front = (float)front;
    aim.area = (float)(2.0 * (front + mass));
    aim.wedge = w.c >= 0.0 ? (float)mass : w.s > 0.0 ? 1.0f : 0.0f; /* its part below: the mass may underflow */
    return aim;
}

VNDF_INLINE vndf_aim aim_in_float(const vndf_distribution *d, float x, float y, vndf_vec3 wi, lanes_m *ready)
{
    if (d->kind == VNDF_KIND_TABLE)
        return vndf_aim_at(d, x * wi.x, y * wi.y, wi.z, ready);
    return vndf_aim_unit(x * wi.x, y * wi.y, wi.z, ready);
}

/* Members are written once, each by itself: what is read soon after must not wait for wider stores. */
VNDF_INLINE void set_view(vndf_view *v, const vndf_distribution *d, double ax, double ay, float x, float y,
                          vndf_vec3 wi, vndf_aim aim)
{
    vndf_beckmann_law law = {0.0, 0.0, 0.0};
    if (d->kind == VNDF_KIND_BECKMANN) {
        law = vndf_beckmann_law_at(aim.s, aim.c);
        aim.area = vndf_beckmann_area_of(&law, aim.s, aim.c);
    }
    v->distribution = d;
    v->wi.x = wi.x;
    v->wi.y = wi.y;
    v->wi.z = wi.z;
    v->alpha_x = ax;
    v->alpha_y = ay;
    v->ax = x;
    v->ay = y;
    v->s = aim.s;
    v->c = aim.c;
    v->cos_phi = aim.cos_phi;
    v->sin_phi = aim.sin_phi;
    v->front = aim.front;
    v->wedge = aim.wedge;
    v->area = aim.area;
    v->spread = aim.area * (x * y);
    v->plain = vndf_aim_is_plain(x, y, aim.c);
    v->whole = law.whole;
    v->line = law.line;
}

/* For roughness times the table's scale, as it is and as it is drawn with. */
static vndf_view view_scaled(const vndf_distribution *d, double ax, double ay, float x, float y, vndf_vec3 wi)
{
    lanes_m ready = 1;
    vndf_aim aim = aim_in_float(d, x, y, wi, &ready);
    vndf_view view;
    set_view(&view, d, ax, ay, x, y, wi, ready ? aim : aim_exactly(d, ax, ay, wi));
    return view;
}

vndf_view vndf_view_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi)
{
    return view_scaled(d, ax, ay, (float)ax, (float)ay, wi);
}

/* Whatever comes in. */
VNDF_RARE vndf_view view_carefully(const vndf_surface *surface, vndf_vec3 wi)
{
    double ax, ay;
    if (!surface || !vndf_surface_scaled(surface, &ax, &ay) || !is_usable_direction(wi))
        return invalid_view();
    float scale = vndf_unit_scale_float(surface->distribution); /* lanes have no double */
    float x = scale > 0.0f ? surface->alpha_x * scale : (float)ax;
    float y = scale > 0.0f ? surface->alpha_y * scale : (float)ay;
    return view_scaled(surface->distribution, ax, ay, x, y, wi);
}

/* What is plain and ready is valid: nothing else has to be looked at. */
VNDF_INLINE int set_plainly(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    if (!surface || !surface->distribution)
        return 0;
    const vndf_distribution *d = surface->distribution;
    float scale = vndf_unit_scale_float(d), x = surface->alpha_x * scale, y = surface->alpha_y * scale;
    lanes_m ready = 1;
    vndf_aim aim = aim_in_float(d, x, y, wi, &ready);
    if (!(ready & vndf_aim_is_plain(x, y, aim.c)))
        return 0;
    double exact = vndf_unit_scale(d);
    set_view(view, d, surface->alpha_x * exact, surface->alpha_y * exact, x, y, wi, aim);
    return 1;
}

vndf_view vndf_view_from(const vndf_surface *surface, vndf_vec3 wi)
{
    vndf_view view;
    if (!set_plainly(&view, surface, wi))
        return view_carefully(surface, wi);
    return view;
}

void vndf_view_set(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    if (!set_plainly(view, surface, wi))
        *view = view_carefully(surface, wi);
}

VNDF_INLINE float visible_closed(const vndf_view *view, vndf_vec3 wm)
{
    vndf_normal n = vndf_normal_of(wm);
    double facing = vndf_facing(view, n);
    if (!(wm.z >= 0.0f) || !(facing > 0.0))
        return 0.0f;
    vndf_stretched w = vndf_stretched_of(view);
    return vndf_positive(vndf_density_from(view->distribution->kind == VNDF_KIND_GGX
                                               ? vndf_ggx_visible(view, &w, n, facing)
                                               : vndf_beckmann_visible(view, &w, n, facing)));
}

/* A normal that rounding has turned away, turned back. Below the horizon z alone is lowered, by its own rounding:
 * a step that is small only beside 1 would leave the lobe of a Beckmann. */
static vndf_vec3 turn_closed(const vndf_view *view, vndf_vec3 wm)
{
    double level = (double)view->wi.x * wm.x + (double)view->wi.y * wm.y, highest = level / -(double)view->wi.z;
    if (view->wi.z < 0.0f && highest > wm.z * (1.0 - 0x1p-21))
        wm.z = fminf(wm.z, (float)(highest * (1.0 - 0x1p-23)));
    return vndf_facing(view, vndf_normal_of(wm)) > 0.0 ? wm : vndf_turn_to_face(view, wm);
}

static vndf_vec3 sample_closed_carefully(const vndf_view *view, float u1, float u2, float *pdf)
{
    float s = view->s, c = view->c;
    vndf_vec3 n = view->distribution->kind == VNDF_KIND_GGX ? vndf_ggx_sample(s, c, u1, u2)
                                                            : vndf_beckmann_sample(s, c, u1, u2);
    vndf_vec3 wm = vndf_normalize(vndf_from_unit(view, n));
    if (!(vndf_facing(view, vndf_normal_of(wm)) > 0.0))
        wm = turn_closed(view, wm);
    if (pdf)
        *pdf = visible_closed(view, wm);
    return wm;
}

vndf_vec3 vndf_sample_carefully(const vndf_view *view, float u1, float u2, float *pdf)
{
    u1 = vndf_clamp_unit(u1);
    u2 = vndf_clamp_unit(u2);
    if (view->distribution->kind == VNDF_KIND_TABLE)
        return vndf_engine_sample_carefully(view, u1, u2, pdf);
    return sample_closed_carefully(view, u1, u2, pdf);
}

static vndf_vec3 sample_ggx(const vndf_view *view, float u1, float u2, float *pdf)
{
    vndf_incidence w = vndf_incidence_of(view);
    lanes_m plain = 1;
    vndf_drawn n = vndf_ggx_draw(&w, u1, u2, &plain);
    if (!plain)
        return sample_closed_carefully(view, u1, u2, pdf);
    if (pdf)
        *pdf = n.density;
    return vndf_vec3_of(n.x, n.y, n.z);
}

/* Where the density of a slope is that of the rounded normal: not far in the tail, and no small facing. */
static int is_plain_beckmann(const vndf_view *view, const vndf_beckmann_slopes *at, double square)
{
    double s = view->s; /* below 1e-30 it is not what the law has */
    double terms = s * (fabs(at->x) + fabs(at->y)) + view->c;
    return view->plain && square < 12.0 && s > 1e-20 && s * at->d > 0.1 * terms;
}

/* Density of the normal of length 1 over the third power of the length, from that of the slopes. */
static vndf_vec3 sample_beckmann(const vndf_view *view, float u1, float u2, float *pdf)
{
    vndf_beckmann_law law = {vndf_beckmann_bound(view->s, view->c), view->whole, view->line};
    vndf_beckmann_slopes at = vndf_beckmann_draw(&law, u1, u2);
    double square = at.x * at.x + at.y * at.y;
    if (!is_plain_beckmann(view, &at, square))
        return sample_closed_carefully(view, u1, u2, pdf);
    float x = (float)-at.x, y = (float)-at.y;
    float mx = view->ax * (view->cos_phi * x - view->sin_phi * y);
    float my = view->ay * (view->sin_phi * x + view->cos_phi * y), length2 = mx * mx + my * my + 1.0f;
    float length = sqrtf(length2), per = 1.0f / length;
    double density = vndf_beckmann_p22(square) * (view->s * at.d / view->spread);
    if (pdf)
        *pdf = (float)density * (length2 * length);
    return vndf_vec3_of(mx * per, my * per, per);
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
        return vndf_engine_sample(view, u1, u2, pdf);
    if (view->distribution->kind == VNDF_KIND_GGX)
        return sample_ggx(view, u1, u2, pdf);
    return sample_beckmann(view, u1, u2, pdf);
}

float vndf_pdf(const vndf_view *view, vndf_vec3 wm)
{
    if (view->distribution && view->distribution->kind != VNDF_KIND_TABLE)
        return visible_closed(view, wm);
    if (!view->distribution || !(wm.z >= 0.0f) || !(vndf_exact_dot(view->wi, wm) > 0.0))
        return 0.0f;
    return vndf_engine_pdf(view, wm);
}

void vndf_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2)
{
    *u1 = *u2 = 0.0f;
    if (!view->distribution || !(wm.z >= 0.0f) || !is_usable_direction(wm))
        return;
    if (view->distribution->kind == VNDF_KIND_GGX)
        vndf_ggx_invert(view->s, view->c, vndf_normal_to_unit(view, wm), u1, u2);
    else if (view->distribution->kind == VNDF_KIND_BECKMANN)
        vndf_beckmann_invert(view->s, view->c, vndf_normal_to_unit(view, wm), u1, u2);
    else
        vndf_engine_invert(view, vndf_to_unit(view, wm), u1, u2);
    *u1 = vndf_clamp_unit(*u1);
    *u2 = vndf_clamp_unit(*u2);
}

float vndf_visible(const vndf_view *view, vndf_vec3 wm)
{
    if (view->distribution && view->distribution->kind != VNDF_KIND_TABLE)
        return visible_closed(view, wm);
    double facing = view->distribution ? vndf_exact_dot(view->wi, wm) : 0.0;
    if (!(wm.z >= 0.0f) || !(facing > 0.0) || !(view->area > 0.0f))
        return 0.0f;
    double ndf = vndf_ndf_scaled(view->distribution, view->alpha_x, view->alpha_y, wm);
    return vndf_density_from(ndf * (facing * vndf_stretched_of(view).per_length) / view->area);
}
