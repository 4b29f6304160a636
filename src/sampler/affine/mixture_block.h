/* A block of a batch of mixtures: its inputs, the axes of each lobe, and which lobe each u1 draws (mixture.c has the
 * same for one). */
#ifndef VNDF_SAMPLER_AFFINE_MIXTURE_BLOCK_H
#define VNDF_SAMPLER_AFFINE_MIXTURE_BLOCK_H

#include "sampler/affine/blocks.h"

#if VNDF_HAS_LANES

/* A lobe of a block: its axes, weights over their sum, and where in u1 it is drawn. */
typedef struct vndf_lobe_block {
    vndf_axes_block axes;
    double weight[VNDF_AXES_BLOCK], begin[VNDF_AXES_BLOCK], share[VNDF_AXES_BLOCK];
} vndf_lobe_block;

typedef struct vndf_mixture_block {
    const vndf_mixture_batch *batch;
    vndf_walk walk;
    vndf_map_inputs in; /* wi; the rest is read for the axes alone */
    vndf_map_copies copies;
    unsigned char valid[VNDF_AXES_BLOCK];
    vndf_areas_block whole;
    vndf_lobe_block lobe[VNDF_MIXTURE_LOBES];
    float more[3][VNDF_AXES_BLOCK];
} vndf_mixture_block;

/* Before the first block. */
void vndf_mixture_begin(vndf_mixture_block *at, const vndf_mixture_batch *b);

/* Moves on to the next block; 0 after the last. Without wi, weights alone. */
int vndf_mixture_next(vndf_mixture_block *at, int with_wi);

/* More inputs of the block: `which` is 0 to 2. */
const float *vndf_mixture_more(vndf_mixture_block *at, int which, const float *from);

#endif
#endif
