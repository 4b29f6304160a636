/* Batches of inverses, in lanes of doubles. One source, lanes_invert.c, is compiled for each instruction set. Numbers
 * that are not sure (tabulated/inverse.h), and all below the horizon under a table, are left to the scalar call. */
#ifndef VNDF_SAMPLER_BATCH_LANES_INVERT_H
#define VNDF_SAMPLER_BATCH_LANES_INVERT_H

#include "sampler/batch/lanes_eval.h"

/* The inputs of a block, as those of densities: lanes may read each to the end of the last group. */
typedef struct vndf_invert_block {
    const float *of[VNDF_EVAL_INPUTS];
    uint32_t count, left_count;
    uint32_t left[VNDF_EVAL_BLOCK];                 /* indices without an answer */
    float u1[VNDF_EVAL_BLOCK], u2[VNDF_EVAL_BLOCK]; /* the answers */
} vndf_invert_block;

#if VNDF_HAS_LANES
void vndf_invert_block_avx2(const vndf_distribution *d, vndf_invert_block *block);
void vndf_invert_block_avx512(const vndf_distribution *d, vndf_invert_block *block);
#endif

#endif
