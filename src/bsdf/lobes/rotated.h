/* Roughness with axes at an angle: directions are turned to the axes, and sampled ones back. */
#ifndef VNDF_BSDF_LOBES_ROTATED_H
#define VNDF_BSDF_LOBES_ROTATED_H

#include "bsdf/routines.h"

extern const vndf_routines vndf_routines_rotated;

#endif
