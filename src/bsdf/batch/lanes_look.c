/* See lanes_look.h. Lanes past the end of a block work on numbers that are in memory, and nobody reads what they
 * make of them. */
#include "bsdf/batch/lanes_look.h"

#if VNDF_HAS_LANES && VNDF_LANES > 1

#  include "bsdf/batch/lanes_hits.h"
#  include "bsdf/terms/facet.h"
#  include "sampler/batch/density_of.h"
#  include "sampler/batch/lanes_eval.h"

_Static_assert((int)VNDF_EVAL_BLOCK == (int)VNDF_HIT_BLOCK, "a block is answered at once");

/* ---- bare reflection of GGX ---- */

/* lobes/fast_ggx.c. */
static void look_at_ggx(vndf_look_block *b)
{
    const lanes_f nothing = lanes_set(0.0f),
                  four = lanes_set(4.0f * VNDF_TRUST_GGX_FACING * VNDF_TRUST_GGX_FACING);
    vndf_hits shared;
    if (b->hit)
        shared = vndf_shared_hits(b->hit);
    for (uint32_t i = 0; i < b->count; i += VNDF_LANES) {
        vndf_hits h = b->hit ? shared : vndf_hits_at(b->material, b->in, i);
        vndf_vec3_lanes wi = h.at.wi,
                        wo = {lanes_load(b->in[VNDF_LOOK_WO_X] + i), lanes_load(b->in[VNDF_LOOK_WO_Y] + i),
                              lanes_load(b->in[VNDF_LOOK_WO_Z] + i)};
        lanes_f x = wi.x + wo.x, y = wi.y + wo.y, z = wi.z + wo.z, square = x * x + y * y + z * z;
        lanes_m unit = vndf_is_near_unit_square(wo.x * wo.x + wo.y * wo.y + wo.z * wo.z), ready;
        lanes_m good = lanes_both(lanes_both(h.known, h.at.trusted), lanes_both(unit, lanes_less(four, square)));
        lanes_m up = lanes_less(nothing, wo.z);
        lanes_f density = vndf_ggx_density_of(&h.at, wo);
        if (b->value[0]) {
            lanes_f area = vndf_ggx_area_above(h.at.ax, h.at.ay, wo.x, wo.y, wo.z, &ready);
            lanes_f value = vndf_finite_lanes(density * (h.at.area / vndf_unmasked(&h.at, wo, area)));
            for (int k = 0; k < b->material->is.wavelengths; k++)
                lanes_store(b->value[k] + i, lanes_keep(lanes_both(good, up), value));
        }
        if (b->pdf)
            lanes_store(b->pdf + i, lanes_keep(lanes_both(good, up), vndf_positive_lanes(density)));
        vndf_set_bits(&b->left, i, lanes_mask_bits(lanes_without(lanes_both(h.seen, up), good)));
    }
}

/* ---- facets ---- */

/* The hits of a block, the facets between the directions, and the answers about them. */
typedef struct work {
    float side[VNDF_HIT_BLOCK], x[VNDF_HIT_BLOCK], y[VNDF_HIT_BLOCK], cos_i[VNDF_HIT_BLOCK];
    float area_i[VNDF_HIT_BLOCK], area_o[VNDF_HIT_BLOCK];
    float z[VNDF_HIT_BLOCK], up[VNDF_HIT_BLOCK]; /* of wo: on the side of wi, and turned up */
    double wm[3][VNDF_HIT_BLOCK], facing[VNDF_HIT_BLOCK], jacobian[VNDF_HIT_BLOCK];
    double cosines[VNDF_HIT_BLOCK], masking[VNDF_HIT_BLOCK];
    double ndf[VNDF_HIT_BLOCK], density[VNDF_HIT_BLOCK];
    vndf_sample_bits good, through; /* has a facet that lanes know; it transmits */
} work;

static void find_hits(vndf_look_block *b, work *w)
{
    const lanes_f nothing = lanes_set(0.0f);
    int both = b->material->routines->kind == VNDF_BLOCK_BOTH;
    vndf_hits shared;
    if (b->hit)
        shared = vndf_shared_hits(b->hit);
    for (uint32_t i = 0; i < b->count; i += VNDF_LANES) {
        vndf_hits h = b->hit ? shared : vndf_hits_at(b->material, b->in, i);
        lanes_f x = lanes_load(b->in[VNDF_LOOK_WO_X] + i), y = lanes_load(b->in[VNDF_LOOK_WO_Y] + i);
        lanes_f z = lanes_load(b->in[VNDF_LOOK_WO_Z] + i) * h.side, up = both ? lanes_abs(z) : z;
        lanes_m above = lanes_less(nothing, up), ready = lanes_all();
        lanes_f area = nothing;
        if (b->value[0])
            area = vndf_law_area_above(h.at.distribution, h.at.ax, h.at.ay, x, y, up, &ready);
        lanes_store(w->side + i, h.side);
        lanes_store(w->x + i, h.at.wi.x);
        lanes_store(w->y + i, h.at.wi.y);
        lanes_store(w->cos_i + i, h.at.wi.z);
        lanes_store(w->area_i + i, h.at.area);
        lanes_store(w->area_o + i, area);
        lanes_store(w->z + i, z);
        lanes_store(w->up + i, up);
        lanes_m lit = lanes_both(h.known, above), left = lanes_without(lanes_both(h.seen, above), h.known);
        vndf_set_bits(&w->good, i, lanes_mask_bits(lanes_both(lit, ready)));
        vndf_set_bits(&w->through, i, lanes_mask_bits(lanes_less(z, nothing)));
        vndf_set_bits(&b->left, i, lanes_mask_bits(lanes_either(left, lanes_without(lit, ready))));
    }
}

