/* How many of eight neighbours in a table satisfy a condition: the inner loop of searches, for one lane.
 * Compilers that vectorise the plain loop for AVX2 count lane by lane; intrinsics take its place there. */
#ifndef VNDF_SIMD_COUNT_H
#define VNDF_SIMD_COUNT_H

#include "simd/lanes.h"

#if VNDF_LANES == 1

/* a x[i] + b y[i] <= most. */
VNDF_INLINE uint32_t vndf_count_two(const float *x, const float *y, float a, float b, float most)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < 8; i++)
        count += a * x[i] + b * y[i] <= most;
    return count;
}

/* a x[i] + b y[i] + c z[i] <= most, of n that are a multiple of eight. */
VNDF_INLINE uint32_t vndf_count_three(const float *x, const float *y, const float *z, uint32_t n, float a, float b,
                                      float c, float most)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i++)
        count += a * x[i] + b * y[i] + c * z[i] <= most;
    return count;
}

/* a e + max(a z + b x, 0) g <= most for pairs (x, z) and (e, g). */
VNDF_INLINE uint32_t vndf_count_positive(const float *xz, const float *eg, float a, float b, float most)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < 8; i++) {
        float w = a * xz[2 * i + 1] + b * xz[2 * i];
        count += a * eg[2 * i] + (w > 0.0f ? w : 0.0f) * eg[2 * i + 1] <= most;
    }
    return count;
}

/* e + max(a z + x, 0) g > least for pairs (x, z) and (e, g), of n that are a multiple of eight. */
VNDF_INLINE uint32_t vndf_count_more(const float *xz, const float *eg, uint32_t n, float a, float least)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i++) {
        float w = a * xz[2 * i + 1] + xz[2 * i];
        count += eg[2 * i] + (w > 0.0f ? w : 0.0f) * eg[2 * i + 1] > least;
    }
    return count;
}

#else

VNDF_INLINE uint32_t vndf_count_at_most(__m256 x, float most)
{
    __m256 yes = _mm256_cmp_ps(x, _mm256_set1_ps(most), _CMP_LE_OQ);
    return (uint32_t)__builtin_popcount((unsigned)_mm256_movemask_ps(yes));
}

VNDF_INLINE uint32_t vndf_count_two(const float *x, const float *y, float a, float b, float most)
{
    __m256 first = _mm256_set1_ps(a) * _mm256_loadu_ps(x);
    return vndf_count_at_most(first + _mm256_set1_ps(b) * _mm256_loadu_ps(y), most);
}

VNDF_INLINE uint32_t vndf_count_three(const float *x, const float *y, const float *z, uint32_t n, float a, float b,
                                      float c, float most)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i += 8) {
        __m256 two = _mm256_set1_ps(a) * _mm256_loadu_ps(x + i) + _mm256_set1_ps(b) * _mm256_loadu_ps(y + i);
        count += vndf_count_at_most(two + _mm256_set1_ps(c) * _mm256_loadu_ps(z + i), most);
    }
    return count;
}

/* Pairs are taken apart in an order of their own, which a count does not see. */
VNDF_INLINE uint32_t vndf_count_positive(const float *xz, const float *eg, float a, float b, float most)
{
    __m256 k0 = _mm256_loadu_ps(xz), k1 = _mm256_loadu_ps(xz + 8);
    __m256 s0 = _mm256_loadu_ps(eg), s1 = _mm256_loadu_ps(eg + 8);
    __m256 w =
        _mm256_set1_ps(a) * _mm256_shuffle_ps(k0, k1, 0xdd) + _mm256_set1_ps(b) * _mm256_shuffle_ps(k0, k1, 0x88);
    __m256 seen = _mm256_max_ps(w, _mm256_setzero_ps()); /* 0 for NaN, as above */
    return vndf_count_at_most(
        _mm256_set1_ps(a) * _mm256_shuffle_ps(s0, s1, 0x88) + seen * _mm256_shuffle_ps(s0, s1, 0xdd), most);
}

VNDF_INLINE uint32_t vndf_count_eight_more(const float *xz, const float *eg, float a, float least)
{
    __m256 k0 = _mm256_loadu_ps(xz), k1 = _mm256_loadu_ps(xz + 8);
    __m256 s0 = _mm256_loadu_ps(eg), s1 = _mm256_loadu_ps(eg + 8);
    __m256 w = _mm256_set1_ps(a) * _mm256_shuffle_ps(k0, k1, 0xdd) + _mm256_shuffle_ps(k0, k1, 0x88);
    __m256 weight = _mm256_max_ps(w, _mm256_setzero_ps());
    __m256 sum = _mm256_shuffle_ps(s0, s1, 0x88) + weight * _mm256_shuffle_ps(s0, s1, 0xdd);
    __m256 yes = _mm256_cmp_ps(sum, _mm256_set1_ps(least), _CMP_GT_OQ);
    return (uint32_t)__builtin_popcount((unsigned)_mm256_movemask_ps(yes));
}

VNDF_INLINE uint32_t vndf_count_more(const float *xz, const float *eg, uint32_t n, float a, float least)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < 2 * n; i += 16)
        count += vndf_count_eight_more(xz + i, eg + i, a, least);
    return count;
}

#endif
#endif
