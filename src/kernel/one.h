/* The types of the kernel as one number: `real`, `whole` and `mask` are a float, an int and a truth. lanes.h has the
 * same names for several numbers side by side; exported kernels have them in each language (tools/export). With either
 * page below it the text of the kernel gives the same bits: + - * /, roots, comparisons and bits of floats alone. */
#ifndef VNDF_KERNEL_ONE_H
#define VNDF_KERNEL_ONE_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "core/inline.h"
#include "table/table.h"

#define HERE VNDF_INLINE

typedef float real;
typedef int32_t whole;
typedef int mask;

/* Four numbers of a table that stand side by side. */
typedef struct quad {
    real a, b, c, d;
} quad;

HERE real set(float x)
{
    return x;
}

HERE whole set_whole(int i)
{
    return i;
}

HERE mask less(real a, real b)
{
    return a < b;
}

HERE mask at_most(real a, real b)
{
    return a <= b;
}

HERE mask same(whole a, int b)
{
    return a == b;
}

HERE mask both(mask a, mask b)
{
    return a & b;
}

HERE mask either(mask a, mask b)
{
    return a | b;
}

HERE int any(mask m)
{
    return m;
}

/* Without a branch, which random data would mispredict. */
#if defined(__SSE2__)
#  include <emmintrin.h>
HERE real pick(mask m, real yes, real no)
{
    __m128 all = _mm_castsi128_ps(_mm_cvtsi32_si128(-m));
    __m128 one = _mm_and_ps(all, _mm_set_ss(yes)), other = _mm_andnot_ps(all, _mm_set_ss(no));
    return _mm_cvtss_f32(_mm_or_ps(one, other));
}
#else
HERE real pick(mask m, real yes, real no)
{
    return m ? yes : no;
}
#endif

HERE whole pick_whole(mask m, whole yes, whole no)
{
    return m ? yes : no;
}

/* a < b ? a : b, so b for NaN; and a > b ? a : b. */
HERE real least(real a, real b)
{
    return a < b ? a : b;
}

HERE real most(real a, real b)
{
    return a > b ? a : b;
}

HERE real root(real x)
{
    return sqrtf(x);
}

HERE real size(real x)
{
    return fabsf(x);
}

/* |x| with the sign of y. */
HERE real with_sign(real x, real y)
{
    return copysignf(x, y);
}

HERE whole bits(real x)
{
    whole i;
    memcpy(&i, &x, sizeof i);
    return i;
}

HERE real of_bits(whole i)
{
    real x;
    memcpy(&x, &i, sizeof x);
    return x;
}

HERE real to_real(whole i)
{
    return (real)i;
}

/* The whole part of x, |x| < 2^31. */
HERE whole to_whole(real x)
{
    return (whole)x;
}

HERE whole least_whole(whole a, whole b)
{
    return a < b ? a : b;
}

HERE whole most_whole(whole a, whole b)
{
    return a > b ? a : b;
}

/* ---- tables ---- */

/* A table as the kernel reads it (table/table.h). */
typedef struct table {
    const float *numbers;
    int cells, moments, squarings, highest, steps; /* highest: the highest power of two <= cells, 2^(steps - 1) */
} table;

HERE table table_of(const vndf_distribution *d)
{
    table t = {d->numbers + VNDF_HEAD, d->cells, d->moments, d->squarings, d->highest, d->steps};
    return t;
}

/* Row i of a group. */
HERE quad look(table t, int group, whole i)
{
    const float *row = t.numbers + 4 * (group * (t.cells + 1) + i);
    quad q = {row[0], row[1], row[2], row[3]};
    return q;
}

#endif
