/* One scattering event at a microfacet, and what masks it. The density of wo is that of the normal wm times the
 * Jacobian (Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, equations 14 and
 * 17), r the index beyond over that on the side of wi,
 *
 *     reflection     dwm/dwo = 1/(4 wi.wm),        transmission    dwm/dwo = r^2 |wo.wm|/|wi + r wo|^2,
 *
 * so with G = G2/(wi' wo'), primes for projections on the mean plane, f is F G D (wi.wm) dwm/dwo and (1 - F) of
 * it, and the weight of a sample F G wo' (D (wi.wm)/density of wm): the Jacobians cancel. Text for one double
 * (bsdf/bsdf.h) or one float. */
#ifndef VNDF_KERNEL_LOBES_H
#define VNDF_KERNEL_LOBES_H

#include "kernel/fresnel.h"

#ifndef VNDF_BSDF_BSDF_H /* what that page has for itself */

#  include "kernel/math.h"

/* x rounded to the precision of the normals. */
KERNEL real narrow(real x)
{
    return x;
}

/* log(1 + x), x >= 0. */
KERNEL real log_beyond(real x)
{
    return select(lt(x, set(0.4f)), log_near(min(x, set(0.4f))), log_of(1.0f + x));
}

#endif

#ifndef VNDF_KERNEL_DIRECTION /* where it is another type's name */
typedef struct direction {
    real x, y, z;
} direction;
#endif

