#include "sampler/affine/blocks.h"

#include <string.h>

#if VNDF_HAS_LANES

/* ---- walks ---- */

vndf_walk vndf_walk_over(size_t total, vndf_instructions limit)
{
    vndf_walk at = {total, 0, 0, vndf_instructions_used(limit) == VNDF_INSTRUCTIONS_AVX512};
    return at;
}

int vndf_walk_on(vndf_walk *at)
{
    at->first += at->count;
    if (at->first >= at->total)
        return 0;
    size_t rest = at->total - at->first;
    at->count = rest < VNDF_AXES_BLOCK ? (uint32_t)rest : VNDF_AXES_BLOCK;
    return 1;
}

const float *vndf_walk_input(const vndf_walk *at, const float *from, int is_shared, float *copy)
{
    if (from && !is_shared && at->count == VNDF_AXES_BLOCK)
        return from + at->first;
    for (uint32_t i = 0; i < VNDF_AXES_BLOCK; i++)
        copy[i] = !from || (!is_shared && i >= at->count) ? 0.0f : from[is_shared ? 0 : at->first + i];
    return copy;
}

/* ---- axes ---- */

void vndf_block_axes(int wide, const vndf_map_inputs *in, uint32_t count, vndf_axes_block *to)
{
    if (wide)
        vndf_axes_avx512(in, count, to);
    else
        vndf_axes_avx2(in, count, to);
}

void vndf_block_areas(int wide, const vndf_distribution *d, const vndf_map_inputs *in, const vndf_axes_block *at,
                      uint32_t count, vndf_areas_block *to)
{
    if (wide)
        vndf_axes_areas_avx512(d, in, at, count, to);
    else
        vndf_axes_areas_avx2(d, in, at, count, to);
}

/* ---- answers ---- */

static void leave(vndf_left *left, uint32_t index)
{
    left->index[left->count++] = index;
}

void vndf_left_mark(const vndf_left *left, unsigned char *is_left)
{
    for (uint32_t n = 0; n < left->count; n++)
        is_left[left->index[n]] = 1;
}

/* The inputs of some elements, side by side. */
typedef struct gathered {
    float of[VNDF_EVAL_X][VNDF_AXES_BLOCK];
    vndf_seen_block seen;
} gathered;

static void gather(const vndf_axes_block *at, const vndf_seen_block *seen, const vndf_some *some, gathered *to)
{
    uint32_t end = (some->count + 7) / 8 * 8; /* spare lanes repeat the first element */
    for (uint32_t k = 0; k < end; k++) {
        uint32_t i = some->index[k < some->count ? k : 0];
        to->of[VNDF_EVAL_ALPHA_X][k] = at->ax[i];
        to->of[VNDF_EVAL_ALPHA_Y][k] = at->ay[i];
        to->of[VNDF_EVAL_WI_X][k] = at->x[i];
        to->of[VNDF_EVAL_WI_Y][k] = at->y[i];
        to->of[VNDF_EVAL_WI_Z][k] = at->z[i];
        to->seen.x[k] = seen->x[i];
        to->seen.y[k] = seen->y[i];
        to->seen.z[k] = seen->z[i];
        to->seen.facing[k] = seen->facing[i];
    }
}

static void point_at(vndf_eval_inputs *in, const float *const from[VNDF_EVAL_X], const vndf_seen_block *seen)
{
    for (int n = 0; n < VNDF_EVAL_X; n++)
        in->of[n] = from[n];
    in->normal[0] = seen->x;
    in->normal[1] = seen->y;
    in->normal[2] = seen->z;
    in->facing = seen->facing;
}

static void evaluate(int wide, const vndf_distribution *d, vndf_question question, vndf_eval_block *block)
{
    if (wide)
        vndf_eval_block_avx512(d, question, block);
    else
        vndf_eval_block_avx2(d, question, block);
}

static void answer_some(int wide, const vndf_distribution *d, vndf_question question, const vndf_axes_block *at,
                        const vndf_seen_block *seen, const vndf_some *some, float *value, vndf_left *left)
{
    gathered own;
    vndf_eval_block block;
    if (some->count == 0)
        return;
    gather(at, seen, some, &own);
    const float *from[VNDF_EVAL_X] = {own.of[0], own.of[1], own.of[2], own.of[3], own.of[4]};
    point_at(&block.in, from, &own.seen);
    block.count = some->count;
    evaluate(wide, d, question, &block);
    for (uint32_t k = 0; k < some->count; k++)
        value[some->index[k]] = block.value[k];
    for (uint32_t k = 0; k < block.left_count; k++)
        leave(left, some->index[block.left[k]]);
}

static void answer_all(int wide, const vndf_distribution *d, vndf_question question, const vndf_axes_block *at,
                       const vndf_seen_block *seen, uint32_t count, float *value, vndf_left *left)
{
    const float *from[VNDF_EVAL_X] = {at->ax, at->ay, at->x, at->y, at->z};
    vndf_eval_block block;
    point_at(&block.in, from, seen);
    block.count = count;
    evaluate(wide, d, question, &block);
    memcpy(value, block.value, count * sizeof(float));
    for (uint32_t k = 0; k < block.left_count; k++)
        leave(left, block.left[k]);
}

static void see(int wide, const vndf_map_inputs *in, const vndf_axes_block *at, uint32_t count,
                const float *const normal[3], vndf_seen_block *to)
{
    if (wide)
        vndf_axes_seen_avx512(in, at, count, normal, to);
    else
        vndf_axes_seen_avx2(in, at, count, normal, to);
}

void vndf_block_answer(int wide, const vndf_distribution *d, vndf_question question, const vndf_map_inputs *in,
                       const vndf_axes_block *at, const float *const normal[3], uint32_t count,
                       const vndf_some *some, float *value, vndf_left *left)
{
    vndf_seen_block seen;
    if (normal)
        see(wide, in, at, count, normal, &seen);
    if (some)
        answer_some(wide, d, question, at, &seen, some, value, left);
    else
        answer_all(wide, d, question, at, &seen, count, value, left);
}

/* ---- draws ---- */

void vndf_block_draw(int wide, const vndf_distribution *d, const vndf_map_inputs *in, const vndf_axes_block *at,
                     const float *u1, const float *u2, uint32_t count, int with_density, vndf_real_block *real,
                     vndf_left *left)
{
    vndf_sample_block block = {.alpha_x = at->ax, .alpha_y = at->ay, .wi_x = at->x, .wi_y = at->y, .wi_z = at->z};
    const float *const normal[3] = {real->x, real->y, real->z};
    block.u1 = u1;
    block.u2 = u2;
    block.view = NULL;
    block.count = count;
    block.x = real->x;
    block.y = real->y;
    block.z = real->z;
    block.density = real->density;
    if (wide) {
        vndf_sample_block_avx512(d, &block);
        vndf_axes_real_avx512(d, in, at, count, real);
    } else {
        vndf_sample_block_avx2(d, &block);
        vndf_axes_real_avx2(d, in, at, count, real);
    }
    for (uint32_t k = 0; k < block.left_count; k++)
        leave(left, block.left[k] % VNDF_DELICATE);
    for (uint32_t k = 0; k < real->lost_count; k++)
        leave(left, real->lost[k]);
    if (!with_density || real->slow_count == 0)
        return;
    vndf_some slow;
    slow.count = real->slow_count;
    memcpy(slow.index, real->slow, slow.count * sizeof *slow.index);
    vndf_block_answer(wide, d, VNDF_ASK_PDF, in, at, normal, count, &slow, real->density, left);
}

#endif
