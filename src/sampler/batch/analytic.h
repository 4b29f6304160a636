/* Draws blocks of the closed forms in lanes, for lanes_draw.c. */
#ifndef VNDF_SAMPLER_BATCH_ANALYTIC_H
#define VNDF_SAMPLER_BATCH_ANALYTIC_H

#include "sampler/batch/sort.h"
#include "sampler/analytic/beckmann_draw.h"
#include "sampler/analytic/ggx_draw.h"

/* ---- GGX ---- */

VNDF_INLINE vndf_ggx_incidence ggx_incidence_at(const vndf_sample_block *b, uint32_t i)
{
    return vndf_ggx_incidence_from(lanes_load(b->alpha_x + i), lanes_load(b->alpha_y + i), lanes_load(b->wi_x + i),
                                   lanes_load(b->wi_y + i), lanes_load(b->wi_z + i));
}

/* Groups that take each step in turn: fewer would wait for roots and divisions, more push the batch out of the
 * cache. */
enum { GGX_GROUPS = 8 };

typedef struct ggx_work {
    vndf_ggx_incidence at[GGX_GROUPS];
    vndf_ggx_cap cap[GGX_GROUPS];
    lanes_m trusted[GGX_GROUPS];
} ggx_work;

/* `one` is the incidence that all samples share, or NULL. */
VNDF_INLINE void ggx_leave(vndf_sample_block *b, const ggx_work *w, const vndf_ggx_incidence *one, uint32_t first,
                           uint32_t groups)
{
    for (uint32_t g = 0; g < groups; g++) {
        lanes_m usable = one ? one->trusted : w->at[g].trusted, trusted = w->trusted[g];
        if (lanes_any(lanes_without(lanes_all(), trusted)))
            vndf_block_leave(b, lanes_without(lanes_all(), usable), lanes_without(usable, trusted),
                             first + g * VNDF_LANES);
    }
}

/* The second step of group g. */
VNDF_INLINE vndf_ggx_stretched ggx_stretch(ggx_work *w, const vndf_ggx_incidence *one, uint32_t g)
{
    return vndf_ggx_stretched_at(one ? one : &w->at[g], &w->cap[g], &w->trusted[g]);
}

/* The last step of the group from sample i on. */
VNDF_INLINE void ggx_finish(vndf_sample_block *b, const vndf_ggx_stretched *m, uint32_t i)
{
    vndf_drawn n = vndf_ggx_drawn(m);
    vndf_block_store(b, i, &n);
}

/* Draws groups from sample `first` on. The last step of one stands beside the second of the next. */
VNDF_INLINE void draw_ggx_groups(vndf_sample_block *b, ggx_work *w, const vndf_ggx_incidence *one, uint32_t first,
                                 uint32_t groups)
{
    const float *u1 = b->u1 + first, *u2 = b->u2 + first;
    for (uint32_t g = 0; g < groups && !one; g++)
        w->at[g] = ggx_incidence_at(b, first + g * VNDF_LANES);
    for (uint32_t g = 0; g < groups; g++)
        w->cap[g] = vndf_ggx_cap_at(one ? one : &w->at[g], vndf_block_u(u1 + g * VNDF_LANES),
                                    vndf_block_u(u2 + g * VNDF_LANES));
    vndf_ggx_stretched m = ggx_stretch(w, one, 0);
    lanes_m trusted = w->trusted[0];
    for (uint32_t g = 1; g < groups; g++) {
        vndf_ggx_stretched next = ggx_stretch(w, one, g);
        trusted = lanes_both(trusted, w->trusted[g]);
        ggx_finish(b, &m, first + (g - 1) * VNDF_LANES);
        m = next;
    }
    ggx_finish(b, &m, first + (groups - 1) * VNDF_LANES);
    if (lanes_any(lanes_without(lanes_all(), trusted)))
        ggx_leave(b, w, one, first, groups);
}

VNDF_INLINE void draw_ggx_from(vndf_sample_block *b, const vndf_ggx_incidence *one)
{
    ggx_work w;
    uint32_t groups = (b->count + VNDF_LANES - 1) / VNDF_LANES;
    for (uint32_t g = 0; g < groups; g += GGX_GROUPS)
        draw_ggx_groups(b, &w, one, g * VNDF_LANES, groups - g < GGX_GROUPS ? groups - g : GGX_GROUPS);
}

static inline void vndf_draw_ggx(vndf_sample_block *b)
{
    if (b->view) {
        vndf_ggx_incidence shared = vndf_ggx_incidence_of(b->view);
        draw_ggx_from(b, &shared);
    } else {
        draw_ggx_from(b, NULL);
    }
}

/* ---- Beckmann ---- */

VNDF_INLINE vndf_beckmann_incidence beckmann_incidence_at(const vndf_sample_block *b, uint32_t i)
{
    return vndf_beckmann_incidence_from(lanes_load(b->alpha_x + i), lanes_load(b->alpha_y + i),
                                        lanes_load(b->wi_x + i), lanes_load(b->wi_y + i), lanes_load(b->wi_z + i));
}

/* Each step goes over all groups, as for tables. */
typedef struct beckmann_work {
    vndf_beckmann_incidence at[VNDF_BLOCK_GROUPS];
    vndf_beckmann_place first[VNDF_BLOCK_GROUPS];
    lanes_f u1[VNDF_BLOCK_GROUPS], u2[VNDF_BLOCK_GROUPS], second[VNDF_BLOCK_GROUPS];
} beckmann_work;

/* `one` is the incidence that all samples share, or NULL. */
VNDF_INLINE void draw_slopes(const vndf_sample_block *b, beckmann_work *w, const vndf_beckmann_incidence *one,
                             uint32_t groups)
{
    for (uint32_t g = 0; g < groups; g++) {
        w->u1[g] = vndf_block_u(b->u1 + g * VNDF_LANES);
        w->u2[g] = vndf_block_u(b->u2 + g * VNDF_LANES);
        w->first[g] = vndf_beckmann_first(one ? one : &w->at[g], w->u1[g]);
        w->second[g] = vndf_beckmann_second(w->u2[g]);
    }
    for (uint32_t g = 0; g < groups; g++)
        w->first[g] = vndf_beckmann_step(one ? one : &w->at[g], w->first[g], w->u1[g]);
}

static inline void vndf_draw_beckmann(vndf_sample_block *b)
{
    beckmann_work w;
    uint32_t groups = (b->count + VNDF_LANES - 1) / VNDF_LANES;
    const vndf_beckmann_incidence *one = b->view ? w.at : NULL;
    if (b->view)
        w.at[0] = vndf_beckmann_incidence_of(b->view);
    for (uint32_t g = 0; g < groups && !b->view; g++)
        w.at[g] = beckmann_incidence_at(b, g * VNDF_LANES);
    draw_slopes(b, &w, one, groups);
    for (uint32_t g = 0; g < groups; g++) {
        const vndf_beckmann_incidence *at = one ? one : &w.at[g];
        lanes_m trusted;
        vndf_drawn n =
            vndf_beckmann_normal(at, &w.first[g], w.second[g], vndf_beckmann_middle(w.u1[g], w.u2[g]), &trusted);
        vndf_block_store(b, g * VNDF_LANES, &n);
        if (lanes_any(lanes_without(lanes_all(), trusted)))
            vndf_block_leave(b, lanes_without(lanes_all(), at->trusted), lanes_without(at->trusted, trusted),
                             g * VNDF_LANES);
    }
}

#endif
