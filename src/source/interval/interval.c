/* Intervals: see interval.h. A monotone function takes its bounds at the ends, any other at its extremes in
 * between too. */
#include "source/interval/interval.h"

#include <float.h>

static const double ROUNDING = 3e-16;    /* of + - * /: more than half a unit in the last place */
static const double LIBRARY = 3e-15;     /* of functions of the C library: many units in the last place */
static const double EXPONENTIAL = 1e-15; /* of an exponent, the argument of exp() */
static const double LOG_2 = 0.69314718055994531;
static const double PI = 3.14159265358979323846;

/* ---- ends ---- */

static int is_whole(double x)
{
    return x == floor(x);
}

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

static vndf_interval widened(vndf_wide low, vndf_wide high, double part)
{
    vndf_interval a = {down(low, part), up(high, part)};
    return isnan(low.m) || isnan(high.m) ? vndf_interval_all() : a;
}

static vndf_interval of_doubles(double low, double high)
{
    return widened(vndf_wide_from(low), vndf_wide_from(high), LIBRARY);
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

static vndf_wide larger(vndf_wide a, vndf_wide b)
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
    vndf_interval both = {smaller(a.low, b.low), larger(a.high, b.high)};
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
 * A result that was not rounded is not widened, so that 1 - tanh(r)^2 is 0 where tanh is 1. */
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
    return widened(vndf_wide_plus(a.low, b.low), vndf_wide_plus(a.high, b.high), ROUNDING);
}

vndf_interval vndf_interval_difference(vndf_interval a, vndf_interval b)
{
    return vndf_interval_sum(a, vndf_interval_negative(b));
}

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
    return widened(smaller(smaller(p, q), smaller(r, s)), larger(larger(p, q), larger(r, s)), ROUNDING);
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
    vndf_wide one = {1, 0};
    if (b.low.m < 0 && b.high.m > 0)
        return vndf_interval_all();
    if (b.low.m == 0 && b.high.m == 0)
        return vndf_interval_all();
    if (b.low.m == 0 || b.high.m == 0) { /* on one side of 0 */
        vndf_interval beyond = b.low.m == 0 ? vndf_interval_from(0, HUGE_VAL) : vndf_interval_from(-HUGE_VAL, 0);
        if (b.low.m == 0)
            beyond.low = down(vndf_wide_over(one, b.high), ROUNDING);
        else
            beyond.high = up(vndf_wide_over(one, b.low), ROUNDING);
        return beyond;
    }
    return widened(vndf_wide_over(one, b.high), vndf_wide_over(one, b.low), ROUNDING);
}

vndf_interval vndf_interval_quotient(vndf_interval a, vndf_interval b)
{
    return vndf_interval_product(a, reciprocal(b));
}

vndf_interval vndf_interval_scaled(vndf_interval a, double factor)
{
    return vndf_interval_product(a, vndf_interval_from(factor, factor));
}

/* ---- exponentials and powers ---- */

/* exp of x, moved by its rounding, EXPONENTIAL |x|, in the direction `outwards` (-1 or 1). */
static vndf_wide exponential(double x, int outwards)
{
    double error = LIBRARY + EXPONENTIAL * fabs(x), whole = floor(x / LOG_2);
    if (fabs(x) < 270)
        return vndf_wide_from(exp(x) * (1 + outwards * LIBRARY));
    if (x < -1e290 || x > 1e290)
        return vndf_wide_from((x > 0) == (outwards > 0) && x > 0 ? HUGE_VAL : 0);
    if (error < 0.1)
        return vndf_wide_settle(exp(x - whole * LOG_2) * (1 + outwards * 2 * error), whole);
    return vndf_wide_settle(1, floor(whole + outwards * (2 * error + 2)));
}

/* 2^-1e290 takes the place of 0 as an upper end, and 2^1e290 that of infinity as a lower end. */
static vndf_wide exponential_end(vndf_wide x, int outwards)
{
    double d = vndf_wide_double(x);
    if (d < -1e290 && outwards > 0)
        return vndf_wide_settle(1, -1e290);
    if (d > 1e290 && outwards < 0)
        return vndf_wide_settle(1, 1e290);
    return exponential(d, outwards);
}

vndf_interval vndf_interval_exp(vndf_interval x)
{
    vndf_interval y = {exponential_end(x.low, -1), exponential_end(x.high, 1)};
    return y;
}

static double logarithm(vndf_wide x)
{
    return x.m <= 0 ? -HUGE_VAL : log(x.m) + x.e * LOG_2;
}

vndf_interval vndf_interval_log(vndf_interval x)
{
    if (x.high.m < 0)
        return vndf_interval_all();
    return of_doubles(logarithm(x.low), logarithm(x.high));
}

