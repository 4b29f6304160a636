/* See lanes_look.h. Lanes past the end of a block work on numbers that are in memory, and nobody reads what they
 * make of them. */
#include "bsdf/batch/lanes_look.h"

#if VNDF_HAS_LANES && VNDF_LANES > 1

#  include "bsdf/batch/lanes_facets.h"

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
        vndf_vec3_lanes wo = {lanes_load(b->in[VNDF_LOOK_WO_X] + i), lanes_load(b->in[VNDF_LOOK_WO_Y] + i),
                              lanes_load(b->in[VNDF_LOOK_WO_Z] + i)};
        vndf_vec3_lanes half = vndf_sum(h.at.wi, wo);
        lanes_f square = half.x * half.x + half.y * half.y + half.z * half.z;
        lanes_m unit = vndf_is_near_unit_square(wo.x * wo.x + wo.y * wo.y + wo.z * wo.z), ready;
        lanes_m good = lanes_both(lanes_both(h.known, h.at.trusted), lanes_both(unit, lanes_less(four, square)));
        lanes_m up = lanes_less(nothing, wo.z);
        lanes_f density = vndf_ggx_density_of(&h.at, half);
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

static void find_hits(const vndf_look_block *b, vndf_facets *w)
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
        vndf_set_bits(&w->left, i, lanes_mask_bits(lanes_either(left, lanes_without(lit, ready))));
    }
}

/* ---- results ---- */

VNDF_INLINE void store_float(float *to, uint32_t i, doubles_m good, doubles x)
{
    doubles_store_f(to + i, vndf_density_of(doubles_pick(good, x, doubles_set(0.0))));
}

/* f but for F. */
VNDF_INLINE doubles shape_at(const vndf_facets *w, uint32_t i)
{
    return 0.25 * doubles_load_long(w->ndf + i) * doubles_load_long(w->masking + i);
}

VNDF_INLINE doubles shape_through_at(const vndf_material *m, const vndf_facets *w, uint32_t i)
{
    doubles carried = vndf_carried_at(m, vndf_eta_at(m, w->side + i));
    return doubles_load_long(w->ndf + i) * doubles_load_long(w->facing + i) * doubles_load_long(w->jacobian + i) *
           carried * doubles_load_long(w->masking + i);
}

static void store_reflection(const vndf_look_block *b, const vndf_facets *w)
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

static void store_both(const vndf_look_block *b, const vndf_facets *w)
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
    vndf_facets w;
    vndf_clear_facets(&w, b->material, b->count);
    w.alpha_x = b->in[VNDF_HIT_ALPHA_X];
    w.alpha_y = b->in[VNDF_HIT_ALPHA_Y];
    w.wo_x = b->in[VNDF_LOOK_WO_X];
    w.wo_y = b->in[VNDF_LOOK_WO_Y];
    find_hits(b, &w);
    vndf_find_facets(&w, b->value[0] != NULL);
    if (b->value[0])
        vndf_answer_facets(&w, VNDF_ASK_NDF, w.ndf);
    if (b->pdf)
        vndf_answer_facets(&w, VNDF_ASK_PDF, w.density);
    b->left = w.left;
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
