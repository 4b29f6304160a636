/* Numbers of any size: m 2^e. Inside [2^-400, 2^400] e is 0 and m is the number; outside m is in [1/2, 1) and e, a
 * whole number, may be as large as a double. So exp(-1e30) is not 0 and exp(1e30) not infinite, and their product
 * is right. Results are rounded as doubles are; interval.c widens them to bounds. */
#ifndef VNDF_SOURCE_INTERVAL_WIDE_H
#define VNDF_SOURCE_INTERVAL_WIDE_H

#include <math.h>

typedef struct vndf_wide {
    double m, e;
} vndf_wide;

static const double vndf_wide_exponent = 1e300; /* no exponent is larger */

/* Whether m needs no exponent. */
static inline int vndf_wide_plain(double m)
{
    double size = fabs(m);
    return (size >= 0x1p-400 && size <= 0x1p400) || size == 0;
}

/* m 2^e in the form described above; NaN and infinity stay. */
static inline vndf_wide vndf_wide_settle(double m, double e)
{
    int shift = 0;
    vndf_wide zero = {0, 0}, all = {m < 0 ? -HUGE_VAL : HUGE_VAL, 0};
    if (m == 0)
        return zero;
    if (isnan(m) || isinf(m) || e > vndf_wide_exponent)
        return isnan(m) ? (vndf_wide){m, 0} : all;
    m = frexp(m, &shift);
    e = fmax(e + shift, -vndf_wide_exponent);
    if (e >= -399 && e <= 400)
        return (vndf_wide){ldexp(m, (int)e), 0};
    return (vndf_wide){m, e};
}

static inline vndf_wide vndf_wide_from(double x)
{
    return vndf_wide_plain(x) ? (vndf_wide){x, 0} : vndf_wide_settle(x, 0);
}

static inline double vndf_wide_double(vndf_wide x)
{
    return x.e == 0 ? x.m : ldexp(x.m, (int)fmax(fmin(x.e, 3000), -3000));
}

/* 0 times infinity is 0, which is right for bounds on products of finite numbers. */
static inline vndf_wide vndf_wide_times(vndf_wide a, vndf_wide b)
{
    double m = a.m * b.m, e = a.e + b.e;
    if (a.m == 0 || b.m == 0)
        return (vndf_wide){0, 0};
    return e == 0 && vndf_wide_plain(m) ? (vndf_wide){m, 0} : vndf_wide_settle(m, e);
}

static inline vndf_wide vndf_wide_over(vndf_wide a, vndf_wide b)
{
    return vndf_wide_settle(a.m / b.m, a.e - b.e);
}

static inline vndf_wide vndf_wide_plus(vndf_wide a, vndf_wide b)
{
    vndf_wide large = a.e >= b.e ? a : b, small = a.e >= b.e ? b : a;
    if (large.e == small.e)
        return vndf_wide_settle(a.m + b.m, a.e);
    if (large.m == 0 || small.m == 0 || isinf(large.m) || isinf(small.m))
        return large.m == 0 || isinf(small.m) ? small : large;
    return vndf_wide_settle(large.m + ldexp(small.m, (int)fmax(small.e - large.e, -3000)), large.e);
}

static inline vndf_wide vndf_wide_minus(vndf_wide a)
{
    return (vndf_wide){-a.m, a.e};
}

static inline int vndf_wide_less(vndf_wide a, vndf_wide b)
{
    if (a.e == b.e || (a.m < 0) != (b.m < 0) || a.m == 0 || b.m == 0 || isinf(a.m) || isinf(b.m))
        return a.m < b.m;
    return a.m < 0 ? a.e > b.e : a.e < b.e;
}

#endif
