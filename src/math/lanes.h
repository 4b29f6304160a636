/* Numbers side by side: what is written once for `lanes_f` is compiled for one float, for 8 (AVX2) and for 16
 * (AVX-512), as VNDF_LANES says, and gives the same bits in each lane. + - * / between lanes are the
 * compiler's own, here is the rest. Bits of a float >= 0 are compared as unsigned integers.
 *
 * Both sides of a choice are computed; what is only right in some lanes is masked, and lanes of no use hold numbers
 * that reach nothing. An index is within its array in every lane. */
#ifndef VNDF_MATH_LANES_H
#define VNDF_MATH_LANES_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "core/inline.h"

#ifndef VNDF_LANES
#  define VNDF_LANES 1
#endif

#if VNDF_LANES == 1

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

VNDF_INLINE lanes_u lanes_pick_u(lanes_m m, lanes_u yes, lanes_u no)
{
    return m ? yes : no;
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

VNDF_INLINE lanes_f lanes_gather(const float *base, lanes_u index)
{
    return base[index];
}

VNDF_INLINE lanes_u lanes_gather_u(const uint32_t *base, lanes_u index)
{
    return base[index];
}

/* Reads a half word more than it gives. */
VNDF_INLINE lanes_u lanes_gather_u16(const uint16_t *base, lanes_u index)
{
    return base[index];
}

/* One of sixteen numbers, in registers. */
VNDF_INLINE lanes_f lanes_few(const float *table, lanes_u index)
{
    return table[index];
}

#else

#  include <immintrin.h>

/* lanes_f is a vector of floats to the compiler, so that operators work; lanes_u likewise, of 32-bit integers. */
#  if VNDF_LANES == 16
typedef __m512 lanes_f;
typedef uint32_t lanes_u __attribute__((vector_size(64)));
typedef __mmask16 lanes_m;
#  else
typedef __m256 lanes_f;
typedef uint32_t lanes_u __attribute__((vector_size(32)));
typedef __m256i lanes_m;
#  endif

#  if VNDF_LANES == 16

VNDF_INLINE lanes_f lanes_set(float x)
{
    return _mm512_set1_ps(x);
}

VNDF_INLINE lanes_u lanes_set_u(uint32_t x)
{
    return (lanes_u)_mm512_set1_epi32((int)x);
}

VNDF_INLINE lanes_f lanes_load(const float *from)
{
    return _mm512_loadu_ps(from);
}

VNDF_INLINE void lanes_store(float *to, lanes_f x)
{
    _mm512_storeu_ps(to, x);
}

VNDF_INLINE lanes_u lanes_load_u(const uint32_t *from)
{
    return (lanes_u)_mm512_loadu_si512(from);
}

VNDF_INLINE void lanes_store_u(uint32_t *to, lanes_u x)
{
    _mm512_storeu_si512(to, (__m512i)x);
}

VNDF_INLINE lanes_f lanes_root(lanes_f x)
{
    return _mm512_sqrt_ps(x);
}

VNDF_INLINE lanes_f lanes_abs(lanes_f x)
{
    return _mm512_abs_ps(x);
}

VNDF_INLINE lanes_f lanes_sign(lanes_f x, lanes_f y)
{
    const __m512i sign = _mm512_set1_epi32(INT32_MIN);
    return _mm512_castsi512_ps(
        _mm512_ternarylogic_epi32(sign, _mm512_castps_si512(y), _mm512_castps_si512(x), 0xca));
}

VNDF_INLINE lanes_m lanes_all(void)
{
    return 0xffff;
}

VNDF_INLINE lanes_m lanes_none(void)
{
    return 0;
}

VNDF_INLINE lanes_m lanes_less(lanes_f a, lanes_f b)
{
    return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ);
}

VNDF_INLINE lanes_m lanes_at_most(lanes_f a, lanes_f b)
{
    return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ);
}

VNDF_INLINE lanes_m lanes_at_most_u(lanes_u a, lanes_u b)
{
    return _mm512_cmple_epu32_mask((__m512i)a, (__m512i)b);
}

VNDF_INLINE lanes_m lanes_both(lanes_m a, lanes_m b)
{
    return _kand_mask16(a, b);
}

VNDF_INLINE lanes_m lanes_either(lanes_m a, lanes_m b)
{
    return _kor_mask16(a, b);
}

VNDF_INLINE lanes_m lanes_without(lanes_m a, lanes_m b)
{
    return _kandn_mask16(b, a);
}

VNDF_INLINE lanes_f lanes_pick(lanes_m m, lanes_f yes, lanes_f no)
{
    return _mm512_mask_blend_ps(m, no, yes);
}

VNDF_INLINE lanes_u lanes_pick_u(lanes_m m, lanes_u yes, lanes_u no)
{
    return (lanes_u)_mm512_mask_blend_epi32(m, (__m512i)no, (__m512i)yes);
}

/* Bit i is lane i. */
VNDF_INLINE uint32_t lanes_mask_bits(lanes_m m)
{
    return m;
}

VNDF_INLINE lanes_u lanes_bits(lanes_f x)
{
    return (lanes_u)_mm512_castps_si512(x);
}

VNDF_INLINE lanes_u lanes_whole(lanes_f x)
{
    return (lanes_u)_mm512_cvttps_epi32(x);
}

VNDF_INLINE lanes_f lanes_gather(const float *base, lanes_u index)
{
    return _mm512_i32gather_ps((__m512i)index, base, 4);
}

VNDF_INLINE lanes_u lanes_gather_u(const uint32_t *base, lanes_u index)
{
    return (lanes_u)_mm512_i32gather_epi32((__m512i)index, base, 4);
}

