/* The public calls on a surface: D, P22, projected area, Lambda, G1, G2. */
#include "sampler/surface.h"

#include <float.h>

#include "math/vector.h"
#include "sampler/beckmann.h"
#include "sampler/engine.h"
#include "sampler/ggx.h"
#include "table/table.h"

int vndf_surface_scaled(const vndf_surface *surface, float *ax, float *ay)
{
    if (!surface || !surface->distribution)
        return 0;
    *ax = surface->alpha_x * surface->distribution->scale;
    *ay = surface->alpha_y * surface->distribution->scale;
    return *ax >= 1e-18f && *ax <= 1e18f && *ay >= 1e-18f && *ay <= 1e18f;
}

/* D at roughness 1 in unit direction n. */
static float ndf_closed(const vndf_distribution *d, vndf_vec3 n)
{
    return d->kind == VNDF_KIND_GGX ? vndf_ggx_ndf(n) : vndf_beckmann_ndf(n);
}

float vndf_ndf_scaled(const vndf_distribution *d, float ax, float ay, vndf_vec3 wm)
{
    vndf_vec3 n = {wm.x / ax, wm.y / ay, wm.z};
    if (d->kind != VNDF_KIND_TABLE) { /* D(wm) = D1(n/|n|) / (ax ay |n|^4) */
        float length = vndf_length2(vndf_length2(n.x, n.y), n.z), per = 1.0f / length;
        return ndf_closed(d, vndf_scale(n, per)) * (per / ax) * (per / ay) * per * per;
    }
    float x = vndf_length2(n.x, n.y), per = 1.0f / (x + n.z); /* D(wm) = P22/Z^4 at X + Z = 1, times per^4 / (ax ay) */
    return vndf_engine_p22_over_z4(d, x * per, n.z * per) * (per / ax) * (per / ay) * per * per;
}

float vndf_ndf(const vndf_surface *surface, vndf_vec3 wm)
{
    float ax, ay;
    if (!vndf_surface_scaled(surface, &ax, &ay) || !(wm.z >= 0.0f) || !(vndf_max_abs(wm) > 0.0f) || !(vndf_max_abs(wm) < HUGE_VALF))
        return 0.0f;
    return vndf_ndf_scaled(surface->distribution, ax, ay, wm);
}

float vndf_p22(const vndf_surface *surface, float x, float y)
{
    float ax, ay;
    if (!vndf_surface_scaled(surface, &ax, &ay) || !(fabsf(x) < HUGE_VALF) || !(fabsf(y) < HUGE_VALF))
        return 0.0f;
    const vndf_distribution *d = surface->distribution;
    float r = vndf_length2(x / ax, y / ay), z = 1.0f / (1.0f + r);
    if (d->kind == VNDF_KIND_GGX)
        return vndf_ggx_p22(r * r) / ax / ay;
    if (d->kind == VNDF_KIND_BECKMANN)
        return vndf_beckmann_p22(r * r) / ax / ay;
    return vndf_engine_p22_over_z4(d, r < HUGE_VALF ? r * z : 1.0f, z) * (z * z) * (z * z) / ax / ay;
}

/* The stretched direction of a surface: length 0 if anything is invalid. */
static vndf_view stretched(const vndf_surface *surface, vndf_vec3 w)
{
    return vndf_view_from(surface, w);
}

float vndf_projected_area(const vndf_surface *surface, vndf_vec3 w)
{
    vndf_view view = stretched(surface, w);
    return view.distribution ? vndf_unit_area(view.distribution, view.s, view.c) / view.per_length : 0.0f;
}

/* Lambda(w) = A(-w)/cos(theta) above the horizon, without a difference; -1 - Lambda(-w) below. */
float vndf_lambda(const vndf_surface *surface, vndf_vec3 w)
{
    vndf_view view = stretched(surface, w);
    if (!view.distribution)
        return 0.0f;
    float up = fabsf(view.c), lambda = vndf_unit_area(view.distribution, view.s, -up) / up;
    lambda = lambda < FLT_MAX ? lambda : FLT_MAX; /* at the horizon the quotient is infinite, or 0/0 */
    return view.wi.z < 0.0f ? -1.0f - lambda : lambda;
}

float vndf_g1(const vndf_surface *surface, vndf_vec3 w)
{
    vndf_view view = stretched(surface, w);
    float g1 = view.distribution && view.c > 0.0f ? view.c / vndf_unit_area(view.distribution, view.s, view.c) : 0.0f;
    return g1 < 1.0f ? g1 : 1.0f;
}

float vndf_g2(const vndf_surface *surface, vndf_vec3 wi, vndf_vec3 wo, vndf_g2_model model)
{
    float gi = vndf_g1(surface, wi), go = vndf_g1(surface, wo);
    if (model == VNDF_G2_SEPARABLE || gi == 0.0f || go == 0.0f)
        return gi * go;
    return gi * go / (gi + go - gi * go); /* 1/(1 + Lambda_i + Lambda_o), with 1 + Lambda = 1/G1 */
}
