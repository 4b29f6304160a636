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

/* Appends `first` + i for each lane i of the mask to a list of `count` with room for all lanes; returns the count. */
VNDF_INLINE uint32_t lanes_append(uint32_t *list, uint32_t count, lanes_m m, uint32_t first)
{
    const __m512i lane = _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    lanes_store_u(list + count, (lanes_u)_mm512_maskz_compress_epi32(m, lane) + first);
    return count + (uint32_t)__builtin_popcount(m);
}

#elif VNDF_LANES == 8

/* For each mask of eight lanes: the lane of each place, and the place of each lane; byte i is for place i or lane i. A
 * lane goes behind all lanes of its kind that come before it; lanes outside the mask go behind it. */
#  define LANES_BITS(m)                                                                                   \
    (((m)&1u) + ((m) >> 1 & 1u) + ((m) >> 2 & 1u) + ((m) >> 3 & 1u) + ((m) >> 4 & 1u) + ((m) >> 5 & 1u) + \
     ((m) >> 6 & 1u) + ((m) >> 7 & 1u))
#  define LANES_BEFORE(m, i) LANES_BITS((m) & ((1u << (i)) - 1u))
#  define LANES_GOES(m, i) \
    ((uint64_t)((m) >> (i)&1u ? LANES_BEFORE(m, i) : LANES_BITS(m) + (i)-LANES_BEFORE(m, i)))
#  define LANES_PLACES(m)                                                                             \
    (LANES_GOES(m, 0u) | LANES_GOES(m, 1u) << 8 | LANES_GOES(m, 2u) << 16 | LANES_GOES(m, 3u) << 24 | \
     LANES_GOES(m, 4u) << 32 | LANES_GOES(m, 5u) << 40 | LANES_GOES(m, 6u) << 48 | LANES_GOES(m, 7u) << 56)
#  define LANES_FROM(m, i) ((uint64_t)(i) << 8u * LANES_GOES(m, i))
#  define LANES_ORDERS(m)                                                                                \
    (LANES_FROM(m, 1u) | LANES_FROM(m, 2u) | LANES_FROM(m, 3u) | LANES_FROM(m, 4u) | LANES_FROM(m, 5u) | \
     LANES_FROM(m, 6u) | LANES_FROM(m, 7u))
#  define LANES_OF_4(f, m) f(m), f((m) + 1u), f((m) + 2u), f((m) + 3u)
#  define LANES_OF_16(f, m) \
    LANES_OF_4(f, m), LANES_OF_4(f, (m) + 4u), LANES_OF_4(f, (m) + 8u), LANES_OF_4(f, (m) + 12u)
#  define LANES_OF_64(f, m) \
    LANES_OF_16(f, m), LANES_OF_16(f, (m) + 16u), LANES_OF_16(f, (m) + 32u), LANES_OF_16(f, (m) + 48u)
#  define LANES_OF_256(f) LANES_OF_64(f, 0u), LANES_OF_64(f, 64u), LANES_OF_64(f, 128u), LANES_OF_64(f, 192u)

static const uint64_t LANES_ORDER[256] = {LANES_OF_256(LANES_ORDERS)},
                      LANES_PLACE[256] = {LANES_OF_256(LANES_PLACES)};

typedef struct lanes_split {
    __m256i order, place;
    lanes_m mask;
    uint32_t low, high;
} lanes_split;

/* The array is free from *low to *high; both move towards each other. */
VNDF_INLINE lanes_split lanes_split_by(lanes_m m, uint32_t *low, uint32_t *high)
{
    uint32_t bits = lanes_mask_bits(m), count = (uint32_t)__builtin_popcount(bits);
    lanes_split split = {_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)&LANES_ORDER[bits])),
                         _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)&LANES_PLACE[bits])), m, *low,
                         *high};
    *low += count;
    *high -= 8 - count;
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

VNDF_INLINE uint32_t lanes_append(uint32_t *list, uint32_t count, lanes_m m, uint32_t first)
{
    uint32_t bits = lanes_mask_bits(m);
    __m256i order = _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)&LANES_ORDER[bits]));
    lanes_store_u(list + count, (lanes_u)order + first);
    return count + (uint32_t)__builtin_popcount(bits);
}

#endif
#endif
