/* Where the density and weight of a drawn normal may stand for those of the direction wo that it gives, as wo was
 * rounded: every threshold of the fast lobes, with its cause. Elsewhere lobes/exact.c evaluates the sample at wo.
 *
 * A normal comes with its density to 1e-5 (sampler/trust.h). The direction may add another 1e-5 to its density, and F
 * with masking another 1e-5 to its weight: the shares below add up to that. So by the sums a density is within 2e-5 of
 * vndf_bsdf_pdf and a weight within 3e-5. The worst cases have not met: the worst of 190 million samples is off by
 * 8.5e-6, the normal's error included. */
#ifndef VNDF_BSDF_TRUST_H
#define VNDF_BSDF_TRUST_H

#include <math.h>

#include "simd/lanes.h"

/* ---- the budget ---- */

/* Parts of 1e-5 in units of 1e-8, without the error of the normal's own density: the worst error measured on the
 * trusted side of a threshold, within a factor of two of it, rounded up by hand. Measured with 190 million samples
 * of GGX, Beckmann, all shipped tables and two more, reflection and glass, half of them at the borders of the unit
 * square, roughness 1e-3 to 3; other effects with 19 million. */
enum {
    VNDF_BSDF_PROMISE = 1000,
    VNDF_SHARE_SLOPE = 950,       /* the slope of wo: TURN, POLE, both GAIN, BEYOND; GGX 400 */
    VNDF_SHARE_WO = 50,           /* a few roundings of every sample */
    VNDF_SHARE_REFLECTANCE = 650, /* F where its cosine is rounded: both FACING, REFRACTED, CONDUCTOR_K */
    VNDF_SHARE_MASKING = 200,     /* areas in float: BETA */
    VNDF_SHARE_BOUNDED = 900      /* the part inside the horizon: NUMBER, all BOUNDED */
};

_Static_assert(VNDF_SHARE_SLOPE + VNDF_SHARE_WO <= VNDF_BSDF_PROMISE, "the density of a direction");
_Static_assert(VNDF_SHARE_BOUNDED + VNDF_SHARE_WO <= VNDF_BSDF_PROMISE, "the density of a bounded one");
_Static_assert(VNDF_SHARE_REFLECTANCE + VNDF_SHARE_MASKING + VNDF_SHARE_WO <= VNDF_BSDF_PROMISE,
               "a weight, beside the density that divides it");

/* ---- the slope that wo stands for is the one that was drawn ---- */

/* The least roughness, or 1, times how far wo turns with the normal. Rounding moves wo by 6e-8, and so the slope by
 * 3e-6 of the roughness. This is for laws like GGX, whose P22 changes by a factor of up to e^2 within one roughness;
 * steeper ones want as much more. */
static const float VNDF_TRUST_TURN = 0.03f;

VNDF_INLINE float vndf_turn_for(double steepness)
{
    return VNDF_TRUST_TURN * (steepness > 2.0 ? (float)(0.5 * steepness) : 1.0f);
}

/* How much more a law asks for where its P22 is steeper than that: Beckmann's, at R = 3.9, where float ends. */
static const float VNDF_TRUST_STEEPER = 3.5f;

/* `turn` is that of the law. */
VNDF_INLINE lanes_m vndf_trusts_turn(lanes_f ax, lanes_f ay, lanes_f gain, lanes_f turn)
{
    return lanes_less(turn, lanes_least(lanes_least(ax, ay), lanes_set(1.0f)) * gain);
}

/* The sine of the normal times how far wo turns with it: beside the pole the rounding of wo turns the azimuth of the
 * normal, and what a table draws there changes with the azimuth. */
static const float VNDF_TRUST_POLE = 1e-2f;

VNDF_INLINE lanes_m vndf_trusts_pole(lanes_f x, lanes_f y, lanes_f gain)
{
    return lanes_less(lanes_set(VNDF_TRUST_POLE * VNDF_TRUST_POLE), (x * x + y * y) * (gain * gain));
}

