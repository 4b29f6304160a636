/* Lanes of two kinds sorted as they are put into an array: those of a mask from its beginning on, the others
 * from its end down. What is stored beyond either kind is overwritten by what comes next, as long as all of the array
 * is filled, whole vectors at a time; so each member of a record takes a permutation and two stores, or four of
 * half the width. The way back takes loads of the same places. */
#ifndef VNDF_MATH_LANES_SPLIT_H
#define VNDF_MATH_LANES_SPLIT_H

#include "math/lanes.h"

#if VNDF_LANES == 16

/* Of one vector: `order` is the lane of each place, `place` the place of each lane, 16 more for the others. */
typedef struct lanes_split {
    __m512i order, place;
    uint32_t low, high; /* the places are low, low + 1, ..., and ..., high - 2, high - 1 */
} lanes_split;

/* *low and *high, between which the array is free, come closer. */
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

/* Those of the mask from one array, the others from another. */
VNDF_INLINE lanes_f lanes_split_load(const lanes_split *split, const float *low, const float *high)
{
    return _mm512_permutex2var_ps(lanes_load(low + split->low), split->place,
                                  lanes_load(high + (split->high - 16)));
}

#elif VNDF_LANES == 8

/* Of four lanes for each mask: the lane of each place, and the place of each lane, a hexadecimal digit each, the
 * last for the first. */
static const uint16_t LANES_ORDER[16] = {0x3210, 0x3210, 0x3201, 0x3210, 0x3102, 0x3120, 0x3021, 0x3210,
                                         0x2103, 0x2130, 0x2031, 0x2310, 0x1032, 0x1320, 0x0321, 0x3210};
static const uint16_t LANES_PLACE[16] = {0x3210, 0x3210, 0x3201, 0x3210, 0x3021, 0x3120, 0x3102, 0x3210,
                                         0x0321, 0x1320, 0x1302, 0x2310, 0x1032, 0x2130, 0x2103, 0x3210};

/* The lower four lanes, then the upper. */
typedef struct lanes_split {
    __m256i order, place;
    lanes_m mask;
    uint32_t low[2], high[2];
} lanes_split;

VNDF_INLINE __m256i lanes_split_digits(const uint16_t *table, uint32_t bits)
{
    __m128i lower = _mm_set1_epi32(table[bits & 15]), upper = _mm_set1_epi32(table[bits >> 4]);
    return _mm256_srlv_epi32(_mm256_set_m128i(upper, lower), _mm256_set_epi32(12, 8, 4, 0, 12, 8, 4, 0));
}

VNDF_INLINE lanes_split lanes_split_by(lanes_m m, uint32_t *low, uint32_t *high)
{
    uint32_t bits = lanes_mask_bits(m), lower = (uint32_t)__builtin_popcount(bits & 15);
    uint32_t upper = (uint32_t)__builtin_popcount(bits >> 4);
    lanes_split split = {lanes_split_digits(LANES_ORDER, bits), lanes_split_digits(LANES_PLACE, bits), m,
                         {*low, *low + lower}, {*high, *high - (4 - lower)}};
    *low += lower + upper;
    *high -= 8 - lower - upper;
    return split;
}

VNDF_INLINE void lanes_split_store(const lanes_split *split, float *to, lanes_f x)
{
    __m256 sorted = _mm256_permutevar_ps(x, split->order);
    __m128 lower = _mm256_castps256_ps128(sorted), upper = _mm256_extractf128_ps(sorted, 1);
    _mm_storeu_ps(to + split->low[0], lower);
    _mm_storeu_ps(to + (split->high[0] - 4), lower);
    _mm_storeu_ps(to + split->low[1], upper);
    _mm_storeu_ps(to + (split->high[1] - 4), upper);
}

VNDF_INLINE lanes_f lanes_split_load(const lanes_split *split, const float *low, const float *high)
{
    __m256 a = _mm256_castps128_ps256(_mm_loadu_ps(low + split->low[0]));
    __m256 b = _mm256_castps128_ps256(_mm_loadu_ps(high + (split->high[0] - 4)));
    a = _mm256_insertf128_ps(a, _mm_loadu_ps(low + split->low[1]), 1);
    b = _mm256_insertf128_ps(b, _mm_loadu_ps(high + (split->high[1] - 4)), 1);
    return lanes_pick(split->mask, _mm256_permutevar_ps(a, split->place), _mm256_permutevar_ps(b, split->place));
}

#endif
#endif
