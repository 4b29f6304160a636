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

/* Small arguments use the theta-transformed series, which converges where the other does not. */
static double kolmogorov_tail(double x)
{
    const double pi = acos(-1.0);
    double sum = 0;
    if (x <= 0)
        return 1;
    if (x < 1.18) {
        for (int k = 1; k <= 7; k += 2)
            sum += exp(-k * k * pi * pi / (8 * x * x));
        return 1 - sqrt(2 * pi) / x * sum;
    }
    for (int k = 1; k <= 6; k++)
        sum += (k % 2 ? 2 : -2) * exp(-2.0 * k * k * x * x);
    return sum;
}

double statistics_kolmogorov_p(double distance, size_t n)
{
    double root = sqrt((double)n);
    return n == 0 ? 1 : kolmogorov_tail(distance * (root + 0.12 + 0.11 / root));
}

double statistics_sidak(double level, size_t n)
{
    return n == 0 ? level : -expm1(log1p(-level) / (double)n);
}
