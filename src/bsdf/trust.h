/* Where the density and weight of a drawn normal may stand for those of the direction wo that it gives, as wo was
 * rounded: every threshold of the fast lobes, with its cause. Elsewhere lobes/exact.c evaluates the sample at wo.
 *
 * The promise is 1e-5 of a density and of a weight. A normal comes with the density of sampler/trust.h, or one that is
 * formed from wo itself. */
#ifndef VNDF_BSDF_TRUST_H
#define VNDF_BSDF_TRUST_H

#include <math.h>

#include "core/inline.h"

/* ---- the slope that wo stands for is the one that was drawn ---- */

/* The least roughness, or 1, times how far wo turns with the normal: wo is rounded by 3e-8, so the slope is within
 * 5e-6 of the roughness. */
static const float VNDF_TRUST_TURN = 0.04f;

VNDF_INLINE int vndf_trusts_turn(float ax, float ay, float gain)
{
    float least = ax < ay ? ax : ay;
    return (least < 1.0f ? least : 1.0f) * gain > VNDF_TRUST_TURN;
}

/* The cosine to the normal from which a reflection with all its terms is tried at all. */
static const float VNDF_TRUST_REFLECTION_FACING = 0.1f;

/* Refraction. wo turns with the normal by `gain`, and not at all where it is unbent; near total reflection 1 - F
 * changes as fast as 1/beyond; and near the horizon the slope as fast as 1/wm.z. */
static const float VNDF_TRUST_REFRACTION_GAIN = 0.4f, VNDF_TRUST_REFRACTION_FACING = 0.1f;
static const double VNDF_TRUST_BEYOND = 0.1;
static const float VNDF_TRUST_REFRACTION_TURN = 0.16f;

/* Rotated lobes round wo three times more. */
static const float VNDF_TRUST_ROTATED_GAIN = 0.2f;

/* ---- terms of a weight ---- */

/* The cosine of refraction, squared: beside total reflection F changes without bound. */
static const double VNDF_TRUST_REFRACTED = 0.2;

/* A conductor whose F is as steep: eta below 1 and k below this. */
static const float VNDF_TRUST_CONDUCTOR_K = 0.05f;

/* A value, and the density that divides it: what a float holds. */
static const float VNDF_TRUST_VALUE = 1e37f, VNDF_TRUST_DIVISOR = 1e-30f;

/* ---- densities from wi + wo ---- */

/* wi.wm below which the lengths of wi and wo count, which are 1 but for rounding; they are made 1 there. */
static const double VNDF_TRUST_LENGTHS = 0.04;

/* GGX. The same for its density in float, and the roughness from which the density of the normal is taken, which
 * costs less; nearly all surfaces are on one side of it, so that the branch is foreseen. */
static const float VNDF_TRUST_GGX_FACING = 0.05f, VNDF_TRUST_GGX_ROUGH = 0.4f;

VNDF_INLINE int vndf_trusts_drawn_ggx(float ax, float ay, float facing)
{
    return (ax > VNDF_TRUST_GGX_ROUGH) & (ay > VNDF_TRUST_GGX_ROUGH) & vndf_trusts_turn(ax, ay, facing);
}

/* ---- bounded normals: their density changes within a rounding on short chords of the disc, at the ends of its
 * extent and where all of u1 gives one normal ---- */

/* Away from the border of the unit square. */
VNDF_INLINE int vndf_trusts_number(float u)
{
    return fabsf(u - 0.5f) < 0.499f;
}

/* What is left of the area inside the horizon. */
static const float VNDF_TRUST_BOUNDED_AREA = 0.1f;

/* How much less wo turns than the normal, which turns the azimuth of the stretched normal by as much more; at most
 * one half. */
static const float VNDF_TRUST_BOUNDED_REACH = 2.5f, VNDF_TRUST_BOUNDED_REACH_MOST = 0.5f;

#endif
