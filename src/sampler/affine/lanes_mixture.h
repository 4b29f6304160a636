/* Shares of lobes in lanes of doubles. One source, lanes_mixture.c, is compiled for each instruction set. It says of a
 * block of mixtures what mixture.c says of one: weights over their sum, the areas of the whole, the part of u1 that
 * each lobe takes, and which lobe a number chooses. */
#ifndef VNDF_SAMPLER_AFFINE_LANES_MIXTURE_H
#define VNDF_SAMPLER_AFFINE_LANES_MIXTURE_H

#include "sampler/affine/lanes_axes.h"
#include "vndf.h"

/* A lobe of a block: its axes and areas, weights over their sum, and where in u1 it is drawn. */
typedef struct vndf_lobe_block {
    vndf_axes_block axes;
    vndf_areas_block areas;
    double weight[VNDF_AXES_BLOCK], begin[VNDF_AXES_BLOCK], share[VNDF_AXES_BLOCK];
} vndf_lobe_block;

/* The lobes, and the areas of the whole; `toward` is -1 where the mixture or the direction is invalid. */
typedef struct vndf_lobes_block {
    int lobes;
    vndf_lobe_block lobe[VNDF_MIXTURE_LOBES];
    vndf_areas_block whole;
} vndf_lobes_block;

/* For each lobe the samples that it draws, and those that another lobe draws although this one has a weight; the share
 * of the lobe that draws, 0 of what is invalid; and the part of the lobe's share that lies before u1. */
typedef struct vndf_choice_block {
    vndf_some own[VNDF_MIXTURE_LOBES], other[VNDF_MIXTURE_LOBES];
    double share[VNDF_AXES_BLOCK];
    float part[VNDF_AXES_BLOCK];
} vndf_choice_block;

#if VNDF_HAS_LANES

#  define VNDF_DECLARE_MIXTURE(name)                                                                  \
    void vndf_mixture_weigh_##name(const float *const *weight, uint32_t count, vndf_lobes_block *at); \
    void vndf_mixture_share_##name(uint32_t count, vndf_lobes_block *at);                             \
    void vndf_mixture_choose_##name(const vndf_lobes_block *at, const float *u1, uint32_t count,      \
                                    vndf_choice_block *to);

VNDF_DECLARE_MIXTURE(avx2)
VNDF_DECLARE_MIXTURE(avx512)

#endif
#endif
