/* A reflection in float, for one or for lanes: the direction, whether its density may stand (trust.h), its density, and
 * the weight of a bare one. The scattering of one sample (lobes/scatter.h) and of a block (batch/lanes_scatter.c) are
 * made of these. */
#ifndef VNDF_BSDF_TERMS_EVENT_H
#define VNDF_BSDF_TERMS_EVENT_H

#include "bsdf/trust.h"
#include "sampler/law.h"
#include "vndf_bsdf.h"

/* A vector, lane by lane. */
#if VNDF_LANES == 1
typedef vndf_vec3 vndf_vec3_lanes;
#else
typedef struct vndf_vec3_lanes {
    lanes_f x, y, z;
} vndf_vec3_lanes;
#endif

/* The numbers of a hit that float reads. */
typedef struct vndf_incident {
    const vndf_distribution *distribution;
    vndf_vec3_lanes wi;
    lanes_f ax, ay, area;
    float turn;
    lanes_m trusted; /* whether the view is */
} vndf_incident;

/* A drawn normal: facing = wi.wm, quotient = D(wm) facing/density; and the second uniform number. */
typedef struct vndf_bsdf_normal {
    vndf_vec3_lanes wm;
    lanes_f density, facing, quotient, u2;
} vndf_bsdf_normal;

/* The choices of a routine, constants. */
typedef struct vndf_choice {
    vndf_normals_drawn normals;
    int bare;   /* no Fresnel term, height-correlated masking, seen from above alone */
    int turned; /* the hit is turned to its principal axes, and wo back from there (lobes/scatter.h) */
} vndf_choice;

/* ---- the direction ---- */

/* wi mirrored at wm. An error of `facing` or of the length of wm is one of the length of wo: wm stays the half
 * vector. Where the surface is smooth 2 facing wm.x is small, and so is its rounding. */
VNDF_INLINE vndf_vec3_lanes vndf_reflected(vndf_vec3_lanes wi, vndf_vec3_lanes wm, lanes_f facing)
{
    lanes_f twice = 2.0f * facing;
    vndf_vec3_lanes wo = {twice * wm.x - wi.x, twice * wm.y - wi.y, twice * wm.z - wi.z};
    return wo;
}

/* ---- trust ---- */

/* Whether wo stands for a normal on the same side of wi, in front or in the wedge. */
VNDF_INLINE lanes_m vndf_keeps_side(const vndf_incident *at, const vndf_bsdf_normal *n, lanes_f gain)
{
    vndf_vec3_lanes i = at->wi, m = n->wm;
    return vndf_trusts_wo_side(i.x * m.x + i.y * m.y, i.x * i.x + i.y * i.y, gain);
}

/* Whether the slope that wo stands for is the one that was drawn; `gain` is how far wo turns with the normal. */
VNDF_INLINE lanes_m vndf_is_settled(const vndf_incident *at, const vndf_bsdf_normal *n, lanes_f gain)
{
    lanes_f turn = lanes_set(at->turn), x = n->wm.x, y = n->wm.y;
    lanes_m steeper = vndf_law_is_steeper(at->distribution, at->ax, at->ay, x, y);
    turn = lanes_pick(steeper, turn * VNDF_TRUST_STEEPER, turn);
    lanes_m turns = lanes_both(vndf_trusts_turn(at->ax, at->ay, gain, turn), vndf_trusts_pole(x, y, gain));
    turns = lanes_both(turns, vndf_keeps_side(at, n, gain));
    return lanes_both(turns, lanes_less(n->u2, lanes_set(VNDF_TRUST_LAST)));
}

/* How far a refraction turns with wm, by which vndf_is_settled asks; `turn` = |along|/eta. */
VNDF_INLINE lanes_f vndf_refraction_gain(lanes_f turn, lanes_f z)
{
    return VNDF_TRUST_REFRACTION_GAIN * turn * z;
}

