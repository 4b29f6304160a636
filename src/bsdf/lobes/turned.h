/* Roughness with principal axes at an angle: directions are turned to the axes, and sampled ones back. */
#ifndef VNDF_BSDF_LOBES_TURNED_H
#define VNDF_BSDF_LOBES_TURNED_H

#include "bsdf/routines.h"

/* Prepares the hit of the material's unturned routines in the axes, whose angle the roughness has. */
int vndf_prepare_turned(vndf_bsdf *bsdf, const vndf_roughness *roughness, vndf_vec3 wi);

/* Random walks. Other routines turn directions themselves (vndf_choice). */
extern const vndf_routines vndf_routines_turned_walk;

/* The roughness and the axes of a matrix of slopes; 0 if it is invalid. */
int vndf_turned_roughness(const vndf_distribution *distribution, const vndf_affine *affine,
                          vndf_roughness *roughness);

#endif
