/* Incomplete gamma (DLMF 8.7.1 and 8.9.2): below x = a + 1 the series
 *
 *     P(a, x) = x^a e^-x / Gamma(a + 1) * sum_n x^n / ((a + 1) ... (a + n)),
 *
 * above it the continued fraction of Q(a, x), evaluated forwards by Lentz's method. Both need of the
 * order of sqrt(a) terms near x = a, where they are slowest. */
#include "evidence/measure/statistics.h"

#include <math.h>

enum { TERMS_MAX = 100000 };

/* x^a e^-x / Gamma(a). Around x = a, where a log x and x are large and nearly cancel, the difference is
 * taken by log1p and Stirling's series instead of lgamma. */
static double gamma_front(double a, double x)
{
    if (a < 20)
        return exp(a * log(x) - x - lgamma(a));
    double relative = (x - a) / a;
    double exponent = a * (log1p(relative) - relative);
    double stirling = (1.0 / 12 - (1.0 / 360 - 1.0 / (1260 * a * a)) / (a * a)) / a;
    return sqrt(a / (2 * acos(-1.0))) * exp(exponent - stirling);
}

static double series_p(double a, double x)
{
    double term = 1 / a, sum = term;
    for (int n = 1; n < TERMS_MAX && term > sum * 1e-17; n++) {
        term *= x / (a + n);
        sum += term;
    }
    return sum * gamma_front(a, x);
}

static double fraction_q(double a, double x)
{
    double b = x + 1 - a, c = 1e300, d = 1 / b, product = d;
    for (int n = 1; n < TERMS_MAX; n++) {
        double numerator = -n * (n - a);
        b += 2;
        d = 1 / (b + numerator * d);
        c = b + numerator / c;
        product *= c * d;
        if (fabs(c * d - 1) < 1e-16)
            break;
    }
    return product * gamma_front(a, x);
}

double statistics_gamma_q(double a, double x)
{
    if (!(a > 0) || !(x >= 0))
        return NAN;
    if (x == 0)
        return 1;
    if (isinf(x))
        return 0;
    return x < a + 1 ? 1 - series_p(a, x) : fraction_q(a, x);
}

double statistics_chi_square_p(double statistic, size_t dof)
{
    return dof == 0 ? 1 : statistics_gamma_q((double)dof / 2, statistic / 2);
}

double statistics_sidak(double level, size_t n)
{
    return n == 0 ? level : -expm1(log1p(-level) / (double)n);
}

/* ---- Pearson ------------------------------------------------------------------------------------- */

typedef struct class_sum {
    double expected, observed, variance;
} class_sum;

static double deviation(class_sum sum)
{
    double difference = sum.observed - sum.expected;
    return difference * difference / sum.variance;
}

static class_sum together(class_sum a, class_sum b)
{
    return (class_sum){a.expected + b.expected, a.observed + b.observed, a.variance + b.variance};
}

/* Bins that expect little go together with their neighbours, so that a deviation in a tail is not drowned by the
 * rest of it. The newest class is kept open, since what is left at the end joins it. */
pearson pearson_of(const double *expected, const double *observed, const double *variance, size_t bins,
                   double least)
{
    class_sum open = {0, 0, 0}, last = {0, 0, 0};
    pearson found = {0, 0, 0, 0};
    for (size_t i = 0; i < bins; i++) {
        class_sum bin = {expected[i], observed[i], variance ? variance[i] : expected[i]};
        if (!(bin.expected >= least)) {
            found.pooled++;
            open = together(open, bin);
            if (!(open.expected >= least))
                continue;
            bin = open;
            open = (class_sum){0, 0, 0};
        }
        found.statistic += found.classes++ ? deviation(last) : 0;
        last = bin;
    }
    if (!found.classes)
        return found;
    found.statistic += deviation(together(last, open));
    found.p = statistics_chi_square_p(found.statistic, found.classes - 1);
    return found;
}
