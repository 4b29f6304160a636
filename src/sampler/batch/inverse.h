/* Inverts blocks in lanes, for lanes_invert.c. Normals under a table take two ways, in front of wi and in the wedge:
 * they are sorted by way first, and each way inverts its own normals. */
#ifndef VNDF_SAMPLER_BATCH_INVERSE_H
#define VNDF_SAMPLER_BATCH_INVERSE_H

#include "sampler/analytic/inverse.h"
#include "sampler/batch/lanes_invert.h"
#include "sampler/surface.h"
#include "sampler/tabulated/inverse.h"
#include "sampler/tabulated/stretched_view.h"
#include "simd/list.h"

enum { VNDF_EVERY_DOUBLE = (1 << VNDF_DOUBLES) - 1 };

/* ---- closed forms ---- */

VNDF_INLINE vndf_query inverse_query_at(const vndf_invert_block *b, uint32_t i)
{
    vndf_query g = {{doubles_load(b->of[VNDF_EVAL_ALPHA_X] + i), doubles_load(b->of[VNDF_EVAL_ALPHA_Y] + i),
                     doubles_load(b->of[VNDF_EVAL_WI_X] + i), doubles_load(b->of[VNDF_EVAL_WI_Y] + i),
                     doubles_load(b->of[VNDF_EVAL_WI_Z] + i)},
                    doubles_load(b->of[VNDF_EVAL_X] + i),
                    doubles_load(b->of[VNDF_EVAL_Y] + i),
                    doubles_load(b->of[VNDF_EVAL_Z] + i)};
    return g;
}

/* vndf_invert's own conditions. */
VNDF_INLINE doubles_m inverse_query_is_valid(const vndf_query *g)
{
    const doubles nothing = doubles_set(0.0);
    doubles square = g->x * g->x + g->y * g->y + g->z * g->z;
    doubles_m usable = doubles_both(doubles_less(nothing, square), doubles_less(square, doubles_set(HUGE_VAL)));
    return doubles_both(doubles_both(vndf_direction_is_valid(&g->wi), usable), doubles_at_most(nothing, g->z));
}

/* Groups that take each step in turn, so that roots and divisions of one do not wait for those of another. */
enum { INVERSE_GROUPS = 8 };

/* `inverse` is vndf_ggx_inverse or vndf_beckmann_inverse. */
VNDF_INLINE void inverse_closed_groups(vndf_invert_block *b, uint32_t first, uint32_t groups,
                                       vndf_uniforms (*inverse)(const vndf_unit_query *))
{
    vndf_unit_query q[INVERSE_GROUPS];
    for (uint32_t g = 0; g < groups; g++) {
        uint32_t i = first + g * VNDF_DOUBLES;
        vndf_query query = inverse_query_at(b, i);
        uint32_t valid = doubles_mask_bits(inverse_query_is_valid(&query));
        q[g] = vndf_unit_query_of(&query);
        b->left_count =
            vndf_list_bits(b->left, b->left_count, ~valid & VNDF_EVERY_DOUBLE, i, VNDF_DOUBLES, b->count);
    }
    for (uint32_t g = 0; g < groups; g++) {
        vndf_uniforms u = inverse(&q[g]);
        doubles_store_f(b->u1 + first + g * VNDF_DOUBLES, u.u1);
        doubles_store_f(b->u2 + first + g * VNDF_DOUBLES, u.u2);
    }
}

VNDF_INLINE void inverse_closed(vndf_invert_block *b, vndf_uniforms (*inverse)(const vndf_unit_query *))
{
    uint32_t groups = (b->count + VNDF_DOUBLES - 1) / VNDF_DOUBLES;
    for (uint32_t g = 0; g < groups; g += INVERSE_GROUPS)
        inverse_closed_groups(b, g * VNDF_DOUBLES, groups - g < INVERSE_GROUPS ? groups - g : INVERSE_GROUPS,
                              inverse);
}

static inline void vndf_invert_ggx(vndf_invert_block *b)
{
    inverse_closed(b, vndf_ggx_inverse);
}

