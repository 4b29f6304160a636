/* The public calls on a view: stretch, turn, and hand over to the engine or a closed form. */
#include "math/vector.h"
#include "sampler/beckmann.h"
#include "sampler/engine.h"
#include "sampler/frame.h"
#include "sampler/ggx.h"
#include "sampler/surface.h"
#include "sampler/wedge.h"

/* Not zero, infinite or NaN: squares of floats neither overflow nor vanish in double. */
static int is_usable_direction(vndf_vec3 w)
{
    double square = (double)w.x * w.x + (double)w.y * w.y + (double)w.z * w.z;
    return square > 0.0 && square < HUGE_VAL;
}

/* (alpha_x wi.x, alpha_y wi.y, wi.z) in polar form: s and c, the factor that brings it to them, and azimuth. With
 * s + |c| = 1 for the engine, s^2 + c^2 = 1 for the closed forms. In double: no length or roughness is out of
 * range, and the digits are there that an area takes which falls as fast as the normals of a Beckmann do. */
typedef struct polar {
    double s, c, per_length;
    float cos_phi, sin_phi;
} polar;

VNDF_INLINE polar stretch(vndf_vec3 wi, double ax, double ay, int table)
{
    double x = ax * wi.x, y = ay * wi.y, across2 = x * x + y * y, across = sqrt(across2);
    double per = 1.0 / (table ? across + fabs((double)wi.z) : sqrt(across2 + (double)wi.z * wi.z));
    double per_across = across > 0.0 ? 1.0 / across : 0.0;
    polar p = {across * per, wi.z * per + 0.0, per, /* -0 becomes +0: the horizon is seen from above */
               across > 0.0 ? (float)(x * per_across) : 1.0f, (float)(y * per_across)};
    return p;
}

static vndf_view invalid_view(void)
{
    vndf_view view = {0};
    return view;
}

VNDF_INLINE vndf_view view_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi)
{
    int table = d->kind == VNDF_KIND_TABLE;
    polar p = stretch(wi, ax, ay, table);
    vndf_wedge_view w = {0};
    if (table)
        w = vndf_wedge_view_at(d, p.s, p.c);
    else
        w.area = (float)vndf_unit_area(d, p.s, p.c);
    vndf_view view = {d, wi, ax, ay, p.s, p.c, p.per_length, 1.0f / (float)ax, 1.0f / (float)ay,
                      p.cos_phi, p.sin_phi, w.area, w.front, w.wedge};
    return view;
}

vndf_view vndf_view_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi)
{
    return view_scaled(d, ax, ay, wi);
}

vndf_view vndf_view_from(const vndf_surface *surface, vndf_vec3 wi)
{
    double ax, ay;
    if (!vndf_surface_scaled(surface, &ax, &ay) || !is_usable_direction(wi))
        return invalid_view();
    return view_scaled(surface->distribution, ax, ay, wi);
}

VNDF_INLINE float visible_closed(const vndf_view *view, vndf_vec3 wm)
{
    vndf_normal n = vndf_normal_of(wm);
    double facing = vndf_facing(view, n);
    if (!(wm.z >= 0.0f) || !(facing > 0.0))
        return 0.0f;
    return vndf_positive(vndf_density_from(view->distribution->kind == VNDF_KIND_GGX
                                               ? vndf_ggx_visible(view, n, facing)
                                               : vndf_beckmann_visible(view, n, facing)));
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

static vndf_vec3 sample_closed(const vndf_view *view, float u1, float u2, float *pdf)
{
    float s = (float)view->s, c = (float)view->c;
    vndf_vec3 n = view->distribution->kind == VNDF_KIND_GGX ? vndf_ggx_sample(s, c, u1, u2)
                                                            : vndf_beckmann_sample(s, c, u1, u2);
    vndf_vec3 wm = vndf_normalize(vndf_from_unit(view, n));
    if (!(vndf_facing(view, vndf_normal_of(wm)) > 0.0))
        wm = turn_closed(view, wm);
    if (pdf)
        *pdf = visible_closed(view, wm);
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
        return vndf_engine_sample(view, u1, u2, pdf);
    return sample_closed(view, u1, u2, pdf);
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
        vndf_ggx_invert((float)view->s, (float)view->c, vndf_normal_to_unit(view, wm), u1, u2);
    else if (view->distribution->kind == VNDF_KIND_BECKMANN)
        vndf_beckmann_invert((float)view->s, (float)view->c, vndf_normal_to_unit(view, wm), u1, u2);
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
    return vndf_density_from(ndf * (facing * view->per_length) / view->area);
}
