/* Lanes of doubles; lanes.h is the same for floats. Code that uses `doubles` is compiled for one double, for 4 (AVX2)
 * and for 8 (AVX-512), VNDF_DOUBLES of them, and gives the same bits in each lane. The compiler provides + - * /
 * between them. doubles_f holds as many floats, the numbers of tables, and doubles_u as many indices. The rules of
 * lanes.h hold. */
#ifndef VNDF_SIMD_DOUBLES_H
#define VNDF_SIMD_DOUBLES_H

#include "simd/lanes.h"

#if VNDF_LANES == 1
#  include "simd/doubles_one.h"
#elif VNDF_LANES == 8
#  include "simd/doubles_avx2.h"
#else
#  include "simd/doubles_avx512.h"
#endif

/* Four successive floats of a line, lane by lane; two successive doubles. */
typedef struct doubles_four {
    doubles a, b, c, d;
} doubles_four;

typedef struct doubles_two {
    doubles a, b;
} doubles_two;

/* Where each lane begins to read: at[lane] numbers after the base. */
typedef struct doubles_lines {
    const float *base;
    uint32_t at[VNDF_DOUBLES];
} doubles_lines;

typedef struct doubles_long_lines {
    const double *base;
    uint32_t at[VNDF_DOUBLES];
} doubles_long_lines;

#if VNDF_LANES == 1

VNDF_INLINE doubles_lines doubles_lines_at(const float *base, uint32_t stride, doubles_u index)
{
    doubles_lines lines = {base, {stride * index}};
    return lines;
}

VNDF_INLINE doubles_long_lines doubles_long_lines_at(const double *base, uint32_t stride, doubles_u index)
{
    doubles_long_lines lines = {base, {stride * index}};
    return lines;
}

VNDF_INLINE doubles_four doubles_load_four(const doubles_lines *lines, size_t first)
{
    const float *at = lines->base + lines->at[0] + first;
    doubles_four four = {at[0], at[1], at[2], at[3]};
    return four;
}

VNDF_INLINE doubles_two doubles_load_two(const doubles_long_lines *lines, size_t first)
{
    const double *at = lines->base + lines->at[0] + first;
    doubles_two two = {at[0], at[1]};
    return two;
}

#else

VNDF_INLINE doubles_lines doubles_lines_at(const float *base, uint32_t stride, doubles_u index)
{
    doubles_lines lines = {.base = base};
    doubles_spill_u(lines.at, index * stride);
    return lines;
}

VNDF_INLINE doubles_long_lines doubles_long_lines_at(const double *base, uint32_t stride, doubles_u index)
{
    doubles_long_lines lines = {.base = base};
    doubles_spill_u(lines.at, index * stride);
    return lines;
}

VNDF_INLINE int doubles_any(doubles_m m)
{
    return doubles_mask_bits(m) != 0;
}

#  if VNDF_DOUBLES == 8

/* Lanes i and i + 4. */
VNDF_INLINE __m256 doubles_load_halves(const doubles_lines *lines, int i, size_t first)
{
    __m256 row = _mm256_castps128_ps256(_mm_loadu_ps(lines->base + lines->at[i] + first));
    return _mm256_insertf128_ps(row, _mm_loadu_ps(lines->base + lines->at[i + 4] + first), 1);
}

VNDF_INLINE doubles_four doubles_load_four(const doubles_lines *lines, size_t first)
{
    __m256 r0 = doubles_load_halves(lines, 0, first), r1 = doubles_load_halves(lines, 1, first);
    __m256 r2 = doubles_load_halves(lines, 2, first), r3 = doubles_load_halves(lines, 3, first);
    __m256 a = _mm256_unpacklo_ps(r0, r1), b = _mm256_unpackhi_ps(r0, r1);
    __m256 c = _mm256_unpacklo_ps(r2, r3), d = _mm256_unpackhi_ps(r2, r3);
    doubles_four four = {
        doubles_widen(_mm256_shuffle_ps(a, c, 0x44)), doubles_widen(_mm256_shuffle_ps(a, c, 0xee)),
        doubles_widen(_mm256_shuffle_ps(b, d, 0x44)), doubles_widen(_mm256_shuffle_ps(b, d, 0xee))};
    return four;
}

/* Lanes i, i + 2, i + 4, i + 6. */
VNDF_INLINE doubles doubles_load_pairs(const doubles_long_lines *lines, int i, size_t first)
{
    __m512d row = _mm512_castpd128_pd512(_mm_loadu_pd(lines->base + lines->at[i] + first));
    row = _mm512_insertf64x2(row, _mm_loadu_pd(lines->base + lines->at[i + 2] + first), 1);
    row = _mm512_insertf64x2(row, _mm_loadu_pd(lines->base + lines->at[i + 4] + first), 2);
    return _mm512_insertf64x2(row, _mm_loadu_pd(lines->base + lines->at[i + 6] + first), 3);
}

VNDF_INLINE doubles_two doubles_load_two(const doubles_long_lines *lines, size_t first)
{
    doubles even = doubles_load_pairs(lines, 0, first), odd = doubles_load_pairs(lines, 1, first);
    doubles_two two = {_mm512_unpacklo_pd(even, odd), _mm512_unpackhi_pd(even, odd)};
    return two;
}

#  else

VNDF_INLINE doubles_four doubles_load_four(const doubles_lines *lines, size_t first)
{
    const float *from = lines->base + first;
    __m128 r0 = _mm_loadu_ps(from + lines->at[0]), r1 = _mm_loadu_ps(from + lines->at[1]);
    __m128 r2 = _mm_loadu_ps(from + lines->at[2]), r3 = _mm_loadu_ps(from + lines->at[3]);
    __m128 a = _mm_unpacklo_ps(r0, r1), b = _mm_unpackhi_ps(r0, r1);
    __m128 c = _mm_unpacklo_ps(r2, r3), d = _mm_unpackhi_ps(r2, r3);
    doubles_four four = {doubles_widen(_mm_shuffle_ps(a, c, 0x44)), doubles_widen(_mm_shuffle_ps(a, c, 0xee)),
                         doubles_widen(_mm_shuffle_ps(b, d, 0x44)), doubles_widen(_mm_shuffle_ps(b, d, 0xee))};
    return four;
}

/* Lanes i and i + 2. */
VNDF_INLINE doubles doubles_load_pairs(const doubles_long_lines *lines, int i, size_t first)
{
    __m256d row = _mm256_castpd128_pd256(_mm_loadu_pd(lines->base + lines->at[i] + first));
    return _mm256_insertf128_pd(row, _mm_loadu_pd(lines->base + lines->at[i + 2] + first), 1);
}

VNDF_INLINE doubles_two doubles_load_two(const doubles_long_lines *lines, size_t first)
{
    doubles even = doubles_load_pairs(lines, 0, first), odd = doubles_load_pairs(lines, 1, first);
    doubles_two two = {_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd)};
    return two;
}

#  endif
#endif

/* ---- whatever the width ---- */

/* max(x, 0), 0 for NaN. */
VNDF_INLINE doubles doubles_positive(doubles x)
{
    return doubles_pick(doubles_less(doubles_set(0.0), x), x, doubles_set(0.0));
}

VNDF_INLINE doubles doubles_between(doubles x, double least, double most)
{
    x = doubles_pick(doubles_less(x, doubles_set(most)), x, doubles_set(most));
    return doubles_pick(doubles_less(doubles_set(least), x), x, doubles_set(least));
}

#endif
