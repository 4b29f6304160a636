/* The calls of many: in lanes where there are any, else one after the other. */
#include <string.h>

#include "core/inline.h"
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

/* Element i of a batch. */
VNDF_INLINE vndf_surface surface_at(const vndf_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_ALPHA ? 0 : i;
    vndf_surface surface = {b->distribution, b->alpha_x[at], b->alpha_y[at]};
    return surface;
}

VNDF_INLINE vndf_vec3 wi_at(const vndf_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_WI ? 0 : i;
    vndf_vec3 wi = {b->wi_x[at], b->wi_y[at], b->wi_z[at]};
    return wi;
}

VNDF_INLINE vndf_vec3 normal_at(vndf_normals wm, size_t i)
{
    vndf_vec3 n = {wm.x[i], wm.y[i], wm.z[i]};
    return n;
}

/* Whether all elements have one view. */
VNDF_INLINE int is_one_view(const vndf_batch *b)
{
    return (b->shared & VNDF_SHARED_ALPHA) && (b->shared & VNDF_SHARED_WI) && b->count > 0;
}

VNDF_INLINE vndf_view view_at(const vndf_batch *b, size_t i)
{
    vndf_surface surface = surface_at(b, i);
    return vndf_view_from(&surface, wi_at(b, i));
}

/* The view of element i, given that of the one before it. */
VNDF_INLINE void next_view(const vndf_batch *b, size_t i, vndf_view *view)
{
    if (i == 0 || !is_one_view(b))
        *view = view_at(b, i);
}

/* ---- sample ---- */

static void sample_one_by_one(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf)
{
    vndf_view view;
    for (size_t i = 0; i < b->count; i++) {
        float density;
        next_view(b, i, &view);
        vndf_vec3 n = vndf_sample(&view, u1[i], u2[i], pdf ? &density : NULL);
        wm.x[i] = n.x;
        wm.y[i] = n.y;
        wm.z[i] = n.z;
        if (pdf)
            pdf[i] = density;
    }
}

#if VNDF_HAS_LANES

/* From an array of a number each or of one for all. */
static void fill(float *to, const float *from, size_t first, uint32_t count, unsigned is_shared)
{
    for (uint32_t i = 0; i < count; i++)
        to[i] = from[is_shared ? 0 : first + i];
}

static void fill_block(vndf_sample_block *block, const vndf_batch *b, size_t first, const float *u1, const float *u2)
{
    uint32_t count = block->count;
    unsigned alpha = b->shared & VNDF_SHARED_ALPHA, wi = b->shared & VNDF_SHARED_WI;
    memcpy(block->u1, u1 + first, count * sizeof *u1);
    memcpy(block->u2, u2 + first, count * sizeof *u2);
    if (block->view)
        return;
    fill(block->alpha_x, b->alpha_x, first, count, alpha);
    fill(block->alpha_y, b->alpha_y, first, count, alpha);
    fill(block->wi_x, b->wi_x, first, count, wi);
    fill(block->wi_y, b->wi_y, first, count, wi);
    fill(block->wi_z, b->wi_z, first, count, wi);
}

/* What lanes have left, before the block's results go where its numbers may have come from. */
static void sample_left(vndf_sample_block *block, const vndf_batch *b, size_t first)
{
    for (uint32_t n = 0; n < block->left_count; n++) {
        uint32_t i = block->left[n];
        vndf_view own;
        if (!block->view)
            own = view_at(b, first + i);
        vndf_vec3 wm = vndf_sample(block->view ? block->view : &own, block->u1[i], block->u2[i], &block->density[i]);
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
    memset(&block, 0, sizeof block);
    if (is_one_view(b)) {
        view = view_at(b, 0);
        block.view = &view;
    }
    for (size_t first = 0; first < b->count; first += block.count) {
        size_t left = b->count - first;
        block.count = left < VNDF_BLOCK_SAMPLES ? (uint32_t)left : VNDF_BLOCK_SAMPLES;
        fill_block(&block, b, first, u1, u2);
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
    return b->count > 1 && b->distribution && b->distribution->kind == VNDF_KIND_TABLE &&
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

/* ---- the others ---- */

void vndf_pdf_n(const vndf_batch *b, vndf_normals wm, float *pdf)
{
    vndf_view view;
    for (size_t i = 0; i < b->count; i++) {
        next_view(b, i, &view);
        pdf[i] = vndf_pdf(&view, normal_at(wm, i));
    }
}

void vndf_visible_n(const vndf_batch *b, vndf_normals wm, float *visible)
{
    vndf_view view;
    for (size_t i = 0; i < b->count; i++) {
        next_view(b, i, &view);
        visible[i] = vndf_visible(&view, normal_at(wm, i));
    }
}

void vndf_invert_n(const vndf_batch *b, vndf_normals wm, float *u1, float *u2)
{
    vndf_view view;
    for (size_t i = 0; i < b->count; i++) {
        float a, c;
        next_view(b, i, &view);
        vndf_invert(&view, normal_at(wm, i), &a, &c);
        u1[i] = a;
        u2[i] = c;
    }
}

void vndf_ndf_n(const vndf_batch *b, vndf_normals wm, float *ndf)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_surface surface = surface_at(b, i);
        ndf[i] = vndf_ndf(&surface, normal_at(wm, i));
    }
}

void vndf_projected_area_n(const vndf_batch *b, float *area)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_surface surface = surface_at(b, i);
        area[i] = vndf_projected_area(&surface, wi_at(b, i));
    }
}

void vndf_lambda_n(const vndf_batch *b, float *lambda)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_surface surface = surface_at(b, i);
        lambda[i] = vndf_lambda(&surface, wi_at(b, i));
    }
}

void vndf_g1_n(const vndf_batch *b, float *g1)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_surface surface = surface_at(b, i);
        g1[i] = vndf_g1(&surface, wi_at(b, i));
    }
}
