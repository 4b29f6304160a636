/* Draws a batch: in lanes where the processor has them, else one after the other. */
#include <stdint.h>
#include <string.h>

#include "core/inline.h"
#include "math/vector.h"
#include "sampler/batch/batch.h"
#include "sampler/batch/lanes_sample.h"
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

VNDF_INLINE void put_normal(vndf_normals to, size_t i, vndf_vec3 n)
{
    to.x[i] = n.x;
    to.y[i] = n.y;
    to.z[i] = n.z;
}

VNDF_INLINE vndf_vec3 sample_view(const vndf_view *view, float u1, float u2, float *density, float *weight)
{
    return weight ? vndf_sample_weight(view, u1, u2, density, weight) : vndf_sample(view, u1, u2, density);
}

VNDF_INLINE void sample_one(const vndf_view *view, const vndf_batch_call *c, size_t i)
{
    float density, weight;
    vndf_vec3 n = sample_view(view, c->from1[i], c->from2[i], c->to1 ? &density : NULL, c->to2 ? &weight : NULL);
    put_normal(c->wm, i, n);
    if (c->to1)
        c->to1[i] = density;
    if (c->to2)
        c->to2[i] = weight;
}

static void sample_one_by_one(const vndf_batch *b, const vndf_batch_call *c)
{
    vndf_batch_for_each_view(b, c, sample_one);
}

#if VNDF_HAS_LANES

enum { INPUTS = 7, RESULTS = 5 };

/* Copies of inputs (vndf_batch_input). Results wait here for the last block, and wherever results may overwrite
 * inputs. */
typedef struct copies {
    float of[INPUTS][VNDF_BLOCK_SAMPLES], result[RESULTS][VNDF_BLOCK_SAMPLES];
} copies;

static void read_block(vndf_sample_block *block, const vndf_batch *b, size_t first, const vndf_batch_call *call,
                       copies *c)
{
    uint32_t n = block->count;
    int alpha = (b->shared & VNDF_SHARED_ALPHA) != 0, wi = (b->shared & VNDF_SHARED_WI) != 0;
    block->u1 = vndf_batch_input(call->from1, 0, first, n, VNDF_BLOCK_SAMPLES, c->of[0]);
    block->u2 = vndf_batch_input(call->from2, 0, first, n, VNDF_BLOCK_SAMPLES, c->of[1]);
    if (block->view)
        return;
    block->alpha_x = vndf_batch_input(b->alpha_x, alpha, first, n, VNDF_BLOCK_SAMPLES, c->of[2]);
    block->alpha_y = vndf_batch_input(b->alpha_y, alpha, first, n, VNDF_BLOCK_SAMPLES, c->of[3]);
    block->wi_x = vndf_batch_input(b->wi_x, wi, first, n, VNDF_BLOCK_SAMPLES, c->of[4]);
    block->wi_y = vndf_batch_input(b->wi_y, wi, first, n, VNDF_BLOCK_SAMPLES, c->of[5]);
    block->wi_z = vndf_batch_input(b->wi_z, wi, first, n, VNDF_BLOCK_SAMPLES, c->of[6]);
}

static int overlap(const float *a, const float *b, size_t count)
{
    uintptr_t first = (uintptr_t)a, second = (uintptr_t)b, bytes = count * sizeof(float);
    return first < second + bytes && second < first + bytes;
}

/* Whether no result overlaps an input. */
static int is_apart(const vndf_batch *b, const vndf_batch_call *c)
{
    const float *read[INPUTS] = {c->from1, c->from2, b->alpha_x, b->alpha_y, b->wi_x, b->wi_y, b->wi_z};
    const float *written[RESULTS] = {c->wm.x, c->wm.y, c->wm.z, c->to1, c->to2};
    for (int i = 0; i < INPUTS; i++)
        for (int j = 0; j < RESULTS; j++)
            if (written[j] && overlap(read[i], written[j], b->count))
                return 0;
    return 1;
}

/* Where a block writes its results: in place, or into the copies. */
static void place_results(vndf_sample_block *block, copies *c, size_t first, int apart,
                          const vndf_batch_call *call)
{
    int at_once = apart && block->count == VNDF_BLOCK_SAMPLES;
    block->x = at_once ? call->wm.x + first : c->result[0];
    block->y = at_once ? call->wm.y + first : c->result[1];
    block->z = at_once ? call->wm.z + first : c->result[2];
    block->density = at_once && call->to1 ? call->to1 + first : c->result[3];
    block->weight = !call->to2 ? NULL : at_once ? call->to2 + first : c->result[4];
}

/* Draws the samples that lanes have left, before results overwrite inputs. */
static void sample_left(const vndf_sample_block *block, const vndf_batch *b, size_t first)
{
    const vndf_normals to = {block->x, block->y, block->z};
    for (uint32_t n = 0; n < block->left_count; n++) {
        uint32_t i = block->left[n] % VNDF_DELICATE;
        vndf_view own = block->view ? *block->view : vndf_batch_view(b, first + i);
        float *density = &block->density[i], *weight = block->weight ? &block->weight[i] : NULL;
        if (weight)
            *weight = 0.0f;
        put_normal(to, i,
                   block->left[n] >= VNDF_DELICATE
                       ? vndf_sample_exactly(&own, block->u1[i], block->u2[i], density)
                       : sample_view(&own, block->u1[i], block->u2[i], density, weight));
    }
}

