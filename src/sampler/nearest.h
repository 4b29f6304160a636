/* The uniform numbers whose sample is nearest to a normal. */
#ifndef VNDF_SAMPLER_NEAREST_H
#define VNDF_SAMPLER_NEAREST_H

#include "vndf.h"

/* Moves uniform numbers that give about the normal wm, which faces wi, to such that give it within 4e-6, or as
 * nearly as numbers within some tens of 2^-24 do: of a valid view of a table. Distances are those of unit normals
 * of the unit problem. */
void vndf_nearest(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2);

#endif
