/* What all blocks of a batch have: inputs of hits, and lists of elements. */
#ifndef VNDF_BSDF_BATCH_BLOCK_H
#define VNDF_BSDF_BATCH_BLOCK_H

#include <string.h>

#include "bsdf/routines.h"
#include "simd/list.h"

enum { VNDF_HIT_BLOCK = 256 };

/* The inputs of hits; others follow. Lanes may read each array to the end of the last group. */
enum { VNDF_HIT_ALPHA_X, VNDF_HIT_ALPHA_Y, VNDF_HIT_WI_X, VNDF_HIT_WI_Y, VNDF_HIT_WI_Z, VNDF_HIT_INPUTS };

/* One bit for each element. */
typedef struct vndf_sample_bits {
    uint32_t of[VNDF_HIT_BLOCK / 32];
} vndf_sample_bits;

VNDF_INLINE void vndf_clear_bits(vndf_sample_bits *bits)
{
    memset(bits, 0, sizeof *bits);
}

VNDF_INLINE void vndf_set_bits(vndf_sample_bits *bits, uint32_t first, uint32_t mask)
{
    bits->of[first / 32] |= mask << first % 32;
}

VNDF_INLINE uint32_t vndf_bits_at(const vndf_sample_bits *bits, uint32_t first)
{
    return bits->of[first / 32] >> first % 32;
}

#if VNDF_HAS_LANES

/* The elements below `end` whose bits are set. Returns how many there are. */
VNDF_INLINE uint32_t vndf_list_samples(const vndf_sample_bits *bits, uint32_t end, uint32_t list[VNDF_HIT_BLOCK])
{
    uint32_t count = 0;
    for (uint32_t first = 0; first < end; first += 32)
        count = vndf_list_bits(list, count, bits->of[first / 32], first, 32, end);
    return count;
}

#endif

#endif
