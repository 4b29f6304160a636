/* Beta(a, b) = Gamma(a) Gamma(b)/Gamma(a + b). Both arguments are brought to 10 or more,
 *
 *     Beta(a, b) = Beta(a + 1, b) (a + b)/a,
 *
 * and Stirling's series is taken there, its error below 6e-11. With a >= b
 *
 *     log Beta = log(2 pi)/2 + (b - 1/2) log b - b log(a + b) - (a - 1/2) log(1 + b/a) + R(a) + R(b) - R(a + b),
 *
 * where nothing of the size of a cancels. Factors a + b of the first steps are taken over the last one, so that
 * they do not overflow; its powers join the logarithm. */
#include "bsdf/beta.h"

#include "math/elementary.h"

/* log Gamma(x) without its large terms: 1/(12 x) - 1/(360 x^3) + 1/(1260 x^5). */
static double remainder_at(double x)
{
    double per = 1.0 / x, square = per * per;
    return per * (1.0 / 12 - square * (1.0 / 360 - square * (1.0 / 1260)));
}

/* Product of (a + b)/a over the steps, each over `sum`. */
static double raised(double *a, double b, double sum, double *steps)
{
    double over = 1.0, under = 1.0;
    for (; *a < 10.0; *a += 1.0) {
        over *= (*a + b) / sum;
        under *= *a;
        *steps += 1.0;
    }
    return over / under;
}

double vndf_beta(double a, double b)
{
    if (b > a)
        return vndf_beta(b, a);
    if (!(a < 1e300))
        return 0.0;
    double sum = a + b + 20.0, steps = 0.0, factor = raised(&a, b, sum, &steps);
    factor *= raised(&b, a, sum, &steps);
    double large = a > b ? a : b, small = a > b ? b : a;
    double most = (small - 0.5) * vndf_log(small) - small * vndf_log(large + small) + steps * vndf_log(sum);
    double logarithm = 0.91893853320467274 + most - (large - 0.5) * vndf_log1p(small / large) +
                       (remainder_at(large) + remainder_at(small) - remainder_at(large + small));
    return factor * vndf_exp(logarithm);
}
