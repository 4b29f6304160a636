/* Four doubles, AVX2: see doubles.h. */
#ifndef VNDF_SIMD_DOUBLES_AVX2_H
#define VNDF_SIMD_DOUBLES_AVX2_H

#include <immintrin.h>
#include <stdint.h>

#include "core/inline.h"

#define VNDF_DOUBLES 4

typedef __m256d doubles;
typedef __m128 doubles_f;
typedef uint32_t doubles_u __attribute__((vector_size(16)));
typedef __m256i doubles_m;

VNDF_INLINE doubles doubles_set(double x)
{
    return _mm256_set1_pd(x);
}

VNDF_INLINE doubles_u doubles_set_u(uint32_t x)
{
    return (doubles_u)_mm_set1_epi32((int)x);
}

VNDF_INLINE doubles_f doubles_narrow(doubles x)
{
    return _mm256_cvtpd_ps(x);
}

VNDF_INLINE doubles doubles_widen(doubles_f x)
{
    return _mm256_cvtps_pd(x);
}

/* Floats become doubles, and back. */
VNDF_INLINE doubles doubles_load(const float *from)
{
    return doubles_widen(_mm_loadu_ps(from));
}

VNDF_INLINE doubles doubles_load_long(const double *from)
{
    return _mm256_loadu_pd(from);
}

VNDF_INLINE void doubles_store_long(double *to, doubles x)
{
    _mm256_storeu_pd(to, x);
}

VNDF_INLINE void doubles_store_f(float *to, doubles_f x)
{
    _mm_storeu_ps(to, x);
}

VNDF_INLINE doubles_u doubles_load_u(const uint32_t *from)
{
    return (doubles_u)_mm_loadu_si128((const __m128i *)from);
}

VNDF_INLINE void doubles_store_u(uint32_t *to, doubles_u x)
{
    _mm_storeu_si128((__m128i *)to, (__m128i)x);
}

/* For reading the lanes one by one: from memory they cost less than from the register. */
VNDF_INLINE void doubles_spill_u(uint32_t to[VNDF_DOUBLES], doubles_u x)
{
    doubles_store_u(to, x);
    __asm__("" : "+m"(*(uint32_t(*)[VNDF_DOUBLES])to));
}

VNDF_INLINE doubles doubles_root(doubles x)
{
    return _mm256_sqrt_pd(x);
}

VNDF_INLINE doubles doubles_abs(doubles x)
{
    return _mm256_andnot_pd(_mm256_set1_pd(-0.0), x);
}

VNDF_INLINE doubles doubles_sign(doubles x, doubles y)
{
    const __m256d sign = _mm256_set1_pd(-0.0);
    return _mm256_or_pd(_mm256_and_pd(sign, y), _mm256_andnot_pd(sign, x));
}

VNDF_INLINE doubles_m doubles_less(doubles a, doubles b)
{
    return _mm256_castpd_si256(_mm256_cmp_pd(a, b, _CMP_LT_OQ));
}

VNDF_INLINE doubles_m doubles_at_most(doubles a, doubles b)
{
    return _mm256_castpd_si256(_mm256_cmp_pd(a, b, _CMP_LE_OQ));
}

VNDF_INLINE doubles_m doubles_at_most_u(doubles_u a, doubles_u b)
{
    return _mm256_cvtepi32_epi64(_mm_cmpeq_epi32(_mm_max_epu32((__m128i)a, (__m128i)b), (__m128i)b));
}

VNDF_INLINE int doubles_differ_u(doubles_u a, doubles_u b)
{
    return _mm_movemask_epi8(_mm_cmpeq_epi32((__m128i)a, (__m128i)b)) != 0xffff;
}

VNDF_INLINE doubles_m doubles_both(doubles_m a, doubles_m b)
{
    return _mm256_and_si256(a, b);
}

VNDF_INLINE doubles_m doubles_without(doubles_m a, doubles_m b)
{
    return _mm256_andnot_si256(b, a);
}

