/* Euler's Beta function from + - * / sqrt alone. With s = a + b, by Stirling's formula with a factor G that makes it
 * exact,
 *
 *     Gamma(x) = sqrt(2 pi) x^(x - 1/2) e^-x G(x),    G(x) = P(x)/Q(x) for x >= 1,
 *     Beta = sqrt(2 pi/s) G(a) G(b)/G(s) exp(-(a - 1/2) log(s/a) - (b - 1/2) log(s/b)).
 *
 * P and Q are cubic: G tends to 1 as 1/x vanishes, and meets Gamma in six Chebyshev nodes of 1/x in (0, 1]; error
 * 3.3e-9. With a >= b nothing of the size of a cancels where log(s/a) is taken as log1p(b/a).
 *
 * Where a and b are at most 3, which is where most light passes, 1/Gamma is a polynomial, through Chebyshev's nodes: a
 * division and no logarithm; error 3.4e-9. */
#ifndef VNDF_BSDF_TERMS_BETA_H
#define VNDF_BSDF_TERMS_BETA_H

#include "math/elementary.h"

/* Beta(a, b), a and b from 1 to infinity; relative error below 2e-8 where it exceeds 1e-300. */
double vndf_beta(double a, double b);

/* ---- a and b at most 3, for one or for lanes ---- */

/* 1/Gamma(2 + v), |v| <= 1. */
VNDF_INLINE doubles vndf_per_gamma_low(doubles v)
{
    doubles v2 = v * v, v4 = v2 * v2;
    doubles a =
        (0.9999999993501139 + v * -0.42278433500756674) + v2 * (-0.23309368962807794 + v * 0.1910910948396736);
    doubles b = (-0.02455303604654195 + v * -0.017645167964305042) +
                v2 * (0.00802560377377868 + v * -0.0008046582377240052);
    doubles c = (-0.0003653361620208507 + v * 0.0001462358384124983) +
                v2 * (-1.3541934633449767e-05 + v * -3.1693808145962135e-06);
    return a + v4 * (b + v4 * c);
}

/* 1/Gamma(4 + v), |v| <= 2. */
VNDF_INLINE doubles vndf_per_gamma_high(doubles v)
{
    doubles v2 = v * v, v4 = v2 * v2, v8 = v4 * v4;
    doubles a =
        (0.16666666666666666 + v * -0.209352944650567) + v2 * (0.10783405343248284 + v * -0.023121037898835104);
    doubles b = (-0.002796893186094228 + v * 0.0032433801014373174) +
                v2 * (-0.0008994526894948745 + v * 7.492028646892942e-05);
    doubles c = (2.7330790824423336e-05 + v * -1.0992298267446304e-05) +
                v2 * (1.684827570761271e-06 + v * -5.10137902934449e-09);
    doubles d = (-5.539813856859537e-08 + v * 1.3073312724041908e-08) +
                v2 * (-1.155521796658847e-09 + v * -1.737361601000305e-10);
    return (a + v4 * b) + v8 * (c + v4 * (d + v4 * 4.4957524034074456e-11));
}

/* a and b at most 3. */
VNDF_INLINE doubles vndf_beta_near(doubles a, doubles b)
{
    doubles s = a + b;
    return vndf_per_gamma_high(s - 4.0) / (vndf_per_gamma_low(a - 2.0) * vndf_per_gamma_low(b - 2.0));
}

/* ---- beyond ---- */

/* G is over/under; beyond 1e15 it is 1. */
typedef struct vndf_gamma_factor {
    doubles over, under;
} vndf_gamma_factor;

VNDF_INLINE vndf_gamma_factor vndf_gamma_factor_at(doubles x)
{
    const doubles most = doubles_set(1e15);
    doubles at = doubles_pick(doubles_less(x, most), x, most), square = at * at;
    vndf_gamma_factor g = {
        square * (at + 0.877274526231992049) + (0.461868317211344979 * at + 0.0465154620075117628),
        square * (at + 0.793941164930515474) + (0.392236399396363733 * at + 0.0137262470011538833)};
    return g;
}

/* What the exponential is of, negated; `log_a` = log(s/a). */
VNDF_INLINE doubles vndf_beta_exponent(doubles a, doubles b, doubles log_a)
{
    return (a - 0.5) * log_a + (b - 0.5) * vndf_log((a + b) / b);
}

/* Beta from the exponential. */
VNDF_INLINE doubles vndf_beta_far(doubles a, doubles b, doubles falloff)
{
    doubles s = a + b;
    vndf_gamma_factor at_a = vndf_gamma_factor_at(a), at_b = vndf_gamma_factor_at(b),
                      at_s = vndf_gamma_factor_at(s);
    doubles over = 2.5066282746310005 * (at_a.over * at_b.over) * at_s.under;
    return falloff * over / (at_a.under * at_b.under * at_s.over * doubles_root(s));
}

/* From where log(s/a) is taken as log1p(b/a): up to there the error of the quotient does not show. */
static const double VNDF_BETA_LOG = 1e4;

#if VNDF_LANES > 1

/* vndf_beta in lanes. Clears *ready where the call for one has another form. */
VNDF_INLINE doubles vndf_beta_lanes(doubles x, doubles y, doubles_m *ready)
{
    doubles_m first = doubles_less(y, x);
    doubles a = doubles_pick(first, x, y), b = doubles_pick(first, y, x), beta = vndf_beta_near(a, b);
    doubles_m near = doubles_at_most(a, doubles_set(3.0)), far = doubles_without(*ready, near);
    if (!doubles_any(far))
        return beta;
    doubles exponent = vndf_beta_exponent(a, b, vndf_log((a + b) / a));
    doubles_m good =
        doubles_both(doubles_less(a, doubles_set(VNDF_BETA_LOG)), doubles_at_most(exponent, doubles_set(700.0)));
    *ready = doubles_without(*ready, doubles_without(far, good));
    exponent = doubles_pick(good, exponent, doubles_set(0.0));
    return doubles_pick(near, beta, vndf_beta_far(a, b, vndf_exp_near(-exponent)));
}

#endif
#endif