VNDF_INLINE lanes_u lanes_gather_u16(const uint16_t *base, lanes_u index)
{
    return (lanes_u)_mm512_i32gather_epi32((__m512i)index, base, 2) & 0xffffu;
}

VNDF_INLINE lanes_f lanes_few(const float *table, lanes_u index)
{
    return _mm512_permutexvar_ps((__m512i)index, _mm512_loadu_ps(table));
}

#  else

VNDF_INLINE lanes_f lanes_set(float x)
{
    return _mm256_set1_ps(x);
}

VNDF_INLINE lanes_u lanes_set_u(uint32_t x)
{
    return (lanes_u)_mm256_set1_epi32((int)x);
}

VNDF_INLINE lanes_f lanes_load(const float *from)
{
    return _mm256_loadu_ps(from);
}

VNDF_INLINE void lanes_store(float *to, lanes_f x)
{
    _mm256_storeu_ps(to, x);
}

VNDF_INLINE lanes_u lanes_load_u(const uint32_t *from)
{
    return (lanes_u)_mm256_loadu_si256((const __m256i *)from);
}

VNDF_INLINE void lanes_store_u(uint32_t *to, lanes_u x)
{
    _mm256_storeu_si256((__m256i *)to, (__m256i)x);
}

VNDF_INLINE lanes_f lanes_root(lanes_f x)
{
    return _mm256_sqrt_ps(x);
}

VNDF_INLINE lanes_f lanes_abs(lanes_f x)
{
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), x);
}

VNDF_INLINE lanes_f lanes_sign(lanes_f x, lanes_f y)
{
    const __m256 sign = _mm256_set1_ps(-0.0f);
    return _mm256_or_ps(_mm256_and_ps(sign, y), _mm256_andnot_ps(sign, x));
}

VNDF_INLINE lanes_m lanes_all(void)
{
    return _mm256_set1_epi32(-1);
}

VNDF_INLINE lanes_m lanes_none(void)
{
    return _mm256_setzero_si256();
}

VNDF_INLINE lanes_m lanes_less(lanes_f a, lanes_f b)
{
    return _mm256_castps_si256(_mm256_cmp_ps(a, b, _CMP_LT_OQ));
}

VNDF_INLINE lanes_m lanes_at_most(lanes_f a, lanes_f b)
{
    return _mm256_castps_si256(_mm256_cmp_ps(a, b, _CMP_LE_OQ));
}

VNDF_INLINE lanes_m lanes_at_most_u(lanes_u a, lanes_u b)
{
    return _mm256_cmpeq_epi32(_mm256_max_epu32((__m256i)a, (__m256i)b), (__m256i)b);
}

VNDF_INLINE lanes_m lanes_both(lanes_m a, lanes_m b)
{
    return _mm256_and_si256(a, b);
}

VNDF_INLINE lanes_m lanes_either(lanes_m a, lanes_m b)
{
    return _mm256_or_si256(a, b);
}

VNDF_INLINE lanes_m lanes_without(lanes_m a, lanes_m b)
{
    return _mm256_andnot_si256(b, a);
}

VNDF_INLINE lanes_f lanes_pick(lanes_m m, lanes_f yes, lanes_f no)
{
    return _mm256_blendv_ps(no, yes, _mm256_castsi256_ps(m));
}

VNDF_INLINE lanes_u lanes_pick_u(lanes_m m, lanes_u yes, lanes_u no)
{
    return (lanes_u)_mm256_blendv_epi8((__m256i)no, (__m256i)yes, m);
}

VNDF_INLINE uint32_t lanes_mask_bits(lanes_m m)
{
    return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(m));
}

VNDF_INLINE lanes_u lanes_bits(lanes_f x)
{
    return (lanes_u)_mm256_castps_si256(x);
}

VNDF_INLINE lanes_u lanes_whole(lanes_f x)
{
    return (lanes_u)_mm256_cvttps_epi32(x);
}

VNDF_INLINE lanes_f lanes_gather(const float *base, lanes_u index)
{
    return _mm256_i32gather_ps(base, (__m256i)index, 4);
}

VNDF_INLINE lanes_u lanes_gather_u(const uint32_t *base, lanes_u index)
{
    return (lanes_u)_mm256_i32gather_epi32((const int *)base, (__m256i)index, 4);
}

VNDF_INLINE lanes_u lanes_gather_u16(const uint16_t *base, lanes_u index)
{
    return (lanes_u)_mm256_i32gather_epi32((const int *)base, (__m256i)index, 2) & 0xffffu;
}

VNDF_INLINE lanes_f lanes_few(const float *table, lanes_u index)
{
    __m256 low = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table), (__m256i)index);
    __m256 high = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table + 8), (__m256i)index);
    return _mm256_blendv_ps(low, high, _mm256_castsi256_ps((__m256i)(index << 28)));
}

#  endif

VNDF_INLINE int lanes_any(lanes_m m)
{
    return lanes_mask_bits(m) != 0;
}

#endif

/* ---- whatever the width ---- */

/* max(x, 0), 0 for NaN. */
VNDF_INLINE lanes_f lanes_positive(lanes_f x)
{
    return lanes_pick(lanes_less(lanes_set(0.0f), x), x, lanes_set(0.0f));
}

/* min(a, b), b for NaN. */
VNDF_INLINE lanes_f lanes_least(lanes_f a, lanes_f b)
{
    return lanes_pick(lanes_less(a, b), a, b);
}

/* min(x, most), most for NaN. */
VNDF_INLINE lanes_f lanes_limit(lanes_f x, float most)
{
    return lanes_pick(lanes_less(x, lanes_set(most)), x, lanes_set(most));
}

VNDF_INLINE lanes_u lanes_limit_u(lanes_u x, lanes_u most)
{
    return lanes_pick_u(lanes_at_most_u(x, most), x, most);
}

#endif
