/* Averages of test functions over samples, each weighted by true density over returned density, against the
 * quadrature of the same functions: shared by the short and the long test. */
#ifndef TESTS_ORACLE_ORACLE_UNBIASED_H
#define TESTS_ORACLE_ORACLE_UNBIASED_H

#include "oracle/oracle_validate.h"

enum { ORACLE_FUNCTIONS = 6 };

/* One roughness and direction, and the true averages there of the functions of wm: 1, wm.z, wm.x, wm.y^2, wi.wm,
 * and a soft step at the slope `middle`. */
typedef struct oracle_expected {
    float alpha_x, alpha_y;
    vndf_vec3 wi;
    double middle, reference[ORACLE_FUNCTIONS];
} oracle_expected;
oracle_expected oracle_expect(const oracle *o, const vndf_surface *surface, vndf_vec3 wi);

/* By samples: the mean and its standard error. */
typedef struct oracle_average {
    double mean, error;
} oracle_average;

/* Fills one average per function. Samples are drawn with 24-bit uniform numbers from the state. */
void oracle_averages(const oracle *o, const vndf_distribution *table, const oracle_expected *expected,
                     unsigned long samples, unsigned long long *state, oracle_average average[ORACLE_FUNCTIONS]);

#endif