/* The power of a number >= 0. */
static vndf_wide power_end(vndf_wide x, double exponent, int outwards)
{
    double size = exponent * logarithm(x);
    if (x.m == 1 && x.e == 0)
        return x;
    if (x.m <= 0)
        return vndf_wide_from(exponent > 0 ? 0 : HUGE_VAL);
    if (x.e == 0 && fabs(size) < 270)
        return vndf_wide_from(pow(x.m, exponent) * (1 + outwards * LIBRARY));
    size += outwards * fabs(size) * LIBRARY;
    return exponential_end(vndf_wide_from(size), outwards);
}

static vndf_interval power_of_positive(vndf_interval x, double exponent)
{
    vndf_interval y = {power_end(exponent > 0 ? x.low : x.high, exponent, -1),
                       power_end(exponent > 0 ? x.high : x.low, exponent, 1)};
    return y;
}

static vndf_interval size_of(vndf_interval x)
{
    vndf_interval negative = vndf_interval_negative(x), zero = vndf_interval_from(0, 0);
    if (x.low.m >= 0)
        return x;
    if (x.high.m <= 0)
        return negative;
    zero.high = larger(x.high, negative.high);
    return zero;
}

vndf_interval vndf_interval_power(vndf_interval x, double exponent)
{
    vndf_interval part = x;
    int odd = is_whole(exponent) && !is_whole(exponent / 2);
    if (exponent == 0)
        return vndf_interval_from(1, 1);
    if (x.low.m >= 0)
        return power_of_positive(x, exponent);
    if (is_whole(exponent) && (!odd || x.high.m <= 0)) {
        part = power_of_positive(size_of(x), exponent);
        return odd ? vndf_interval_negative(part) : part;
    }
    if (odd && exponent < 0)
        return vndf_interval_all();
    part.low = vndf_wide_from(0);
    if (!odd)
        return x.high.m < 0 ? vndf_interval_all() : power_of_positive(part, exponent);
    part = power_of_positive(part, exponent);
    part.low = vndf_interval_negative(power_of_positive(size_of((vndf_interval){x.low, {0, 0}}), exponent)).low;
    return part;
}

/* ---- functions of doubles ---- */

/* Positive numbers too small for a double become the least one as an upper end. */
static double low_of(vndf_interval x)
{
    return vndf_interval_low(x);
}

static double high_of(vndf_interval x)
{
    return vndf_interval_high(x);
}

/* Whether place + n period lies in [low, high] for some n, or nearly. */
static int meets(double low, double high, double place, double period)
{
    double margin = 1e-15 * (1 + fabs(low) + fabs(high));
    return floor((high + margin - place) / period) >= ceil((low - margin - place) / period);
}

/* sin and cos: 1 at top + 2 pi n, -1 half a turn later. */
static vndf_interval wave(double (*f)(double), vndf_interval x, double top)
{
    double low = low_of(x), high = high_of(x);
    if (!(high - low < 2 * PI) || fabs(low) > 1e9 || fabs(high) > 1e9)
        return vndf_interval_from(-1, 1);
    double a = f(low), b = f(high), least = fmin(a, b), most = fmax(a, b);
    double error = LIBRARY * (fabs(least) + fabs(most));
    return vndf_interval_from(meets(low, high, top + PI, 2 * PI) ? -1 : fmax(least - error, -1),
                              meets(low, high, top, 2 * PI) ? 1 : fmin(most + error, 1));
}

vndf_interval vndf_interval_sin(vndf_interval x)
{
    return wave(sin, x, PI / 2);
}

vndf_interval vndf_interval_cos(vndf_interval x)
{
    return wave(cos, x, 0);
}

vndf_interval vndf_interval_tan(vndf_interval x)
{
    double low = low_of(x), high = high_of(x);
    if (!(high - low < PI) || fabs(low) > 1e9 || fabs(high) > 1e9 || meets(low, high, PI / 2, PI))
        return vndf_interval_all();
    return of_doubles(tan(low), tan(high));
}

vndf_interval vndf_interval_asin(vndf_interval x)
{
    double low = low_of(x), high = high_of(x);
    if (low > 1 || high < -1)
        return vndf_interval_all();
    return of_doubles(asin(fmax(low, -1)), asin(fmin(high, 1)));
}

vndf_interval vndf_interval_acos(vndf_interval x)
{
    double low = low_of(x), high = high_of(x);
    if (low > 1 || high < -1)
        return vndf_interval_all();
    return of_doubles(acos(fmin(high, 1)), acos(fmax(low, -1)));
}

vndf_interval vndf_interval_atan(vndf_interval x)
{
    return of_doubles(atan(low_of(x)), atan(high_of(x)));
}

/* A function that rises from -1 to 1, and is 1 in doubles from x = full on. There the interval has no width, so
 * that the difference of two such functions vanishes. */