/* Masking over both cosines. Clears *ready where lanes do not know it. */
VNDF_INLINE doubles masking_at(const vndf_look_block *b, const work *w, uint32_t i, const vndf_facet *f,
                               uint32_t bits, doubles_m *ready)
{
    doubles masking = vndf_height_correlated(doubles_load(w->cos_i + i), doubles_load(w->up + i),
                                             doubles_load(w->area_i + i), doubles_load(w->area_o + i));
    if (!bits)
        return masking;
    const vndf_slants_of of = {{w->x + i, w->y + i, w->cos_i + i},
                               {b->in[VNDF_LOOK_WO_X] + i, b->in[VNDF_LOOK_WO_Y] + i, w->up + i},
                               w->area_i + i,
                               w->area_o + i};
    doubles_m through = doubles_of_mask_bits(bits);
    *ready = through;
    return doubles_pick(
        through, vndf_transmission_masking(b->material->is.distribution, b->in, i, &of, f->cos_i, f->cos_o, ready),
        masking);
}

VNDF_INLINE vndf_facet picked_facet(doubles_m m, const vndf_facet *yes, const vndf_facet *no)
{
    vndf_facet f = {vndf_picked_normal(m, yes->wm, no->wm),       doubles_pick(m, yes->cos_i, no->cos_i),
                    doubles_pick(m, yes->cos_o, no->cos_o),       doubles_pick(m, yes->facing_i, no->facing_i),
                    doubles_pick(m, yes->facing_o, no->facing_o), doubles_pick(m, yes->jacobian, no->jacobian)};
    return f;
}

VNDF_INLINE vndf_facet facet_at(const vndf_look_block *b, const work *w, uint32_t i, uint32_t through)
{
    const uint32_t all = (1u << VNDF_DOUBLES) - 1;
    vndf_normal wi = {doubles_load(w->x + i), doubles_load(w->y + i), doubles_load(w->cos_i + i)};
    vndf_normal wo = {doubles_load(b->in[VNDF_LOOK_WO_X] + i), doubles_load(b->in[VNDF_LOOK_WO_Y] + i),
                      doubles_load(w->z + i)};
    if (!through)
        return vndf_facet_reflecting(wi, wo);
    vndf_facet bent = vndf_facet_refracting(wi, wo, vndf_eta_at(b->material, w->side + i));
    if (through == all)
        return bent;
    vndf_facet back = vndf_facet_reflecting(wi, wo);
    return picked_facet(doubles_of_mask_bits(through), &bent, &back);
}

static void find_facets(vndf_look_block *b, work *w)
{
    const doubles nothing = doubles_set(0.0);
    const uint32_t all = (1u << VNDF_DOUBLES) - 1;
    int both = b->material->routines->kind == VNDF_BLOCK_BOTH;
    for (uint32_t i = 0; i < b->count; i += VNDF_DOUBLES) {
        uint32_t through = both ? vndf_bits_at(&w->through, i) & all : 0, good = vndf_bits_at(&w->good, i);
        vndf_facet f = facet_at(b, w, i, through);
        doubles_m meets = doubles_both(doubles_less(nothing, f.facing_i), doubles_less(nothing, f.facing_o));
        good &= doubles_mask_bits(meets);
        if (b->value[0]) {
            doubles_m ready = doubles_of_mask_bits(0);
            doubles_store_long(w->masking + i, masking_at(b, w, i, &f, through & good, &ready));
            vndf_set_bits(&b->left, i, through & good & ~doubles_mask_bits(ready));
        }
        doubles_store_long(w->wm[0] + i, f.wm.x);
        doubles_store_long(w->wm[1] + i, f.wm.y);
        doubles_store_long(w->wm[2] + i, f.wm.z);
        doubles_store_long(w->facing + i, f.facing_i);
        doubles_store_long(w->jacobian + i, f.jacobian);
        w->good.of[i / 32] &= ~((all & ~good) << i % 32);
    }
}

/* ---- answers about facets ---- */

