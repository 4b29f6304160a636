/* Lists of lanes, for lanes_axes.c and lanes_mixture.c. */
#ifndef VNDF_SAMPLER_AFFINE_LANES_LIST_H
#define VNDF_SAMPLER_AFFINE_LANES_LIST_H

#include "simd/doubles.h"

/* Indices of the lanes in `m`, from `first` on, that are below `end`. */
VNDF_INLINE uint32_t vndf_list_append(uint32_t *list, uint32_t count, doubles_m m, uint32_t first, uint32_t end)
{
    uint32_t bits = doubles_mask_bits(m);
    if (end - first < VNDF_DOUBLES)
        bits &= (1u << (end - first)) - 1;
    for (; bits != 0; bits &= bits - 1)
        list[count++] = first + (uint32_t)__builtin_ctz(bits);
    return count;
}

#endif
