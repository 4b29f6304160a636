/* Surfaces of several lobes, or of one with a mean slope (sampler/affine). */
#ifndef VNDF_BSDF_LOBES_MIXTURE_H
#define VNDF_BSDF_LOBES_MIXTURE_H

#include "bsdf/routines.h"

extern const vndf_routines vndf_routines_mixture;

/* Writes the view of wi as it is; 0 if the mixture is invalid. */
int vndf_mixture_see(vndf_bsdf *bsdf, const vndf_mixture *mixture, vndf_vec3 wi);

/* w.z - w.mean of the mixture that was seen: below 0 beyond its mean plane; and n.w, n the unit normal of that
 * plane. */
double vndf_mixture_rise(const vndf_bsdf *bsdf, vndf_vec3 w);
double vndf_mixture_cosine(const vndf_bsdf *bsdf, vndf_vec3 w);

#endif
