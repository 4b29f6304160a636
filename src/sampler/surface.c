/* The public calls on a surface: D, P22, projected area, Lambda, G1, G2. */
#include "sampler/surface.h"

#include "math/vector.h"
#include "sampler/beckmann.h"
#include "sampler/engine.h"
#include "sampler/ggx.h"
#include "sampler/stretch.h"
#include "table/table.h"

double vndf_ndf_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 wm)
{
    if (d->kind == VNDF_KIND_GGX)
        return vndf_ggx_ndf(ax, ay, vndf_normal_of(wm));
    if (d->kind == VNDF_KIND_BECKMANN)
        return vndf_beckmann_ndf(ax, ay, vndf_normal_of(wm));
    double mx = wm.x / ax, my = wm.y / ay, x = sqrt(mx * mx + my * my), per = 1.0 / (x + wm.z);
    /* D(wm) = P22/Z^4 at X + Z = 1, times per^4 / (ax ay) */
    return vndf_engine_p22_over_z4(d, x * per, wm.z * per) * (per / ax) * (per / ay) * per * per;
}

float vndf_ndf(const vndf_surface *surface, vndf_vec3 wm)
{
    double ax, ay;
    if (!vndf_surface_scaled(surface, &ax, &ay) || !(wm.z >= 0.0f) || !(vndf_dot(wm, wm) > 0.0f) ||
        !(vndf_dot(wm, wm) < HUGE_VALF))
        return 0.0f; /* also for NaN */
    return vndf_density_from(vndf_ndf_scaled(surface->distribution, ax, ay, wm));
}

float vndf_p22(const vndf_surface *surface, float x, float y)
{
    double ax, ay;
    if (!vndf_surface_scaled(surface, &ax, &ay) || !(fabsf(x) < HUGE_VALF) || !(fabsf(y) < HUGE_VALF))
        return 0.0f;
    const vndf_distribution *d = surface->distribution;
    double sx = x / ax, sy = y / ay, r2 = sx * sx + sy * sy, r = sqrt(r2), z = 1.0 / (1.0 + r);
    double p22 = d->kind == VNDF_KIND_GGX        ? vndf_ggx_p22(r2)
                 : d->kind == VNDF_KIND_BECKMANN ? vndf_beckmann_p22(r2)
                                                 : vndf_engine_p22_over_z4(d, r * z, z) * (z * z) * (z * z);
    return vndf_density_from(p22 / ax / ay);
}

float vndf_area_scaled(const vndf_distribution *d, double ax, double ay, vndf_vec3 w)
{
    vndf_stretched s = vndf_stretch(w, ax, ay, d->kind == VNDF_KIND_TABLE);
    return (float)(vndf_unit_area(d, s.s, s.c) / (s.per_length * sqrt(vndf_exact_dot(w, w))));
}

float vndf_projected_area(const vndf_surface *surface, vndf_vec3 w)
{
    vndf_view view = vndf_view_from(surface, w);
    if (!view.distribution)
        return 0.0f;
    return vndf_area_scaled(view.distribution, view.alpha_x, view.alpha_y, w);
}

/* Lambda(w) = A(-w)/cos(theta) above the horizon, without a difference; -1 - Lambda(-w) below. */
float vndf_lambda(const vndf_surface *surface, vndf_vec3 w)
{
    vndf_view view = vndf_view_from(surface, w);
    if (!view.distribution)
        return 0.0f;
    vndf_stretched s = vndf_stretched_of(&view);
    double up = fabs(s.c), exact = vndf_unit_area(view.distribution, s.s, -up) / up;
    float lambda = exact < FLT_MAX ? (float)exact : FLT_MAX; /* at the horizon the quotient is infinite, or 0/0 */
    return view.wi.z < 0.0f ? -1.0f - lambda : lambda;
}

float vndf_g1(const vndf_surface *surface, vndf_vec3 w)
{
    vndf_view view = vndf_view_from(surface, w);
    if (!view.distribution)
        return 0.0f;
    vndf_stretched s = vndf_stretched_of(&view);
    double g1 = s.c > 0.0 ? s.c / vndf_unit_area(view.distribution, s.s, s.c) : 0.0;
    return g1 < 1.0 ? (float)g1 : 1.0f;
}

/* 1/(1 + Lambda_i + Lambda_o), with 1 + Lambda = 1/G1: the smaller G1 times a factor that is 1/2 at least, since a
 * product of two small ones would underflow. */
float vndf_g2(const vndf_surface *surface, vndf_vec3 wi, vndf_vec3 wo, vndf_g2_model model)
{
    float gi = vndf_g1(surface, wi), go = vndf_g1(surface, wo);
    float least = gi < go ? gi : go, most = gi < go ? go : gi;
    if (model == VNDF_G2_SEPARABLE || least == 0.0f)
        return gi * go;
    return least * (most / (most + least * (1.0f - most)));
}
