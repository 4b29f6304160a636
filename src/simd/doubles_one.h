/* One double: see doubles.h. */
#ifndef VNDF_SIMD_DOUBLES_ONE_H
#define VNDF_SIMD_DOUBLES_ONE_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "core/inline.h"

#define VNDF_DOUBLES 1

typedef double doubles;
typedef float doubles_f;
typedef uint32_t doubles_u;
typedef int doubles_m;

VNDF_INLINE doubles doubles_set(double x)
{
    return x;
}

VNDF_INLINE doubles_u doubles_set_u(uint32_t x)
{
    return x;
}

VNDF_INLINE doubles doubles_root(doubles x)
{
    return sqrt(x);
}

VNDF_INLINE doubles doubles_abs(doubles x)
{
    return fabs(x);
}

/* |x| with the sign of y. */
VNDF_INLINE doubles doubles_sign(doubles x, doubles y)
{
    return copysign(x, y);
}

VNDF_INLINE doubles_f doubles_narrow(doubles x)
{
    return (float)x;
}

VNDF_INLINE doubles doubles_widen(doubles_f x)
{
    return x;
}

VNDF_INLINE int doubles_any(doubles_m m)
{
    return m;
}

VNDF_INLINE doubles_m doubles_less(doubles a, doubles b)
{
    return a < b;
}

VNDF_INLINE doubles_m doubles_at_most(doubles a, doubles b)
{
    return a <= b;
}

VNDF_INLINE doubles_m doubles_at_most_u(doubles_u a, doubles_u b)
{
    return a <= b;
}

/* Whether a and b differ in any lane. */
VNDF_INLINE int doubles_differ_u(doubles_u a, doubles_u b)
{
    return a != b;
}

VNDF_INLINE doubles_m doubles_both(doubles_m a, doubles_m b)
{
    return a & b;
}

/* a, but not b. */
VNDF_INLINE doubles_m doubles_without(doubles_m a, doubles_m b)
{
    return a & !b;
}

VNDF_INLINE doubles doubles_pick(doubles_m m, doubles yes, doubles no)
{
    return m ? yes : no;
}

VNDF_INLINE doubles_u doubles_pick_u(doubles_m m, doubles_u yes, doubles_u no)
{
    return m ? yes : no;
}

VNDF_INLINE doubles_u doubles_least_u(doubles_u a, doubles_u b)
{
    return a < b ? a : b;
}

VNDF_INLINE doubles_u doubles_most_u(doubles_u a, doubles_u b)
{
    return a < b ? b : a;
}

VNDF_INLINE doubles_u doubles_bits(doubles_f x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* 2^k, k from -1022 to 1023, of `shifted` = k + 1.5 2^52. */
VNDF_INLINE doubles doubles_power_of_two(doubles shifted)
{
    uint64_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    bits = (bits + 1023) << 52;
    memcpy(&shifted, &bits, sizeof bits);
    return shifted;
}

VNDF_INLINE doubles doubles_gather(const float *base, doubles_u index)
{
    return base[index];
}

VNDF_INLINE doubles_u doubles_gather_u(const uint32_t *base, doubles_u index)
{
    return base[index];
}

/* m, where x = 2^k m and 1/sqrt(2) <= m < sqrt(2); x > 0, finite and not denormal. Subtracting the bits of 1/sqrt(2)
 * from the bits of x leaves k in the exponent. */
VNDF_INLINE doubles doubles_mantissa(doubles x, doubles *k)
{
    uint64_t bits, least = 0x3FE6A09E667F3BCDu;
    memcpy(&bits, &x, sizeof bits);
    int whole = (int)((bits - least + ((uint64_t)1023 << 52)) >> 52) - 1023;
    bits -= (uint64_t)whole << 52;
    memcpy(&x, &bits, sizeof x);
    *k = whole;
    return x;
}

#endif
