/* Pearson's chi-square: counts of samples in bins against what is expected there. The one place that pools bins
 * and decides; `vndf check` and all tests that bin use it. */
#ifndef TOOLS_EVIDENCE_MEASURE_PEARSON_H
#define TOOLS_EVIDENCE_MEASURE_PEARSON_H

#include <stddef.h>

typedef struct pearson {
    double statistic; /* sum of (observed - expected)^2 / expected */
    double p;         /* the chance of a larger one if the samples follow what is expected; 0 without a class */
    size_t classes;   /* classes - 1 degrees of freedom */
    size_t pooled;    /* bins that expect less than `least` */
} pearson;

/* The bins have to be all there is: both sums are the number of samples. A bin that expects `least` or more is a
 * class; the others are added up in their order until they expect as much, and what is left at the end joins the
 * last class. variance: by what a squared difference is divided, for expectations that are estimates; NULL: by
 * what is expected. */
pearson pearson_of(const double *expected, const double *observed, const double *variance, size_t bins,
                   double least);

#endif
