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

vndf_jet vndf_jet_number(double x);

vndf_jet vndf_jet_negative(const vndf_jet *x);
vndf_jet vndf_jet_sum(const vndf_jet *x, const vndf_jet *y);
vndf_jet vndf_jet_difference(const vndf_jet *x, const vndf_jet *y);
vndf_jet vndf_jet_product(const vndf_jet *x, const vndf_jet *y);
vndf_jet vndf_jet_quotient(const vndf_jet *x, const vndf_jet *y);
vndf_jet vndf_jet_pow(const vndf_jet *x, const vndf_jet *y);
vndf_jet vndf_jet_min(const vndf_jet *x, const vndf_jet *y);
vndf_jet vndf_jet_max(const vndf_jet *x, const vndf_jet *y);

vndf_jet vndf_jet_exp(const vndf_jet *x);
vndf_jet vndf_jet_log(const vndf_jet *x);
vndf_jet vndf_jet_sqrt(const vndf_jet *x);
vndf_jet vndf_jet_sin(const vndf_jet *x);
vndf_jet vndf_jet_cos(const vndf_jet *x);
vndf_jet vndf_jet_tan(const vndf_jet *x);
vndf_jet vndf_jet_asin(const vndf_jet *x);
vndf_jet vndf_jet_acos(const vndf_jet *x);
vndf_jet vndf_jet_atan(const vndf_jet *x);
vndf_jet vndf_jet_sinh(const vndf_jet *x);
vndf_jet vndf_jet_cosh(const vndf_jet *x);
vndf_jet vndf_jet_tanh(const vndf_jet *x);
vndf_jet vndf_jet_erf(const vndf_jet *x);
vndf_jet vndf_jet_erfc(const vndf_jet *x);
vndf_jet vndf_jet_lgamma(const vndf_jet *x);
vndf_jet vndf_jet_gamma(const vndf_jet *x);
vndf_jet vndf_jet_abs(const vndf_jet *x);
vndf_jet vndf_jet_step(const vndf_jet *x);

#endif
