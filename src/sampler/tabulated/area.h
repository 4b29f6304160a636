/* Projected area, Lambda and G1 of any distribution, in double from the very numbers that came in, for one or
 * for lanes. All three come from the area A(-|w|) of the direction turned below the horizon, a sum of positive
 * terms: A(w) - A(-w) = cos(theta), so A(|w|) = cos(theta) + A(-|w|) and Lambda = A(-|w|)/cos(theta).
 *
 * The direction (alpha_x w.x, alpha_y w.y, w.z) stays as long as it is: an area grows with the length, and
 * quotients drop it. With S its part across, U = |w.z| and L^2 = S^2 + U^2
 *
 *     table     2 (S + U) M(S/(S + U)),    M the mass of half the wedge below (sampler/tabulated/theory.h)
 *     GGX       S^2/(2 (L + U)),
 *     Beckmann  S exp(-K^2) N/(N + K)/(2 sqrt(pi)),    K = U/S, N(K) of math/erfc_remainder.h. */
#ifndef VNDF_SAMPLER_TABULATED_AREA_H
#define VNDF_SAMPLER_TABULATED_AREA_H

#include "math/elementary.h"
#include "sampler/tabulated/wedge.h"

/* Roughness times the table's scale, and a direction. */
typedef struct vndf_direction {
    doubles ax, ay, x, y, z;
} vndf_direction;

/* Whether it is one: elsewhere all is 0. */
VNDF_INLINE doubles_m vndf_direction_is_valid(const vndf_direction *w)
{
    const doubles least = doubles_set(1e-18), most = doubles_set(1e18);
    doubles square = w->x * w->x + w->y * w->y + w->z * w->z;
    doubles_m low = doubles_both(doubles_at_most(least, w->ax), doubles_at_most(least, w->ay));
    doubles_m high = doubles_both(doubles_at_most(w->ax, most), doubles_at_most(w->ay, most));
    doubles_m usable =
        doubles_both(doubles_less(doubles_set(0.0), square), doubles_less(square, doubles_set(HUGE_VAL)));
    return doubles_both(doubles_both(low, high), usable);
}

/* S. */
VNDF_INLINE doubles vndf_direction_across(const vndf_direction *w)
{
    doubles x = w->ax * w->x, y = w->ay * w->y;
    return doubles_root(x * x + y * y);
}

VNDF_INLINE doubles vndf_area_below_table(const vndf_distribution *d, doubles across, doubles up, doubles_m valid)
{
    doubles sum = across + up, y = doubles_pick(valid, across / sum, doubles_set(0.5)); /* to be looked up */
    return 2.0 * sum * vndf_wedge_mass(&d->below, y);
}

VNDF_INLINE doubles vndf_area_below_ggx(doubles across, doubles up)
{
    doubles across2 = across * across;
    return 0.5 * across2 / (doubles_root(across2 + up * up) + up);
}

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

VNDF_INLINE doubles vndf_area_below_beckmann(doubles across, doubles up)
{
    doubles k = vndf_beckmann_cotangent(across, up);
    vndf_erfc_quotient n = vndf_erfc_remainder_parts(k);
    return vndf_per_two_root_pi * across * vndf_beckmann_falloff(k) * (n.above / (n.above + k * n.below));
}

/* A(-|w|). */
VNDF_INLINE doubles vndf_area_below(const vndf_distribution *d, const vndf_direction *w, doubles_m valid)
{
    doubles across = vndf_direction_across(w), up = doubles_abs(w->z);
    if (d->kind == VNDF_KIND_GGX)
        return vndf_area_below_ggx(across, up);
    if (d->kind == VNDF_KIND_BECKMANN)
        return vndf_area_below_beckmann(across, up);
    return vndf_area_below_table(d, across, up, valid);
}

/* ---- what the public calls return ---- */

/* Per length of w. */
VNDF_INLINE doubles_f vndf_area_of(const vndf_distribution *d, const vndf_direction *w)
{
    doubles_m valid = vndf_direction_is_valid(w);
    doubles area = vndf_area_below(d, w, valid) + doubles_positive(w->z);
    doubles length = doubles_root(w->x * w->x + w->y * w->y + w->z * w->z);
    return doubles_narrow(doubles_pick(valid, area / length, doubles_set(0.0)));
}

/* At the horizon the quotient is infinite, or 0/0. */
VNDF_INLINE doubles_f vndf_lambda_of(const vndf_distribution *d, const vndf_direction *w)
{
    const doubles most = doubles_set(FLT_MAX);
    doubles_m valid = vndf_direction_is_valid(w);
    doubles exact = vndf_area_below(d, w, valid) / doubles_abs(w->z);
    doubles lambda = doubles_widen(doubles_narrow(doubles_pick(doubles_less(exact, most), exact, most)));
    lambda = doubles_pick(doubles_less(w->z, doubles_set(0.0)), -1.0 - lambda, lambda);
    return doubles_narrow(doubles_pick(valid, lambda, doubles_set(0.0)));
}

VNDF_INLINE doubles_f vndf_g1_of(const vndf_distribution *d, const vndf_direction *w)
{
    doubles_m valid = vndf_direction_is_valid(w);
    doubles up = w->z, g1 = up / (up + vndf_area_below(d, w, valid)), one = doubles_set(1.0);
    g1 = doubles_pick(doubles_less(g1, one), g1, one);
    doubles_m above = doubles_both(valid, doubles_less(doubles_set(0.0), up));
    return doubles_narrow(doubles_pick(above, g1, doubles_set(0.0)));
}

#endif
