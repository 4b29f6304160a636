/* Sorts lanes of two kinds into an array: the lanes of a mask from the beginning of the array on, the other lanes
 * from its end down. Each member of a record takes one permutation and two stores of whole vectors. A store writes
 * beyond its kind; the next store overwrites that, as long as the whole array is filled, a vector at a time. The
 * way back loads the same places. */
#ifndef VNDF_SIMD_LANES_SPLIT_H
#define VNDF_SIMD_LANES_SPLIT_H

#include "simd/lanes.h"

#if VNDF_LANES == 16

/* `order` holds the lane of each place, `place` the place of each lane; lanes outside the mask have 16 added. */
typedef struct lanes_split {
    __m512i order, place;
    uint32_t low, high; /* the places are low, low + 1, ..., and ..., high - 2, high - 1 */
} lanes_split;

/* The array is free from *low to *high; both move towards each other. */
VNDF_INLINE lanes_split lanes_split_by(lanes_m m, uint32_t *low, uint32_t *high)
{
    const __m512i lane = _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    uint32_t count = (uint32_t)__builtin_popcount(m);
    lanes_m others = (lanes_m)~m, behind = (lanes_m)(0xffffu << count);
    __m512i order = _mm512_maskz_compress_epi32(m, lane);
    order = _mm512_mask_expand_epi32(order, behind, _mm512_maskz_compress_epi32(others, lane));
    __m512i from = _mm512_add_epi32(lane, _mm512_set1_epi32((int)count + 16));
    __m512i place = _mm512_mask_expand_epi32(_mm512_maskz_expand_epi32(others, from), m, lane);
    lanes_split split = {order, place, *low, *high};
    *low += count;
    *high -= 16 - count;
    return split;
}

VNDF_INLINE void lanes_split_store(const lanes_split *split, float *to, lanes_f x)
{
    lanes_f sorted = _mm512_permutexvar_ps(split->order, x);
    lanes_store(to + split->low, sorted);
    lanes_store(to + (split->high - 16), sorted);
}

/* Loads the lanes of the mask from the array `low`, the others from `high`. */
VNDF_INLINE lanes_f lanes_split_load(const lanes_split *split, const float *low, const float *high)
{
    return _mm512_permutex2var_ps(lanes_load(low + split->low), split->place,
                                  lanes_load(high + (split->high - 16)));
}

#elif VNDF_LANES == 8

/* For each mask of four lanes: the lane of each place, and the place of each lane, as hexadecimal digits, the last
 * digit for the first. */
static const uint16_t LANES_ORDER[16] = {0x3210, 0x3210, 0x3201, 0x3210, 0x3102, 0x3120, 0x3021, 0x3210,
                                         0x2103, 0x2130, 0x2031, 0x2310, 0x1032, 0x1320, 0x0321, 0x3210};
static const uint16_t LANES_PLACE[16] = {0x3210, 0x3210, 0x3201, 0x3210, 0x3021, 0x3120, 0x3102, 0x3210,
                                         0x0321, 0x1320, 0x1302, 0x2310, 0x1032, 0x2130, 0x2103, 0x3210};

typedef struct lanes_split {
    __m256i order, place;
    lanes_m mask;
    uint32_t low, high;
} lanes_split;

/* One digit to each lane; permutations read three bits of it. */
VNDF_INLINE __m256i lanes_split_digits(uint32_t digits)
{
    return _mm256_srlv_epi32(_mm256_set1_epi32((int)digits), _mm256_set_epi32(28, 24, 20, 16, 12, 8, 4, 0));
}

/* For eight lanes: `lower` of the lower four and `upper` of the upper four are in the mask. The places of each of
 * the four kinds move by the number of lanes before them. */
VNDF_INLINE lanes_split lanes_split_by(lanes_m m, uint32_t *low, uint32_t *high)
{
    uint32_t bits = lanes_mask_bits(m), a = LANES_ORDER[bits & 15], b = LANES_ORDER[bits >> 4] | 0x4444u;
    uint32_t lower = (uint32_t)__builtin_popcount(bits & 15), upper = (uint32_t)__builtin_popcount(bits >> 4);
    uint32_t a_in = a & ((1u << 4 * lower) - 1), b_in = b & ((1u << 4 * upper) - 1);
    uint32_t order = a_in | b_in << 4 * lower | (a ^ a_in) << 4 * upper | (b ^ b_in) << 16;
    uint32_t a_place = LANES_PLACE[bits & 15], b_place = LANES_PLACE[bits >> 4];
    __m256i in = _mm256_set_m128i(_mm_set1_epi32((int)lower), _mm_setzero_si128());
    __m256i out = _mm256_set_m128i(_mm_set1_epi32(4), _mm_set1_epi32((int)upper));
    __m256i place = _mm256_and_si256(lanes_split_digits(a_place | b_place << 16), _mm256_set1_epi32(3));
    lanes_split split = {lanes_split_digits(order), _mm256_add_epi32(place, _mm256_blendv_epi8(out, in, m)), m,
                         *low, *high};
    *low += lower + upper;
    *high -= 8 - lower - upper;
    return split;
}

VNDF_INLINE void lanes_split_store(const lanes_split *split, float *to, lanes_f x)
{
    lanes_f sorted = _mm256_permutevar8x32_ps(x, split->order);
    lanes_store(to + split->low, sorted);
    lanes_store(to + (split->high - 8), sorted);
}

VNDF_INLINE lanes_f lanes_split_load(const lanes_split *split, const float *low, const float *high)
{
    __m256 in = _mm256_permutevar8x32_ps(lanes_load(low + split->low), split->place);
    __m256 out = _mm256_permutevar8x32_ps(lanes_load(high + (split->high - 8)), split->place);
    return lanes_pick(split->mask, in, out);
}

#endif
#endif
