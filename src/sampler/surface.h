/* What the view and the surface calls share: the distribution under a stretch. */
#ifndef VNDF_SAMPLER_SURFACE_H
#define VNDF_SAMPLER_SURFACE_H

#include "vndf.h"

/* Whether a surface is valid: alpha times the table's scale within [1e-18, 1e18]. */
int vndf_surface_usable(const vndf_surface *surface);

/* D(wm) for roughness times the table's scale (ax, ay). */
float vndf_ndf_scaled(const vndf_distribution *d, float ax, float ay, vndf_vec3 wm);

#endif
