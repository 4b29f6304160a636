/* Eight doubles, AVX-512 F, DQ and VL: see doubles.h. */
#ifndef VNDF_SIMD_DOUBLES_AVX512_H
#define VNDF_SIMD_DOUBLES_AVX512_H

#include <immintrin.h>
#include <stdint.h>

#include "core/inline.h"

#define VNDF_DOUBLES 8

typedef __m512d doubles;
typedef __m256 doubles_f;
typedef uint32_t doubles_u __attribute__((vector_size(32)));
typedef __mmask8 doubles_m;

VNDF_INLINE doubles doubles_set(double x)
{
    return _mm512_set1_pd(x);
}

VNDF_INLINE doubles_u doubles_set_u(uint32_t x)
{
    return (doubles_u)_mm256_set1_epi32((int)x);
}

VNDF_INLINE doubles_f doubles_narrow(doubles x)
{
    return _mm512_cvtpd_ps(x);
}

VNDF_INLINE doubles doubles_widen(doubles_f x)
{
    return _mm512_cvtps_pd(x);
}

VNDF_INLINE doubles doubles_load(const float *from)
{
    return doubles_widen(_mm256_loadu_ps(from));
}

VNDF_INLINE doubles doubles_load_long(const double *from)
{
    return _mm512_loadu_pd(from);
}

VNDF_INLINE void doubles_store_long(double *to, doubles x)
{
    _mm512_storeu_pd(to, x);
}

VNDF_INLINE void doubles_store_f(float *to, doubles_f x)
{
    _mm256_storeu_ps(to, x);
}

VNDF_INLINE doubles_u doubles_load_u(const uint32_t *from)
{
    return (doubles_u)_mm256_loadu_si256((const __m256i *)from);
}

VNDF_INLINE void doubles_store_u(uint32_t *to, doubles_u x)
{
    _mm256_storeu_si256((__m256i *)to, (__m256i)x);
}

/* For reading the lanes one by one: from memory they cost less than from the register. */
VNDF_INLINE void doubles_spill_u(uint32_t to[VNDF_DOUBLES], doubles_u x)
{
    doubles_store_u(to, x);
    __asm__("" : "+m"(*(uint32_t(*)[VNDF_DOUBLES])to));
}

VNDF_INLINE doubles doubles_root(doubles x)
{
    return _mm512_sqrt_pd(x);
}

VNDF_INLINE doubles doubles_abs(doubles x)
{
    return _mm512_abs_pd(x);
}

VNDF_INLINE doubles doubles_sign(doubles x, doubles y)
{
    const __m512i sign = _mm512_set1_epi64(INT64_MIN);
    return _mm512_castsi512_pd(
        _mm512_ternarylogic_epi64(sign, _mm512_castpd_si512(y), _mm512_castpd_si512(x), 0xca));
}

VNDF_INLINE doubles_m doubles_less(doubles a, doubles b)
{
    return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
}

VNDF_INLINE doubles_m doubles_at_most(doubles a, doubles b)
{
    return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ);
}

VNDF_INLINE doubles_m doubles_at_most_u(doubles_u a, doubles_u b)
{
    return _mm256_cmple_epu32_mask((__m256i)a, (__m256i)b);
}

VNDF_INLINE int doubles_differ_u(doubles_u a, doubles_u b)
{
    return _mm256_cmpneq_epu32_mask((__m256i)a, (__m256i)b) != 0;
}

VNDF_INLINE doubles_m doubles_both(doubles_m a, doubles_m b)
{
    return _kand_mask8(a, b);
}

VNDF_INLINE doubles_m doubles_without(doubles_m a, doubles_m b)
{
    return _kandn_mask8(b, a);
}

VNDF_INLINE doubles doubles_pick(doubles_m m, doubles yes, doubles no)
{
    return _mm512_mask_blend_pd(m, no, yes);
}

VNDF_INLINE doubles_u doubles_pick_u(doubles_m m, doubles_u yes, doubles_u no)
{
    return (doubles_u)_mm256_mask_blend_epi32(m, (__m256i)no, (__m256i)yes);
}

