/* Lists of lanes, for builds that have them (gcc and clang). */
#ifndef VNDF_SIMD_LIST_H
#define VNDF_SIMD_LIST_H

#include <stdint.h>

#include "core/inline.h"

/* Appends first + n for each bit n of `bits`, of which there are `width`, where that is below `end`. Returns the new
 * count. */
VNDF_INLINE uint32_t vndf_list_bits(uint32_t *list, uint32_t count, uint32_t bits, uint32_t first, uint32_t width,
                                    uint32_t end)
{
    if (end - first < width)
        bits &= (1u << (end - first)) - 1;
    for (; bits != 0; bits &= bits - 1)
        list[count++] = first + (uint32_t)__builtin_ctz(bits);
    return count;
}

#endif
