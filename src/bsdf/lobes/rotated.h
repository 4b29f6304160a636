/* The axes of the roughness at an angle: directions are turned to them, what comes out is turned back. */
#ifndef VNDF_BSDF_LOBES_ROTATED_H
#define VNDF_BSDF_LOBES_ROTATED_H

#include "bsdf/routines.h"

extern const vndf_routines vndf_routines_rotated;

#endif
