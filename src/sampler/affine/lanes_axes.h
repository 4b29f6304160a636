/* Affine surfaces in lanes of doubles. One source, lanes_axes.c, is compiled for each instruction set. It takes blocks
 * of surfaces and directions to their principal axes (principal.h), where the batches of plain surfaces draw and
 * evaluate them (batch/), and normals there and back. */
#ifndef VNDF_SAMPLER_AFFINE_LANES_AXES_H
#define VNDF_SAMPLER_AFFINE_LANES_AXES_H

#include <stdint.h>

#include "sampler/batch/lanes_eval.h"
#include "sampler/batch/lanes_sample.h"

enum { VNDF_AXES_BLOCK = 128 };

/* Some elements of a block. Lanes write past the end of the list. */
typedef struct vndf_some {
    uint32_t index[VNDF_AXES_BLOCK + 8], count;
} vndf_some;

/* The inputs of a block. */
enum {
    VNDF_MAP_XX,
    VNDF_MAP_XY,
    VNDF_MAP_YX,
    VNDF_MAP_YY,
    VNDF_MAP_MEAN_X,
    VNDF_MAP_MEAN_Y,
    VNDF_MAP_WI_X,
    VNDF_MAP_WI_Y,
    VNDF_MAP_WI_Z,
    VNDF_MAP_INPUTS
};

/* Lanes may read each to the end of the last group. */
typedef struct vndf_map_inputs {
    const float *of[VNDF_MAP_INPUTS];
} vndf_map_inputs;

/* The plain surfaces and directions, and the axes. */
typedef struct vndf_axes_block {
    float ax[VNDF_AXES_BLOCK], ay[VNDF_AXES_BLOCK];
    float x[VNDF_AXES_BLOCK], y[VNDF_AXES_BLOCK], z[VNDF_AXES_BLOCK];
    double cosine[VNDF_AXES_BLOCK], sine[VNDF_AXES_BLOCK];
    double mean_x[VNDF_AXES_BLOCK], mean_y[VNDF_AXES_BLOCK], factor[VNDF_AXES_BLOCK];
} vndf_axes_block;

/* vndf_areas; `toward` is -1 where the surface or the direction is invalid. */
typedef struct vndf_areas_block {
    double toward[VNDF_AXES_BLOCK], away[VNDF_AXES_BLOCK], up[VNDF_AXES_BLOCK];
} vndf_areas_block;

/* Normals that the plain surfaces drew and their densities, which become those of the real ones. `lost` lists normals
 * that face away, and `slow` those whose density has to be evaluated. */
typedef struct vndf_real_block {
    float x[VNDF_AXES_BLOCK], y[VNDF_AXES_BLOCK], z[VNDF_AXES_BLOCK], density[VNDF_AXES_BLOCK];
    vndf_some lost, slow;
} vndf_real_block;

/* Real normals seen from the axes, and wi'.n. */
typedef struct vndf_seen_block {
    double x[VNDF_AXES_BLOCK], y[VNDF_AXES_BLOCK], z[VNDF_AXES_BLOCK], facing[VNDF_AXES_BLOCK];
} vndf_seen_block;

#if VNDF_HAS_LANES

#  define VNDF_DECLARE_AXES(name)                                                                                 \
    void vndf_axes_##name(const vndf_map_inputs *in, uint32_t count, vndf_axes_block *to);                        \
    void vndf_axes_turn_##name(const vndf_map_inputs *in, uint32_t count, vndf_axes_block *to);                   \
    void vndf_axes_areas_##name(const vndf_distribution *d, const vndf_map_inputs *in, const vndf_axes_block *at, \
                                uint32_t count, vndf_areas_block *to);                                            \
    void vndf_axes_real_##name(const vndf_distribution *d, const vndf_map_inputs *in, const vndf_axes_block *at,  \
                               uint32_t count, vndf_real_block *real);                                            \
    void vndf_axes_seen_##name(const vndf_map_inputs *in, const vndf_axes_block *at, uint32_t count,              \
                               const float *const normal[3], vndf_seen_block *to);

VNDF_DECLARE_AXES(avx2)
VNDF_DECLARE_AXES(avx512)

#endif
#endif
