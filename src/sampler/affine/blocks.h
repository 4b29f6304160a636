/* Blocks of affine surfaces for batches (lanes_axes.h): inputs, draws and answers, of the widest instruction set that
 * the batch may use. Elements that lanes leave are listed, for the scalar calls. */
#ifndef VNDF_SAMPLER_AFFINE_BLOCKS_H
#define VNDF_SAMPLER_AFFINE_BLOCKS_H

#include "sampler/affine/lanes_axes.h"

#if VNDF_HAS_LANES

/* Copies of inputs that lanes cannot read in place. */
typedef struct vndf_map_copies {
    float of[VNDF_MAP_INPUTS][VNDF_AXES_BLOCK];
} vndf_map_copies;

/* Where a batch is in its blocks, and whether lanes of AVX-512 take them. */
typedef struct vndf_walk {
    size_t total, first;
    uint32_t count;
    int wide;
} vndf_walk;

/* Before the first block. */
vndf_walk vndf_walk_over(size_t total, vndf_instructions limit);

/* Moves on to the next block; 0 after the last. */
int vndf_walk_on(vndf_walk *at);

/* The block's numbers, which lanes may read to the end of a block; NULL holds zeros. */
const float *vndf_walk_input(const vndf_walk *at, const float *from, int is_shared, float *copy);

/* Elements that the scalar calls have to answer. An element may stand there twice. */
typedef struct vndf_left {
    uint32_t index[4 * VNDF_AXES_BLOCK], count;
} vndf_left;

/* Sets what is listed. */
void vndf_left_mark(const vndf_left *left, unsigned char *is_left);

/* Some elements of a block. */
typedef struct vndf_some {
    uint32_t index[VNDF_AXES_BLOCK], count;
} vndf_some;

void vndf_block_axes(int wide, const vndf_map_inputs *in, uint32_t count, vndf_axes_block *to);
void vndf_block_areas(int wide, const vndf_distribution *d, const vndf_map_inputs *in, const vndf_axes_block *at,
                      uint32_t count, vndf_areas_block *to);

/* Draws real normals; densities only where they are wanted. */
void vndf_block_draw(int wide, const vndf_distribution *d, const vndf_map_inputs *in, const vndf_axes_block *at,
                     const float *u1, const float *u2, uint32_t count, int with_density, vndf_real_block *real,
                     vndf_left *left);

/* The answers for real normals, to value[i] for all elements, or for some of them; normals are not read for a question
 * of a direction alone. */
void vndf_block_answer(int wide, const vndf_distribution *d, vndf_question question, const vndf_map_inputs *in,
                       const vndf_axes_block *at, const float *const normal[3], uint32_t count,
                       const vndf_some *some, float *value, vndf_left *left);

#endif
#endif
