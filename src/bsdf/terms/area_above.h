/* The projected area of a microsurface along a direction above the horizon, in float where that is good enough. */
#ifndef VNDF_BSDF_TERMS_AREA_ABOVE_H
#define VNDF_BSDF_TERMS_AREA_ABOVE_H

#include "sampler/tabulated/aim.h"
#include "sampler/analytic/beckmann_draw.h"
#include "sampler/surface.h"

/* A/across of a Beckmann, from K = c/s = z/across (sampler/analytic/beckmann_draw.h). */
VNDF_INLINE float vndf_beckmann_area_over(float bound)
{
    float line = 3.54490770f * bound;
    return 0.282094792f * (1.0f + (line + vndf_beckmann_tail(bound, bound < 2.0f)));
}

/* A(w) of GGX: 2 A = w.z + |(ax w.x, ay w.y, w.z)|. */
VNDF_INLINE float vndf_ggx_area_above(float ax, float ay, vndf_vec3 w)
{
    float x = ax * w.x, y = ay * w.y;
    return 0.5f * (w.z + sqrtf((x * x + y * y) + w.z * w.z));
}

/* A(w) for a unit w, w.z > 0, and ax, ay the roughness times the distribution's scale; relative error below 2e-6.
 * Where *ready is 0 it has to be had otherwise. */
VNDF_INLINE float vndf_area_above(const vndf_distribution *d, float ax, float ay, vndf_vec3 w, int *ready)
{
    float x = ax * w.x, y = ay * w.y, across2 = x * x + y * y;
    if (d->kind == VNDF_KIND_GGX) {
        *ready = across2 < VNDF_TRUST_GGX_ACROSS2;
        return vndf_ggx_area_above(ax, ay, w);
    }
    float across = sqrtf(across2), sum = across + w.z;
    *ready = vndf_trusts_direction(across2, w.z, sum);
    if (!*ready)
        return 0.0f;
    if (d->kind == VNDF_KIND_BECKMANN)
        return across * vndf_beckmann_area_over(w.z / across);
    float per = 1.0f / sum, s = across * per, c = w.z * per, per_width;
    float area = 2.0f * (vndf_front_mass(vndf_front_of(d, s, c)) + vndf_wedge_quick(&d->above, c, &per_width));
    *ready = vndf_trusts_area_piece(per_width);
    return area * sum;
}

#endif
