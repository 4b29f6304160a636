/* Sampling many: in lanes where there are any, else one after the other. */
#include <string.h>

#include "core/inline.h"
#include "math/vector.h"
#include "sampler/batch.h"
#include "sampler/batch_lanes.h"
#include "sampler/surface.h"
#include "vndf.h"

#if VNDF_HAS_LANES

static int has_avx2(void)
{
    return __builtin_cpu_supports("avx2");
}

static int has_avx512(void)
{
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
}

#else

static int has_avx2(void)
{
    return 0;
}

static int has_avx512(void)
{
    return 0;
}

#endif

vndf_instructions vndf_instructions_used(vndf_instructions limit)
{
    if ((limit == VNDF_INSTRUCTIONS_BEST || limit >= VNDF_INSTRUCTIONS_AVX512) && has_avx512())
        return VNDF_INSTRUCTIONS_AVX512;
    if ((limit == VNDF_INSTRUCTIONS_BEST || limit >= VNDF_INSTRUCTIONS_AVX2) && has_avx2())
        return VNDF_INSTRUCTIONS_AVX2;
    return VNDF_INSTRUCTIONS_PORTABLE;
}

/* ---- sample ---- */

VNDF_INLINE void sample_one(const vndf_view *view, const vndf_batch_call *c, size_t i)
{
    float density;
    vndf_vec3 n = vndf_sample(view, c->from1[i], c->from2[i], c->to1 ? &density : NULL);
    c->wm.x[i] = n.x;
    c->wm.y[i] = n.y;
    c->wm.z[i] = n.z;
    if (c->to1)
        c->to1[i] = density;
}

static void sample_one_by_one(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf)
{
    vndf_batch_call c = {wm, u1, u2, pdf, NULL};
    vndf_batch_for_each_view(b, &c, sample_one);
}

#if VNDF_HAS_LANES

enum { INPUTS = 7 };

/* Inputs of a block that are not read where they lie: one for all, and the last of a batch, which groups of
 * lanes would read beyond. */
typedef struct copies {
    float of[INPUTS][VNDF_BLOCK_SAMPLES];
} copies;

static const float *input_at(const float *from, int is_shared, size_t first, uint32_t count, float *copy)
{
    if (is_shared) {
        for (uint32_t i = 0; first == 0 && i < VNDF_BLOCK_SAMPLES; i++)
            copy[i] = from[0];
        return copy;
    }
    if (count == VNDF_BLOCK_SAMPLES)
        return from + first;
    for (uint32_t i = 0; i < VNDF_BLOCK_SAMPLES; i++)
        copy[i] = i < count ? from[first + i] : 0.0f;
    return copy;
}

static void aim_block(vndf_sample_block *block, const vndf_batch *b, size_t first, const float *u1,
                      const float *u2, copies *c)
{
    uint32_t n = block->count;
    int alpha = (b->shared & VNDF_SHARED_ALPHA) != 0, wi = (b->shared & VNDF_SHARED_WI) != 0;
    block->u1 = input_at(u1, 0, first, n, c->of[0]);
    block->u2 = input_at(u2, 0, first, n, c->of[1]);
    if (block->view)
        return;
    block->alpha_x = input_at(b->alpha_x, alpha, first, n, c->of[2]);
    block->alpha_y = input_at(b->alpha_y, alpha, first, n, c->of[3]);
    block->wi_x = input_at(b->wi_x, wi, first, n, c->of[4]);
    block->wi_y = input_at(b->wi_y, wi, first, n, c->of[5]);
    block->wi_z = input_at(b->wi_z, wi, first, n, c->of[6]);
}

/* What lanes have left, before the block's results go where its numbers may have come from. */
static void sample_left(vndf_sample_block *block, const vndf_batch *b, size_t first)
{
    for (uint32_t n = 0; n < block->left_count; n++) {
        uint32_t i = block->left[n] % VNDF_DELICATE;
        vndf_view own = block->view ? *block->view : vndf_batch_view(b, first + i);
        vndf_vec3 wm = block->left[n] >= VNDF_DELICATE
                           ? vndf_sample_carefully(&own, block->u1[i], block->u2[i], &block->density[i])
                           : vndf_sample(&own, block->u1[i], block->u2[i], &block->density[i]);
        block->x[i] = wm.x;
        block->y[i] = wm.y;
        block->z[i] = wm.z;
    }
}

static void sample_in_lanes(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf)
{
    int wide = vndf_instructions_used(b->limit) == VNDF_INSTRUCTIONS_AVX512;
    vndf_view view;
    vndf_sample_block block;
    copies own;
    block.view = NULL;
    if (vndf_batch_is_one_view(b)) {
        view = vndf_batch_view(b, 0);
        block.view = &view;
    }
    if (block.view && !view.plain) { /* lanes would leave all of it */
        sample_one_by_one(b, u1, u2, wm, pdf);
        return;
    }
    for (size_t first = 0; first < b->count; first += block.count) {
        size_t left = b->count - first;
        block.count = left < VNDF_BLOCK_SAMPLES ? (uint32_t)left : VNDF_BLOCK_SAMPLES;
        aim_block(&block, b, first, u1, u2, &own);
        if (wide)
            vndf_sample_block_avx512(b->distribution, &block);
        else
            vndf_sample_block_avx2(b->distribution, &block);
        sample_left(&block, b, first);
        size_t bytes = block.count * sizeof(float);
        memcpy(wm.x + first, block.x, bytes);
        memcpy(wm.y + first, block.y, bytes);
        memcpy(wm.z + first, block.z, bytes);
        if (pdf)
            memcpy(pdf + first, block.density, bytes);
    }
}

/* Whether lanes draw most samples of a batch. */
static int has_lanes(const vndf_batch *b)
{
    return b->count > 1 && b->distribution && b->distribution->kind != VNDF_KIND_BECKMANN &&
           vndf_unit_scale_float(b->distribution) > 0.0f &&
           vndf_instructions_used(b->limit) != VNDF_INSTRUCTIONS_PORTABLE;
}

void vndf_sample_n(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf)
{
    if (has_lanes(b))
        sample_in_lanes(b, u1, u2, wm, pdf);
    else
        sample_one_by_one(b, u1, u2, wm, pdf);
}

#else

void vndf_sample_n(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf)
{
    sample_one_by_one(b, u1, u2, wm, pdf);
}

#endif
