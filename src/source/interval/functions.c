/* Functions of intervals: a monotone function takes its bounds at the ends, any other at its extremes in between
 * too. */
#include "source/interval/interval.h"

static const double EXPONENTIAL = 1e-15; /* error of an exponent, the argument of exp() */
static const double LOG_2 = 0.69314718055994531;
static const double PI = 3.14159265358979323846;

static int is_whole(double x)
{
    return x == floor(x);
}

/* ---- exponentials and powers ---- */

/* exp of x, moved by its rounding, EXPONENTIAL |x|, in the direction `outwards` (-1 or 1). */
static vndf_wide exponential(double x, int outwards)
{
    double error = VNDF_LIBRARY + EXPONENTIAL * fabs(x), whole = floor(x / LOG_2);
    if (fabs(x) < 270)
        return vndf_wide_from(exp(x) * (1 + outwards * VNDF_LIBRARY));
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
    return vndf_interval_of_library(logarithm(x.low), logarithm(x.high));
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
        return vndf_wide_from(pow(x.m, exponent) * (1 + outwards * VNDF_LIBRARY));
    size += outwards * fabs(size) * VNDF_LIBRARY;
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
    zero.high = vndf_wide_larger(x.high, negative.high);
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

/* Whether place + n period lies in [low, high] for some n, or nearly. */
static int meets(double low, double high, double place, double period)
{
    double margin = 1e-15 * (1 + fabs(low) + fabs(high));
    return floor((high + margin - place) / period) >= ceil((low - margin - place) / period);
}

/* sin and cos: 1 at top + 2 pi n, -1 half a turn later. */
static vndf_interval wave(double (*f)(double), vndf_interval x, double top)
{
    double low = vndf_interval_low(x), high = vndf_interval_high(x);
    if (!(high - low < 2 * PI) || fabs(low) > 1e9 || fabs(high) > 1e9)
        return vndf_interval_from(-1, 1);
    double a = f(low), b = f(high), least = fmin(a, b), most = fmax(a, b);
    double error = VNDF_LIBRARY * (fabs(least) + fabs(most));
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
    double low = vndf_interval_low(x), high = vndf_interval_high(x);
    if (!(high - low < PI) || fabs(low) > 1e9 || fabs(high) > 1e9 || meets(low, high, PI / 2, PI))
        return vndf_interval_all();
    return vndf_interval_of_library(tan(low), tan(high));
}

vndf_interval vndf_interval_asin(vndf_interval x)
{
    double low = vndf_interval_low(x), high = vndf_interval_high(x);
    if (low > 1 || high < -1)
        return vndf_interval_all();
    return vndf_interval_of_library(asin(fmax(low, -1)), asin(fmin(high, 1)));
}

vndf_interval vndf_interval_acos(vndf_interval x)
{
    double low = vndf_interval_low(x), high = vndf_interval_high(x);
    if (low > 1 || high < -1)
        return vndf_interval_all();
    return vndf_interval_of_library(acos(fmin(high, 1)), acos(fmax(low, -1)));
}

vndf_interval vndf_interval_atan(vndf_interval x)
{
    return vndf_interval_of_library(atan(vndf_interval_low(x)), atan(vndf_interval_high(x)));
}

/* A function that rises from -1 to 1, and is 1 in doubles from x = full on. There the interval has no width, so
 * that the difference of two such functions vanishes. */
static vndf_interval step_of(double (*f)(double), vndf_interval x, double full)
{
    double low = vndf_interval_low(x), high = vndf_interval_high(x);
    vndf_interval y = vndf_interval_of_library(f(low), f(high));
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
    vndf_interval ends = vndf_interval_from(vndf_interval_low(x), vndf_interval_high(x));
    return vndf_interval_widened(sinh_end(ends.low, -1), sinh_end(ends.high, 1), VNDF_LIBRARY);
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
    return vndf_interval_widened(cosh_end(size.low, -1), cosh_end(size.high, 1), VNDF_LIBRARY);
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
    return vndf_interval_widened(erfc_end(vndf_interval_high(x), -1), erfc_end(vndf_interval_low(x), 1),
                                 VNDF_LIBRARY);
}

/* ---- gamma ---- */

vndf_interval vndf_interval_lgamma(vndf_interval x)
{
    static const double place = 1.4616321449683623, least = -0.12148629053584961;
    double low = vndf_interval_low(x), high = vndf_interval_high(x), error = VNDF_LIBRARY;
    if (!(low > 0)) /* poles, unless x is a single number */
        return low == high && !is_whole(low) ? vndf_interval_of_library(lgamma(low), lgamma(low))
                                             : vndf_interval_all();
    double a = lgamma(low), b = lgamma(high), bottom = low <= place && high >= place ? least : fmin(a, b);
    return vndf_interval_of_library(bottom - error, fmax(a, b) + error);
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
    double low = vndf_interval_low(x), high = vndf_interval_high(x);
    if (!(low > 0))
        return vndf_interval_all();
    double a = polygamma(n, low), b = polygamma(n, high), error = 1e-12 + 1e-12 * fmax(fabs(a), fabs(b));
    return vndf_interval_from(fmin(a, b) - error, fmax(a, b) + error);
}
