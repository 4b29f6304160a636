/* Adaptive integration of one function on a finite interval. */
#ifndef VNDF_QUADRATURE_ADAPTIVE_H
#define VNDF_QUADRATURE_ADAPTIVE_H

typedef double vndf_integrand(double x, void *user);

typedef struct vndf_integral {
    double value;
    double error; /* estimate of |value - truth| */
} vndf_integral;

/* integral of f over [a, b] by 10-point Gauss rules, halved where the halves disagree with the whole by
 * more than tolerance times the part's share; at most 2^depth parts anywhere. NaN of f comes through. */
vndf_integral vndf_integrate(vndf_integrand *f, void *user, double a, double b, double tolerance, int depth);

#endif
