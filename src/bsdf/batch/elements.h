/* The elements of a batch, and the blocks that lanes take of it. */
#ifndef VNDF_BSDF_BATCH_ELEMENTS_H
#define VNDF_BSDF_BATCH_ELEMENTS_H

#include "bsdf/batch/block.h"
#include "bsdf/terms/masking.h"
#include "math/vector.h"
#include "sampler/batch/batch.h"

/* 1 where the build compiles lanes. */
#ifndef VNDF_HAS_LANES
#  define VNDF_HAS_LANES 0
#endif

/* ---- elements ---- */

VNDF_INLINE size_t vndf_element_index(const vndf_bsdf_batch *b, size_t i, unsigned shared)
{
    return b->shared & shared ? 0 : i;
}

VNDF_INLINE vndf_vec3 vndf_element_wi(const vndf_bsdf_batch *b, size_t i)
{
    size_t at = vndf_element_index(b, i, VNDF_SHARED_WI);
    return vndf_vec3_of(b->wi_x[at], b->wi_y[at], b->wi_z[at]);
}

VNDF_INLINE vndf_roughness vndf_element_roughness(const vndf_bsdf_batch *b, size_t i)
{
    size_t at = vndf_element_index(b, i, VNDF_SHARED_ALPHA);
    vndf_roughness r = b->material->roughness;
    if (b->alpha_x) {
        r.alpha_x = b->alpha_x[at];
        r.alpha_y = b->alpha_y[at];
    }
    if (b->cos_rotation) {
        r.cos_rotation = b->cos_rotation[at];
        r.sin_rotation = b->sin_rotation[at];
    }
    return r;
}

VNDF_INLINE int vndf_elements_share_shape(const vndf_bsdf_batch *b)
{
    return (b->shared & VNDF_SHARED_ALPHA) || (!b->alpha_x && !b->cos_rotation && !b->affine && !b->mixture);
}

/* Whether all elements are one hit. */
VNDF_INLINE int vndf_elements_share_hit(const vndf_bsdf_batch *b)
{
    return (b->shared & VNDF_SHARED_WI) && vndf_elements_share_shape(b);
}

VNDF_INLINE void vndf_element_hit(vndf_bsdf *hit, const vndf_bsdf_batch *b, size_t i)
{
    size_t at = vndf_element_index(b, i, VNDF_SHARED_ALPHA);
    vndf_roughness r;
    switch (b->material->is.effects.shape) {
    case VNDF_SHAPE_ALIGNED:
    case VNDF_SHAPE_ROTATED: break;
    case VNDF_SHAPE_MATRIX:
    case VNDF_SHAPE_AFFINE:
        vndf_bsdf_affine(hit, b->material, b->affine ? b->affine + at : NULL, vndf_element_wi(b, i));
        return;
    case VNDF_SHAPE_MIXTURE:
        vndf_bsdf_mixture(hit, b->material, b->mixture ? b->mixture + at : NULL, vndf_element_wi(b, i));
        return;
    }
    r = vndf_element_roughness(b, i);
    vndf_bsdf_hit(hit, b->material, &r, vndf_element_wi(b, i));
}

/* ---- blocks ---- */

/* Whether lanes do a batch. F of a steep conductor is evaluated at each direction. Other masking has no lanes, nor
 * have both lobes with another F, or with light that goes straight on. */
VNDF_INLINE int vndf_elements_have_lanes(const vndf_bsdf_batch *b)
{
    const vndf_material *m = b->material;
    int bends = m->is.effects.fresnel == VNDF_FRESNEL_DIELECTRIC && m->is.eta != 1.0f;
    if (m->routines->kind == VNDF_BLOCK_NONE || (m->routines->kind == VNDF_BLOCK_BOTH && !bends))
        return 0;
    return VNDF_HAS_LANES && b->count > 1 && !m->steep && m->masking == &vndf_masking_height_correlated &&
           vndf_instructions_used(b->limit) != VNDF_INSTRUCTIONS_PORTABLE;
}

/* The inputs of the hits. */
VNDF_INLINE void vndf_block_hits(const vndf_bsdf_batch *b, size_t first, uint32_t count, const float **in,
                                 float (*copy)[VNDF_HIT_BLOCK])
{
    const vndf_roughness *r = &b->material->roughness;
    int alpha = (b->shared & VNDF_SHARED_ALPHA) || !b->alpha_x, wi = (b->shared & VNDF_SHARED_WI) != 0;
    const float *from[VNDF_HIT_INPUTS] = {b->alpha_x ? b->alpha_x : &r->alpha_x,
                                          b->alpha_x ? b->alpha_y : &r->alpha_y, b->wi_x, b->wi_y, b->wi_z};
    for (int n = 0; n < VNDF_HIT_INPUTS; n++)
        in[n] =
            vndf_batch_input(from[n], n <= VNDF_HIT_ALPHA_Y ? alpha : wi, first, count, VNDF_HIT_BLOCK, copy[n]);
}

#endif