static vndf_interval step_of(double (*f)(double), vndf_interval x, double full)
{
    double low = low_of(x), high = high_of(x);
    vndf_interval y = of_doubles(f(low), f(high));
    if (fabs(low) >= full)
        y.low.m = low < 0 ? -1 : 1;
    if (fabs(high) >= full)
        y.high.m = high < 0 ? -1 : 1;
    return y;
}

vndf_interval vndf_interval_tanh(vndf_interval x)
{
    return step_of(tanh, x, 20);
}

vndf_interval vndf_interval_erf(vndf_interval x)
{
    return step_of(erf, x, 6);
}

static const double FAR = 25; /* cosh is half an exponential in doubles; erfc is near its smallest value */

/* sinh and cosh of |x|: half of exp beyond FAR. */
static vndf_interval half_exp(vndf_interval x)
{
    return vndf_interval_scaled(vndf_interval_exp(x), 0.5);
}

static vndf_wide sinh_end(vndf_wide x, int outwards)
{
    vndf_wide size = x.m < 0 ? vndf_wide_minus(x) : x;
    if (vndf_wide_double(size) < FAR)
        return vndf_wide_from(sinh(vndf_wide_double(x)));
    vndf_interval half = half_exp((vndf_interval){size, size});
    return x.m < 0 ? vndf_wide_minus(outwards > 0 ? half.low : half.high) : outwards > 0 ? half.high : half.low;
}

vndf_interval vndf_interval_sinh(vndf_interval x)
{
    vndf_interval ends = vndf_interval_from(low_of(x), high_of(x));
    return widened(sinh_end(ends.low, -1), sinh_end(ends.high, 1), LIBRARY);
}

static vndf_wide cosh_end(vndf_wide size, int outwards)
{
    if (vndf_wide_double(size) < FAR)
        return vndf_wide_from(cosh(vndf_wide_double(size)));
    vndf_interval half = half_exp((vndf_interval){size, size});
    return outwards > 0 ? half.high : half.low;
}

vndf_interval vndf_interval_cosh(vndf_interval x)
{
    vndf_interval size = size_of(x);
    return widened(cosh_end(size.low, -1), cosh_end(size.high, 1), LIBRARY);
}

/* exp(-x^2)/(2 x) < erfc x < 0.6 exp(-x^2)/x for x >= 25. */
static vndf_wide erfc_end(double x, int outwards)
{
    if (x < FAR)
        return vndf_wide_from(erfc(x));
    if (isinf(x))
        return vndf_wide_from(0);
    vndf_interval at = vndf_interval_from(x, x), square = vndf_interval_negative(vndf_interval_product(at, at));
    vndf_interval y = vndf_interval_quotient(vndf_interval_exp(square), at);
    return outwards > 0 ? vndf_interval_scaled(y, 0.6).high : vndf_interval_scaled(y, 0.5).low;
}

vndf_interval vndf_interval_erfc(vndf_interval x)
{
    return widened(erfc_end(high_of(x), -1), erfc_end(low_of(x), 1), LIBRARY);
}

/* ---- gamma ---- */

vndf_interval vndf_interval_lgamma(vndf_interval x)
{
    static const double place = 1.4616321449683623, least = -0.12148629053584961;
    double low = low_of(x), high = high_of(x), error = LIBRARY;
    if (!(low > 0)) /* poles, unless x is a single number */
        return low == high && !is_whole(low) ? of_doubles(lgamma(low), lgamma(low)) : vndf_interval_all();
    double a = lgamma(low), b = lgamma(high), bottom = low <= place && high >= place ? least : fmin(a, b);
    return of_doubles(bottom - error, fmax(a, b) + error);
}

/* Derivatives 1 to 3 of lgamma beyond 20, where the next terms are below a relative 1e-14. */
static double polygamma_far(int n, double x)
{
    double y = 1 / (x * x);
    if (n == 0)
        return log(x) - 0.5 / x - y * (1.0 / 12 - y * (1.0 / 120 - y * (1.0 / 252 - y / 240)));
    if (n == 1)
        return 1 / x + y * (0.5 + 1 / x * (1.0 / 6 - y * (1.0 / 30 - y * (1.0 / 42 - y / 30))));
    return -y * (1 + 1 / x + y * (0.5 - y * (1.0 / 6 - y * (1.0 / 6 - y * 0.3))));
}

static double polygamma(int n, double x)
{
    double sum = 0;
    for (; x < 20; x++)
        sum += n == 0 ? -1 / x : n == 1 ? 1 / (x * x) : -2 / (x * x * x);
    return sum + polygamma_far(n, x);
}

vndf_interval vndf_interval_polygamma(int n, vndf_interval x)
{
    double low = low_of(x), high = high_of(x);
    if (!(low > 0))
        return vndf_interval_all();
    double a = polygamma(n, low), b = polygamma(n, high), error = 1e-12 + 1e-12 * fmax(fabs(a), fabs(b));
    return vndf_interval_from(fmin(a, b) - error, fmax(a, b) + error);
}
