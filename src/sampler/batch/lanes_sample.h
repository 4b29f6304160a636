/* Batches in lanes: one source, lanes_draw.c, compiled for each instruction set. A block of a batch is drawn
 * where float is trusted (draw.h), sorted into samples in front of wi and in the wedge (sort.h); the rest is
 * left to the calls of one. */
#ifndef VNDF_SAMPLER_BATCH_LANES_SAMPLE_H
#define VNDF_SAMPLER_BATCH_LANES_SAMPLE_H

#include <stdint.h>

#include "vndf.h"

/* 1 where the build compiles lanes_draw.c for AVX2 and AVX-512. */
#ifndef VNDF_HAS_LANES
#  define VNDF_HAS_LANES 0
#endif

enum { VNDF_BLOCK_SAMPLES = 256, VNDF_DELICATE = 1 << 16 };

/* Samples of a block: what they are given, arrays that lanes may read to the end of the last group, and where
 * what is drawn goes. */
typedef struct vndf_sample_block {
    const float *alpha_x, *alpha_y, *wi_x, *wi_y, *wi_z, *u1, *u2;
    const vndf_view *view; /* of all, then alpha and wi are not read; or NULL */
    uint32_t count, left_count;
    /* indices of those that are not drawn, VNDF_DELICATE added if that was tried */
    uint32_t left[VNDF_BLOCK_SAMPLES];
    float *x, *y, *z, *density; /* to be written, to the end of the last group */
} vndf_sample_block;

#if VNDF_HAS_LANES
void vndf_sample_block_avx2(const vndf_distribution *d, vndf_sample_block *block);
void vndf_sample_block_avx512(const vndf_distribution *d, vndf_sample_block *block);
#endif

#endif