#  if VNDF_LANES == 16
#    define ANSWER vndf_eval_block_avx512
#  else
#    define ANSWER vndf_eval_block_avx2
#  endif

/* D, or the density. That of a closed form takes wi.wm from the directions as they are given. */
static void answer(vndf_look_block *b, const work *w, vndf_question question, double *exact)
{
    const vndf_distribution *d = b->material->is.distribution;
    vndf_eval_block block;
    block.in = (vndf_eval_inputs){{b->in[VNDF_HIT_ALPHA_X], b->in[VNDF_HIT_ALPHA_Y], w->x, w->y, w->cos_i},
                                  {w->wm[0], w->wm[1], w->wm[2]},
                                  vndf_law_is_exact(d) ? NULL : w->facing};
    block.count = b->count;
    block.exact = exact;
    ANSWER(d, question, &block);
    for (uint32_t n = 0; n < block.left_count; n++)
        vndf_set_bits(&b->left, block.left[n], vndf_bits_at(&w->good, block.left[n]) & 1);
}

/* ---- results ---- */

VNDF_INLINE void store_float(float *to, uint32_t i, doubles_m good, doubles x)
{
    doubles_store_f(to + i, vndf_density_of(doubles_pick(good, x, doubles_set(0.0))));
}

/* f but for F. */
VNDF_INLINE doubles shape_at(const work *w, uint32_t i)
{
    return 0.25 * doubles_load_long(w->ndf + i) * doubles_load_long(w->masking + i);
}

VNDF_INLINE doubles shape_through_at(const vndf_material *m, const work *w, uint32_t i)
{
    doubles carried = vndf_carried_at(m, vndf_eta_at(m, w->side + i));
    return doubles_load_long(w->ndf + i) * doubles_load_long(w->facing + i) * doubles_load_long(w->jacobian + i) *
           carried * doubles_load_long(w->masking + i);
}

static void store_reflection(const vndf_look_block *b, const work *w)
{
    const vndf_material *m = b->material;
    for (uint32_t i = 0; i < b->count; i += VNDF_DOUBLES) {
        doubles_m good = doubles_of_mask_bits(vndf_bits_at(&w->good, i));
        doubles facing = doubles_load_long(w->facing + i), eta = vndf_eta_at(m, w->side + i);
        for (int k = 0; k < m->is.wavelengths && b->value[0]; k++) {
            doubles shape = shape_at(w, i);
            if (m->routines->kind != VNDF_BLOCK_BARE)
                shape = shape * vndf_reflectance_lanes(m, k, facing, eta);
            store_float(b->value[k], i, good, shape);
        }
        if (b->pdf)
            store_float(b->pdf, i, good, doubles_load_long(w->density + i) * doubles_load_long(w->jacobian + i));
    }
}

static void store_both(const vndf_look_block *b, const work *w)
{
    const vndf_material *m = b->material;
    for (uint32_t i = 0; i < b->count; i += VNDF_DOUBLES) {
        doubles_m good = doubles_of_mask_bits(vndf_bits_at(&w->good, i));
        doubles_m through = doubles_of_mask_bits(vndf_bits_at(&w->through, i));
        doubles facing = doubles_load_long(w->facing + i), eta = vndf_eta_at(m, w->side + i);
        doubles f = vndf_reflectance_lanes(m, 0, facing, eta), mean = vndf_mean_lanes(m, f);
        doubles part = doubles_pick(through, 1.0 - mean, mean);
        if (b->value[0]) {
            doubles value = doubles_pick(through, shape_through_at(m, w, i) * (1.0 - f), shape_at(w, i) * f);
            for (int k = 0; k < m->is.wavelengths; k++)
                store_float(b->value[k], i, good, value);
        }
        if (b->pdf) {
            doubles density = doubles_load_long(w->density + i) * doubles_load_long(w->jacobian + i);
            store_float(b->pdf, i, good, part * density);
        }
    }
}

static void look(vndf_look_block *b)
{
    work w;
    vndf_clear_bits(&w.good);
    vndf_clear_bits(&w.through);
    find_hits(b, &w);
    find_facets(b, &w);
    if (b->value[0])
        answer(b, &w, VNDF_ASK_NDF, w.ndf);
    if (b->pdf)
        answer(b, &w, VNDF_ASK_PDF, w.density);
    if (b->material->routines->kind == VNDF_BLOCK_BOTH)
        store_both(b, &w);
    else
        store_reflection(b, &w);
}

#  if VNDF_LANES == 16
void vndf_look_block_avx512(vndf_look_block *b)
#  else
void vndf_look_block_avx2(vndf_look_block *b)
#  endif
{
    vndf_clear_bits(&b->left);
    if (b->material->routines->kind == VNDF_BLOCK_BARE && vndf_law_is_ggx(b->material->is.distribution))
        look_at_ggx(b);
    else
        look(b);
}

#endif
