/* The ends of intervals, + - * / of intervals, and their exponentials and powers: see interval.h. */
#include "source/interval/interval.h"

#include <float.h>

static const double ROUNDING = 3e-16; /* of + - * /: more than half a unit in the last place */
static const double LIBRARY = 3e-15;  /* error of functions of the C library: many units in the last place */
static const double EXPONENT = 1e-15; /* error of the argument of exp() */
static const double EXPONENT_LARGEST = 1e300;
static const double LOG_2 = 0.69314718055994531;

/* ---- numbers of any size, rounded as doubles are ---- */

/* Whether m needs no exponent. */
static int plain(double m)
{
    double size = fabs(m);
    return (size >= 0x1p-400 && size <= 0x1p400) || size == 0;
}

/* m 2^e in the form of the header; NaN and infinity stay. */
static vndf_wide settled(double m, double e)
{
    int shift = 0;
    if (m == 0 || (e == 0 && plain(m))) /* nearly always */
        return (vndf_wide){m, 0};
    if (!isfinite(m) || e > EXPONENT_LARGEST)
        return (vndf_wide){m * HUGE_VAL, 0};
    m = frexp(m, &shift);
    e = fmax(e + shift, -EXPONENT_LARGEST);
    return e >= -399 && e <= 400 ? (vndf_wide){ldexp(m, (int)e), 0} : (vndf_wide){m, e};
}

static double double_of(vndf_wide x)
{
    return x.e == 0 ? x.m : ldexp(x.m, (int)fmax(fmin(x.e, 3000), -3000));
}

/* 0 times infinity is 0, which is right for bounds on products of finite numbers. */
static vndf_wide times(vndf_wide a, vndf_wide b)
{
    return a.m == 0 || b.m == 0 ? (vndf_wide){0, 0} : settled(a.m * b.m, a.e + b.e);
}

static vndf_wide plus(vndf_wide a, vndf_wide b)
{
    vndf_wide large = a.e >= b.e ? a : b, small = a.e >= b.e ? b : a;
    if (large.e == small.e)
        return settled(a.m + b.m, a.e);
    if (large.m == 0 || isinf(large.m) || isinf(small.m))
        return large.m == 0 || isinf(small.m) ? small : large;
    return settled(large.m + ldexp(small.m, (int)fmax(small.e - large.e, -3000)), large.e);
}

static vndf_wide minus(vndf_wide a)
{
    return (vndf_wide){-a.m, a.e};
}

int vndf_wide_less(vndf_wide a, vndf_wide b)
{
    if (a.e == b.e || (a.m < 0) != (b.m < 0) || a.m == 0 || b.m == 0 || isinf(a.m) || isinf(b.m))
        return a.m < b.m;
    return a.m < 0 ? a.e > b.e : a.e < b.e;
}

static vndf_wide smaller(vndf_wide a, vndf_wide b)
{
    return vndf_wide_less(b, a) ? b : a;
}

static vndf_wide larger(vndf_wide a, vndf_wide b)
{
    return vndf_wide_less(a, b) ? b : a;
}

/* ---- ends ---- */

/* x moved down by this part of it. Exponents beyond 2^50 are rounded too. */
static vndf_wide down(vndf_wide x, double part)
{
    double m = x.m - fabs(x.m) * part, spread = fabs(x.e) > 0x1p50 ? 4 * ROUNDING * fabs(x.e) : 0;
    if (x.e == 0 && plain(m)) /* nearly always */
        return (vndf_wide){m, 0};
    if (isinf(x.m))
        return x.m > 0 ? (vndf_wide){0.5, EXPONENT_LARGEST} : x;
    if (x.m > 0 && x.e <= -EXPONENT_LARGEST)
        return (vndf_wide){0, 0};
    return settled(m, floor(x.e + (x.m > 0 ? -spread : spread)));
}

/* Both ends moved by this part of them; the whole line if one is not a number. */
static vndf_interval widened(vndf_wide low, vndf_wide high, double part)
{
    if (isnan(low.m + high.m))
        return vndf_interval_all();
    return (vndf_interval){down(low, part), minus(down(minus(high), part))};
}

vndf_interval vndf_interval_from(double low, double high)
{
    return (vndf_interval){settled(low, 0), settled(high, 0)};
}

vndf_interval vndf_interval_all(void)
{
    return (vndf_interval){{-HUGE_VAL, 0}, {HUGE_VAL, 0}};
}

vndf_interval vndf_interval_hull(vndf_interval a, vndf_interval b)
{
    return (vndf_interval){smaller(a.low, b.low), larger(a.high, b.high)};
}

vndf_interval vndf_interval_of_library(double low, double high)
{
    return widened(settled(low, 0), settled(high, 0), LIBRARY);
}

double vndf_interval_low(vndf_interval a)
{
    double x = double_of(a.low);
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
    return (vndf_interval){minus(a.high), minus(a.low)};
}

vndf_interval vndf_interval_size(vndf_interval a)
{
    vndf_interval negative = vndf_interval_negative(a);
    if (a.low.m >= 0 || a.high.m <= 0)
        return a.low.m >= 0 ? a : negative;
    return (vndf_interval){{0, 0}, larger(a.high, negative.high)};
}

