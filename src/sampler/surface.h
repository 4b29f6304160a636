/* What the view and the surface calls share: the distribution under a stretch. */
#ifndef VNDF_SAMPLER_SURFACE_H
#define VNDF_SAMPLER_SURFACE_H

#include <float.h>

#include "core/inline.h"
#include "vndf.h"

/* Roughness times the table's scale; 0 unless both are within [1e-18, 1e18] and there is a distribution. */
int vndf_surface_scaled(const vndf_surface *surface, float *ax, float *ay);

/* A density as a float: the largest one for what is larger, 0 for NaN. */
VNDF_INLINE float vndf_density_from(double density)
{
    return density > 0.0 ? (density < (double)FLT_MAX ? (float)density : FLT_MAX) : 0.0f;
}

/* D(wm) for roughness times the table's scale (ax, ay). */
float vndf_ndf_scaled(const vndf_distribution *d, float ax, float ay, vndf_vec3 wm);

#endif
