/* Intervals that hold the exact result in spite of rounding: every end moves outwards by a few units in the last
 * place, more than the error of + - * / and of the C library. Where a function is defined on a part of the interval
 * only, the result is for that part; where it is defined nowhere, the result is the whole line.
 *
 * Ends are numbers of any size, m 2^e: so exp(-1e30) is not 0 and exp(1e30) not infinite, and their product is right.
 * Inside [2^-400, 2^400] e is 0 and m is the number; outside m is in [1/2, 1) and e, a whole number, may be as large
 * as 1e300. */
#ifndef VNDF_SOURCE_INTERVAL_INTERVAL_H
#define VNDF_SOURCE_INTERVAL_INTERVAL_H

#include <math.h>

typedef struct vndf_wide {
    double m, e;
} vndf_wide;

typedef struct vndf_interval {
    vndf_wide low, high;
} vndf_interval;

int vndf_wide_less(vndf_wide a, vndf_wide b);

vndf_interval vndf_interval_from(double low, double high); /* as they stand */
vndf_interval vndf_interval_all(void);
vndf_interval vndf_interval_hull(vndf_interval a, vndf_interval b);
vndf_interval vndf_interval_of_library(double low, double high); /* of what the C library gave for the two ends */

/* The ends as doubles, outwards. */
double vndf_interval_low(vndf_interval a);
double vndf_interval_high(vndf_interval a);

vndf_interval vndf_interval_negative(vndf_interval a);
vndf_interval vndf_interval_size(vndf_interval a); /* the absolute value */
vndf_interval vndf_interval_sum(vndf_interval a, vndf_interval b);
vndf_interval vndf_interval_difference(vndf_interval a, vndf_interval b);
vndf_interval vndf_interval_product(vndf_interval a, vndf_interval b);
vndf_interval vndf_interval_quotient(vndf_interval a, vndf_interval b);
vndf_interval vndf_interval_scaled(vndf_interval a, double factor);
vndf_interval vndf_interval_exp(vndf_interval x);
vndf_interval vndf_interval_log(vndf_interval x);
vndf_interval vndf_interval_power(vndf_interval x, double exponent); /* negative x only if the exponent is whole */

#endif
