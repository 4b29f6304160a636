/* Intervals that hold the exact result in spite of rounding: every end moves outwards by a few units in the last
 * place, more than the error of + - * / and of the C library. Ends are numbers of any size (wide.h). Where a
 * function is defined on a part of the interval only, the result is for that part; where it is defined nowhere,
 * the result is the whole line. */
#ifndef VNDF_SOURCE_INTERVAL_INTERVAL_H
#define VNDF_SOURCE_INTERVAL_INTERVAL_H

#include "source/interval/wide.h"

typedef struct vndf_interval {
    vndf_wide low, high;
} vndf_interval;

vndf_interval vndf_interval_from(double low, double high); /* as they stand */
vndf_interval vndf_interval_all(void);
vndf_interval vndf_interval_hull(vndf_interval a, vndf_interval b);

/* The ends as doubles, outwards. */
double vndf_interval_low(vndf_interval a);
double vndf_interval_high(vndf_interval a);

/* Whether 0 lies in it, ends included. */
static inline int vndf_interval_vanishes(vndf_interval a)
{
    return a.low.m <= 0 && a.high.m >= 0;
}

vndf_interval vndf_interval_negative(vndf_interval a);
vndf_interval vndf_interval_sum(vndf_interval a, vndf_interval b);
vndf_interval vndf_interval_difference(vndf_interval a, vndf_interval b);
vndf_interval vndf_interval_product(vndf_interval a, vndf_interval b);
vndf_interval vndf_interval_quotient(vndf_interval a, vndf_interval b);
vndf_interval vndf_interval_scaled(vndf_interval a, double factor);

vndf_interval vndf_interval_exp(vndf_interval x);
vndf_interval vndf_interval_log(vndf_interval x);
vndf_interval vndf_interval_power(vndf_interval x, double exponent); /* negative x only if the exponent is whole */
vndf_interval vndf_interval_sin(vndf_interval x);
vndf_interval vndf_interval_cos(vndf_interval x);
vndf_interval vndf_interval_tan(vndf_interval x);
vndf_interval vndf_interval_asin(vndf_interval x);
vndf_interval vndf_interval_acos(vndf_interval x);
vndf_interval vndf_interval_atan(vndf_interval x);
vndf_interval vndf_interval_sinh(vndf_interval x);
vndf_interval vndf_interval_cosh(vndf_interval x);
vndf_interval vndf_interval_tanh(vndf_interval x);
vndf_interval vndf_interval_erf(vndf_interval x);
vndf_interval vndf_interval_erfc(vndf_interval x);
vndf_interval vndf_interval_lgamma(vndf_interval x);
vndf_interval vndf_interval_polygamma(int n,
                                      vndf_interval x); /* derivative n + 1 of lgamma, n from 0 to 2; x > 0 */

/* Moving the ends outwards: inside of interval.c and functions.c. */
static const double VNDF_LIBRARY = 3e-15; /* error of functions of the C library: many units in the last place */

/* Both ends moved by this part of them; the whole line if one is not a number. */
vndf_interval vndf_interval_widened(vndf_wide low, vndf_wide high, double part);

/* Of what the C library gave for the two ends. */
vndf_interval vndf_interval_of_library(double low, double high);

vndf_wide vndf_wide_larger(vndf_wide a, vndf_wide b);

#endif
