#include "sampler/affine/blocks.h"

#include <string.h>

#include "math/vector.h"
#include "sampler/law.h"
#include "sampler/surface.h"

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

/* ---- surfaces ---- */

void vndf_block_axes(int wide, int with_matrix, const vndf_map_inputs *in, uint32_t count, vndf_axes_block *to)
{
    if (wide && with_matrix)
        vndf_axes_avx512(in, count, to);
    else if (wide)
        vndf_axes_turn_avx512(in, count, to);
    else if (with_matrix)
        vndf_axes_avx2(in, count, to);
    else
        vndf_axes_turn_avx2(in, count, to);
}

void vndf_block_areas(const vndf_surfaces *of, uint32_t count, vndf_areas_block *to)
{
    if (of->wide)
        vndf_axes_areas_avx512(of->distribution, of->in, of->axes, count, to);
    else
        vndf_axes_areas_avx2(of->distribution, of->in, of->axes, count, to);
}

/* ---- some elements ---- */

/* The list, filled up to whole groups with its first element. Returns how many that are. */
static uint32_t whole_groups(const vndf_some *some, uint32_t *index)
{
    uint32_t end = (some->count + 15) / 16 * 16;
    memcpy(index, some->index, some->count * sizeof *index);
    for (uint32_t k = some->count; k < end; k++)
        index[k] = some->index[0];
    return end;
}

void vndf_block_pick(const float *from, const vndf_some *some, float *to)
{
    uint32_t index[VNDF_AXES_BLOCK], end = whole_groups(some, index);
    for (uint32_t k = 0; k < end; k++)
        to[k] = from[index[k]];
}

static void pick_axes(const vndf_axes_block *from, const uint32_t *index, uint32_t end, vndf_axes_block *to)
{
    for (uint32_t k = 0; k < end; k++) {
        uint32_t i = index[k];
        to->ax[k] = from->ax[i];
        to->ay[k] = from->ay[i];
        to->x[k] = from->x[i];
        to->y[k] = from->y[i];
        to->z[k] = from->z[i];
        to->cosine[k] = from->cosine[i];
        to->sine[k] = from->sine[i];
        to->mean_x[k] = from->mean_x[i];
        to->mean_y[k] = from->mean_y[i];
        to->factor[k] = from->factor[i];
    }
}

vndf_surfaces vndf_block_gather(const vndf_surfaces *of, const vndf_some *some, vndf_gathered *own)
{
    vndf_surfaces to = *of;
    uint32_t index[VNDF_AXES_BLOCK], end;
    if (of->is_one)
        return to;
    end = whole_groups(some, index);
    pick_axes(of->axes, index, end, &own->axes);
    for (int n = 0; n < 3; n++) {
        const float *wi = of->in->of[VNDF_MAP_WI_X + n];
        own->in.of[VNDF_MAP_WI_X + n] = own->wi[n];
        for (uint32_t k = 0; k < end; k++)
            own->wi[n][k] = wi[index[k]];
    }
    to.axes = &own->axes;
    to.in = &own->in;
    return to;
}

static void leave(vndf_left *left, uint32_t index)
{
    left->index[left->count++] = index;
}

void vndf_left_mark(const vndf_left *left, unsigned char *is_left)
{
    for (uint32_t n = 0; n < left->count; n++)
        is_left[left->index[n]] = 1;
}

/* ---- answers ---- */

static void see(const vndf_surfaces *of, uint32_t count, const float *const normal[3], vndf_seen_block *to)
{
    if (of->wide)
        vndf_axes_seen_avx512(of->in, of->axes, count, normal, to);
    else
        vndf_axes_seen_avx2(of->in, of->axes, count, normal, to);
}

void vndf_block_answer(const vndf_surfaces *of, vndf_question question, const float *const normal[3],
                       uint32_t count, float *value, vndf_left *left)
{
    const vndf_axes_block *at = of->axes;
    vndf_seen_block seen;
    vndf_eval_block block;
    block.in = (vndf_eval_inputs){{at->ax, at->ay, at->x, at->y, at->z}, {seen.x, seen.y, seen.z}, seen.facing};
    block.count = count;
    block.exact = NULL;
    if (normal)
        see(of, count, normal, &seen);
    if (of->wide)
        vndf_eval_block_avx512(of->distribution, question, &block);
    else
        vndf_eval_block_avx2(of->distribution, question, &block);
    memcpy(value, block.value, count * sizeof(float));
    for (uint32_t k = 0; k < block.left_count; k++)
        leave(left, block.left[k]);
}

