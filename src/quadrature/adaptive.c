#include "quadrature/adaptive.h"

#include <math.h>

#include "quadrature/gauss.h"

static double rule(vndf_integrand *f, void *user, double a, double b)
{
    double sum = 0.0;
    for (int i = 0; i < VNDF_GAUSS; i++)
        sum += vndf_gauss_weight[i] * f(a + (b - a) * vndf_gauss_node[i], user);
    return sum * (b - a);
}

static vndf_integral refine(vndf_integrand *f, void *user, double a, double b, double whole, double tolerance,
                            int depth)
{
    double middle = a + (b - a) / 2, left = rule(f, user, a, middle), right = rule(f, user, middle, b);
    double error = fabs(left + right - whole);
    vndf_integral result = {left + right, error};
    if (!(error > tolerance) || depth <= 0) /* also ends where f is NaN */
        return result;
    vndf_integral l = refine(f, user, a, middle, left, tolerance / 2, depth - 1);
    vndf_integral r = refine(f, user, middle, b, right, tolerance / 2, depth - 1);
    result.value = l.value + r.value;
    result.error = l.error + r.error;
    return result;
}

vndf_integral vndf_integrate(vndf_integrand *f, void *user, double a, double b, double tolerance, int depth)
{
    return refine(f, user, a, b, rule(f, user, a, b), tolerance, depth);
}
