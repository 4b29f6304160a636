/* Bounds of a function on an interval of u: enclosures of its values and of its Taylor coefficients, f^(k)(u)/k!,
 * at all points of the interval. Where f is not smooth the coefficients are the whole line; at a kink the first
 * coefficient stays bounded. */
#ifndef VNDF_SOURCE_INTERVAL_JET_H
#define VNDF_SOURCE_INTERVAL_JET_H

#include "source/interval/interval.h"

enum { VNDF_JET = 3 }; /* the last coefficient */

typedef struct vndf_jet {
    int constant; /* coefficients beyond the value are 0 */
    vndf_interval at[VNDF_JET + 1];
} vndf_jet;

vndf_jet vndf_jet_constant(vndf_interval value);
vndf_jet vndf_jet_number(double x);
int vndf_jet_is_number(vndf_jet x); /* a finite one, known exactly */

/* A function of x of which only the value is known. */
vndf_jet vndf_jet_value(vndf_interval value, vndf_jet x);

vndf_jet vndf_jet_negative(vndf_jet x);
vndf_jet vndf_jet_sum(vndf_jet x, vndf_jet y);
vndf_jet vndf_jet_difference(vndf_jet x, vndf_jet y);
vndf_jet vndf_jet_product(vndf_jet x, vndf_jet y);
vndf_jet vndf_jet_quotient(vndf_jet x, vndf_jet y);

/* y and its derivative by x, which is d. */
vndf_jet vndf_jet_integral(vndf_interval value, vndf_jet x, vndf_jet d);

/* y and z with y' = z and z' = sign y, where sign is 1 or -1: sin, cosh and their kin. */
vndf_jet vndf_jet_wave(vndf_jet x, vndf_interval y, vndf_interval z, int sign);

vndf_jet vndf_jet_exp(vndf_jet x);
vndf_jet vndf_jet_log(vndf_jet x);
vndf_jet vndf_jet_power(vndf_jet x, double exponent);
vndf_jet vndf_jet_pow(vndf_jet x, vndf_jet y);
vndf_jet vndf_jet_max(vndf_jet x, vndf_jet y);

#endif
