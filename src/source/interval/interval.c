/* The ends of intervals, and + - * / of them: see interval.h. */
#include "source/interval/interval.h"

#include <float.h>

static const double ROUNDING = 3e-16; /* of + - * /: more than half a unit in the last place */

/* ---- ends ---- */

/* Exponents beyond 2^50 are rounded too. */
static double exponent_error(double e)
{
    return fabs(e) > 0x1p50 ? 4 * ROUNDING * fabs(e) : 0;
}

static vndf_wide moved(vndf_wide x, double by, double exponents)
{
    return vndf_wide_settle(x.m + by, floor(x.e + exponents));
}

static vndf_wide down(vndf_wide x, double part)
{
    double size = fabs(x.m), spread = exponent_error(x.e);
    vndf_wide largest = {0.5, vndf_wide_exponent}, zero = {0, 0};
    if (isinf(x.m))
        return x.m > 0 ? largest : x;
    if (x.m > 0 && x.e <= -vndf_wide_exponent)
        return zero;
    return moved(x, -size * part, x.m > 0 ? -spread : spread);
}

static vndf_wide up(vndf_wide x, double part)
{
    return vndf_wide_minus(down(vndf_wide_minus(x), part));
}

vndf_interval vndf_interval_widened(vndf_wide low, vndf_wide high, double part)
{
    vndf_interval a = {down(low, part), up(high, part)};
    return isnan(low.m) || isnan(high.m) ? vndf_interval_all() : a;
}

vndf_interval vndf_interval_of_library(double low, double high)
{
    return vndf_interval_widened(vndf_wide_from(low), vndf_wide_from(high), VNDF_LIBRARY);
}

/* Whether doubles without exponents can hold the ends. */
static int plain(vndf_interval a, vndf_interval b)
{
    return a.low.e == 0 && a.high.e == 0 && b.low.e == 0 && b.high.e == 0;
}

/* The same for low <= high whose ends need no exponents; else returns 0. */
static int widened_plainly(double low, double high, vndf_interval *a)
{
    double l = low - ROUNDING * fabs(low), h = high + ROUNDING * fabs(high);
    vndf_interval made = {{l, 0}, {h, 0}};
    *a = made;
    return vndf_wide_plain(l) && vndf_wide_plain(h);
}

static vndf_wide smaller(vndf_wide a, vndf_wide b)
{
    return vndf_wide_less(b, a) ? b : a;
}

vndf_wide vndf_wide_larger(vndf_wide a, vndf_wide b)
{
    return vndf_wide_less(a, b) ? b : a;
}

vndf_interval vndf_interval_from(double low, double high)
{
    vndf_interval a = {vndf_wide_from(low), vndf_wide_from(high)};
    return a;
}

vndf_interval vndf_interval_all(void)
{
    return vndf_interval_from(-HUGE_VAL, HUGE_VAL);
}

vndf_interval vndf_interval_hull(vndf_interval a, vndf_interval b)
{
    vndf_interval both = {smaller(a.low, b.low), vndf_wide_larger(a.high, b.high)};
    return both;
}

double vndf_interval_low(vndf_interval a)
{
    double x = vndf_wide_double(a.low);
    if (x == 0 && a.low.m < 0)
        return -DBL_MIN;
    return isinf(x) && x > 0 ? DBL_MAX : x - DBL_MIN * (fabs(x) > 0 && fabs(x) < DBL_MIN);
}

double vndf_interval_high(vndf_interval a)
{
    return -vndf_interval_low(vndf_interval_negative(a));
}

/* ---- arithmetic ---- */

vndf_interval vndf_interval_negative(vndf_interval a)
{
    vndf_interval b = {vndf_wide_minus(a.high), vndf_wide_minus(a.low)};
    return b;
}

static int is_number(vndf_interval a, double x)
{
    return a.low.m == x && a.high.m == x && a.low.e == 0 && a.high.e == 0;
}

/* Whole numbers so small that their sum and product are exact: counts, signs, the limits of saturating functions.
 * A result that was not rounded is not vndf_interval_widened, so that 1 - tanh(r)^2 is 0 where tanh is 1. */
static int is_small_whole(vndf_interval a)
{
    double x = a.low.m;
    return is_number(a, x) && fabs(x) < 0x1p26 && floor(x) == x;
}

vndf_interval vndf_interval_sum(vndf_interval a, vndf_interval b)
{
    vndf_interval sum;
    if (is_number(a, 0) || is_number(b, 0))
        return is_number(a, 0) ? b : a;
    if (is_small_whole(a) && is_small_whole(b))
        return vndf_interval_from(a.low.m + b.low.m, a.low.m + b.low.m);
    if (plain(a, b) && widened_plainly(a.low.m + b.low.m, a.high.m + b.high.m, &sum))
        return sum;
    return vndf_interval_widened(vndf_wide_plus(a.low, b.low), vndf_wide_plus(a.high, b.high), ROUNDING);
}

vndf_interval vndf_interval_difference(vndf_interval a, vndf_interval b)
{
    return vndf_interval_sum(a, vndf_interval_negative(b));
}

/* fmin and fmax of the C library are calls. */
static double least_of(double a, double b)
{
    return a < b ? a : b;
}

static double most_of(double a, double b)
{
    return a > b ? a : b;
}

static vndf_interval product_of_wides(vndf_interval a, vndf_interval b)
{
    vndf_wide p = vndf_wide_times(a.low, b.low), q = vndf_wide_times(a.low, b.high);
    vndf_wide r = vndf_wide_times(a.high, b.low), s = vndf_wide_times(a.high, b.high);
    return vndf_interval_widened(smaller(smaller(p, q), smaller(r, s)),
                                 vndf_wide_larger(vndf_wide_larger(p, q), vndf_wide_larger(r, s)), ROUNDING);
}

vndf_interval vndf_interval_product(vndf_interval a, vndf_interval b)
{
    vndf_interval product;
    if (is_number(a, 1) || is_number(b, 1))
        return is_number(a, 1) ? b : a;
    if (is_small_whole(a) && is_small_whole(b))
        return vndf_interval_from(a.low.m * b.low.m, a.low.m * b.low.m);
    if (!plain(a, b))
        return product_of_wides(a, b);
    double p = a.low.m * b.low.m, q = a.low.m * b.high.m, r = a.high.m * b.low.m, s = a.high.m * b.high.m;
    double low = least_of(least_of(p, q), least_of(r, s)), high = most_of(most_of(p, q), most_of(r, s));
    return p + q + r + s - (p + q + r + s) == 0 && widened_plainly(low, high, &product) ? product
                                                                                        : product_of_wides(a, b);
}

static vndf_interval reciprocal(vndf_interval b)
{
    const vndf_wide one = {1, 0};
    vndf_interval all = vndf_interval_all();
    if ((b.low.m < 0 && b.high.m > 0) || (b.low.m == 0 && b.high.m == 0))
        return all;
    if (b.low.m == 0) /* on one side of 0 */
        return (vndf_interval){down(vndf_wide_over(one, b.high), ROUNDING), all.high};
    if (b.high.m == 0)
        return (vndf_interval){all.low, up(vndf_wide_over(one, b.low), ROUNDING)};
    return vndf_interval_widened(vndf_wide_over(one, b.high), vndf_wide_over(one, b.low), ROUNDING);
}

vndf_interval vndf_interval_quotient(vndf_interval a, vndf_interval b)
{
    return vndf_interval_product(a, reciprocal(b));
}

vndf_interval vndf_interval_scaled(vndf_interval a, double factor)
{
    return vndf_interval_product(a, vndf_interval_from(factor, factor));
}