/* The weights that lanes have not computed: all of a closed form, which draws with the visible density itself. */
static void weigh_left(const vndf_sample_block *block, const vndf_batch *b, size_t first)
{
    int is_table = vndf_is_table(b->distribution);
    for (uint32_t i = 0; i < block->count; i++) {
        float density = block->density[i];
        if (!is_table || !(density > 0.0f)) {
            block->weight[i] = density > 0.0f ? 1.0f : 0.0f;
        } else if (!(block->weight[i] > 0.0f)) {
            vndf_view own = block->view ? *block->view : vndf_batch_view(b, first + i);
            vndf_vec3 wm = {block->x[i], block->y[i], block->z[i]};
            block->weight[i] = vndf_weight_of(&own, wm, density);
        }
    }
}

/* Moves results from the copies to where they belong. */
static void move_results(const vndf_sample_block *block, size_t first, const vndf_batch_call *c)
{
    size_t bytes = block->count * sizeof(float);
    if (c->to1 && block->density != c->to1 + first)
        memcpy(c->to1 + first, block->density, bytes);
    if (block->x == c->wm.x + first)
        return;
    memcpy(c->wm.x + first, block->x, bytes);
    memcpy(c->wm.y + first, block->y, bytes);
    memcpy(c->wm.z + first, block->z, bytes);
    if (c->to2)
        memcpy(c->to2 + first, block->weight, bytes);
}

static void draw_block(const vndf_batch *b, vndf_sample_block *block, int wide)
{
    if (wide)
        vndf_sample_block_avx512(b->distribution, block);
    else
        vndf_sample_block_avx2(b->distribution, block);
}

static void draw_below(const vndf_batch *b, vndf_sample_block *block, int wide)
{
    if (!vndf_is_table(b->distribution) || block->view || block->left_count == 0)
        return;
    if (wide)
        vndf_sample_below_avx512(b->distribution, block);
    else
        vndf_sample_below_avx2(b->distribution, block);
}

/* Whether a table is seen from below the horizon alone: then the first lanes would leave every sample. */
static int is_below(const vndf_batch *b, const vndf_sample_block *block)
{
    uint32_t i = 0;
    while (!block->view && vndf_is_table(b->distribution) && i < block->count && block->wi_z[i] < 0.0f)
        i++;
    return i == block->count;
}

static void leave_all(vndf_sample_block *block)
{
    for (block->left_count = 0; block->left_count < block->count; block->left_count++)
        block->left[block->left_count] = block->left_count;
}

static void sample_in_lanes(const vndf_batch *b, const vndf_batch_call *c)
{
    int wide = vndf_instructions_used(b->limit) == VNDF_INSTRUCTIONS_AVX512;
    int apart = b->count >= VNDF_BLOCK_SAMPLES && is_apart(b, c);
    int one = vndf_batch_is_one_view(b), below = one && vndf_is_table(b->distribution) && b->wi_z[0] < 0.0f;
    vndf_view view;
    vndf_sample_block block;
    copies own;
    block.view = NULL;
    if (one && !below) {
        view = vndf_batch_view(b, 0);
        block.view = &view;
    }
    if (block.view && !view.trusted) { /* lanes would leave every sample */
        sample_one_by_one(b, c);
        return;
    }
    for (size_t first = 0; first < b->count; first += block.count) {
        size_t left = b->count - first;
        block.count = left < VNDF_BLOCK_SAMPLES ? (uint32_t)left : VNDF_BLOCK_SAMPLES;
        read_block(&block, b, first, c, &own);
        place_results(&block, &own, first, apart, c);
        if (is_below(b, &block))
            leave_all(&block);
        else
            draw_block(b, &block, wide);
        draw_below(b, &block, wide);
        sample_left(&block, b, first);
        if (block.weight)
            weigh_left(&block, b, first);
        move_results(&block, first, c);
    }
}

static void sample_all(const vndf_batch *b, const vndf_batch_call *c)
{
    if (vndf_batch_has_lanes(b) && vndf_unit_scale_float(b->distribution) > 0.0f) /* lanes have no double */
        sample_in_lanes(b, c);
    else
        sample_one_by_one(b, c);
}

#else

static void sample_all(const vndf_batch *b, const vndf_batch_call *c)
{
    sample_one_by_one(b, c);
}

#endif

void vndf_sample_n(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf)
{
    vndf_batch_call c = {wm, u1, u2, pdf, NULL};
    sample_all(b, &c);
}

void vndf_sample_weight_n(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf,
                          float *weight)
{
    vndf_batch_call c = {wm, u1, u2, pdf, weight};
    sample_all(b, &c);
}
