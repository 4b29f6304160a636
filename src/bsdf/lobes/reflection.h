/* Routines of materials that reflect and do not transmit, by the frame of the hit and vndf_normals_drawn. */
#ifndef VNDF_BSDF_LOBES_REFLECTION_H
#define VNDF_BSDF_LOBES_REFLECTION_H

#include "bsdf/routines.h"

enum { VNDF_NORMALS_COUNT = VNDF_NORMALS_V_CAVITY + 1 };

/* A hit in its principal axes, and one that is turned to them (turned.h). */
enum { VNDF_FRAME_ALIGNED, VNDF_FRAME_TURNED, VNDF_FRAMES };

/* Bare: no Fresnel term and height-correlated masking, from above alone. The others have any. */
extern const vndf_routines vndf_routines_bare[VNDF_FRAMES][VNDF_NORMALS_COUNT],
    vndf_routines_reflection[VNDF_FRAMES][VNDF_NORMALS_COUNT];

/* Bare, normals of GGX: visible ones, and, where the hit is not turned, visible ones that reflect upwards. */
extern const vndf_routines vndf_routines_bare_ggx[VNDF_FRAMES], vndf_routines_bare_bounded_ggx;

#endif
