/* One scattering event on any surface. */
#ifndef VNDF_BSDF_LOBES_SINGLE_H
#define VNDF_BSDF_LOBES_SINGLE_H

#include "bsdf/routines.h"

/* Reflection without Fresnel term with height-correlated masking; reflection; transmission; both. */
extern const vndf_routines vndf_routines_bare, vndf_routines_reflection, vndf_routines_transmission,
    vndf_routines_both;

#endif
