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
#include "bsdf/terms/beta.h"

#include "math/exp_log.h"

/* ---- a and b at most 3 ---- */

/* 1/Gamma(2 + v), |v| <= 1. */
VNDF_INLINE double per_gamma_low(double v)
{
    double v2 = v * v, v4 = v2 * v2;
    double a =
        (0.9999999993501139 + v * -0.42278433500756674) + v2 * (-0.23309368962807794 + v * 0.1910910948396736);
    double b = (-0.02455303604654195 + v * -0.017645167964305042) +
               v2 * (0.00802560377377868 + v * -0.0008046582377240052);
    double c = (-0.0003653361620208507 + v * 0.0001462358384124983) +
               v2 * (-1.3541934633449767e-05 + v * -3.1693808145962135e-06);
    return a + v4 * (b + v4 * c);
}

/* 1/Gamma(4 + v), |v| <= 2. */
VNDF_INLINE double per_gamma_high(double v)
{
    double v2 = v * v, v4 = v2 * v2, v8 = v4 * v4;
    double a =
        (0.16666666666666666 + v * -0.209352944650567) + v2 * (0.10783405343248284 + v * -0.023121037898835104);
    double b = (-0.002796893186094228 + v * 0.0032433801014373174) +
               v2 * (-0.0008994526894948745 + v * 7.492028646892942e-05);
    double c = (2.7330790824423336e-05 + v * -1.0992298267446304e-05) +
               v2 * (1.684827570761271e-06 + v * -5.10137902934449e-09);
    double d = (-5.539813856859537e-08 + v * 1.3073312724041908e-08) +
               v2 * (-1.155521796658847e-09 + v * -1.737361601000305e-10);
    return (a + v4 * b) + v8 * (c + v4 * (d + v4 * 4.4957524034074456e-11));
}

/* a and b at most 3. */
VNDF_INLINE double near_one(double a, double b)
{
    double s = a + b;
    return per_gamma_high(s - 4.0) / (per_gamma_low(a - 2.0) * per_gamma_low(b - 2.0));
}

/* ---- beyond ---- */

/* G is over/under; beyond 1e15 it is 1. */
typedef struct gamma_factor {
    double over, under;
} gamma_factor;

VNDF_INLINE gamma_factor gamma_factor_at(double x)
{
    double at = x < 1e15 ? x : 1e15, square = at * at;
    gamma_factor g = {square * (at + 0.877274526231992049) + (0.461868317211344979 * at + 0.0465154620075117628),
                      square * (at + 0.793941164930515474) + (0.392236399396363733 * at + 0.0137262470011538833)};
    return g;
}

/* log(s/a), a >= b. Up to 1e4 the error of the quotient does not show. */
VNDF_INLINE double log_of_sum_over(double a, double b)
{
    return a < 1e4 ? vndf_log((a + b) / a) : vndf_log1p(b / a);
}

double vndf_beta(double x, double y)
{
    double a = x > y ? x : y, b = x > y ? y : x, s = a + b;
    if (a <= 3.0)
        return near_one(a, b);
    if (!(a < 1e300))
        return 0.0;
    double falloff = vndf_exp(-((a - 0.5) * log_of_sum_over(a, b) + (b - 0.5) * vndf_log(s / b)));
    gamma_factor at_a = gamma_factor_at(a), at_b = gamma_factor_at(b), at_s = gamma_factor_at(s);
    double over = 2.5066282746310005 * (at_a.over * at_b.over) * at_s.under;
    return falloff * over / (at_a.under * at_b.under * at_s.over * sqrt(s));
}
