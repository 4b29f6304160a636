/* Probabilities that decide a test: regularised incomplete gamma, chi-square and Kolmogorov-Smirnov
 * p-values, and the level that each of several tests gets. Values only, no input or output. */
#ifndef TOOLS_EVIDENCE_MEASURE_STATISTICS_H
#define TOOLS_EVIDENCE_MEASURE_STATISTICS_H

#include <stddef.h>

/* Q(a, x) = Gamma(a, x)/Gamma(a), a > 0, x >= 0: relative error below 1e-11 for a from 1e-3 to
 * 1e4 where Q exceeds 1e-300. NaN for other arguments. */
double statistics_gamma_q(double a, double x);

/* The chance that chi-square with dof degrees of freedom exceeds the statistic. 1 if dof is 0. */
double statistics_chi_square_p(double statistic, size_t dof);

/* The chance that the Kolmogorov-Smirnov distance of n samples exceeds `distance`, which is 0 to 1: the asymptotic
 * series with Stephens' correction for finite n, within 2e-3 for n >= 20. 1 if n is 0. */
double statistics_kolmogorov_p(double distance, size_t n);

/* The level of each of n independent tests, so that all of them together err with probability `level`, which is
 * 0 to 1 (Sidak). */
double statistics_sidak(double level, size_t n);

#endif
