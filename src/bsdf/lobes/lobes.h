/* The routines of materials, by what they wrap. */
#ifndef VNDF_BSDF_LOBES_LOBES_H
#define VNDF_BSDF_LOBES_LOBES_H

#include "bsdf/routines.h"

/* One scattering event: reflection without a Fresnel term and with height-correlated masking; reflection; transmission;
 * both (single.c). */
extern const vndf_routines vndf_routines_bare, vndf_routines_reflection, vndf_routines_transmission,
    vndf_routines_both;

/* The energy that single scattering loses, given back from a table of albedos (compensated.c). */
extern const vndf_routines vndf_routines_turquin, vndf_routines_kulla_conty;

/* Writes F at normal incidence and its mean of each wavelength, which compensation takes. */
void vndf_compensation_resolve(vndf_material *material);

/* Reflected light goes to where the half turn about z takes it (retro.c). */
extern const vndf_routines vndf_routines_retro;

#endif
