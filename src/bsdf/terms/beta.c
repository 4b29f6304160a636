#include "bsdf/terms/beta.h"

/* log(s/a), a >= b. */
VNDF_INLINE double log_of_sum_over(double a, double b)
{
    return a < VNDF_BETA_LOG ? vndf_log((a + b) / a) : vndf_log1p(b / a);
}

double vndf_beta(double x, double y)
{
    double a = x > y ? x : y, b = x > y ? y : x;
    if (a <= 3.0)
        return vndf_beta_near(a, b);
    if (!(a < 1e300))
        return 0.0;
    return vndf_beta_far(a, b, vndf_exp(-vndf_beta_exponent(a, b, log_of_sum_over(a, b))));
}
