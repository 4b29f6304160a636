/* The types of the kernel as one number: `real`, `integer` and `mask` are a float, an int and a truth. lanes.h has the
 * same names for several numbers side by side; exported kernels have them in each language (tools/export). With either
 * page below it the text of the kernel gives the same bits: + - * /, roots, comparisons and bits of floats alone.
 *
 * With VNDF_KERNEL_DOUBLE `real` is a double: for what scatters light, since refraction where the index ratio is near
 * 1, and Fresnel's terms beside total reflection, want more digits of directions than floats have; and for
 * certificates, which compare what the run time draws with what is seen. */
#ifndef VNDF_KERNEL_ONE_H
#define VNDF_KERNEL_ONE_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "core/inline.h"

#define KERNEL VNDF_INLINE

#if defined(VNDF_KERNEL_DOUBLE)
typedef double real;
#  define REAL(function) function
#else
typedef float real;
#  define REAL(function) function##f
#endif

/* ---- choices ---- */

typedef int mask;

KERNEL mask lt(real a, real b)
{
    return a < b;
}

KERNEL mask le(real a, real b)
{
    return a <= b;
}

KERNEL mask eq(int32_t a, int b)
{
    return a == b;
}

KERNEL mask both(mask a, mask b)
{
    return a & b;
}

KERNEL mask either(mask a, mask b)
{
    return a | b;
}

KERNEL int any(mask m)
{
    return m;
}

KERNEL real select(mask m, real yes, real no)
{
    return m ? yes : no;
}

/* a < b ? a : b, so b for NaN; and a > b ? a : b. */
KERNEL real min(real a, real b)
{
    return a < b ? a : b;
}

KERNEL real max(real a, real b)
{
    return a > b ? a : b;
}

/* ---- numbers ---- */

KERNEL real set(real x)
{
    return x;
}

KERNEL real kernel_sqrt(real x)
{
    return REAL(sqrt)(x);
}

KERNEL real kernel_abs(real x)
{
    return REAL(fabs)(x);
}

/* C's own are of doubles and of ints. */
#define sqrt(x) kernel_sqrt(x)
#define abs(x) kernel_abs(x)

/* |x| with the sign of y. */
KERNEL real with_sign(real x, real y)
{
    return REAL(copysign)(x, y);
}

#ifndef VNDF_KERNEL_DOUBLE
#  include "kernel/rows.h"
#endif

#if defined(__SSE2__) && !defined(VNDF_KERNEL_DOUBLE)
#  include <emmintrin.h>
#  define VNDF_KERNEL_SSE2 1

/* Lane 0 is x; with gcc without an instruction that clears the others. */
KERNEL __m128 lane(float x)
{
#  if defined(__clang__)
    return _mm_set_ss(x);
#  else
    __m128 all;
    __asm__("" : "=x"(all) : "0"(x));
    return all;
#  endif
}

/* How many of the first four lanes are set before one is not, added up over two masks. */
KERNEL int count_ones(unsigned bits_set)
{
    return __builtin_ctz(~bits_set);
}

/* x four times, from a register. */
KERNEL __m128 spread(float x)
{
    return _mm_shuffle_ps(lane(x), lane(x), 0);
}

KERNEL unsigned le_4(const float *numbers, __m128 square, __m128 under)
{
    __m128 r = _mm_loadu_ps(numbers);
    return (unsigned)_mm_movemask_ps(_mm_cmple_ps(_mm_mul_ps(_mm_mul_ps(r, r), under), square));
}

/* The last knot R with R^2 under <= square (law.h has the same as a loop). */
KERNEL integer find_knot(table t, real square, real under)
{
    int block = 0;
    const float *pivot = t.columns + VNDF_COLUMNS * t.column;
    __m128 x = spread(square), y = spread(under);
    for (int i = 0; i < t.pivots; i += 4)
        block += count_ones(le_4(pivot + i, x, y));
    const float *first = t.columns + VNDF_COLUMN_STEP * block + 1;
    return VNDF_COLUMN_STEP * block + count_ones(le_4(first, x, y) | le_4(first + 4, x, y) << 4);
}

/* Weights of a law, four times each. */
typedef struct weights_4 {
    __m128 w1, w0, wq, w4, left;
} weights_4;

/* Which of four sums are at least `left`, in the order of law_sum. */
KERNEL unsigned sums_4(const float *columns, int stride, weights_4 w)
{
    __m128 a =
        _mm_add_ps(_mm_mul_ps(w.w1, _mm_loadu_ps(columns)), _mm_mul_ps(w.w0, _mm_loadu_ps(columns + stride)));
    __m128 b = _mm_add_ps(_mm_mul_ps(w.wq, _mm_loadu_ps(columns + 2 * stride)),
                          _mm_mul_ps(w.w4, _mm_loadu_ps(columns + 3 * stride)));
    return (unsigned)_mm_movemask_ps(_mm_cmpge_ps(_mm_add_ps(a, b), w.left));
}

/* The last knot beyond which at least `left` of the law lies. */
KERNEL integer find_sum(table t, real w1, real w0, real wq, real w4, real left)
{
    int block = 0;
    const float *pivot = t.columns + VNDF_COLUMNS * t.column + t.pivots;
    weights_4 w = {spread(w1), spread(w0), spread(wq), spread(w4), spread(left)};
    for (int i = 0; i < t.pivots; i += 4)
        block += count_ones(sums_4(pivot + i, t.pivots, w));
    const float *first = t.columns + t.column + VNDF_COLUMN_STEP * block + 1;
    return VNDF_COLUMN_STEP * block + count_ones(sums_4(first, t.column, w) | sums_4(first + 4, t.column, w) << 4);
}

#  define VNDF_KERNEL_FINDS 1
#endif

#endif
