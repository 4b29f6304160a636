/* The density of visible normals at a normal in double. A half vector rounded to float would lie elsewhere in a narrow
 * lobe. */
#ifndef VNDF_BSDF_WALK_VISIBLE_H
#define VNDF_BSDF_WALK_VISIBLE_H

#include "sampler/analytic_density.h"

/* Dv(wm); wm is unit, facing = wi.wm > 0. 0 where wm.z < 0. */
double vndf_walk_visible(const vndf_view *view, vndf_normal wm, double facing);

#endif