void vndf_block_answer_some(const vndf_surfaces *of, vndf_question question, const float *const normal[3],
                            const vndf_some *some, float *value, vndf_left *left)
{
    vndf_gathered own;
    float picked[3][VNDF_AXES_BLOCK];
    const float *const picked_normal[3] = {picked[0], picked[1], picked[2]};
    if (some->count == 0)
        return;
    const vndf_surfaces own_surfaces = vndf_block_gather(of, some, &own);
    for (int n = 0; n < 3; n++)
        vndf_block_pick(normal[n], some, picked[n]);
    vndf_block_answer(&own_surfaces, question, picked_normal, some->count, value, left);
}

/* ---- draws ---- */

static void draw_plain(const vndf_surfaces *of, vndf_sample_block *block)
{
    if (of->wide)
        vndf_sample_block_avx512(of->distribution, block);
    else
        vndf_sample_block_avx2(of->distribution, block);
}

static int is_straight(const vndf_axes_block *at, uint32_t i)
{
    return at->sine[i] == 0.0 && at->mean_x[i] == 0.0 && at->mean_y[i] == 0.0;
}

/* Below the horizon of the axes: what draw_one does, in lanes. */
static void draw_below(const vndf_surfaces *of, vndf_sample_block *block)
{
    const vndf_axes_block *at = of->axes;
    if (!vndf_is_table(of->distribution) || block->view || block->left_count == 0)
        return;
    if (of->wide)
        vndf_sample_below_avx512(of->distribution, block);
    else
        vndf_sample_below_avx2(of->distribution, block);
    for (uint32_t i = 0; i < block->count; i++)
        if (block->wi_z[i] < 0.0f && !is_straight(at, i))
            block->density[i] = 0.0f;
}

/* What vndf_affine_sample does along the axes. A density that has to be evaluated is 0 here, which is not trusted;
 * what is invalid is left. */
static void draw_one(const vndf_surfaces *of, vndf_sample_block *block, uint32_t i, vndf_left *left)
{
    const vndf_axes_block *at = of->axes;
    const vndf_surface plain = {of->distribution, at->ax[i], at->ay[i]};
    float u1 = vndf_clamp_unit(block->u1[i]), u2 = vndf_clamp_unit(block->u2[i]), density = 0.0f;
    int fast = 1;
    vndf_view view;
    vndf_view_set(&view, &plain, vndf_vec3_of(at->x[i], at->y[i], at->z[i]));
    if (!view.distribution) {
        leave(left, i);
        return;
    }
    vndf_vec3 n = is_straight(at, i) ? vndf_law_sample(&view, u1, u2, &density)
                                     : vndf_law_sample_telling(&view, u1, u2, &density, &fast);
    block->x[i] = n.x;
    block->y[i] = n.y;
    block->z[i] = n.z;
    block->density[i] = fast ? density : 0.0f;
}

/* Samples that lanes cannot draw. */
static void draw_left(const vndf_surfaces *of, vndf_sample_block *block, vndf_left *left)
{
    for (uint32_t k = 0; k < block->left_count; k++)
        draw_one(of, block, block->left[k] % VNDF_DELICATE, left);
}

static void make_real(const vndf_surfaces *of, uint32_t count, vndf_real_block *real)
{
    if (of->wide)
        vndf_axes_real_avx512(of->distribution, of->in, of->axes, count, real);
    else
        vndf_axes_real_avx2(of->distribution, of->in, of->axes, count, real);
}

/* Densities that did not survive. */
static void evaluate(const vndf_surfaces *of, vndf_real_block *real, vndf_left *left)
{
    const float *const normal[3] = {real->x, real->y, real->z};
    const vndf_some *slow = &real->slow;
    float value[VNDF_AXES_BLOCK];
    vndf_left from;
    from.count = 0;
    vndf_block_answer_some(of, VNDF_ASK_PDF, normal, slow, value, &from);
    for (uint32_t k = 0; k < slow->count; k++)
        real->density[slow->index[k]] = value[k];
    for (uint32_t k = 0; k < from.count; k++)
        leave(left, slow->index[from.index[k]]);
}

void vndf_block_draw(const vndf_surfaces *of, const float *u1, const float *u2, uint32_t count, int with_density,
                     vndf_real_block *real, vndf_left *left)
{
    const vndf_axes_block *at = of->axes;
    vndf_sample_block block = {.alpha_x = at->ax, .alpha_y = at->ay, .wi_x = at->x, .wi_y = at->y, .wi_z = at->z};
    block.u1 = u1;
    block.u2 = u2;
    block.view = of->view;
    block.count = count;
    block.x = real->x;
    block.y = real->y;
    block.z = real->z;
    block.density = real->density;
    draw_plain(of, &block);
    draw_below(of, &block);
    draw_left(of, &block, left);
    make_real(of, count, real);
    for (uint32_t k = 0; k < real->lost.count; k++)
        leave(left, real->lost.index[k]);
    if (with_density)
        evaluate(of, real, left);
}

#endif
