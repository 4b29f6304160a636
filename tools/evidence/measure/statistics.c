#include "evidence/measure/measure.h"

#include <math.h>

/* Q(a, x) of the incomplete gamma function, a = dof/2, by Q(a + 1, x) = Q(a, x) + x^a e^-x/Gamma(a + 1) (DLMF 8.8.6)
 * from Q(1/2, x) = erfc(sqrt(x)) or Q(0, x) = 0. All terms are positive. */
double statistics_chi_square_p(double statistic, size_t dof)
{
    const double x = statistic / 2, first = dof % 2 ? 0.5 : 0;
    double sum = dof % 2 ? erfc(sqrt(x)) : 0;
    if (dof == 0 || statistic <= 0)
        return 1;
    if (isinf(x))
        return 0;
    for (double a = first; a < (double)dof / 2; a++)
        sum += exp(a * log(x) - x - lgamma(a + 1));
    return sum > 1 ? 1 : sum;
}

double statistics_sidak(double level, size_t n)
{
    return n == 0 ? level : -expm1(log1p(-level) / (double)n);
}

typedef struct class_sum {
    double expected, observed;
} class_sum;

static double deviation(double expected, double observed)
{
    return (observed - expected) * (observed - expected) / expected;
}

/* Bins that expect little go together with their neighbours, so that a deviation in a tail is not drowned by the
 * rest of it. The newest class is kept open, since what is left at the end joins it. */
pearson pearson_of(const double *expected, const double *observed, size_t bins)
{
    static const double LEAST = 5;
    class_sum open = {0, 0}, last = {0, 0};
    pearson found = {0, 0, 0};
    for (size_t i = 0; i < bins; i++) {
        const int is_alone = expected[i] >= LEAST;
        const class_sum bin = {expected[i] + (is_alone ? 0 : open.expected),
                               observed[i] + (is_alone ? 0 : open.observed)};
        open = is_alone ? open : bin;
        if (!(bin.expected >= LEAST))
            continue;
        open = is_alone ? open : (class_sum){0, 0};
        found.statistic += found.classes++ ? deviation(last.expected, last.observed) : 0;
        last = bin;
    }
    if (!found.classes)
        return found;
    found.statistic += deviation(last.expected + open.expected, last.observed + open.observed);
    found.p = statistics_chi_square_p(found.statistic, found.classes - 1);
    return found;
}
