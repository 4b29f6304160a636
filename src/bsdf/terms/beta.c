/* Beta(a, b) = Gamma(a) Gamma(b)/Gamma(s), s = a + b, by Stirling's formula with a factor G that makes it exact,
 *
 *     Gamma(x) = sqrt(2 pi) x^(x - 1/2) e^-x G(x),    G(x) = P(x)/Q(x) for x >= 1,
 *     Beta = sqrt(2 pi/s) G(a) G(b)/G(s) exp(-(a - 1/2) log(s/a) - (b - 1/2) log(s/b)).
 *
 * P and Q are cubic: G tends to 1 as 1/x vanishes, and meets Gamma in six Chebyshev nodes of 1/x in (0, 1]; error
 * 3.3e-9. With a >= b nothing of the size of a cancels where log(s/a) is taken as log1p(b/a). */
#include "bsdf/terms/beta.h"

#include "math/elementary.h"

/* G is over/under; beyond 1e15 it is 1. */
typedef struct fraction {
    double over, under;
} fraction;

VNDF_INLINE fraction correction_at(double x)
{
    double at = x < 1e15 ? x : 1e15, square = at * at;
    fraction g = {square * (at + 0.877274526231992049) + (0.461868317211344979 * at + 0.0465154620075117628),
                  square * (at + 0.793941164930515474) + (0.392236399396363733 * at + 0.0137262470011538833)};
    return g;
}

/* log(1 + b/a), a >= b; up to 1e4 times the error of the quotient does not show. */
VNDF_INLINE double log_of_sum_over(double a, double b, double sum)
{
    return a < 1e4 ? vndf_log(sum / a) : vndf_log1p(b / a);
}

double vndf_beta(double x, double y)
{
    double a = x > y ? x : y, b = x > y ? y : x, s = a + b;
    if (!(a < 1e300))
        return 0.0;
    fraction at_a = correction_at(a), at_b = correction_at(b), at_s = correction_at(s);
    double exponent = (a - 0.5) * log_of_sum_over(a, b, s) + (b - 0.5) * vndf_log(s / b);
    double over = 2.5066282746310005 * (at_a.over * at_b.over) * at_s.under;
    return vndf_exp(-exponent) * over / (at_a.under * at_b.under * at_s.over * sqrt(s));
}