/* Whether it is x, a whole number. */
static int is_number(vndf_interval a, double x)
{
    return a.low.m == x && a.high.m == x;
}

/* Whole numbers so small that their sum and product are exact: counts, signs, the limits of saturating functions. What
 * was not rounded is not widened, so that 1 - tanh(r)^2 is 0 where tanh is 1. */
static int is_small_whole(vndf_interval a)
{
    double x = a.low.m;
    return fabs(x) < 0x1p26 && floor(x) == x && is_number(a, x);
}

vndf_interval vndf_interval_sum(vndf_interval a, vndf_interval b)
{
    if (is_number(a, 0) || is_number(b, 0))
        return is_number(a, 0) ? b : a;
    if (is_small_whole(a) && is_small_whole(b))
        return vndf_interval_from(a.low.m + b.low.m, a.low.m + b.low.m);
    return widened(plus(a.low, b.low), plus(a.high, b.high), ROUNDING);
}

vndf_interval vndf_interval_difference(vndf_interval a, vndf_interval b)
{
    return vndf_interval_sum(a, vndf_interval_negative(b));
}

vndf_interval vndf_interval_product(vndf_interval a, vndf_interval b)
{
    if (is_number(a, 1) || is_number(b, 1))
        return is_number(a, 1) ? b : a;
    if (is_small_whole(a) && is_small_whole(b))
        return vndf_interval_from(a.low.m * b.low.m, a.low.m * b.low.m);
    vndf_wide p = times(a.low, b.low), q = times(a.low, b.high), r = times(a.high, b.low),
              s = times(a.high, b.high);
    return widened(smaller(smaller(p, q), smaller(r, s)), larger(larger(p, q), larger(r, s)), ROUNDING);
}

/* 1/b, whose ends are on one side of 0, or 0 itself for one of them. */
vndf_interval vndf_interval_quotient(vndf_interval a, vndf_interval b)
{
    vndf_interval over = vndf_interval_all();
    if (is_number(b, 1))
        return a;
    if ((b.low.m < 0 && b.high.m > 0) || (b.low.m == 0 && b.high.m == 0))
        return vndf_interval_product(a, over);
    if (b.high.m != 0)
        over.low = down(settled(1 / b.high.m, -b.high.e), ROUNDING);
    if (b.low.m != 0)
        over.high = minus(down(settled(-1 / b.low.m, -b.low.e), ROUNDING));
    return vndf_interval_product(a, over);
}

vndf_interval vndf_interval_scaled(vndf_interval a, double factor)
{
    return vndf_interval_product(a, vndf_interval_from(factor, factor));
}

/* ---- exponentials and powers ---- */

/* exp of x, moved by its rounding, EXPONENT |x|, in the direction `outwards` (-1 or 1). Beyond 1e290, 2^-1e290 takes
 * the place of 0 as an upper end, and 2^1e290 that of infinity as a lower end. */
static vndf_wide exponential(double x, int outwards)
{
    double error = LIBRARY + EXPONENT * fabs(x), whole = floor(x / LOG_2);
    if (fabs(x) < 270)
        return settled(exp(x) * (1 + outwards * LIBRARY), 0);
    if (fabs(x) > 1e290 && (x > 0) != (outwards > 0))
        return settled(1, x < 0 ? -1e290 : 1e290);
    if (fabs(x) > 1e290)
        return settled(x > 0 ? HUGE_VAL : 0, 0);
    if (error < 0.1)
        return settled(exp(x - whole * LOG_2) * (1 + outwards * 2 * error), whole);
    return settled(1, floor(whole + outwards * (2 * error + 2)));
}

vndf_interval vndf_interval_exp(vndf_interval x)
{
    return (vndf_interval){exponential(double_of(x.low), -1), exponential(double_of(x.high), 1)};
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
    if (x.m == 1)
        return x;
    if (x.m <= 0)
        return settled(exponent > 0 ? 0 : HUGE_VAL, 0);
    if (x.e == 0 && fabs(size) < 270)
        return settled(pow(x.m, exponent) * (1 + outwards * LIBRARY), 0);
    return exponential(size + outwards * fabs(size) * LIBRARY, outwards);
}

static vndf_interval power_of_positive(vndf_interval x, double exponent)
{
    return (vndf_interval){power_end(exponent > 0 ? x.low : x.high, exponent, -1),
                           power_end(exponent > 0 ? x.high : x.low, exponent, 1)};
}

vndf_interval vndf_interval_power(vndf_interval x, double exponent)
{
    int whole = exponent == floor(exponent), odd = whole && exponent / 2 != floor(exponent / 2);
    vndf_interval defined = {{0, 0}, x.high}, below = {{0, 0}, minus(x.low)};
    if (exponent == 0)
        return vndf_interval_from(1, 1);
    if (x.low.m >= 0)
        return power_of_positive(x, exponent);
    if (whole && !odd)
        return power_of_positive(vndf_interval_size(x), exponent);
    if (odd && x.high.m <= 0)
        return vndf_interval_negative(power_of_positive(vndf_interval_negative(x), exponent));
    if (x.high.m < 0 || (odd && exponent < 0))
        return vndf_interval_all();
    defined = power_of_positive(defined, exponent);
    if (odd)
        defined.low = minus(power_of_positive(below, exponent).high);
    return defined;
}
