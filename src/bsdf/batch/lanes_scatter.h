/* Samples of bare reflection, of reflection and of both lobes in lanes: one source, lanes_scatter.c, is compiled for
 * each instruction set. It takes the drawn normals of a block, and does what the call of one does with a normal
 * (lobes/scatter.h): both are made of terms/event.h. Samples that float may not scatter it leaves to that call. */
#ifndef VNDF_BSDF_BATCH_LANES_SCATTER_H
#define VNDF_BSDF_BATCH_LANES_SCATTER_H

#include "bsdf/batch/block.h"

/* The inputs of a block beside those of its hits. */
enum { VNDF_SCATTER_U2 = VNDF_HIT_INPUTS, VNDF_SCATTER_U3, VNDF_SCATTER_INPUTS };

/* Normals, their densities and weights (vndf_sample_weight_n). */
typedef struct vndf_drawn_block {
    float x[VNDF_HIT_BLOCK], y[VNDF_HIT_BLOCK], z[VNDF_HIT_BLOCK];
    float density[VNDF_HIT_BLOCK], weight[VNDF_HIT_BLOCK];
} vndf_drawn_block;

typedef struct vndf_scatter_block {
    const vndf_material *material;
    const vndf_bsdf *hit; /* of all samples, then alpha and wi are not read; or NULL */
    const float *in[VNDF_SCATTER_INPUTS];
    const vndf_drawn_block *drawn;
    uint32_t count;
    vndf_scattered_n to; /* written to the end of the last group */
    vndf_sample_bits left;
} vndf_scatter_block;

#if VNDF_HAS_LANES
void vndf_scatter_block_avx2(vndf_scatter_block *block);
void vndf_scatter_block_avx512(vndf_scatter_block *block);
#endif

#endif
