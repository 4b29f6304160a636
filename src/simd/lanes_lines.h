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

enum { LANES_QUARTERS = VNDF_LANES / 4 };

/* Four floats from each address, side by side. */
VNDF_INLINE lanes_f lanes_load_quarters(const float *const at[LANES_QUARTERS])
{
#  if VNDF_LANES == 16
    __m512 row = _mm512_castps128_ps512(_mm_loadu_ps(at[0]));
    row = _mm512_mask_broadcast_f32x4(row, 0x00f0, _mm_loadu_ps(at[1]));
    row = _mm512_mask_broadcast_f32x4(row, 0x0f00, _mm_loadu_ps(at[2]));
    return _mm512_mask_broadcast_f32x4(row, 0xf000, _mm_loadu_ps(at[3]));
#  else
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(at[0])), _mm_loadu_ps(at[1]), 1);
#  endif
}

/* Row i holds the fours of lanes i, i + 4, ... */
VNDF_INLINE lanes_four lanes_transposed(const lanes_f row[4])
{
#  if VNDF_LANES == 16
    lanes_f a = _mm512_unpacklo_ps(row[0], row[1]), b = _mm512_unpackhi_ps(row[0], row[1]);
    lanes_f c = _mm512_unpacklo_ps(row[2], row[3]), d = _mm512_unpackhi_ps(row[2], row[3]);
    lanes_four four = {_mm512_shuffle_ps(a, c, 0x44), _mm512_shuffle_ps(a, c, 0xee), _mm512_shuffle_ps(b, d, 0x44),
                       _mm512_shuffle_ps(b, d, 0xee)};
#  else
    lanes_f a = _mm256_unpacklo_ps(row[0], row[1]), b = _mm256_unpackhi_ps(row[0], row[1]);
    lanes_f c = _mm256_unpacklo_ps(row[2], row[3]), d = _mm256_unpackhi_ps(row[2], row[3]);
    lanes_four four = {_mm256_shuffle_ps(a, c, 0x44), _mm256_shuffle_ps(a, c, 0xee), _mm256_shuffle_ps(b, d, 0x44),
                       _mm256_shuffle_ps(b, d, 0xee)};
#  endif
    return four;
}

VNDF_INLINE lanes_four lanes_load_four(const lanes_lines *lines, size_t first)
{
    lanes_f row[4];
    for (int i = 0; i < 4; i++) {
        const float *at[LANES_QUARTERS];
        for (int q = 0; q < LANES_QUARTERS; q++)
            at[q] = lines->at[i + 4 * q] + first;
        row[i] = lanes_load_quarters(at);
    }
    return lanes_transposed(row);
}

/* Where fours stand: `stride` floats from one index to the next. */
typedef struct lanes_source {
    const float *base;
    size_t stride;
} lanes_source;

/* Loads fours from a few sources, for indices that have been in memory for long: of indices just made compilers would
 * take the vector apart, or the loads would stall on store forwarding. All fours of a lane are loaded before those of
 * the next quarter, so that few addresses wait in registers. */
VNDF_INLINE void lanes_load_fours(lanes_four *to, const lanes_source *from, int count, const uint32_t *index)
{
    lanes_f row[8][4];
#  pragma GCC unroll 4
    for (int i = 0; i < 4; i++)
        for (int n = 0; n < count; n++) {
            const float *at[LANES_QUARTERS];
            for (int q = 0; q < LANES_QUARTERS; q++)
                at[q] = from[n].base + from[n].stride * index[i + 4 * q];
            row[n][i] = lanes_load_quarters(at);
        }
    for (int n = 0; n < count; n++)
        to[n] = lanes_transposed(row[n]);
}

#endif
#endif
