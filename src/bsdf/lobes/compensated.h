/* Energy that single scattering loses, given back from a table of albedos. */
#ifndef VNDF_BSDF_LOBES_COMPENSATED_H
#define VNDF_BSDF_LOBES_COMPENSATED_H

#include "bsdf/routines.h"

extern const vndf_routines vndf_routines_turquin, vndf_routines_kulla_conty;

/* Writes F at normal incidence and its mean of each wavelength. */
void vndf_compensation_resolve(vndf_material *material);

#endif
