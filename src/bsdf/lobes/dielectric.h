/* Routines of materials that transmit, by the frame of the hit and vndf_normals_drawn; none for bounded normals. */
#ifndef VNDF_BSDF_LOBES_DIELECTRIC_H
#define VNDF_BSDF_LOBES_DIELECTRIC_H

#include "bsdf/lobes/reflection.h"

/* Transmission alone, and both lobes. */
extern const vndf_routines vndf_routines_transmission[VNDF_FRAMES][VNDF_NORMALS_COUNT],
    vndf_routines_both[VNDF_FRAMES][VNDF_NORMALS_COUNT];

#endif
