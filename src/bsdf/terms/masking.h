/* Masking and shadowing over both cosines, G2/(cos_i cos_o), in terms of projected areas A = cos (1 + Lambda)
 * along a direction and B = cos Lambda along its opposite (Heitz 2014, equations 98 and 99):
 *
 *     height-correlated    1/(cos_i cos_o (1 + Lambda_i + Lambda_o)) = 1/(cos_o A_i + cos_i B_o)
 *     separable            1/(A_i A_o)
 *
 * which is finite where a cosine vanishes: A does not. */
#ifndef VNDF_BSDF_TERMS_MASKING_H
#define VNDF_BSDF_TERMS_MASKING_H

#include "bsdf/routines.h"
#include "bsdf/trust.h"
#include "sampler/law.h"

/* Height-correlated, from both areas. At most 1/(cos_o A_i), so that no weight of visible normals exceeds 1. */
VNDF_INLINE doubles vndf_height_correlated(doubles cos_i, doubles cos_o, doubles area_i, doubles area_o)
{
    return 1.0 / (cos_o * area_i + cos_i * doubles_positive(area_o - cos_o));
}

/* Whether areas in float will not do for the Beta function of a transmission; i and o are A/cos. */
VNDF_INLINE doubles_m vndf_needs_exact_areas(doubles i, doubles o)
{
    return doubles_less(doubles_set(VNDF_TRUST_BETA), i + o);
}

#if VNDF_LANES == 1

/* A(w), w.z > 0, with the roughness of the hit. */
VNDF_INLINE float vndf_bsdf_area(const vndf_bsdf *b, vndf_vec3 w)
{
    int ready;
    float area = vndf_law_area_above(b->view.distribution, b->view.ax, b->view.ay, w.x, w.y, w.z, &ready);
    return ready ? area : vndf_area_scaled(b->view.distribution, b->view.alpha_x, b->view.alpha_y, w);
}

/* The same of the direction of the view. */
VNDF_INLINE float vndf_bsdf_view_area(const vndf_bsdf *b)
{
    int ready;
    float area = vndf_law_view_area(&b->view, &ready);
    return ready ? area : vndf_area_scaled(b->view.distribution, b->view.alpha_x, b->view.alpha_y, b->view.wi);
}

extern const vndf_masking_routine vndf_masking_height_correlated, vndf_masking_separable, vndf_masking_v_cavities,
    vndf_masking_none;

#endif
#endif
