/* Batches in lanes: one source, lanes_draw.c, is compiled for each instruction set. It sorts a block of a batch into
 * samples in front of wi and in the wedge (sort.h), draws them in float (draw.h), and leaves samples that float may not
 * draw to the scalar calls. */
#ifndef VNDF_SAMPLER_BATCH_LANES_SAMPLE_H
#define VNDF_SAMPLER_BATCH_LANES_SAMPLE_H

#include <stdint.h>

#include "vndf.h"

/* 1 where the build compiles lanes_draw.c for AVX2 and AVX-512. */
#ifndef VNDF_HAS_LANES
#  define VNDF_HAS_LANES 0
#endif

enum { VNDF_BLOCK_SAMPLES = 256, VNDF_DELICATE = 1 << 16 };

/* The samples of a block: input arrays, which lanes may read to the end of the last group, and output arrays. */
typedef struct vndf_sample_block {
    const float *alpha_x, *alpha_y, *wi_x, *wi_y, *wi_z, *u1, *u2;
    const vndf_view *view; /* shared by all samples, then alpha and wi are not read; or NULL */
    uint32_t count, left_count;
    /* indices of samples that were left; VNDF_DELICATE is added where float has tried */
    uint32_t left[VNDF_BLOCK_SAMPLES];
    float *x, *y, *z, *density; /* written to the end of the last group */
    float *weight;              /* the same, of tables; 0 where the scalar call is to compute it; or NULL */
} vndf_sample_block;

#if VNDF_HAS_LANES
void vndf_sample_block_avx2(const vndf_distribution *d, vndf_sample_block *block);
void vndf_sample_block_avx512(const vndf_distribution *d, vndf_sample_block *block);

/* Draws those of the samples that were left which a table sees from below the horizon, by the exact tier in lanes of
 * doubles (below.h); the block has no view. Leaves what the scalar calls are to draw; weights become 0. */
void vndf_sample_below_avx2(const vndf_distribution *d, vndf_sample_block *block);
void vndf_sample_below_avx512(const vndf_distribution *d, vndf_sample_block *block);
#endif

#endif