KERNEL real dot_of(direction a, direction b)
{
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

/* A microfacet between two directions: its normal, on the side of wi; wo, or of transmission -wo; the projection
 * of that on the mean plane, which is up.z until who knows a mean slope changes it; the sizes of the cosines of
 * both to the normal; 1 - wi.wm; dwm/dwo; and whether there is one, which NaN is not. */
typedef struct event {
    direction wm, up;
    real rise, facing, beyond, rest, jacobian;
    mask met;
} event;

/* ---- at a drawn normal ---- */

/* wi.wm and 1 - wi.wm. Near 1 the second keeps the digits, which Schlick's term is a power of. */
typedef struct seen_cosine {
    real facing, rest;
} seen_cosine;

KERNEL seen_cosine seen_cosine_of(direction wi, direction wm)
{
    real dot = dot_of(wi, wm);
    seen_cosine s = {dot, 1.0f - dot};
    mask near = lt(set(0.9f), dot);
    if (any(near)) {
        real x = wi.x - wm.x, y = wi.y - wm.y, z = wi.z - wm.z;
        s.rest = select(near, 0.5f * ((x * x + y * y) + z * z), s.rest);
        s.facing = select(near, 1.0f - s.rest, dot);
    }
    return s;
}

KERNEL event reflected_at(direction wi, direction wm, seen_cosine c)
{
    real twice = 2.0f * c.facing;
    event e;
    e.wm = wm;
    e.up.x = narrow(twice * wm.x - wi.x);
    e.up.y = narrow(twice * wm.y - wi.y);
    e.up.z = narrow(twice * wm.z - wi.z);
    e.rise = e.up.z;
    e.facing = c.facing;
    e.beyond = c.facing;
    e.rest = c.rest;
    e.jacobian = 0.25f / c.facing;
    e.met = lt(set(0.0f), c.facing);
    return e;
}

/* wi + r (-up) = along wm, along = (r^2 - 1)/(wi.wm + r |wo.wm|), which keeps its digits where r is near 1. A
 * ratio of 1 leaves wi as it is, and has no Jacobian. */
KERNEL event refracted_at(direction wi, direction wm, seen_cosine c, real eta)
{
    real square = refracted_square(c.facing, eta), beyond = sqrt(max(square, set(0.0f)));
    real along = (eta - 1.0f) * (eta + 1.0f) / (c.facing + eta * beyond), per = 1.0f / eta;
    event e;
    e.wm = wm;
    e.up.x = narrow((wi.x + along * wm.x) * per);
    e.up.y = narrow((wi.y + along * wm.y) * per);
    e.up.z = narrow((wi.z + along * wm.z) * per);
    e.rise = e.up.z;
    e.facing = c.facing;
    e.beyond = beyond;
    e.rest = c.rest;
    e.jacobian = eta * eta * beyond / (along * along);
    e.met = both(lt(set(0.0f), c.facing), lt(set(0.0f), square));
    return e;
}

/* ---- of two directions ---- */

/* At grazing wi + wo is short, so an error of the length of wo would tilt wm: wo is rescaled to |wi|. */
KERNEL event reflecting(direction wi, direction wo)
{
    real longer = 0.5f * (dot_of(wi, wi) - dot_of(wo, wo));
    real x = (wi.x + wo.x) + longer * wo.x, y = (wi.y + wo.y) + longer * wo.y, z = (wi.z + wo.z) + longer * wo.z;
    real square = (x * x + y * y) + z * z, per = 1.0f / sqrt(square);
    event e;
    e.wm.x = narrow(x * per);
    e.wm.y = narrow(y * per);
    e.wm.z = narrow(z * per);
    e.up = wo;
    e.rise = wo.z;
    e.facing = dot_of(wi, e.wm);
    e.beyond = e.facing;
    e.rest = 1.0f - e.facing;
    e.jacobian = 0.25f / e.facing;
    e.met = both(both(lt(set(0.0f), square), le(set(0.0f), z)), lt(set(0.0f), e.facing));
    return e;
}

/* Its 1 - wi.wm with all digits, for Fresnel's terms: from the sine of half the turn from wi to wo. */
KERNEL real reflecting_rest(event e, direction wi, direction wo)
{
    real rest = e.rest;
    mask near = lt(rest, set(0.1f));
    if (any(near)) {
        real x = wi.x - wo.x, y = wi.y - wo.y, z = wi.z - wo.z;
        real sine2 = min(0.25f * ((x * x + y * y) + z * z), set(1.0f));
        rest = select(near, sine2 / (1.0f + sqrt(1.0f - sine2)), rest);
    }
    return rest;
}

/* up = -wo. Where wi + r wo is small an error of a length matters, so both lengths are made 1. A normal so steep that
 * its z is less than the rounding of wo has lost its sign: it faces wi, and its z is that rounding, where D is finite;
 * of a tail of r^-3.2 these are some percent of what is drawn. */
KERNEL event refracting(direction wi, direction up, real eta)
{
    real i = 1.0f / sqrt(dot_of(wi, wi)), o = 1.0f / sqrt(dot_of(up, up)), change = eta - 1.0f;
    real ix = wi.x * i, iy = wi.y * i, iz = wi.z * i, ox = up.x * o, oy = up.y * o, oz = up.z * o;
    real x = (ix - ox) - change * ox, y = (iy - oy) - change * oy, z = (iz - oz) - change * oz;
    real round = (1.0f + eta) * 1.1920929e-7f;
    z = select(lt(abs(z), round), with_sign(round, (ix * x + iy * y) + iz * z), z);
    real square = (x * x + y * y) + z * z, per = with_sign(1.0f / sqrt(square), z);
    event e;
    e.wm.x = narrow(x * per);
    e.wm.y = narrow(y * per);
    e.wm.z = narrow(z * per);
    e.up = up;
    e.rise = up.z;
    e.facing = ((ix * x + iy * y) + iz * z) * per;
    e.beyond = ((ox * x + oy * y) + oz * z) * per;
    e.rest = 1.0f - e.facing;
    e.jacobian = eta * eta * e.beyond / square;
    mask faces = both(lt(set(0.0f), e.facing), lt(set(0.0f), e.beyond));
    e.met = both(both(lt(set(0.0f), square), lt(set(0.0f), abs(change))), faces);
    return e;
}

/* ---- masking ----
 *
 * G = G2/(cos_i cos_o) of projections cos_i and cos_o on the mean plane, in terms of projected areas A = cos (1 +
 * Lambda) along a direction and B = cos Lambda along its opposite (Heitz, "Understanding the Masking-Shadowing
 * Function in Microfacet-Based BRDFs", JCGT 2014, equations 98 and 99): it is finite where a cosine vanishes, as A
 * is. */

/* 1/(cos_i cos_o (1 + Lambda_i + Lambda_o)), at most 1/(cos_o A_i), so that no weight of visible normals exceeds
 * 1. */
KERNEL real masked_by_height(real cos_i, real cos_o, real area_i, real area_o)
{
    return 1.0f / (cos_o * area_i + cos_i * max(area_o - cos_o, set(0.0f)));
}

KERNEL real masked_apart(real area_i, real area_o)
{
    return 1.0f / (area_i * area_o);
}

/* G1 of V-cavities, exactly 1 where nothing hides. */
KERNEL real in_cavity(real cosine, real facing, real cos_m)
{
    return min(2.0f * cos_m * cosine / facing, set(1.0f));
}

/* V-cavities mask by the smaller G1: what it shows, the other shows, too. */
KERNEL real masked_in_cavities(real cos_i, real cos_o, real facing, real cos_m)
{
    return min(in_cavity(cos_i, facing, cos_m), in_cavity(cos_o, facing, cos_m)) / (cos_i * cos_o);
}

/* From above the upper part of a side is seen, from below the lower one. */
KERNEL real passed_in_cavities(real cos_i, real cos_o, real facing, real beyond, real cos_m)
{
    real i = in_cavity(cos_i, facing, cos_m), o = in_cavity(cos_o, beyond, cos_m);
    return max(min(i, o) - (1.0f - max(i, o)), set(0.0f)) / (cos_i * cos_o);
}

/* ---- transmission, masked by height: Euler's Beta function ----
 *
 * Heights are u^(1/Lambda_i) distributed from above and (1 - u)^(1/Lambda_o) from below: the part of the
 * microfacets that both see is Beta(1 + Lambda_i, 1 + Lambda_o). With s = a + b, by Stirling's formula with a
 * factor G that makes it exact,
 *
 *     Gamma(x) = sqrt(2 pi) x^(x - 1/2) e^-x G(x),    G(x) = P(1/x)/Q(1/x) for x >= 1,
 *     Beta = sqrt(2 pi/s) G(a) G(b)/G(s) exp(-(a - 1/2) log(s/a) - (b - 1/2) log(s/b)).
 *
 * P and Q are cubic: G meets Gamma in six Chebyshev nodes of 1/x in (0, 1]; error 3.3e-9. With a >= b nothing of the
 * size of a cancels where log(s/a) is taken as log(1 + b/a). Where a and b are at most 3, which is where most light
 * passes, 1/Gamma is a polynomial through Chebyshev's nodes: a division and no logarithm; error 3.4e-9
 * (tools/evidence/fits.py). */

/* 1/Gamma(2 + v), |v| <= 1. */
KERNEL real per_gamma_low(real v)
{
    real v2 = v * v, v4 = v2 * v2;
    real a =
        (0.9999999993501139 + v * -0.42278433500756674) + v2 * (-0.23309368962807794 + v * 0.1910910948396736);
    real b = (-0.02455303604654195 + v * -0.017645167964305042) +
             v2 * (0.00802560377377868 + v * -0.0008046582377240052);
    real c = (-0.0003653361620208507 + v * 0.0001462358384124983) +
             v2 * (-1.3541934633449767e-05 + v * -3.1693808145962135e-06);
    return a + v4 * (b + v4 * c);
}

/* 1/Gamma(4 + v), |v| <= 2. */
KERNEL real per_gamma_high(real v)
{
    real v2 = v * v, v4 = v2 * v2, v8 = v4 * v4;
    real a =
        (0.16666666666666666 + v * -0.209352944650567) + v2 * (0.10783405343248284 + v * -0.023121037898835104);
    real b = (-0.002796893186094228 + v * 0.0032433801014373174) +
             v2 * (-0.0008994526894948745 + v * 7.492028646892942e-05);
    real c = (2.7330790824423336e-05 + v * -1.0992298267446304e-05) +
             v2 * (1.684827570761271e-06 + v * -5.10137902934449e-09);
    real d = (-5.539813856859537e-08 + v * 1.3073312724041908e-08) +
             v2 * (-1.155521796658847e-09 + v * -1.737361601000305e-10);
    return (a + v4 * b) + v8 * (c + v4 * (d + v4 * 4.4957524034074456e-11));
}

/* G of 1/per, over a divisor. */
typedef struct gamma_factor {
    real over, under;
} gamma_factor;

KERNEL gamma_factor gamma_factor_at(real per)
{
    real square = per * per;
    const gamma_factor g = {
        (1.0f + 0.877274526231992049 * per) + square * (0.461868317211344979 + 0.0465154620075117628 * per),
        (1.0f + 0.793941164930515474 * per) + square * (0.392236399396363733 + 0.0137262470011538833 * per)};
    return g;
}

/* a >= b >= 1. */
KERNEL real beta_beyond(real a, real b)
{
    real s = a + b, per_a = 1.0f / a;
    real fall = exp_of(-((a - 0.5f) * log_beyond(b * per_a) + (b - 0.5f) * log_of(s / b)));
    gamma_factor at_a = gamma_factor_at(per_a), at_b = gamma_factor_at(1.0f / b), at_s = gamma_factor_at(1.0f / s);
    real over = 2.5066282746310005 * (at_a.over * at_b.over) * at_s.under;
    return fall * over / (at_a.under * at_b.under * at_s.over * sqrt(s));
}

/* Beta(x, y), x and y from 1 to infinity; with bsdf/bsdf.h the relative error is below 2e-8 where it exceeds
 * 1e-37. */
KERNEL real beta_of(real x, real y)
{
    real a = max(x, y), b = min(x, y), value = set(0.0f);
    mask near = le(a, set(3.0f)), far = both(lt(set(3.0f), a), lt(a, set(1e37f)));
    if (any(near)) {
        real p = min(a, set(3.0f)), q = min(b, set(3.0f));
        real under = per_gamma_low(p - 2.0f) * per_gamma_low(q - 2.0f);
        value = select(near, per_gamma_high((p - 4.0f) + q) / under, value);
    }
    if (any(far))
        value = select(far, beta_beyond(min(a, set(1e37f)), min(b, set(1e37f))), value);
    return value;
}

/* G of transmission. */
KERNEL real passed_by_height(real cos_i, real cos_o, real area_i, real area_o)
{
    real i = max(area_i / cos_i, set(1.0f)), o = max(area_o / cos_o, set(1.0f));
    return beta_of(i, o) / (cos_i * cos_o);
}

#endif