VNDF_INLINE uint32_t doubles_mask_bits(doubles_m m)
{
    return m;
}

/* Stores the numbers of the lanes in `m` one after the other, and anything behind them. Returns how many they are. */
VNDF_INLINE uint32_t doubles_keep_u(uint32_t to[VNDF_DOUBLES], doubles_m m, doubles_u x)
{
    _mm256_storeu_si256((__m256i *)to, _mm256_maskz_compress_epi32(m, (__m256i)x));
    return (uint32_t)__builtin_popcount(m);
}

VNDF_INLINE doubles_u doubles_least_u(doubles_u a, doubles_u b)
{
    return (doubles_u)_mm256_min_epu32((__m256i)a, (__m256i)b);
}

VNDF_INLINE doubles_u doubles_most_u(doubles_u a, doubles_u b)
{
    return (doubles_u)_mm256_max_epu32((__m256i)a, (__m256i)b);
}

VNDF_INLINE doubles_u doubles_bits(doubles_f x)
{
    return (doubles_u)_mm256_castps_si256(x);
}

VNDF_INLINE doubles doubles_power_of_two(doubles shifted)
{
    __m512i sum = _mm512_add_epi64(_mm512_castpd_si512(shifted), _mm512_set1_epi64(1023));
    return _mm512_castsi512_pd(_mm512_slli_epi64(sum, 52));
}

/* Single loads, put together: a gather takes twice the time. */
VNDF_INLINE doubles doubles_gather(const float *base, doubles_u index)
{
    uint32_t at[VNDF_DOUBLES];
    doubles_spill_u(at, index);
    return doubles_widen(_mm256_setr_ps(base[at[0]], base[at[1]], base[at[2]], base[at[3]], base[at[4]],
                                        base[at[5]], base[at[6]], base[at[7]]));
}

VNDF_INLINE doubles_u doubles_gather_u(const uint32_t *base, doubles_u index)
{
    uint32_t at[VNDF_DOUBLES];
    doubles_spill_u(at, index);
    doubles_u made = {base[at[0]], base[at[1]], base[at[2]], base[at[3]],
                      base[at[4]], base[at[5]], base[at[6]], base[at[7]]};
    return made;
}

/* One of sixteen numbers, in registers. */
VNDF_INLINE doubles doubles_few_f(const float *table, doubles_u index)
{
    __m256 low = _mm256_loadu_ps(table), high = _mm256_loadu_ps(table + 8);
    return doubles_widen(_mm256_permutex2var_ps(low, (__m256i)index, high));
}

VNDF_INLINE doubles doubles_few(const double *table, doubles_u index)
{
    __m512i at = _mm512_cvtepu32_epi64((__m256i)index);
    return _mm512_permutex2var_pd(_mm512_loadu_pd(table), at, _mm512_loadu_pd(table + 8));
}

/* The numbers k + 1023 appear in the low bits of 2^52. */
VNDF_INLINE doubles doubles_mantissa(doubles x, doubles *k)
{
    const __m512i one = _mm512_set1_epi64(1023), large = _mm512_set1_epi64(0x4330000000000000);
    const __m512i least = _mm512_set1_epi64(0x3FE6A09E667F3BCD);
    __m512i bits = _mm512_castpd_si512(x), apart = _mm512_sub_epi64(bits, least);
    __m512i above = _mm512_srli_epi64(_mm512_add_epi64(apart, _mm512_slli_epi64(one, 52)), 52);
    *k = _mm512_castsi512_pd(_mm512_or_si512(above, large)) - (0x1p52 + 1023.0);
    return _mm512_castsi512_pd(_mm512_sub_epi64(bits, _mm512_slli_epi64(_mm512_sub_epi64(above, one), 52)));
}

/* Lane i where bit i is set; other bits are not read. */
VNDF_INLINE doubles_m doubles_of_mask_bits(uint32_t bits)
{
    return (doubles_m)bits;
}

#endif
