/* What all blocks of a batch have: inputs of hits, and lists of elements. */
#ifndef VNDF_BSDF_BATCH_BLOCK_H
#define VNDF_BSDF_BATCH_BLOCK_H

#include "bsdf/routines.h"

enum { VNDF_HIT_BLOCK = 256 };

/* The inputs of hits; others follow. Lanes may read each array to the end of the last group. */
enum { VNDF_HIT_ALPHA_X, VNDF_HIT_ALPHA_Y, VNDF_HIT_WI_X, VNDF_HIT_WI_Y, VNDF_HIT_WI_Z, VNDF_HIT_INPUTS };

/* One bit for each element. */
typedef struct vndf_sample_bits {
    uint32_t of[VNDF_HIT_BLOCK / 32];
} vndf_sample_bits;

#endif
