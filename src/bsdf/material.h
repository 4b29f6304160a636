/* The choices of vndf_material_resolve. */
#ifndef VNDF_BSDF_MATERIAL_H
#define VNDF_BSDF_MATERIAL_H

#include "bsdf/routines.h"

/* Scatters nothing, in so many wavelengths, 0 being 3: a wrong description resolves to it, and a hit that sees no
 * surface has it. */
extern const vndf_material vndf_materials_of_nothing[VNDF_WAVELENGTHS + 1];

/* Whether the numbers and the combination of effects make sense; else an error that names what does not. */
vndf_status vndf_description_check(const vndf_description *is, vndf_error *error);

#endif
