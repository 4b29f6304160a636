/* The public calls on a surface: D, P22, projected area, Lambda, G1, G2. */
#include "sampler/surface.h"

#include "math/vector.h"
#include "sampler/beckmann.h"
#include "sampler/engine.h"
#include "sampler/ggx.h"
#include "table/table.h"

float vndf_ndf_scaled(const vndf_distribution *d, float ax, float ay, vndf_vec3 wm)
{
    if (d->kind != VNDF_KIND_TABLE)
        return vndf_density_from(d->kind == VNDF_KIND_GGX ? vndf_ggx_ndf(ax, ay, vndf_normal_of(wm))
                                                          : vndf_beckmann_ndf(ax, ay, vndf_normal_of(wm)));
    vndf_vec3 n = {wm.x / ax, wm.y / ay, wm.z};
    float x = vndf_length2(n.x, n.y), per = 1.0f / (x + n.z); /* D(wm) = P22/Z^4 at X + Z = 1, times per^4 / (ax ay) */
    return vndf_finite(vndf_engine_p22_over_z4(d, x * per, n.z * per) * (per / ax) * (per / ay) * per * per);
}

float vndf_ndf(const vndf_surface *surface, vndf_vec3 wm)
{
    float ax, ay;
    if (!vndf_surface_scaled(surface, &ax, &ay) || !(wm.z >= 0.0f) || !(vndf_dot(wm, wm) > 0.0f) || !(vndf_dot(wm, wm) < HUGE_VALF))
        return 0.0f; /* also for NaN */
    return vndf_ndf_scaled(surface->distribution, ax, ay, wm);
}

float vndf_p22(const vndf_surface *surface, float x, float y)
{
    float ax, ay;
    if (!vndf_surface_scaled(surface, &ax, &ay) || !(fabsf(x) < HUGE_VALF) || !(fabsf(y) < HUGE_VALF))
        return 0.0f;
    const vndf_distribution *d = surface->distribution;
    if (d->kind != VNDF_KIND_TABLE) {
        double sx = (double)x / ax, sy = (double)y / ay, r2 = sx * sx + sy * sy;
        double p22 = d->kind == VNDF_KIND_GGX ? vndf_ggx_p22(r2) : vndf_beckmann_p22(r2);
        return vndf_density_from(p22 / ((double)ax * ay));
    }
    float r = vndf_length2(x / ax, y / ay), z = 1.0f / (1.0f + r);
    return vndf_finite(vndf_engine_p22_over_z4(d, r < HUGE_VALF ? r * z : 1.0f, z) * (z * z) * (z * z) / ax / ay);
}

float vndf_projected_area(const vndf_surface *surface, vndf_vec3 w)
{
    vndf_view view = vndf_view_from(surface, w);
    return view.distribution ? vndf_unit_area(view.distribution, view.s, view.c) / view.per_length : 0.0f;
}

/* Lambda(w) = A(-w)/cos(theta) above the horizon, without a difference; -1 - Lambda(-w) below. */
float vndf_lambda(const vndf_surface *surface, vndf_vec3 w)
{
    vndf_view view = vndf_view_from(surface, w);
    if (!view.distribution)
        return 0.0f;
    float up = fabsf(view.c), lambda = vndf_unit_area(view.distribution, view.s, -up) / up;
    lambda = lambda < FLT_MAX ? lambda : FLT_MAX; /* at the horizon the quotient is infinite, or 0/0 */
    return view.wi.z < 0.0f ? -1.0f - lambda : lambda;
}

float vndf_g1(const vndf_surface *surface, vndf_vec3 w)
{
    vndf_view view = vndf_view_from(surface, w);
    float g1 = view.distribution && view.c > 0.0f ? view.c / vndf_unit_area(view.distribution, view.s, view.c) : 0.0f;
    return g1 < 1.0f ? g1 : 1.0f;
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
