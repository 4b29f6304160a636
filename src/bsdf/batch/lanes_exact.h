/* The samples of a block whose density and weight are those of the rounded wo (lobes/exact.c), in lanes of doubles:
 * they are gathered side by side, so a block with few of them has few groups. For lanes_scatter.c. */
#ifndef VNDF_BSDF_BATCH_LANES_EXACT_H
#define VNDF_BSDF_BATCH_LANES_EXACT_H

#include "bsdf/batch/lanes_facets.h"
#include "bsdf/batch/lanes_scatter.h"

/* Samples side by side: which they are, their inputs and their results. */
typedef struct vndf_exact_samples {
    uint32_t index[VNDF_HIT_BLOCK], count;
    float alpha_x[VNDF_HIT_BLOCK], alpha_y[VNDF_HIT_BLOCK], wo_x[VNDF_HIT_BLOCK], wo_y[VNDF_HIT_BLOCK];
    vndf_facets facets;
    float density[VNDF_HIT_BLOCK], weight[VNDF_HIT_BLOCK], share[VNDF_HIT_BLOCK];
    float part[VNDF_WAVELENGTHS][VNDF_HIT_BLOCK];
} vndf_exact_samples;

/* Sample n of the block becomes number i. */
VNDF_INLINE void vndf_gather_exact(const vndf_scatter_block *b, uint32_t n, const float *area_i,
                                   const float *area_o, uint32_t i, vndf_exact_samples *e)
{
    vndf_facets *f = &e->facets;
    float wi_z = b->in[VNDF_HIT_WI_Z][n], side = b->material->two_sided && wi_z < 0.0f ? -1.0f : 1.0f;
    e->alpha_x[i] = b->in[VNDF_HIT_ALPHA_X][n];
    e->alpha_y[i] = b->in[VNDF_HIT_ALPHA_Y][n];
    e->wo_x[i] = b->to.wo.x[n];
    e->wo_y[i] = b->to.wo.y[n];
    f->side[i] = side;
    f->x[i] = b->in[VNDF_HIT_WI_X][n];
    f->y[i] = b->in[VNDF_HIT_WI_Y][n];
    f->cos_i[i] = side * wi_z;
    f->z[i] = side * b->to.wo.z[n];
    f->up[i] = f->z[i] < 0.0f ? -f->z[i] : f->z[i];
    f->area_i[i] = area_i[n];
    f->area_o[i] = area_o[n];
    vndf_set_bits(&f->through, i, f->z[i] < 0.0f);
}

/* Lanes past the end repeat the first sample. */
VNDF_INLINE void vndf_gather_all_exact(const vndf_scatter_block *b, const float *area_i, const float *area_o,
                                       vndf_exact_samples *e)
{
    vndf_facets *f = &e->facets;
    vndf_clear_facets(f, b->material, e->count);
    f->alpha_x = e->alpha_x;
    f->alpha_y = e->alpha_y;
    f->wo_x = e->wo_x;
    f->wo_y = e->wo_y;
    for (uint32_t i = 0; i < e->count; i++)
        vndf_set_bits(&f->good, i, 1);
    for (uint32_t i = 0; i < (e->count + VNDF_LANES - 1) / VNDF_LANES * VNDF_LANES; i++)
        vndf_gather_exact(b, e->index[i < e->count ? i : 0], area_i, area_o, i, e);
}

/* Density and weight but for F; facets of no density become bad. */
VNDF_INLINE void vndf_weigh_exact(vndf_exact_samples *e, uint32_t i)
{
    vndf_facets *f = &e->facets;
    doubles density = doubles_load_long(f->density + i), facing = doubles_load_long(f->facing + i);
    doubles ratio = doubles_load_long(f->ndf + i) / density;
    doubles weight = doubles_load_long(f->masking + i) * doubles_load_long(f->cos_o + i) * facing * ratio;
    uint32_t drawn = doubles_mask_bits(doubles_less(doubles_set(0.0), density));
    f->good.of[i / 32] &= ~((VNDF_ALL_DOUBLES & ~drawn) << i % 32);
    doubles_store_f(e->density + i, vndf_density_of(density * doubles_load_long(f->jacobian + i)));
    doubles_store_f(e->weight + i, doubles_narrow(weight));
}

/* The part of the samples that takes the lobe, and the weight's parts by wavelength. */
VNDF_INLINE void vndf_colour_exact(const vndf_material *m, vndf_exact_samples *e, uint32_t i)
{
    vndf_facets *f = &e->facets;
    doubles facing = doubles_load_long(f->facing + i), eta = vndf_eta_at(m, f->side + i), share = doubles_set(1.0);
    if (m->routines->kind == VNDF_BLOCK_BOTH) {
        doubles_m through = doubles_of_mask_bits(vndf_bits_at(&f->through, i));
        doubles part = vndf_lobe_weight(m, vndf_reflectance_lanes(m, 0, facing, eta), eta, through, &share);
        doubles_store_f(e->part[0] + i, doubles_narrow(part));
    } else {
        for (int k = 0; k < m->is.wavelengths; k++)
            doubles_store_f(e->part[k] + i, doubles_narrow(vndf_reflectance_lanes(m, k, facing, eta)));
    }
    doubles_store_f(e->share + i, doubles_narrow(share));
}

/* One part stands for all wavelengths, or each has its own. */
VNDF_INLINE void vndf_put_exact(const vndf_scatter_block *b, const vndf_exact_samples *e, uint32_t i)
{
    const vndf_scattered_n *to = &b->to;
    const uint32_t n = e->index[i];
    int good = (int)(vndf_bits_at(&e->facets.good, i) & 1), count = b->material->is.wavelengths;
    int one = b->material->routines->kind == VNDF_BLOCK_BOTH;
    to->density[n] = good ? vndf_positive(e->density[i] * e->share[i]) : 0.0f;
    for (int k = 0; k < count; k++)
        to->weight[k][n] = good ? vndf_finite(e->weight[i] * e->part[one ? 0 : k][i]) : 0.0f;
    if (good)
        return;
    to->wo.x[n] = to->wo.y[n] = 0.0f;
    to->wo.z[n] = 1.0f;
    to->lobe[n] = VNDF_LOBE_NONE;
    if (to->wm.x)
        to->wm.x[n] = to->wm.y[n] = to->wm.z[n] = 0.0f;
}

/* Evaluates the samples of `some`, whose directions and lobes are stored, or leaves them. */
static void vndf_scatter_exactly(vndf_scatter_block *b, const vndf_sample_bits *some, const float *area_i,
                                 const float *area_o)
{
    vndf_exact_samples e;
    e.count = vndf_list_samples(some, b->count, e.index);
    if (e.count == 0)
        return;
    vndf_gather_all_exact(b, area_i, area_o, &e);
    vndf_find_facets(&e.facets, 1);
    vndf_answer_facets(&e.facets, VNDF_ASK_NDF, e.facets.ndf);
    vndf_answer_facets(&e.facets, VNDF_ASK_PDF, e.facets.density);
    for (uint32_t i = 0; i < e.count; i += VNDF_DOUBLES) {
        vndf_weigh_exact(&e, i);
        vndf_colour_exact(b->material, &e, i);
    }
    for (uint32_t i = 0; i < e.count; i++) {
        vndf_put_exact(b, &e, i);
        vndf_set_bits(&b->left, e.index[i], vndf_bits_at(&e.facets.left, i) & 1);
    }
}

#endif
