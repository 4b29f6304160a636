/* Sixteen lanes, AVX-512 F, DQ, BW and VL: see lanes.h. To the compiler lanes_f is a vector of floats and
 * lanes_u a vector of integers, so that operators work. */
#ifndef VNDF_SIMD_LANES_AVX512_H
#define VNDF_SIMD_LANES_AVX512_H

#include <immintrin.h>
#include <stdint.h>

#include "core/inline.h"

typedef __m512 lanes_f;
typedef uint32_t lanes_u __attribute__((vector_size(64)));
typedef __mmask16 lanes_m;

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

VNDF_INLINE lanes_f lanes_least(lanes_f a, lanes_f b)
{
    return _mm512_min_ps(a, b);
}

VNDF_INLINE lanes_f lanes_most(lanes_f a, lanes_f b)
{
    return _mm512_max_ps(a, b);
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

/* No intrinsic: gcc makes one masked comparison of a comparison and this. */
VNDF_INLINE lanes_m lanes_both(lanes_m a, lanes_m b)
{
    return (lanes_m)(a & b);
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

VNDF_INLINE lanes_f lanes_one_of(const float *pair, lanes_m m)
{
    return lanes_pick(m, lanes_set(pair[1]), lanes_set(pair[0]));
}

VNDF_INLINE lanes_u lanes_pick_u(lanes_m m, lanes_u yes, lanes_u no)
{
    return (lanes_u)_mm512_mask_blend_epi32(m, (__m512i)no, (__m512i)yes);
}

VNDF_INLINE lanes_u lanes_limit_u(lanes_u x, lanes_u most)
{
    return (lanes_u)_mm512_min_epu32((__m512i)x, (__m512i)most);
}

VNDF_INLINE lanes_f lanes_keep(lanes_m m, lanes_f x)
{
    return _mm512_maskz_mov_ps(m, x);
}

VNDF_INLINE lanes_u lanes_count(lanes_u x, lanes_m m)
{
    return (lanes_u)_mm512_mask_add_epi32((__m512i)x, m, (__m512i)x, _mm512_set1_epi32(1));
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

VNDF_INLINE lanes_f lanes_of_bits(lanes_u x)
{
    return _mm512_castsi512_ps((__m512i)x);
}

VNDF_INLINE lanes_f lanes_float(lanes_u x)
{
    return _mm512_cvtepi32_ps((__m512i)x);
}

/* Where gcc does not optimise, it has macros in place of functions; these convert their own mask. */
#if defined(__GNUC__)
#  pragma GCC diagnostic push
#  pragma GCC diagnostic ignored "-Wsign-conversion"
#endif

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

#if defined(__GNUC__)
#  pragma GCC diagnostic pop
#endif

VNDF_INLINE lanes_f lanes_few(const float *table, uint32_t count, lanes_u index)
{
    (void)count;
    return _mm512_permutexvar_ps((__m512i)index, _mm512_loadu_ps(table));
}

/* Lane i where bit i is set; other bits are not read. */
VNDF_INLINE lanes_m lanes_of_mask_bits(uint32_t bits)
{
    return (lanes_m)bits;
}

#endif
