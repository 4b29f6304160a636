/* Blocks of affine surfaces for batches (lanes_axes.h): inputs, draws and answers, of the widest instruction set that
 * the batch may use. Elements that lanes leave are listed, for the scalar calls. */
#ifndef VNDF_SAMPLER_AFFINE_BLOCKS_H
#define VNDF_SAMPLER_AFFINE_BLOCKS_H

#include "sampler/affine/lanes_axes.h"

#if VNDF_HAS_LANES

/* ---- walks ---- */

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

/* Whether the block is not the first: what all elements share has been read. */
static inline int vndf_walk_has_begun(const vndf_walk *at)
{
    return at->first > 0;
}

/* The block's numbers, which lanes may read to the end of a block; NULL holds zeros. */
const float *vndf_walk_input(const vndf_walk *at, const float *from, int is_shared, float *copy);

/* ---- surfaces ---- */

/* Copies of inputs that lanes cannot read in place. */
typedef struct vndf_map_copies {
    float of[VNDF_MAP_INPUTS][VNDF_AXES_BLOCK];
} vndf_map_copies;

/* The surfaces and directions of a block: `in` has wi. If all elements share one surface and direction, `view` may be
 * theirs, along the axes, or NULL. */
typedef struct vndf_surfaces {
    int wide, is_one;
    const vndf_distribution *distribution;
    const vndf_map_inputs *in;
    const vndf_axes_block *axes;
    const vndf_view *view;
} vndf_surfaces;

/* The view along the axes; NULL if lanes would leave every sample of it. */
static inline const vndf_view *vndf_trusted_view(const vndf_affine_view *view)
{
    return view->principal.distribution && view->principal.trusted ? &view->principal : NULL;
}

/* Elements that the scalar calls have to answer. An element may stand there twice. */
typedef struct vndf_left {
    uint32_t index[4 * VNDF_AXES_BLOCK], count;
} vndf_left;

/* Sets what is listed. */
void vndf_left_mark(const vndf_left *left, unsigned char *is_left);

/* The axes of the block. `with_matrix`: the matrices are others than those of the block before; otherwise only the
 * directions are. */
void vndf_block_axes(int wide, int with_matrix, const vndf_map_inputs *in, uint32_t count, vndf_axes_block *to);
void vndf_block_areas(const vndf_surfaces *of, uint32_t count, vndf_areas_block *to);

/* Room for surfaces of some elements, side by side. */
typedef struct vndf_gathered {
    vndf_axes_block axes;
    vndf_map_inputs in;
    float wi[3][VNDF_AXES_BLOCK];
} vndf_gathered;

vndf_surfaces vndf_block_gather(const vndf_surfaces *of, const vndf_some *some, vndf_gathered *own);

/* Numbers of some elements, side by side; lanes may read to the end of the last group. */
void vndf_block_pick(const float *from, const vndf_some *some, float *to);

/* ---- draws and answers ---- */

/* Draws real normals; densities only where they are wanted. */
void vndf_block_draw(const vndf_surfaces *of, const float *u1, const float *u2, uint32_t count, int with_density,
                     vndf_real_block *real, vndf_left *left);

/* The answers for real normals; normals are not read for a question of a direction alone. */
void vndf_block_answer(const vndf_surfaces *of, vndf_question question, const float *const normal[3],
                       uint32_t count, float *value, vndf_left *left);

/* The answers for real normals of some elements, to value[0], value[1] and so on; `left` has places in `some`. */
void vndf_block_answer_some(const vndf_surfaces *of, vndf_question question, const float *const normal[3],
                            const vndf_some *some, float *value, vndf_left *left);

#endif
#endif