static inline void vndf_invert_beckmann(vndf_invert_block *b)
{
    inverse_closed(b, vndf_beckmann_inverse);
}

/* ---- tables ---- */

enum { INVERSE_IN_FRONT, INVERSE_IN_WEDGE, INVERSE_WAYS };

/* Room for the last group of a way, too. */
enum { INVERSE_ROOM = VNDF_EVAL_BLOCK + VNDF_DOUBLES };

/* Views and turned normals. */
typedef struct inverse_turned {
    float s[INVERSE_ROOM], c[INVERSE_ROOM], front[INVERSE_ROOM], wedge[INVERSE_ROOM];
    double x[INVERSE_ROOM], y[INVERSE_ROOM], across[INVERSE_ROOM], z[INVERSE_ROOM];
} inverse_turned;

/* The indices of the normals that take each way. */
typedef struct inverse_sorted {
    uint32_t index[INVERSE_WAYS][VNDF_EVAL_BLOCK], count[INVERSE_WAYS];
} inverse_sorted;

/* What a view holds of its frame, for a group of floats. */
typedef struct inverse_frames {
    float ax[VNDF_LANES], ay[VNDF_LANES], cosine[VNDF_LANES], sine[VNDF_LANES];
} inverse_frames;

/* The views of the group from i on, as vndf_view_from makes them. Returns which of them draw in float. */
VNDF_INLINE uint32_t inverse_view(const vndf_distribution *d, const vndf_invert_block *b, uint32_t i,
                                  inverse_frames *frames, inverse_turned *to)
{
    const float scale = vndf_unit_scale_float(d);
    lanes_f ax = lanes_load(b->of[VNDF_EVAL_ALPHA_X] + i) * scale,
            ay = lanes_load(b->of[VNDF_EVAL_ALPHA_Y] + i) * scale;
    lanes_f x = lanes_load(b->of[VNDF_EVAL_WI_X] + i), y = lanes_load(b->of[VNDF_EVAL_WI_Y] + i);
    lanes_m trusted = lanes_all();
    vndf_stretched_view w =
        vndf_stretched_view_at(d, ax * x, ay * y, lanes_load(b->of[VNDF_EVAL_WI_Z] + i), &trusted);
    lanes_store(frames->ax, ax);
    lanes_store(frames->ay, ay);
    lanes_store(frames->cosine, w.cos_phi);
    lanes_store(frames->sine, w.sin_phi);
    lanes_store(to->s + i, w.s);
    lanes_store(to->c + i, w.c);
    lanes_store(to->front + i, w.front);
    lanes_store(to->wedge + i, w.wedge);
    return lanes_mask_bits(lanes_both(trusted, vndf_trusts_scale(ax, ay, w.c)));
}

/* Turns the normals from i on, sorts those whose bit is set, and leaves the others. */
VNDF_INLINE void inverse_turn(vndf_invert_block *b, uint32_t i, const inverse_frames *frames, uint32_t half,
                              uint32_t usable, inverse_turned *to, inverse_sorted *sorted)
{
    vndf_inverse_frame f = {doubles_load(frames->ax + half), doubles_load(frames->ay + half),
                            doubles_load(frames->cosine + half), doubles_load(frames->sine + half)};
    vndf_turned n = vndf_turned_of(&f, doubles_load(b->of[VNDF_EVAL_X] + i), doubles_load(b->of[VNDF_EVAL_Y] + i),
                                   doubles_load(b->of[VNDF_EVAL_Z] + i));
    uint32_t front = doubles_mask_bits(doubles_at_most(doubles_set(0.0), n.x));
    usable &= doubles_mask_bits(vndf_turned_is_valid(&n));
    doubles_store_long(to->x + i, n.x);
    doubles_store_long(to->y + i, n.y);
    doubles_store_long(to->across + i, n.across);
    doubles_store_long(to->z + i, n.z);
    uint32_t *count = sorted->count;
    count[INVERSE_IN_FRONT] = vndf_list_bits(sorted->index[INVERSE_IN_FRONT], count[INVERSE_IN_FRONT],
                                             usable & front, i, VNDF_DOUBLES, b->count);
    count[INVERSE_IN_WEDGE] = vndf_list_bits(sorted->index[INVERSE_IN_WEDGE], count[INVERSE_IN_WEDGE],
                                             usable & ~front, i, VNDF_DOUBLES, b->count);
    b->left_count = vndf_list_bits(b->left, b->left_count, ~usable & VNDF_EVERY_DOUBLE, i, VNDF_DOUBLES, b->count);
}

