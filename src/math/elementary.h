/* exp, log, log1p, erfc and atan2 from + - * / and sqrt alone, so that closed forms give the same bits with every
 * C library. Relative errors, measured by tests/core/test_elementary.c against long double: exp and log below
 * 4e-16 (exp beyond 700 either way 1e-15), log1p and atan2 below 8e-16, half_erfc below 3e-9.
 *
 *   exp    x = k log 2 + r, |r| <= (log 2)/2: 1 + r + r^2 times a polynomial of degree 9 (error 1.6e-17),
 *          times 2^k.
 *   log    x = 2^k m, 1/sqrt(2) <= m < sqrt(2); log m = 2 atanh f with f = (m - 1)/(m + 1), |f| < 0.1716:
 *          2 f (1 + s times a polynomial of degree 6 in s = f^2, error 4.4e-18).
 *   log1p  log(1 + x) times x over the rounded x, (1 + x) - 1 (Higham, "Accuracy and Stability of Numerical
 *          Algorithms", SIAM 2002, 1.14.1).
 *   atan2  the smaller part over the larger, its angle halved twice: |t| < 0.199, twelve terms.
 *
 * log 2 is split so that k times the first part is exact. The polynomials of exp and log interpolate at
 * Chebyshev's nodes; all are summed in pairs, for short chains. */
#ifndef VNDF_MATH_ELEMENTARY_H
#define VNDF_MATH_ELEMENTARY_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "core/inline.h"
#include "math/erfc_remainder.h"

static const double vndf_log2_high = 0x1.62e42fefap-1, vndf_log2_low = 0x1.cf79abc9e3b398p-40;

/* |x| <= 700. The nearest k appears in the low bits of a sum that is too large for fractions. */
VNDF_INLINE doubles vndf_exp_near(doubles x)
{
    doubles shifted = x * 1.4426950408889634 + 0x1.8p52, whole = shifted - 0x1.8p52;
    doubles r = (x - whole * vndf_log2_high) - whole * vndf_log2_low, r2 = r * r, r4 = r2 * r2;
    doubles low = (0.500000000000000103 + r * 0.166666666666666675) +
                  r2 * (0.0416666666666238205 + r * 0.0083333333333300382);
    doubles middle = (0.00138888889173670806 + r * 0.00019841269863171556) +
                     r2 * (2.48015210578682052e-5 + r * 2.75572682769056962e-6);
    doubles high = 2.76202015910315488e-7 + r * 2.5100472505694996e-8;
    return (1.0 + (r + r2 * (low + r4 * (middle + r4 * high)))) * doubles_power_of_two(shifted);
}

/* x > 0, finite and not denormal. */
VNDF_INLINE doubles vndf_log(doubles x)
{
    doubles k, m = doubles_mantissa(x, &k), f = (m - 1.0) / (m + 1.0), s = f * f, s2 = s * s;
    doubles low =
        (0.333333333333333485 + s * 0.199999999999494453) + s2 * (0.142857143131269188 + s * 0.111111055446897481);
    doubles high = (0.090914462162684356 + s * 0.0766580586102750395) + s2 * 0.0730890357670866241;
    return k * vndf_log2_high + (2.0 * f + (2.0 * f * s * (low + s2 * s2 * high) + k * vndf_log2_low));
}

/* The angle whose tangent is t in [0, 1]. */
VNDF_INLINE doubles vndf_atan_unit(doubles t)
{
    t = t / (1.0 + doubles_root(1.0 + t * t));
    t = t / (1.0 + doubles_root(1.0 + t * t));
    doubles s = t * t, s2 = s * s, s4 = s2 * s2;
    doubles low = (1.0 / 3 - s * (1.0 / 5)) + s2 * (1.0 / 7 - s * (1.0 / 9));
    doubles middle = (1.0 / 11 - s * (1.0 / 13)) + s2 * (1.0 / 15 - s * (1.0 / 17));
    doubles high = (1.0 / 19 - s * (1.0 / 21)) + s2 * (1.0 / 23);
    return 4.0 * (t - t * s * (low + s4 * (middle + s4 * high)));
}

/* The azimuth of (x, y) in [-pi, pi], with the sign of y; 0 or pi with that sign where y is 0. */
VNDF_INLINE doubles vndf_atan2(doubles y, doubles x)
{
    const doubles nothing = doubles_set(0.0);
    doubles across = doubles_abs(x), aside = doubles_abs(y);
    doubles_m flat = doubles_less(aside, across);
    doubles larger = doubles_pick(flat, across, aside), smaller = doubles_pick(flat, aside, across);
    doubles angle = doubles_pick(doubles_less(nothing, larger), vndf_atan_unit(smaller / larger), nothing);
    angle = doubles_pick(doubles_less(across, aside), 1.5707963267948966 - angle, angle);
    return doubles_sign(doubles_pick(doubles_less(x, nothing), 3.1415926535897932 - angle, angle), y);
}

#if VNDF_LANES == 1 /* the rest is for one lane */

/* Any x: infinity above 1400, where exp(x/2) squared overflows, 0 below -1400, NaN for NaN. */
static inline double vndf_exp_far(double x)
{
    double root = fabs(x) <= 1400.0 ? vndf_exp_near(0.5 * x) : x > 0.0 ? HUGE_VAL : x < 0.0 ? 0.0 : x;
    return root * root;
}

VNDF_INLINE double vndf_exp(double x)
{
    return fabs(x) <= 700.0 ? vndf_exp_near(x) : vndf_exp_far(x);
}

/* x >= 0, finite. */
VNDF_INLINE double vndf_log1p(double x)
{
    double sum = 1.0 + x, added = sum - 1.0;
    return added > 0.0 ? vndf_log(sum) * (x / added) : x;
}

/* erfc(x)/2. */
VNDF_INLINE double vndf_half_erfc(double x)
{
    double z = fabs(x), tail = 0.28209479177387814 * vndf_exp(-z * z) / (z + vndf_erfc_remainder(z));
    return x < 0.0 ? 1.0 - tail : tail;
}

#endif
#endif
