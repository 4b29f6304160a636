/* Densities of the closed forms: P22 and D of the real problem, for any roughness in [1e-18, 1e18], in double. Nothing
 * overflows or underflows on the way, and products of two floats are exact. Results may lie beyond float.
 *
 * With a = alpha_x alpha_y, Q = (alpha_y wm.x)^2 + (alpha_x wm.y)^2 + (a wm.z)^2 and r = 1/(a wm.z)^2
 *
 *     GGX: D = a^3/(pi Q^2),    Beckmann: D = a^3 r^2 exp(-R^2)/pi,  R^2 = r Q - 1 the squared slope length. */
#ifndef VNDF_SAMPLER_ANALYTIC_DENSITY_H
#define VNDF_SAMPLER_ANALYTIC_DENSITY_H

#include <math.h>

#include "math/elementary.h"
#include "vndf.h"

static const double vndf_inverse_pi = 0.31830988618379067, vndf_root_pi = 1.7724538509055160;

/* A normal, lane by lane. */
typedef struct vndf_normal {
    doubles x, y, z;
} vndf_normal;

#if VNDF_LANES == 1

VNDF_INLINE vndf_normal vndf_normal_of(vndf_vec3 wm)
{
    vndf_normal n = {wm.x, wm.y, wm.z};
    return n;
}

#endif

/* ---- GGX ---- */

/* P22 at the squared slope length r2. */
VNDF_INLINE doubles vndf_ggx_p22(doubles r2)
{
    doubles q = 1.0 + r2;
    return vndf_inverse_pi / (q * q);
}

/* D at a unit wm, wm.z >= 0; relative error below 1e-14. */
VNDF_INLINE doubles vndf_ggx_ndf(doubles alpha_x, doubles alpha_y, vndf_normal wm)
{
    doubles a = alpha_x * alpha_y, x = alpha_y * wm.x, y = alpha_x * wm.y, z = a * wm.z;
    doubles q = x * x + y * y + z * z;
    return vndf_inverse_pi * (a * a * a) / (q * q);
}

/* ---- Beckmann ---- */

/* exp(-r2), or 0 beyond 700: factors are at most 1e90, which does not bring it back to a float. */
VNDF_INLINE doubles vndf_exp_falling(doubles r2)
{
    const doubles most = doubles_set(700.0), nothing = doubles_set(0.0);
    doubles_m counts = doubles_less(r2, most);
    return doubles_pick(counts, vndf_exp_near(nothing - doubles_pick(counts, r2, most)), nothing);
}

VNDF_INLINE doubles vndf_beckmann_p22(doubles r2)
{
    return vndf_inverse_pi * vndf_exp_falling(r2);
}

/* a^3 r^2 exp(-exponent)/pi; r may be infinite where that is 0. */
VNDF_INLINE doubles vndf_beckmann_scaled(doubles a, doubles r, doubles exponent)
{
    doubles scaled = vndf_beckmann_p22(exponent) * (a * a * a) * (r * r);
    return doubles_pick(doubles_less(exponent, doubles_set(700.0)), scaled, doubles_set(0.0));
}

/* D at a unit wm, wm.z >= 0; relative error below 1e-15 (1 + R^2). */
VNDF_INLINE doubles vndf_beckmann_ndf(doubles alpha_x, doubles alpha_y, vndf_normal wm)
{
    doubles a = alpha_x * alpha_y, x = alpha_y * wm.x, y = alpha_x * wm.y, z = a * wm.z, r = 1.0 / (z * z);
    return vndf_beckmann_scaled(a, r, r * (x * x + y * y));
}

#endif
