/* The cubic on [0, 1] that runs from f0 to f1 and has the moments mu0 (weight 1 - xi) and mu1 (weight xi):
 *
 *     f(xi) = f0 (1 - xi) + f1 xi + xi (1 - xi) (a + b xi).
 *
 * With e0, e1 the moments that the straight line lacks, a = 36 e0 - 24 e1 and b = 60 (e1 - e0). */
#ifndef VNDF_TABLE_MOMENT_CUBIC_H
#define VNDF_TABLE_MOMENT_CUBIC_H

typedef struct vndf_moment_cubic {
    double a, b;
} vndf_moment_cubic;

static inline vndf_moment_cubic vndf_moment_cubic_from(double f0, double f1, double mu0, double mu1)
{
    double e0 = mu0 - f0 / 3 - f1 / 6, e1 = mu1 - f0 / 6 - f1 / 3;
    vndf_moment_cubic cubic = {36 * e0 - 24 * e1, 60 * (e1 - e0)};
    return cubic;
}

#endif
