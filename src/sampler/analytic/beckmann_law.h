/* What Beckmann's distribution answers to sampler/law.h. With K = U/S, where S is the length of the stretched direction
 * across z and U its part along z, A(-|w|) = S exp(-K^2) N/(N + K)/(2 sqrt(pi)), N(K) of math/erfc_remainder.h.
 *
 * Below the horizon D and the area both hold exp(-K^2), and both underflow. What is left of
 * R^2 is y^2 + d (d - 2 K) (beckmann.c), of one sign; with (p, q) = (alpha_x wi.x, alpha_y wi.y), f = wi . wm, a =
 * alpha_x alpha_y and r = 1/(a wm.z)^2
 *
 *     R^2 - K^2 = r/(p^2 + q^2) ((alpha_x p wm.y - alpha_y q wm.x)^2 + a^2 f (f - 2 wi.z wm.z)),
 *     A exp(K^2) = S N/(N + K)/(2 sqrt(pi))          (N: math/erfc_remainder.h)
 *
 * from wi itself, since the left side is a difference of numbers of the size of K^2. Dv falls by exp(-1) where the
 * slope moves by 1/(2 K^2) of itself: it is the density of wm as it was rounded, and where that is a hundred such
 * steps (K above some 3e4) it may be 0. */
#ifndef VNDF_SAMPLER_ANALYTIC_BECKMANN_LAW_H
#define VNDF_SAMPLER_ANALYTIC_BECKMANN_LAW_H

#include "math/vector.h"
#include "sampler/all_normals/slope.h"
#include "sampler/analytic/beckmann_draw.h"
#include "sampler/analytic/view.h"
#include "sampler/analytic_density.h"
#include "sampler/tabulated/density.h"

/* ---- for one or for lanes ---- */

/* K, at most 1e30: more does not show. */
VNDF_INLINE doubles vndf_beckmann_cotangent(doubles across, doubles up)
{
    doubles least = 1e-30 * up;
    return up / doubles_pick(doubles_less(least, across), across, least);
}

/* exp(-K^2), at least 1e-304, which does not show either. */
VNDF_INLINE doubles vndf_beckmann_falloff(doubles k)
{
    return vndf_exp_near(-doubles_between(k * k, 0.0, 700.0));
}

static const double vndf_per_two_root_pi = 0.28209479177387814;

VNDF_INLINE doubles vndf_beckmann_area_below(doubles across, doubles up)
{
    doubles k = vndf_beckmann_cotangent(across, up);
    vndf_erfc_quotient n = vndf_erfc_remainder_parts(k);
    return vndf_per_two_root_pi * across * vndf_beckmann_falloff(k) * (n.above / (n.above + k * n.below));
}

/* R^2 - K^2 below the horizon. */
VNDF_INLINE doubles vndf_beckmann_exponent_below(const vndf_query *g, doubles facing, doubles r)
{
    doubles ax = g->wi.ax, ay = g->wi.ay, a = ax * ay, p = ax * g->wi.x, q = ay * g->wi.y;
    doubles side = ax * p * g->y - ay * q * g->x, along = a * a * facing * (facing - 2.0 * g->wi.z * g->z);
    return (side * side + along) / (p * p + q * q) * r;
}

/* D over A; below the horizon both are without exp(-K^2), and A without U. */
VNDF_INLINE doubles vndf_beckmann_visible(const vndf_query *g, doubles facing)
{
    const doubles one = doubles_set(1.0), nothing = doubles_set(0.0);
    doubles a = g->wi.ax * g->wi.ay, x = g->wi.ay * g->x, y = g->wi.ax * g->y, z = a * g->z, r = 1.0 / (z * z);
    doubles across = vndf_direction_across(&g->wi), up = doubles_abs(g->wi.z), falloff = one;
    doubles k = vndf_beckmann_cotangent(across, up), exponent = r * (x * x + y * y);
    doubles_m below = doubles_less(g->wi.z, nothing), above = doubles_at_most(nothing, g->wi.z);
    if (doubles_any(below))
        exponent = doubles_pick(below, vndf_beckmann_exponent_below(g, facing, r), exponent);
    if (doubles_any(above))
        falloff = doubles_pick(below, one, vndf_beckmann_falloff(k));
    vndf_erfc_quotient n = vndf_erfc_remainder_parts(k);
    doubles t = n.above + k * n.below, least = vndf_per_two_root_pi * across * (falloff * n.above);
    doubles per = t / (least + doubles_pick(below, nothing, up) * t);
    doubles visible = vndf_beckmann_scaled(a, r, exponent) * (facing * per);
    return doubles_pick(doubles_without(below, doubles_less(nothing, across)), nothing, visible);
}

/* A/across, from K = c/s = z/across (sampler/analytic/beckmann_draw.h). */
VNDF_INLINE lanes_f vndf_beckmann_area_over(lanes_f bound)
{
    lanes_f line = 3.54490770f * bound;
    return 0.282094792f * (1.0f + (line + vndf_beckmann_tail(bound, lanes_less(bound, lanes_set(2.0f)))));
}

/* A(w) for a unit w = (wx, wy, wz), wz > 0; relative error below 2e-6. Where *trusted is 0 it has to be computed
 * otherwise. */
VNDF_INLINE lanes_f vndf_beckmann_area_above(lanes_f ax, lanes_f ay, lanes_f wx, lanes_f wy, lanes_f wz,
                                             lanes_m *trusted)
{
    lanes_f x = ax * wx, y = ay * wy, across2 = x * x + y * y, across = lanes_root(across2), sum = across + wz;
    *trusted = vndf_trusts_direction(across2, wz, sum);
    if (!lanes_any(*trusted))
        return lanes_set(0.0f);
    return across * vndf_beckmann_area_over(wz / across);
}

/* The same of the direction of a view. Clears *trusted where roughness is not ordinary. */
VNDF_INLINE lanes_f vndf_beckmann_seen_area(lanes_f ax, lanes_f ay, lanes_f wx, lanes_f wy, lanes_f wz,
                                            lanes_m *trusted)
{
    lanes_m ready;
    lanes_f area = vndf_beckmann_area_above(ax, ay, wx, wy, wz, &ready);
    *trusted = lanes_both(*trusted, lanes_both(ready, vndf_trusts_scale(ax, ay, wz)));
    return area;
}

#if VNDF_LANES == 1

/* ---- views ---- */

/* vndf_view_from, and the same in place. */
vndf_view vndf_beckmann_view_from(const vndf_surface *surface, vndf_vec3 wi);
void vndf_beckmann_view_set(vndf_view *view, const vndf_surface *surface, vndf_vec3 wi);

/* vndf_sample of a valid view, and the same where densities in float are known not to do. */
vndf_vec3 vndf_beckmann_view_sample(const vndf_view *view, float u1, float u2, float *pdf);
vndf_vec3 vndf_beckmann_view_sample_exactly(const vndf_view *view, float u1, float u2, float *pdf);

/* vndf_invert of a valid view, wm.z >= 0. */
void vndf_beckmann_view_invert(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2);

/* ---- all normals ---- */

/* The rounding of a normal, 6e-7 of R with that of its azimuth, is R^2 times as much of P22. */
VNDF_INLINE vndf_slope vndf_beckmann_slope_of(float u)
{
    double rest = u < 1.0f ? 1.0 - u : VNDF_LEAST_REST, square = -vndf_log(rest);
    vndf_slope r = {(float)sqrt(square > 0.0 ? square : 0.0), 1.0f, 0.318309886f * (float)rest,
                    square < VNDF_TRUST_ALL_BECKMANN};
    return r;
}

#endif
#endif
