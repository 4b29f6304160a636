/* Values and densities of bare reflection, of reflection and of both lobes in lanes: one source, lanes_look.c, is
 * compiled for each instruction set. The facet between the two directions is terms/facet.h, as for the call of one;
 * its D and its density are answered as batches of vndf.h are (sampler/batch/lanes_eval.h). What lanes may not
 * answer they leave to the call of one. */
#ifndef VNDF_BSDF_BATCH_LANES_LOOK_H
#define VNDF_BSDF_BATCH_LANES_LOOK_H

#include "bsdf/batch/block.h"

/* The inputs of a block beside those of its hits. */
enum { VNDF_LOOK_WO_X = VNDF_HIT_INPUTS, VNDF_LOOK_WO_Y, VNDF_LOOK_WO_Z, VNDF_LOOK_INPUTS };

typedef struct vndf_look_block {
    const vndf_material *material;
    const vndf_bsdf *hit; /* of all elements, or NULL */
    const float *in[VNDF_LOOK_INPUTS];
    uint32_t count;
    /* written to the end of the last group; no values are asked for where the first is NULL, and no densities */
    float *value[VNDF_WAVELENGTHS], *pdf;
    vndf_sample_bits left;
} vndf_look_block;

#if VNDF_HAS_LANES
void vndf_look_block_avx2(vndf_look_block *block);
void vndf_look_block_avx512(vndf_look_block *block);
#endif

#endif
