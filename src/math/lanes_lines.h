/* Loading lines of sixteen floats, one for each lane, and turning them so that member i of all lanes stands side by side:
 * one wide load per lane costs less than a gather per member. */
#ifndef VNDF_MATH_LANES_LINES_H
#define VNDF_MATH_LANES_LINES_H

#include "math/lanes.h"

#if VNDF_LANES == 16

/* Pairs of rows interleaved, then pairs of pairs: 4 x 4 blocks are turned. */
VNDF_INLINE void lanes_turn_blocks(lanes_f row[16])
{
    for (int i = 0; i < 16; i += 4) {
        lanes_f a = _mm512_unpacklo_ps(row[i], row[i + 1]), b = _mm512_unpackhi_ps(row[i], row[i + 1]);
        lanes_f c = _mm512_unpacklo_ps(row[i + 2], row[i + 3]), d = _mm512_unpackhi_ps(row[i + 2], row[i + 3]);
        row[i] = _mm512_shuffle_ps(a, c, 0x44);
        row[i + 1] = _mm512_shuffle_ps(a, c, 0xee);
        row[i + 2] = _mm512_shuffle_ps(b, d, 0x44);
        row[i + 3] = _mm512_shuffle_ps(b, d, 0xee);
    }
}

/* member[i] = lines[16 index + i], i from 0 to 15. */
VNDF_INLINE void lanes_load_lines(const float *lines, lanes_u index, lanes_f *member)
{
    uint32_t at[16];
    lanes_f row[16];
    lanes_store_u(at, index);
    for (int i = 0; i < 16; i++)
        row[i] = lanes_load(lines + 16 * (size_t)at[i]);
    lanes_turn_blocks(row);
    for (int i = 0; i < 4; i++) { /* blocks: lane of four, member of four */
        lanes_f a = _mm512_shuffle_f32x4(row[i], row[4 + i], 0x88), b = _mm512_shuffle_f32x4(row[i], row[4 + i], 0xdd);
        lanes_f c = _mm512_shuffle_f32x4(row[8 + i], row[12 + i], 0x88);
        lanes_f d = _mm512_shuffle_f32x4(row[8 + i], row[12 + i], 0xdd);
        member[i] = _mm512_shuffle_f32x4(a, c, 0x88);
        member[4 + i] = _mm512_shuffle_f32x4(b, d, 0x88);
        member[8 + i] = _mm512_shuffle_f32x4(a, c, 0xdd);
        member[12 + i] = _mm512_shuffle_f32x4(b, d, 0xdd);
    }
}

#elif VNDF_LANES == 8

/* Eight of the sixteen. */
VNDF_INLINE void lanes_load_halves(const float *lines, const uint32_t at[8], lanes_f *member)
{
    lanes_f row[8];
    for (int i = 0; i < 8; i++)
        row[i] = lanes_load(lines + 16 * (size_t)at[i]);
    for (int i = 0; i < 8; i += 4) {
        lanes_f a = _mm256_unpacklo_ps(row[i], row[i + 1]), b = _mm256_unpackhi_ps(row[i], row[i + 1]);
        lanes_f c = _mm256_unpacklo_ps(row[i + 2], row[i + 3]), d = _mm256_unpackhi_ps(row[i + 2], row[i + 3]);
        row[i] = _mm256_shuffle_ps(a, c, 0x44);
        row[i + 1] = _mm256_shuffle_ps(a, c, 0xee);
        row[i + 2] = _mm256_shuffle_ps(b, d, 0x44);
        row[i + 3] = _mm256_shuffle_ps(b, d, 0xee);
    }
    for (int i = 0; i < 4; i++) {
        member[i] = _mm256_permute2f128_ps(row[i], row[4 + i], 0x20);
        member[4 + i] = _mm256_permute2f128_ps(row[i], row[4 + i], 0x31);
    }
}

/* member[i] = lines[16 index + i], i from 0 to 15. */
VNDF_INLINE void lanes_load_lines(const float *lines, lanes_u index, lanes_f *member)
{
    uint32_t at[8];
    lanes_store_u(at, index);
    lanes_load_halves(lines, at, member);
    lanes_load_halves(lines + 8, at, member + 8);
}

#endif
#endif
