/* Densities of the closed forms: P22, D and Dv of the real problem, any roughness within [1e-18, 1e18], in double:
 * nothing overflows or underflows on the way, and products of two floats are exact. Results may lie beyond float.
 *
 * With a = alpha_x alpha_y, Q = (alpha_y wm.x)^2 + (alpha_x wm.y)^2 + (a wm.z)^2 and r = 1/(a wm.z)^2
 *
 *     GGX: D = a^3/(pi Q^2),    Beckmann: D = a^3 r^2 exp(-R^2)/pi,  R^2 = r Q - 1 the squared slope length.
 *
 * Beckmann below the horizon: D and the area both hold exp(-K^2), K = c/s, and both underflow. What is left of
 * R^2 is y^2 + d (d - 2 K) (beckmann.c), of one sign; with (p, q) = (alpha_x wi.x, alpha_y wi.y) and f = wi . wm
 *
 *     R^2 - K^2 = r/(p^2 + q^2) ((alpha_x p wm.y - alpha_y q wm.x)^2 + a^2 f (f - 2 wi.z wm.z)),
 *     A1 exp(K^2) = s N/(N + |K|)/(2 sqrt(pi))          (N: math/erfc_remainder.h)
 *
 * from wi itself, since the left side is a difference of numbers of the size of K^2. Dv falls by exp(-1) where the
 * slope moves by 1/(2 K^2) of itself: it is the density of wm as it was rounded, and where that is a hundred such
 * steps (|K| above some 3e4) it may be 0. */
#ifndef VNDF_SAMPLER_CLOSED_H
#define VNDF_SAMPLER_CLOSED_H

#include <math.h>

#include "core/inline.h"
#include "math/elementary.h"
#include "sampler/stretch.h"
#include "vndf.h"

static const double vndf_inverse_pi = 0.31830988618379067, vndf_root_pi = 1.7724538509055160;

/* A normal in double. */
typedef struct vndf_normal {
    double x, y, z;
} vndf_normal;

VNDF_INLINE vndf_normal vndf_normal_of(vndf_vec3 wm)
{
    vndf_normal n = {wm.x, wm.y, wm.z};
    return n;
}

/* wm taken back to the unit problem, in the turned frame, as if cos_phi^2 + sin_phi^2 were 1: not unit. */
VNDF_INLINE vndf_normal vndf_normal_to_unit(const vndf_view *view, vndf_vec3 wm)
{
    double a = view->cos_phi, b = view->sin_phi, per = 1.0 / (a * a + b * b);
    double x = wm.x * per / view->alpha_x, y = wm.y * per / view->alpha_y;
    vndf_normal n = {a * x + b * y, a * y - b * x, wm.z};
    return n;
}

/* wi . wm: here the terminator is. */
VNDF_INLINE double vndf_facing(const vndf_view *view, vndf_normal wm)
{
    return view->wi.x * wm.x + view->wi.y * wm.y + view->wi.z * wm.z;
}

/* ---- GGX ---- */

/* At the squared slope length r2. */
VNDF_INLINE double vndf_ggx_p22(double r2)
{
    double q = 1.0 + r2;
    return vndf_inverse_pi / (q * q);
}

/* At a unit wm, wm.z >= 0; relative error below 1e-14. */
VNDF_INLINE double vndf_ggx_ndf(double alpha_x, double alpha_y, vndf_normal wm)
{
    double a = alpha_x * alpha_y, x = alpha_y * wm.x, y = alpha_x * wm.y, z = a * wm.z;
    double q = x * x + y * y + z * z;
    return vndf_inverse_pi * (a * a * a) / (q * q);
}

/* Where facing = wi . wm > 0; relative error below 1e-6 at every angle. 0 where s is 0. */
VNDF_INLINE double vndf_ggx_visible(const vndf_view *view, const vndf_stretched *w, vndf_normal wm, double facing)
{
    double s = w->s, c = w->c;
    if (c < 0.0 && !(s > 0.0))
        return 0.0;
    double per_area = c < 0.0 ? 2.0 * (1.0 - c) / (s * s) : 2.0 / (1.0 + c);
    return vndf_ggx_ndf(view->alpha_x, view->alpha_y, wm) * (facing * w->per_length * per_area);
}

/* ---- Beckmann ---- */

/* A1 = c (1 + erf(c/s))/2 + s exp(-(c/s)^2)/(2 sqrt(pi)), relative error below 2e-7 on the whole sphere as
 * long as the result is a normal float; it underflows to 0 beyond c/s = -9 (174 degrees). */
float vndf_beckmann_area(float s, float c);

VNDF_INLINE double vndf_beckmann_p22(double r2)
{
    return vndf_inverse_pi * vndf_exp(-r2);
}

/* a^3 r^2 exp(-exponent)/pi; beyond 745 exp is 0, and r may be infinite. */
VNDF_INLINE double vndf_beckmann_scaled(double a, double r, double exponent)
{
    return exponent < 745.0 ? vndf_inverse_pi * vndf_exp(-exponent) * (a * a * a) * (r * r) : 0.0;
}

/* At a unit wm, wm.z >= 0; relative error below 1e-15 (1 + R^2). */
VNDF_INLINE double vndf_beckmann_ndf(double alpha_x, double alpha_y, vndf_normal wm)
{
    double a = alpha_x * alpha_y, x = alpha_y * wm.x, y = alpha_x * wm.y, z = a * wm.z, r = 1.0 / (z * z);
    return vndf_beckmann_scaled(a, r, r * (x * x + y * y));
}

/* A1 of a view above the horizon, from what drawing in float has of it where there is that (beckmann_draw.h). */
VNDF_INLINE double vndf_beckmann_view_area(const vndf_view *view, const vndf_stretched *w)
{
    if (!view->plain)
        return vndf_beckmann_area((float)w->s, (float)w->c);
    return w->s * (1.0 + view->closed[3] + view->closed[4]) / (2.0 * vndf_root_pi);
}

/* D exp(K^2) below the horizon. */
VNDF_INLINE double vndf_beckmann_ndf_below(const vndf_view *view, vndf_normal wm, double facing)
{
    double ax = view->alpha_x, ay = view->alpha_y, a = ax * ay, z = a * wm.z, r = 1.0 / (z * z);
    double p = ax * view->wi.x, q = ay * view->wi.y, across = ax * p * wm.y - ay * q * wm.x;
    double along = a * a * facing * (facing - 2.0 * view->wi.z * wm.z);
    return vndf_beckmann_scaled(a, r, (across * across + along) / (p * p + q * q) * r);
}

/* Where facing = wi . wm > 0; relative error below 1e-6, that of the area, at every angle. 0 where s is 0. */
VNDF_INLINE double vndf_beckmann_visible(const vndf_view *view, const vndf_stretched *w, vndf_normal wm,
                                         double facing)
{
    double weight = facing * w->per_length, s = w->s;
    if (w->c >= 0.0)
        return vndf_beckmann_ndf(view->alpha_x, view->alpha_y, wm) * (weight / vndf_beckmann_view_area(view, w));
    if (!(s > 0.0))
        return 0.0;
    double z = -w->c / s, n = vndf_erfc_remainder(z);
    return vndf_beckmann_ndf_below(view, wm, facing) * (weight * 2.0 * vndf_root_pi * (n + z) / (s * n));
}

#endif
