/* The uniform numbers whose sample is nearest to a normal. */
#ifndef VNDF_SAMPLER_NEAREST_H
#define VNDF_SAMPLER_NEAREST_H

#include "vndf.h"

/* For a valid view of a table, and a normal wm that faces wi: moves uniform numbers that give about wm to numbers that
 * give wm within 4e-6, or as nearly as some tens of steps of 2^-24 can. Distances are between unit normals of the unit
 * problem. */
void vndf_nearest(const vndf_view *view, vndf_vec3 wm, float *u1, float *u2);

#endif
