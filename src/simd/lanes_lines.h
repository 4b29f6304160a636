/* Loads four neighbours for each lane and transposes them: four vectors, each with one of the four for all lanes.
 * Loads of 16 bytes cost less than a gather for every number. */
#ifndef VNDF_SIMD_LANES_LINES_H
#define VNDF_SIMD_LANES_LINES_H

#include "simd/lanes.h"

/* Four members, each lane by lane. */
typedef struct lanes_four {
    lanes_f a, b, c, d;
} lanes_four;

/* Where each lane begins to read: `index` times `stride` floats after the base, found once for all members. */
typedef struct lanes_lines {
    const float *at[VNDF_LANES];
} lanes_lines;

#if VNDF_LANES == 1

VNDF_INLINE lanes_lines lanes_lines_at(const float *base, uint32_t stride, lanes_u index)
{
    lanes_lines lines = {{base + (size_t)stride * index}};
    return lines;
}

/* Numbers `first` to first + 3 of each line. */
VNDF_INLINE lanes_four lanes_load_four(const lanes_lines *lines, size_t first)
{
    const float *at = lines->at[0] + first;
    lanes_four four = {at[0], at[1], at[2], at[3]};
    return four;
}

#else

VNDF_INLINE lanes_lines lanes_lines_at(const float *base, uint32_t stride, lanes_u index)
{
    uint32_t at[VNDF_LANES];
    lanes_lines lines;
    lanes_store_u(at, index * stride);
    for (int i = 0; i < VNDF_LANES; i++)
        lines.at[i] = base + at[i];
    return lines;
}

/* The same for indices that have been in memory for long. For indices just made compilers would take the vector
 * apart, or the loads would stall on store forwarding. */
VNDF_INLINE lanes_lines lanes_lines_from(const float *base, uint32_t stride, const uint32_t *index)
{
    lanes_lines lines;
    for (int i = 0; i < VNDF_LANES; i++)
        lines.at[i] = base + (size_t)stride * index[i];
    return lines;
}

#  if VNDF_LANES == 16

/* Lanes i, i + 4, i + 8, i + 12. */
VNDF_INLINE lanes_f lanes_load_quarters(const lanes_lines *lines, int i, size_t first)
{
    __m512 row = _mm512_castps128_ps512(_mm_loadu_ps(lines->at[i] + first));
    row = _mm512_insertf32x4(row, _mm_loadu_ps(lines->at[i + 4] + first), 1);
    row = _mm512_insertf32x4(row, _mm_loadu_ps(lines->at[i + 8] + first), 2);
    return _mm512_insertf32x4(row, _mm_loadu_ps(lines->at[i + 12] + first), 3);
}

VNDF_INLINE lanes_four lanes_load_four(const lanes_lines *lines, size_t first)
{
    lanes_f r0 = lanes_load_quarters(lines, 0, first), r1 = lanes_load_quarters(lines, 1, first);
    lanes_f r2 = lanes_load_quarters(lines, 2, first), r3 = lanes_load_quarters(lines, 3, first);
    lanes_f a = _mm512_unpacklo_ps(r0, r1), b = _mm512_unpackhi_ps(r0, r1);
    lanes_f c = _mm512_unpacklo_ps(r2, r3), d = _mm512_unpackhi_ps(r2, r3);
    lanes_four four = {_mm512_shuffle_ps(a, c, 0x44), _mm512_shuffle_ps(a, c, 0xee), _mm512_shuffle_ps(b, d, 0x44),
                       _mm512_shuffle_ps(b, d, 0xee)};
    return four;
}

#  else

/* Lanes i and i + 4. */
VNDF_INLINE lanes_f lanes_load_quarters(const lanes_lines *lines, int i, size_t first)
{
    __m256 row = _mm256_castps128_ps256(_mm_loadu_ps(lines->at[i] + first));
    return _mm256_insertf128_ps(row, _mm_loadu_ps(lines->at[i + 4] + first), 1);
}

VNDF_INLINE lanes_four lanes_load_four(const lanes_lines *lines, size_t first)
{
    lanes_f r0 = lanes_load_quarters(lines, 0, first), r1 = lanes_load_quarters(lines, 1, first);
    lanes_f r2 = lanes_load_quarters(lines, 2, first), r3 = lanes_load_quarters(lines, 3, first);
    lanes_f a = _mm256_unpacklo_ps(r0, r1), b = _mm256_unpackhi_ps(r0, r1);
    lanes_f c = _mm256_unpacklo_ps(r2, r3), d = _mm256_unpackhi_ps(r2, r3);
    lanes_four four = {_mm256_shuffle_ps(a, c, 0x44), _mm256_shuffle_ps(a, c, 0xee), _mm256_shuffle_ps(b, d, 0x44),
                       _mm256_shuffle_ps(b, d, 0xee)};
    return four;
}

#  endif
#endif
#endif
