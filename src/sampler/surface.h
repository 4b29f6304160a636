/* What the view and the surface calls share: the distribution under a stretch. */
#ifndef VNDF_SAMPLER_SURFACE_H
#define VNDF_SAMPLER_SURFACE_H

#include <float.h>

#include "core/inline.h"
#include "table/table.h"
#include "vndf.h"

/* Roughness times the table's scale; 0 unless both are within [1e-18, 1e18] and there is a distribution. */
VNDF_INLINE int vndf_surface_scaled(const vndf_surface *surface, float *ax, float *ay)
{
    if (!surface || !surface->distribution)
        return 0;
    *ax = surface->alpha_x * surface->distribution->scale;
    *ay = surface->alpha_y * surface->distribution->scale;
    return *ax >= 1e-18f && *ax <= 1e18f && *ay >= 1e-18f && *ay <= 1e18f;
}

/* A density as a float: the largest one for what is larger, 0 for NaN. */
VNDF_INLINE float vndf_density_from(double density)
{
    return density > 0.0 ? (density < (double)FLT_MAX ? (float)density : FLT_MAX) : 0.0f;
}

/* D(wm) for roughness times the table's scale (ax, ay). */
float vndf_ndf_scaled(const vndf_distribution *d, float ax, float ay, vndf_vec3 wm);

#endif
