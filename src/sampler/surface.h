/* What the view and the surface calls share: the distribution under a stretch. */
#ifndef VNDF_SAMPLER_SURFACE_H
#define VNDF_SAMPLER_SURFACE_H

#include "vndf.h"

/* Roughness times the table's scale; 0 unless both are within [1e-18, 1e18] and there is a distribution. */
int vndf_surface_scaled(const vndf_surface *surface, float *ax, float *ay);

/* D(wm) for roughness times the table's scale (ax, ay). */
float vndf_ndf_scaled(const vndf_distribution *d, float ax, float ay, vndf_vec3 wm);

#endif
