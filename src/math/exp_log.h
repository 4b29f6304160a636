/* exp, log and log1p in double from + - * / alone, so that the bits are the same with every C library. Relative errors,
 * measured against long double: exp and log below 4e-16 (exp beyond 700 either way 1e-15), log1p below 8e-16.
 *
 *   exp    x = k log 2 + r, |r| <= (log 2)/2: 1 + r + r^2 times a polynomial of degree 9 (error 1.6e-17),
 *          times 2^k.
 *   log    x = 2^k m, 1/sqrt(2) <= m < sqrt(2); log m = 2 atanh f with f = (m - 1)/(m + 1), |f| < 0.1716:
 *          2 f (1 + s times a polynomial of degree 6 in s = f^2, error 4.4e-18).
 *   log1p  log(1 + x) times x over the rounded x, (1 + x) - 1 (Higham, "Accuracy and Stability of Numerical
 *          Algorithms", SIAM 2002, 1.14.1).
 *
 * log 2 is split so that k times the first part is exact. The polynomials interpolate at Chebyshev's nodes
 * (tools/evidence/fits.py); they are summed in pairs, for short chains. */
#ifndef VNDF_MATH_EXP_LOG_H
#define VNDF_MATH_EXP_LOG_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "core/inline.h"

#define VNDF_LOG2_HIGH 0x1.62e42fefap-1
#define VNDF_LOG2_LOW 0x1.cf79abc9e3b398p-40

/* |x| <= 700. The nearest k appears in the low bits of a sum that is too large for fractions. */
VNDF_INLINE double vndf_exp_near(double x)
{
    double shifted = x * 1.4426950408889634 + 0x1.8p52, whole = shifted - 0x1.8p52, power;
    double r = (x - whole * VNDF_LOG2_HIGH) - whole * VNDF_LOG2_LOW, r2 = r * r, r4 = r2 * r2;
    double low = (0.500000000000000103 + r * 0.166666666666666675) +
                 r2 * (0.0416666666666238205 + r * 0.0083333333333300382);
    double middle = (0.00138888889173670806 + r * 0.00019841269863171556) +
                    r2 * (2.48015210578682052e-5 + r * 2.75572682769056962e-6);
    double high = 2.76202015910315488e-7 + r * 2.5100472505694996e-8;
    uint64_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    bits = (bits + 1023) << 52;
    memcpy(&power, &bits, sizeof power);
    return (1.0 + (r + r2 * (low + r4 * (middle + r4 * high)))) * power;
}

/* Any x: infinity above 1400, 0 below -1400, NaN for NaN. */
VNDF_INLINE double vndf_exp(double x)
{
    if (fabs(x) <= 700.0)
        return vndf_exp_near(x);
    double root = fabs(x) <= 1400.0 ? vndf_exp_near(0.5 * x) : x > 0.0 ? HUGE_VAL : x < 0.0 ? 0.0 : x;
    return root * root;
}

/* x > 0, finite and not denormal. */
VNDF_INLINE double vndf_log(double x)
{
    uint64_t bits, least = 0x3FE6A09E667F3BCDu; /* of 1/sqrt(2) */
    memcpy(&bits, &x, sizeof bits);
    int k = (int)((bits - least + ((uint64_t)1023 << 52)) >> 52) - 1023;
    bits -= (uint64_t)k << 52;
    memcpy(&x, &bits, sizeof x);
    double f = (x - 1.0) / (x + 1.0), s = f * f, s2 = s * s;
    double low =
        (0.333333333333333485 + s * 0.199999999999494453) + s2 * (0.142857143131269188 + s * 0.111111055446897481);
    double high = (0.090914462162684356 + s * 0.0766580586102750395) + s2 * 0.0730890357670866241;
    return k * VNDF_LOG2_HIGH + (2.0 * f + (2.0 * f * s * (low + s2 * s2 * high) + k * VNDF_LOG2_LOW));
}

/* x >= 0, finite. */
VNDF_INLINE double vndf_log1p(double x)
{
    double sum = 1.0 + x, added = sum - 1.0;
    return added > 0.0 ? vndf_log(sum) * (x / added) : x;
}

#endif
