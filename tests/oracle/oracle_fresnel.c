/* Fresnel's equations as they stand in the books, for a complex index m = n + ik:
 *
 *     t = sqrt(1 - sin^2/m^2),   r_s = (c - m t)/(c + m t),   r_p = (m c - t)/(m c + t),   F = (|r_s|^2 + |r_p|^2)/2,
 *
 * in long double, where their differences of nearly equal numbers cost what float does not show. */
#include <math.h>

#include "oracle/oracle_bsdf.h"

typedef struct complex_number {
    long double re, im;
} complex_number;

static complex_number times(complex_number a, complex_number b)
{
    return (complex_number){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

static complex_number over(complex_number a, complex_number b)
{
    long double square = b.re * b.re + b.im * b.im;
    complex_number conjugate = {b.re / square, -b.im / square};
    return times(a, conjugate);
}

/* The root with a real part >= 0. */
static complex_number root(complex_number a)
{
    long double size = hypotl(a.re, a.im), larger = sqrtl((size + fabsl(a.re)) / 2);
    if (!(size > 0))
        return (complex_number){0, 0};
    if (a.re >= 0)
        return (complex_number){larger, a.im / (2 * larger)};
    return (complex_number){fabsl(a.im) / (2 * larger), copysignl(larger, a.im)};
}

static long double ratio_square(complex_number x, complex_number y)
{
    complex_number less = {x.re - y.re, x.im - y.im}, more = {x.re + y.re, x.im + y.im};
    return (less.re * less.re + less.im * less.im) / (more.re * more.re + more.im * more.im);
}

long double oracle_fresnel(long double cosine, long double n, long double k)
{
    long double sin2 = (1 - cosine) * (1 + cosine);
    complex_number m = {n, k}, c = {cosine, 0}, bent = over((complex_number){sin2, 0}, times(m, m));
    complex_number t = root((complex_number){1 - bent.re, -bent.im});
    if (cosine <= 0)
        return 1;
    if (n == 1 && k <= 0)
        return 0;
    if (k <= 0 && n * n <= sin2)
        return 1; /* in total reflection, exactly */
    return (ratio_square(c, times(m, t)) + ratio_square(times(m, c), t)) / 2;
}