static inline void inverse_sort(const vndf_distribution *d, vndf_invert_block *b, inverse_turned *to,
                                inverse_sorted *sorted)
{
    sorted->count[INVERSE_IN_FRONT] = sorted->count[INVERSE_IN_WEDGE] = 0;
    for (uint32_t first = 0; first < b->count; first += VNDF_LANES) {
        inverse_frames frames;
        uint32_t usable = inverse_view(d, b, first, &frames, to);
        for (uint32_t half = 0; half < VNDF_LANES && first + half < b->count; half += VNDF_DOUBLES)
            inverse_turn(b, first + half, &frames, half, usable >> half & VNDF_EVERY_DOUBLE, to, sorted);
    }
}

/* Copies what one way takes, one after the other: gathers cost more. Spare lanes repeat the first normal. */
VNDF_INLINE void inverse_gather(const inverse_turned *from, const uint32_t *index, uint32_t count,
                                inverse_turned *to)
{
    for (uint32_t i = 0; i < count + VNDF_DOUBLES; i++) {
        uint32_t at = index[i < count ? i : 0];
        to->s[i] = from->s[at];
        to->c[i] = from->c[at];
        to->front[i] = from->front[at];
        to->wedge[i] = from->wedge[at];
        to->x[i] = from->x[at];
        to->y[i] = from->y[at];
        to->across[i] = from->across[at];
        to->z[i] = from->z[at];
    }
}

/* Puts a group's numbers where its normals were, and leaves those that are not sure. */
VNDF_INLINE void inverse_scatter(vndf_invert_block *b, const uint32_t *index, uint32_t count,
                                 const vndf_inverse *inverse)
{
    float u1[VNDF_DOUBLES], u2[VNDF_DOUBLES];
    uint32_t sure = doubles_mask_bits(inverse->sure);
    doubles_store_f(u1, doubles_narrow(inverse->u1));
    doubles_store_f(u2, doubles_narrow(inverse->u2));
    for (uint32_t i = 0; i < VNDF_DOUBLES && i < count; i++) {
        b->u1[index[i]] = u1[i];
        b->u2[index[i]] = u2[i];
        b->left[b->left_count] = index[i];
        b->left_count += !(sure >> i & 1);
    }
}

VNDF_INLINE void inverse_way(const vndf_distribution *d, vndf_invert_block *b, const inverse_turned *from,
                             const inverse_sorted *sorted, int way)
{
    const uint32_t *index = sorted->index[way], count = sorted->count[way];
    inverse_turned own;
    if (count == 0)
        return;
    inverse_gather(from, index, count, &own);
    for (uint32_t i = 0; i < count; i += VNDF_DOUBLES) {
        vndf_inverse_view w = {doubles_load(own.s + i), doubles_load(own.c + i), doubles_load(own.front + i),
                               doubles_load(own.wedge + i)};
        vndf_turned n = {doubles_load_long(own.x + i), doubles_load_long(own.y + i),
                         doubles_load_long(own.across + i), doubles_load_long(own.z + i)};
        vndf_inverse inverse =
            way == INVERSE_IN_FRONT ? vndf_inverse_in_front(d, &w, &n) : vndf_inverse_in_wedge(d, &w, &n);
        inverse_scatter(b, index + i, count - i, &inverse);
    }
}

static inline void vndf_invert_table(const vndf_distribution *d, vndf_invert_block *b)
{
    inverse_turned turned;
    inverse_sorted sorted;
    inverse_sort(d, b, &turned, &sorted);
    inverse_way(d, b, &turned, &sorted, INVERSE_IN_FRONT);
    inverse_way(d, b, &turned, &sorted, INVERSE_IN_WEDGE);
}

#endif
