/* What decides a test: p-values of chi-square, the level that each of several tests gets, and Pearson's chi-square:
 * counts of samples in bins against what is expected there. The one place that pools bins and decides; `vndf check` and
 * all tests that bin use it. */
#pragma once

#include <stddef.h>

/* The chance that chi-square with dof degrees of freedom exceeds the statistic, 1 if dof is 0: relative error below
 * 1e-10 for 1e4 of them where it exceeds 1e-300. */
double statistics_chi_square_p(double statistic, size_t dof);

/* The level of each of n independent tests, so that all of them together err with probability `level`, which is
 * 0 to 1 (Sidak). */
double statistics_sidak(double level, size_t n);

typedef struct pearson {
    double statistic; /* sum of (observed - expected)^2 / expected */
    double p;         /* the chance of a larger one if the samples follow what is expected; 0 without a class */
    size_t classes;   /* classes - 1 degrees of freedom */
} pearson;

/* The bins have to be all there is: both sums are the number of samples. A bin that expects 5 or more is a class; the
 * others are added up in their order until they expect as much, and what is left at the end joins the last class. */
pearson pearson_of(const double *expected, const double *observed, size_t bins);
