/* Draws and evaluates blocks of mixtures: samples are sorted by lobe, each lobe draws its own, and all other lobes
 * evaluate them. */
#ifndef VNDF_SAMPLER_AFFINE_MIXTURE_DRAW_H
#define VNDF_SAMPLER_AFFINE_MIXTURE_DRAW_H

#include "sampler/affine/mixture_block.h"

#if VNDF_HAS_LANES

/* The samples of a block, and which lobe drew each; -1 of what is invalid. What lanes cannot do is left to the scalar
 * call. */
typedef struct vndf_mixture_drawn {
    float x[VNDF_AXES_BLOCK], y[VNDF_AXES_BLOCK], z[VNDF_AXES_BLOCK], pdf[VNDF_AXES_BLOCK];
    int lobe[VNDF_AXES_BLOCK];
    unsigned char left[VNDF_AXES_BLOCK];
} vndf_mixture_drawn;

/* Densities only where they are wanted. */
void vndf_mixture_draw(const vndf_mixture_block *at, const float *u1, const float *u2, int with_density,
                       vndf_mixture_drawn *to);

/* Answers for the whole; marks in `left` those that the scalar call has to give. */
void vndf_mixture_answer(vndf_mixture_block *at, vndf_question question, vndf_normals wm, float *value,
                         unsigned char *left);

#endif
#endif
