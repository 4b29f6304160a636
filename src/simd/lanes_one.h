/* One lane: see lanes.h. */
#ifndef VNDF_SIMD_LANES_ONE_H
#define VNDF_SIMD_LANES_ONE_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "core/inline.h"

typedef float lanes_f;
typedef uint32_t lanes_u;
typedef int lanes_m;

VNDF_INLINE lanes_f lanes_set(float x)
{
    return x;
}

VNDF_INLINE lanes_u lanes_set_u(uint32_t x)
{
    return x;
}

VNDF_INLINE lanes_f lanes_root(lanes_f x)
{
    return sqrtf(x);
}

VNDF_INLINE lanes_f lanes_abs(lanes_f x)
{
    return fabsf(x);
}

/* |x| with the sign of y. */
VNDF_INLINE lanes_f lanes_sign(lanes_f x, lanes_f y)
{
    return copysignf(x, y);
}

/* a < b ? a : b, so b for NaN; and a > b ? a : b. One instruction on x86. */
VNDF_INLINE lanes_f lanes_least(lanes_f a, lanes_f b)
{
    return a < b ? a : b;
}

VNDF_INLINE lanes_f lanes_most(lanes_f a, lanes_f b)
{
    return a > b ? a : b;
}

VNDF_INLINE int lanes_any(lanes_m m)
{
    return m;
}

VNDF_INLINE lanes_m lanes_all(void)
{
    return 1;
}

VNDF_INLINE lanes_m lanes_none(void)
{
    return 0;
}

VNDF_INLINE lanes_m lanes_less(lanes_f a, lanes_f b)
{
    return a < b;
}

VNDF_INLINE lanes_m lanes_at_most(lanes_f a, lanes_f b)
{
    return a <= b;
}

VNDF_INLINE lanes_m lanes_at_most_u(lanes_u a, lanes_u b)
{
    return a <= b;
}

VNDF_INLINE lanes_m lanes_both(lanes_m a, lanes_m b)
{
    return a & b;
}

VNDF_INLINE lanes_m lanes_either(lanes_m a, lanes_m b)
{
    return a | b;
}

/* a, but not b. */
VNDF_INLINE lanes_m lanes_without(lanes_m a, lanes_m b)
{
    return a & !b;
}

VNDF_INLINE lanes_f lanes_pick(lanes_m m, lanes_f yes, lanes_f no)
{
    return m ? yes : no;
}

/* pair[1] where m is set, else pair[0], without a branch, which would be mispredicted. */
VNDF_INLINE lanes_f lanes_one_of(const float *pair, lanes_m m)
{
    return pair[m];
}

VNDF_INLINE lanes_u lanes_pick_u(lanes_m m, lanes_u yes, lanes_u no)
{
    return m ? yes : no;
}

/* x, plus 1 in the lanes of m. */
VNDF_INLINE lanes_u lanes_count(lanes_u x, lanes_m m)
{
    return x + (uint32_t)m;
}

VNDF_INLINE lanes_u lanes_limit_u(lanes_u x, lanes_u most)
{
    return x < most ? x : most;
}

/* x in the lanes of m, else 0. */
VNDF_INLINE lanes_f lanes_keep(lanes_m m, lanes_f x)
{
    return m ? x : 0.0f;
}

VNDF_INLINE lanes_u lanes_bits(lanes_f x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* The whole part of x, from 0 to 2^31. */
VNDF_INLINE lanes_u lanes_whole(lanes_f x)
{
    return (uint32_t)(int32_t)x;
}

VNDF_INLINE lanes_f lanes_of_bits(lanes_u x)
{
    float number;
    memcpy(&number, &x, sizeof number);
    return number;
}

/* x as a signed integer. */
VNDF_INLINE lanes_f lanes_float(lanes_u x)
{
    int32_t whole;
    memcpy(&whole, &x, sizeof whole);
    return (float)whole;
}

VNDF_INLINE lanes_f lanes_gather(const float *base, lanes_u index)
{
    return base[index];
}

VNDF_INLINE lanes_u lanes_gather_u(const uint32_t *base, lanes_u index)
{
    return base[index];
}

/* May read one half word beyond the number it returns. */
VNDF_INLINE lanes_u lanes_gather_u16(const uint16_t *base, lanes_u index)
{
    return base[index];
}

/* One of `count` numbers, at most sixteen, in registers. Sixteen are read. */
VNDF_INLINE lanes_f lanes_few(const float *table, uint32_t count, lanes_u index)
{
    (void)count;
    return table[index];
}

#endif
