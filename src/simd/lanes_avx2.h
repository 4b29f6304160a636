/* Eight lanes, AVX2: see lanes.h and lanes_avx512.h. */
#ifndef VNDF_SIMD_LANES_AVX2_H
#define VNDF_SIMD_LANES_AVX2_H

#include <immintrin.h>
#include <stdint.h>

#include "core/inline.h"

typedef __m256 lanes_f;
typedef uint32_t lanes_u __attribute__((vector_size(32)));
typedef __m256i lanes_m;

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

VNDF_INLINE lanes_f lanes_least(lanes_f a, lanes_f b)
{
    return _mm256_min_ps(a, b);
}

VNDF_INLINE lanes_f lanes_most(lanes_f a, lanes_f b)
{
    return _mm256_max_ps(a, b);
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

VNDF_INLINE lanes_f lanes_one_of(const float *pair, lanes_m m)
{
    return lanes_pick(m, lanes_set(pair[1]), lanes_set(pair[0]));
}

VNDF_INLINE lanes_u lanes_pick_u(lanes_m m, lanes_u yes, lanes_u no)
{
    return (lanes_u)_mm256_blendv_epi8((__m256i)no, (__m256i)yes, m);
}

VNDF_INLINE lanes_u lanes_limit_u(lanes_u x, lanes_u most)
{
    return (lanes_u)_mm256_min_epu32((__m256i)x, (__m256i)most);
}

VNDF_INLINE lanes_f lanes_keep(lanes_m m, lanes_f x)
{
    return _mm256_and_ps(_mm256_castsi256_ps(m), x);
}

VNDF_INLINE lanes_u lanes_count(lanes_u x, lanes_m m)
{
    return x - (lanes_u)m;
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

VNDF_INLINE lanes_f lanes_of_bits(lanes_u x)
{
    return _mm256_castsi256_ps((__m256i)x);
}

VNDF_INLINE lanes_f lanes_float(lanes_u x)
{
    return _mm256_cvtepi32_ps((__m256i)x);
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

VNDF_INLINE lanes_f lanes_few(const float *table, uint32_t count, lanes_u index)
{
    __m256 low = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table), (__m256i)index);
    if (count <= 8)
        return low;
    __m256 high = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table + 8), (__m256i)index);
    return _mm256_blendv_ps(low, high, _mm256_castsi256_ps((__m256i)(index << 28)));
}

/* Lane i where bit i is set; other bits are not read. */
VNDF_INLINE lanes_m lanes_of_mask_bits(uint32_t bits)
{
    const __m256i each = _mm256_set_epi32(128, 64, 32, 16, 8, 4, 2, 1);
    return _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32((int)bits), each), each);
}

#endif
