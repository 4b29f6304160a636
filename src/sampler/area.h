/* The projected area of a microsurface along a direction above the horizon, in float where that is good enough. */
#ifndef VNDF_SAMPLER_AREA_H
#define VNDF_SAMPLER_AREA_H

#include "sampler/aim.h"
#include "sampler/surface.h"

/* A(w) for a unit w, w.z > 0, and ax, ay the roughness times the distribution's scale; relative error below 2e-6.
 * Where *ready is 0 it has to be had otherwise. For GGX 2 A = w.z + |(ax w.x, ay w.y, w.z)|. */
VNDF_INLINE float vndf_area_above(const vndf_distribution *d, float ax, float ay, vndf_vec3 w, int *ready)
{
    float x = ax * w.x, y = ay * w.y, across2 = x * x + y * y;
    *ready = across2 < 1e24f && d->kind != VNDF_KIND_BECKMANN;
    if (d->kind == VNDF_KIND_GGX)
        return 0.5f * (w.z + sqrtf(across2 + w.z * w.z));
    float across = sqrtf(across2), sum = across + w.z, per = 1.0f / sum, s = across * per, c = w.z * per, per_width;
    *ready &= c > 1e-6f && across2 > 1e-24f;
    if (!*ready)
        return 0.0f;
    float area = 2.0f * (vndf_front_mass(vndf_front_of(d, s, c)) + vndf_wedge_quick(&d->above, c, &per_width));
    *ready = per_width <= VNDF_QUICK_PER_WIDTH;
    return area * sum;
}

#endif
