/* Masking and shadowing over both cosines, G = G2/(cos_i cos_o), in terms of projected areas A = cos (1 + Lambda)
 * along a direction and B = cos Lambda along its opposite (Heitz 2014, equations 98 and 99):
 *
 *     height-correlated    1/(cos_i cos_o (1 + Lambda_i + Lambda_o)) = 1/(cos_o A_i + cos_i B_o)
 *     separable            1/(A_i A_o)
 *
 * which is finite where a cosine vanishes: A does not. */
#ifndef VNDF_BSDF_TERMS_MASKING_H
#define VNDF_BSDF_TERMS_MASKING_H

#include "bsdf/routines.h"

/* Height-correlated, from both areas. At most 1/(cos_o A_i), so that no weight of visible normals exceeds 1. */
VNDF_INLINE double vndf_height_correlated(double cos_i, double cos_o, double area_i, double area_o)
{
    double below = area_o - cos_o;
    return 1.0 / (cos_o * area_i + cos_i * (below > 0.0 ? below : 0.0));
}

extern const vndf_masking_routine vndf_masking_height_correlated, vndf_masking_separable, vndf_masking_v_cavities,
    vndf_masking_none;

#endif
