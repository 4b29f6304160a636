/* D of any distribution at a given normal, and the visible density Dv = D (wi.wm)/A(wi), in double from the very
 * numbers that came in, for one or for lanes. Areas are those of area.h, as long as the stretched direction is.
 *
 * Beckmann below the horizon: D and the area both hold exp(-K^2), K = U/S, and both underflow. What is left of
 * R^2 is y^2 + d (d - 2 K) (beckmann.c), of one sign; with (p, q) = (alpha_x wi.x, alpha_y wi.y), f = wi . wm, a =
 * alpha_x alpha_y and r = 1/(a wm.z)^2
 *
 *     R^2 - K^2 = r/(p^2 + q^2) ((alpha_x p wm.y - alpha_y q wm.x)^2 + a^2 f (f - 2 wi.z wm.z)),
 *     A exp(K^2) = S N/(N + K)/(2 sqrt(pi))          (N: math/erfc_remainder.h)
 *
 * from wi itself, since the left side is a difference of numbers of the size of K^2. Dv falls by exp(-1) where the
 * slope moves by 1/(2 K^2) of itself: it is the density of wm as it was rounded, and where that is a hundred such
 * steps (K above some 3e4) it may be 0. */
#ifndef VNDF_SAMPLER_ANALYTIC_DENSITY_H
#define VNDF_SAMPLER_ANALYTIC_DENSITY_H

#include "sampler/closed.h"
#include "sampler/tabulated/density.h"

/* Roughness in range, and a normal above the surface whose square is a float that is not 0. */
VNDF_INLINE doubles_m vndf_normal_is_valid(const vndf_given *g)
{
    const doubles least = doubles_set(1e-18), most = doubles_set(1e18);
    doubles square = g->x * g->x + g->y * g->y + g->z * g->z;
    doubles_m low = doubles_both(doubles_at_most(least, g->wi.ax), doubles_at_most(least, g->wi.ay));
    doubles_m high = doubles_both(doubles_at_most(g->wi.ax, most), doubles_at_most(g->wi.ay, most));
    doubles_m usable = doubles_both(doubles_at_most(doubles_set(FLT_TRUE_MIN), square),
                                    doubles_less(square, doubles_set(FLT_MAX)));
    return doubles_both(doubles_both(low, high), doubles_both(usable, doubles_at_most(doubles_set(0.0), g->z)));
}

/* D, of a valid normal. */
VNDF_INLINE doubles vndf_ndf_of(const vndf_distribution *d, const vndf_given *g)
{
    vndf_normal wm = {g->x, g->y, g->z};
    if (d->kind == VNDF_KIND_GGX)
        return vndf_ggx_ndf(g->wi.ax, g->wi.ay, wm);
    if (d->kind == VNDF_KIND_BECKMANN)
        return vndf_beckmann_ndf(g->wi.ax, g->wi.ay, wm);
    vndf_bare n = vndf_bare_of(g);
    return vndf_given_ndf(d, &n);
}

/* ---- visible ---- */

/* R^2 - K^2 below the horizon. */
VNDF_INLINE doubles vndf_beckmann_exponent_below(const vndf_given *g, doubles facing, doubles r)
{
    doubles ax = g->wi.ax, ay = g->wi.ay, a = ax * ay, p = ax * g->wi.x, q = ay * g->wi.y;
    doubles side = ax * p * g->y - ay * q * g->x, along = a * a * facing * (facing - 2.0 * g->wi.z * g->z);
    return (side * side + along) / (p * p + q * q) * r;
}

/* D over A; below the horizon both are without exp(-K^2), and A without U. */
VNDF_INLINE doubles vndf_beckmann_visible(const vndf_given *g, doubles facing)
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

/* a^3/(pi Q^2) over A = (L + U)/2, or S^2/(2 (L + U)) below the horizon. */
VNDF_INLINE doubles vndf_ggx_visible(const vndf_given *g, doubles facing)
{
    doubles a = g->wi.ax * g->wi.ay, x = g->wi.ay * g->x, y = g->wi.ax * g->y, z = a * g->z;
    doubles q = x * x + y * y + z * z, across = vndf_direction_across(&g->wi), s2 = across * across;
    doubles sum = doubles_root(s2 + g->wi.z * g->wi.z) + doubles_abs(g->wi.z);
    doubles_m below = doubles_less(g->wi.z, doubles_set(0.0)), seen = doubles_less(doubles_set(0.0), s2);
    doubles part = q * q * doubles_pick(below, s2, sum * sum);
    doubles visible = 2.0 * vndf_inverse_pi * (a * a * a) * (facing * sum) / part;
    return doubles_pick(doubles_without(below, seen), doubles_set(0.0), visible); /* straight down sees nothing */
}

/* Dv where wi . wm = facing > 0 and all is valid. */
VNDF_INLINE doubles vndf_visible_of(const vndf_distribution *d, const vndf_given *g, doubles facing)
{
    const doubles nothing = doubles_set(0.0);
    if (d->kind == VNDF_KIND_GGX)
        return vndf_ggx_visible(g, facing);
    if (d->kind == VNDF_KIND_BECKMANN)
        return vndf_beckmann_visible(g, facing);
    doubles area = vndf_area_below(d, &g->wi, vndf_direction_is_valid(&g->wi)) + doubles_positive(g->wi.z);
    return doubles_pick(doubles_less(nothing, area), vndf_ndf_of(d, g) / area * facing, nothing);
}

#endif