/* The level part of wi.wm over that of wi, times how far wo turns with the normal: where it changes its sign, the
 * normal of a table goes from the front to the wedge, whose density is another by what the table is off: unasked, one
 * of 5e7 samples is off by more than 1e-5, 3e-3 for a table of 2 KiB. */
static const float VNDF_TRUST_WO_SIDE = 1e-6f;

VNDF_INLINE lanes_m vndf_trusts_wo_side(lanes_f along, lanes_f across2, lanes_f gain)
{
    lanes_f turned = along * gain;
    return lanes_at_most(VNDF_TRUST_WO_SIDE * VNDF_TRUST_WO_SIDE * across2, turned * turned);
}

/* The cosine to the normal: rounding moves it by 1e-7, and F over it. */
static const float VNDF_TRUST_REFLECTION_FACING = 0.1f, VNDF_TRUST_REFRACTION_FACING = 0.1f;

/* A refraction's turn is given whole, a reflection's by half. */
static const float VNDF_TRUST_REFRACTION_GAIN = 0.75f;

/* The cosine of refraction: beside total reflection wo turns as fast as one over it. */
static const double VNDF_TRUST_BEYOND = 0.1;

/* Rotated walks round wo once more, and once more where it is evaluated. */
static const float VNDF_TRUST_WALK_GAIN = 0.55f;

/* The second uniform number: the last normals of a table may be just before a jump of D. */
static const float VNDF_TRUST_LAST = 0.9999f;

/* ---- terms of a weight ---- */

/* The cosine of refraction, squared: beside total reflection F changes without bound. */
static const double VNDF_TRUST_REFRACTED = 0.2;

/* A conductor whose F is as steep: eta below 1 and k below this. */
static const float VNDF_TRUST_CONDUCTOR_K = 0.05f;

/* Arguments of Beta: its relative error is up to five times theirs where they add up to this, and areas in float err
 * by 1e-6. */
static const double VNDF_TRUST_BETA = 8.0;

/* ---- densities from wi + wo ---- */

/* GGX: the cosine to the normal, for its density in float. */
static const float VNDF_TRUST_GGX_FACING = 0.05f;

/* ---- bounded normals: on short chords of the disc, at the ends of its extent and where all of u1 gives one normal
 * their density changes within a rounding ---- */

/* Away from the border of the unit square. */
VNDF_INLINE int vndf_trusts_number(float u)
{
    return fabsf(u - 0.5f) < 0.498f;
}

/* The part of the area that is left inside the horizon. */
static const float VNDF_TRUST_BOUNDED_AREA = 0.1f;

/* GGX. wo turns less than the normal by this times roughness and cosine, and the azimuth of the stretched normal by
 * as much more. */
static const float VNDF_TRUST_BOUNDED_REACH = 2.5f, VNDF_TRUST_BOUNDED_REACH_MOST = 0.5f;

/* ---- these thresholds have no share: on both sides the result is good ---- */

/* A value, and the density that divides it: the range of a float. */
static const float VNDF_TRUST_VALUE = 1e37f, VNDF_TRUST_DIVISOR = 1e-30f;

/* wi.wm below which the lengths of wi and wo count, which are 1 but for rounding; they are made 1 there. */
static const double VNDF_TRUST_LENGTHS = 0.04;

/* GGX. The roughness from which the density of the normal is taken, which costs less than the density of wi + wo;
 * nearly all surfaces are on one side of it, so that the branch is foreseen. */
static const float VNDF_TRUST_GGX_ROUGH = 0.4f;

VNDF_INLINE lanes_m vndf_trusts_drawn_ggx(lanes_f ax, lanes_f ay, lanes_f facing)
{
    lanes_m rough = lanes_less(lanes_set(VNDF_TRUST_GGX_ROUGH), lanes_least(ax, ay));
    return lanes_both(rough, vndf_trusts_turn(ax, ay, facing, lanes_set(VNDF_TRUST_TURN)));
}

#endif
