/* The facets between the directions of a block (terms/facet.h), their masking, D and densities, for lanes_look.c and
 * lanes_exact.h. D and densities are answered as batches of vndf.h are, not rounded (sampler/batch/lanes_eval.h). */
#ifndef VNDF_BSDF_BATCH_LANES_FACETS_H
#define VNDF_BSDF_BATCH_LANES_FACETS_H

#include "bsdf/batch/lanes_hits.h"
#include "bsdf/terms/facet.h"
#include "sampler/batch/density_of.h"
#include "sampler/batch/lanes_eval.h"

_Static_assert((int)VNDF_EVAL_BLOCK == (int)VNDF_HIT_BLOCK, "a block is answered at once");

#if VNDF_LANES == 16
#  define VNDF_ANSWER vndf_eval_block_avx512
#else
#  define VNDF_ANSWER vndf_eval_block_avx2
#endif

/* `of` has both directions as lanes_look.c does: z of wo on the side of wi, and turned up. */
typedef struct vndf_facets {
    const vndf_material *material;
    uint32_t count;
    const float *alpha_x, *alpha_y, *wo_x, *wo_y;
    float side[VNDF_HIT_BLOCK], x[VNDF_HIT_BLOCK], y[VNDF_HIT_BLOCK], cos_i[VNDF_HIT_BLOCK]; /* of wi */
    float z[VNDF_HIT_BLOCK], up[VNDF_HIT_BLOCK], area_i[VNDF_HIT_BLOCK], area_o[VNDF_HIT_BLOCK];
    double wm[3][VNDF_HIT_BLOCK], facing[VNDF_HIT_BLOCK], jacobian[VNDF_HIT_BLOCK], cos_o[VNDF_HIT_BLOCK];
    double masking[VNDF_HIT_BLOCK], ndf[VNDF_HIT_BLOCK], density[VNDF_HIT_BLOCK];
    vndf_sample_bits good, through, left; /* has a facet; it transmits; lanes do not know it */
} vndf_facets;

enum { VNDF_ALL_DOUBLES = (1 << VNDF_DOUBLES) - 1 };

/* Masking over both cosines. Clears *ready where lanes do not know it. */
VNDF_INLINE doubles vndf_facets_masking(const vndf_facets *w, uint32_t i, const vndf_facet *f, uint32_t through,
                                        doubles_m *ready)
{
    doubles masking = vndf_height_correlated(doubles_load(w->cos_i + i), doubles_load(w->up + i),
                                             doubles_load(w->area_i + i), doubles_load(w->area_o + i));
    *ready = doubles_of_mask_bits(through);
    if (!through)
        return masking;
    const vndf_slants_of of = {{w->x + i, w->y + i, w->cos_i + i},
                               {w->wo_x + i, w->wo_y + i, w->up + i},
                               w->area_i + i,
                               w->area_o + i,
                               w->alpha_x + i,
                               w->alpha_y + i};
    doubles_m passes = *ready;
    doubles other = vndf_transmission_masking(w->material->is.distribution, &of, f->cos_i, f->cos_o, ready);
    return doubles_pick(passes, other, masking);
}

VNDF_INLINE vndf_facet vndf_picked_facet(doubles_m m, const vndf_facet *yes, const vndf_facet *no)
{
    vndf_facet f = {vndf_picked_normal(m, yes->wm, no->wm),       doubles_pick(m, yes->cos_i, no->cos_i),
                    doubles_pick(m, yes->cos_o, no->cos_o),       doubles_pick(m, yes->facing_i, no->facing_i),
                    doubles_pick(m, yes->facing_o, no->facing_o), doubles_pick(m, yes->jacobian, no->jacobian)};
    return f;
}

VNDF_INLINE vndf_facet vndf_facets_at(const vndf_facets *w, uint32_t i, uint32_t through)
{
    vndf_normal wi = {doubles_load(w->x + i), doubles_load(w->y + i), doubles_load(w->cos_i + i)};
    vndf_normal wo = {doubles_load(w->wo_x + i), doubles_load(w->wo_y + i), doubles_load(w->z + i)};
    if (!through)
        return vndf_facet_reflecting(wi, wo);
    vndf_facet bent = vndf_facet_refracting(wi, wo, vndf_eta_at(w->material, w->side + i));
    if (through == VNDF_ALL_DOUBLES)
        return bent;
    vndf_facet back = vndf_facet_reflecting(wi, wo);
    return vndf_picked_facet(doubles_of_mask_bits(through), &bent, &back);
}

/* From directions, areas, and `good` where there may be a facet; with masking if it is asked for. */
VNDF_INLINE void vndf_find_facets(vndf_facets *w, int masked)
{
    const doubles nothing = doubles_set(0.0);
    int both = w->material->routines->kind == VNDF_BLOCK_BOTH;
    for (uint32_t i = 0; i < w->count; i += VNDF_DOUBLES) {
        uint32_t through = both ? vndf_bits_at(&w->through, i) & VNDF_ALL_DOUBLES : 0;
        uint32_t good = vndf_bits_at(&w->good, i) & VNDF_ALL_DOUBLES;
        vndf_facet f = vndf_facets_at(w, i, through);
        doubles_m ready;
        good &=
            doubles_mask_bits(doubles_both(doubles_less(nothing, f.facing_i), doubles_less(nothing, f.facing_o)));
        if (masked) {
            doubles_store_long(w->masking + i, vndf_facets_masking(w, i, &f, through & good, &ready));
            vndf_set_bits(&w->left, i, through & good & ~doubles_mask_bits(ready));
        }
        doubles_store_long(w->wm[0] + i, f.wm.x);
        doubles_store_long(w->wm[1] + i, f.wm.y);
        doubles_store_long(w->wm[2] + i, f.wm.z);
        doubles_store_long(w->facing + i, f.facing_i);
        doubles_store_long(w->jacobian + i, f.jacobian);
        doubles_store_long(w->cos_o + i, f.cos_o);
        w->good.of[i / 32] &= ~((VNDF_ALL_DOUBLES & ~good) << i % 32);
    }
}

/* D, or the density of each facet. That of a closed form takes wi.wm from the directions as they are given. */
VNDF_INLINE void vndf_answer_facets(vndf_facets *w, vndf_question question, double *exact)
{
    const vndf_distribution *d = w->material->is.distribution;
    vndf_eval_block block;
    block.in = (vndf_eval_inputs){{w->alpha_x, w->alpha_y, w->x, w->y, w->cos_i},
                                  {w->wm[0], w->wm[1], w->wm[2]},
                                  vndf_law_is_exact(d) ? NULL : w->facing};
    block.count = w->count;
    block.exact = exact;
    VNDF_ANSWER(d, question, &block);
    for (uint32_t n = 0; n < block.left_count; n++)
        vndf_set_bits(&w->left, block.left[n], vndf_bits_at(&w->good, block.left[n]) & 1);
}

VNDF_INLINE void vndf_clear_facets(vndf_facets *w, const vndf_material *material, uint32_t count)
{
    w->material = material;
    w->count = count;
    vndf_clear_bits(&w->good);
    vndf_clear_bits(&w->through);
    vndf_clear_bits(&w->left);
}

#endif