/* Whether the sample takes the density of its normal, and whether it is trusted with any density in float. */
typedef struct vndf_reflection_trust {
    lanes_m as_drawn, trusted;
} vndf_reflection_trust;

/* Whether vndf_ggx_density_of may stand: nothing underflows in a trusted view. */
VNDF_INLINE lanes_m vndf_has_ggx_density(const vndf_incident *at, lanes_f facing, vndf_choice choice)
{
    if (choice.normals != VNDF_NORMALS_VISIBLE || !vndf_law_is_ggx(at->distribution))
        return lanes_none();
    return lanes_both(at->trusted, lanes_less(lanes_set(VNDF_TRUST_GGX_FACING), facing));
}

VNDF_INLINE vndf_reflection_trust vndf_trust_reflection(const vndf_incident *at, const vndf_bsdf_normal *n,
                                                        vndf_choice choice)
{
    lanes_m of_wo = vndf_has_ggx_density(at, n->facing, choice), without = lanes_without(lanes_all(), of_wo);
    vndf_reflection_trust trust = {lanes_none(), lanes_less(lanes_set(VNDF_TRUST_REFLECTION_FACING), n->facing)};
    if (lanes_any(of_wo))
        trust.as_drawn = lanes_both(of_wo, vndf_trusts_drawn_ggx(at->ax, at->ay, n->facing));
    if (lanes_any(without))
        trust.as_drawn = lanes_either(trust.as_drawn, lanes_both(without, vndf_is_settled(at, n, n->facing)));
    if (choice.bare)
        trust.trusted = lanes_either(trust.trusted, of_wo);
    trust.trusted = lanes_both(trust.trusted, lanes_either(trust.as_drawn, of_wo));
    return trust;
}

/* ---- density and weight ---- */

VNDF_INLINE vndf_vec3_lanes vndf_sum(vndf_vec3_lanes a, vndf_vec3_lanes b)
{
    vndf_vec3_lanes sum = {a.x + b.x, a.y + b.y, a.z + b.z};
    return sum;
}

/* Visible normals of GGX reflect to wo with the density D(wm)/(4 A(wi)). With H = wi + wo, each part of which is a sum
 * of two floats and so exact but for one rounding, and a = ax ay,
 *
 *     D(wm) = a t^2/pi,    t = a |H|^2/((ay Hx)^2 + (ax Hy)^2 + (a Hz)^2).
 *
 * So it is the density of the rounded wo, however smooth the surface is; relative error below 2e-6. */
VNDF_INLINE lanes_f vndf_ggx_density_of(const vndf_incident *at, vndf_vec3_lanes h)
{
    lanes_f a = at->ax * at->ay, p = at->ay * h.x, q = at->ax * h.y, r = a * h.z;
    lanes_f t = a * (h.x * h.x + h.y * h.y + h.z * h.z) / (p * p + q * q + r * r);
    return 0.0795774715f * a / at->area * (t * t);
}

/* The density of a trusted reflection, h = wi + wo. */
VNDF_INLINE lanes_f vndf_reflected_density(const vndf_incident *at, const vndf_bsdf_normal *n, vndf_vec3_lanes h,
                                           lanes_m as_drawn)
{
    if (!vndf_law_is_ggx(at->distribution) || !lanes_any(lanes_without(lanes_all(), as_drawn)))
        return 0.25f * n->density / n->facing;
    if (!lanes_any(as_drawn))
        return vndf_ggx_density_of(at, h);
    return lanes_pick(as_drawn, 0.25f * n->density / n->facing, vndf_ggx_density_of(at, h));
}

/* cos_i cos_o/G2, height-correlated (masking.h); `area` is that of wo. */
VNDF_INLINE lanes_f vndf_unmasked(const vndf_incident *at, vndf_vec3_lanes wo, lanes_f area)
{
    return wo.z * at->area + at->wi.z * lanes_positive(area - wo.z);
}

#endif