VNDF_INLINE doubles doubles_pick(doubles_m m, doubles yes, doubles no)
{
    return _mm256_blendv_pd(no, yes, _mm256_castsi256_pd(m));
}

VNDF_INLINE doubles_u doubles_pick_u(doubles_m m, doubles_u yes, doubles_u no)
{
    __m128 low = _mm_castsi128_ps(_mm256_castsi256_si128(m));
    __m128 high = _mm_castsi128_ps(_mm256_extracti128_si256(m, 1)), half = _mm_shuffle_ps(low, high, 0x88);
    return (doubles_u)_mm_blendv_epi8((__m128i)no, (__m128i)yes, _mm_castps_si128(half));
}

VNDF_INLINE uint32_t doubles_mask_bits(doubles_m m)
{
    return (uint32_t)_mm256_movemask_pd(_mm256_castsi256_pd(m));
}

/* Stores the numbers of the lanes in `m` one after the other, and anything behind them. Returns how many they are. */
VNDF_INLINE uint32_t doubles_keep_u(uint32_t to[VNDF_DOUBLES], doubles_m m, doubles_u x)
{
    uint32_t bits = doubles_mask_bits(m), count = 0;
    for (int i = 0; i < VNDF_DOUBLES; i++) {
        to[count] = x[i];
        count += bits >> i & 1;
    }
    return count;
}

VNDF_INLINE doubles_u doubles_least_u(doubles_u a, doubles_u b)
{
    return (doubles_u)_mm_min_epu32((__m128i)a, (__m128i)b);
}

VNDF_INLINE doubles_u doubles_most_u(doubles_u a, doubles_u b)
{
    return (doubles_u)_mm_max_epu32((__m128i)a, (__m128i)b);
}

VNDF_INLINE doubles_u doubles_bits(doubles_f x)
{
    return (doubles_u)_mm_castps_si128(x);
}

VNDF_INLINE doubles doubles_power_of_two(doubles shifted)
{
    __m256i sum = _mm256_add_epi64(_mm256_castpd_si256(shifted), _mm256_set1_epi64x(1023));
    return _mm256_castsi256_pd(_mm256_slli_epi64(sum, 52));
}

/* Single loads, put together: a gather takes twice the time. */
VNDF_INLINE doubles doubles_gather(const float *base, doubles_u index)
{
    uint32_t at[VNDF_DOUBLES];
    doubles_spill_u(at, index);
    return doubles_widen(_mm_setr_ps(base[at[0]], base[at[1]], base[at[2]], base[at[3]]));
}

VNDF_INLINE doubles_u doubles_gather_u(const uint32_t *base, doubles_u index)
{
    uint32_t at[VNDF_DOUBLES];
    doubles_spill_u(at, index);
    doubles_u made = {base[at[0]], base[at[1]], base[at[2]], base[at[3]]};
    return made;
}

/* The numbers k + 1023 appear in the low bits of 2^52. */
VNDF_INLINE doubles doubles_mantissa(doubles x, doubles *k)
{
    const __m256i one = _mm256_set1_epi64x(1023), large = _mm256_set1_epi64x(0x4330000000000000);
    const __m256i least = _mm256_set1_epi64x(0x3FE6A09E667F3BCD);
    __m256i bits = _mm256_castpd_si256(x), apart = _mm256_sub_epi64(bits, least);
    __m256i above = _mm256_srli_epi64(_mm256_add_epi64(apart, _mm256_slli_epi64(one, 52)), 52);
    *k = _mm256_castsi256_pd(_mm256_or_si256(above, large)) - (0x1p52 + 1023.0);
    return _mm256_castsi256_pd(_mm256_sub_epi64(bits, _mm256_slli_epi64(_mm256_sub_epi64(above, one), 52)));
}

/* Lane i where bit i is set; other bits are not read. */
VNDF_INLINE doubles_m doubles_of_mask_bits(uint32_t bits)
{
    const __m256i each = _mm256_set_epi64x(8, 4, 2, 1);
    return _mm256_cmpeq_epi64(_mm256_and_si256(_mm256_set1_epi64x(bits), each), each);
}

#endif
