/* Routines of materials with multiple scattering: the walk of walk.h. */
#ifndef VNDF_BSDF_WALK_MULTIPLE_H
#define VNDF_BSDF_WALK_MULTIPLE_H

#include "bsdf/routines.h"

/* With an index ratio of 1 light meets no surface and goes straight on. */
extern const vndf_routines vndf_routines_multiple, vndf_routines_unbent;

#endif
