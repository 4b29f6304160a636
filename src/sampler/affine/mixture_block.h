/* A block of a batch of mixtures: its inputs, the axes of each lobe, and which lobe each u1 draws (lanes_mixture.h). */
#ifndef VNDF_SAMPLER_AFFINE_MIXTURE_BLOCK_H
#define VNDF_SAMPLER_AFFINE_MIXTURE_BLOCK_H

#include "sampler/affine/blocks.h"
#include "sampler/affine/lanes_mixture.h"

#if VNDF_HAS_LANES

typedef struct vndf_mixture_block {
    const vndf_mixture_batch *batch;
    vndf_walk walk;
    vndf_map_inputs in; /* wi; the rest is read for the axes alone */
    vndf_map_copies copies;
    float weight_copies[VNDF_MIXTURE_LOBES][VNDF_AXES_BLOCK], more[3][VNDF_AXES_BLOCK];
    vndf_affine_view view[VNDF_MIXTURE_LOBES]; /* if all elements share one surface and direction */
    vndf_lobes_block of;
} vndf_mixture_block;

/* Before the first block. */
void vndf_mixture_begin(vndf_mixture_block *at, const vndf_mixture_batch *b);

/* Moves on to the next block; 0 after the last. Without wi, weights alone. */
int vndf_mixture_next(vndf_mixture_block *at, int with_wi);

/* The surfaces of a lobe. */
vndf_surfaces vndf_mixture_surfaces(const vndf_mixture_block *at, int lobe);

/* More inputs of the block: `which` is 0 to 2. */
const float *vndf_mixture_more(vndf_mixture_block *at, int which, const float *from);

/* Which lobe each number chooses. */
void vndf_mixture_choose(const vndf_mixture_block *at, const float *u1, vndf_choice_block *to);

#endif
#endif
