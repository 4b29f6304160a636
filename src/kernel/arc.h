/* The azimuth of a normal, given the length of its slope: Kepler's equation.
 *
 * A normal (x cos a, x sin a, z) of the unit problem is seen from (s, 0, c) by c z + s x cos a, where that is above 0:
 * for |a| < A. Divided by |c| z + s x this is cc + ss cos a, ss + |cc| = 1. From the end of the arc, d = A - a, it is
 *
 *     p + q sin d + r (1 - cos d),        p = max(cc - ss, 0), q = sqrt(max(ss - cc, 0)), r = min(cc, ss),
 *
 * above the horizon, a sum of positive terms, and q sin d - |cc| (1 - cos d) below it. The mass of half the arc is T =
 * cc A + q, and u of it lies beyond a where
 *
 *     F(d) = p d + q (1 - cos d) + r (d - sin d) = u T.
 *
 * The start follows Kepler's equation where one of its terms is alone: v^2/d^2 is a sum of theirs, with coefficients
 * fitted for the least largest relative error where v >= 0.004, within 8% (tools/evidence/fits.py). One step of
 * Householder's of order three follows. |F(d)/T - u| is at most 2e-5, where the eccentricity is near 1 and u small, and
 * 1e-7 in the mean (tests/sampler/test_invert.c). */
#ifndef VNDF_KERNEL_ARC_H
#define VNDF_KERNEL_ARC_H

#include "kernel/math.h"

/* The constants above for one slope length; all but A and sum are over `sum`. */
typedef struct arc {
    real cc, p, q, q2, r;
    real length, mass; /* A and T */
    real sum;          /* |c| z + s x */
} arc;

/* From cz = |c| z, sx = s x and edge = sx - cz, which keeps its digits where it is small. */
KERNEL arc arc_of(real cz, real sx, real edge, const int below)
{
    real sum = cz + sx, reach = sqrt(max(edge, set(0.0f)) * sum), per = 1.0f / sum;
    real cc = cz * per, e = edge * per, q = min(reach * per, set(1.0f)), q2 = min(max(e, set(0.0f)), set(1.0f));
    if (below) {
        q = max(q, set(1e-5f)); /* cubes of q occur */
        q2 = max(q2, set(1e-10f));
    }
    real g = arc_rest(q2), bend = 2.0f * q * (1.0f - q2 * g), rest = (q * q2) * (1.0f + g * (1.0f - q2));
    arc k = {cc, max(-e, set(0.0f)), q, q2, min(cc, sx * per), 3.14159265f - bend, 3.14159265f * cc + rest, sum};
    if (below) {
        k.cc = -cc;
        k.p = set(0.0f);
        k.r = -cc;
        k.length = bend;
        k.mass = rest;
    }
    return k;
}

/* 1/sqrt(x) within 0.2%, from the bits of x > 0 and one step of Newton's. */
KERNEL real arc_inverse_root(real x)
{
    real y = of_bits(0x5f375a86 - bits(x) / 2);
    return y * (1.5f - 0.5f * x * (y * y));
}

/* x^(2/3) within 5%, x >= 0, from the bits of x. */
KERNEL real arc_two_thirds(real x)
{
    return of_bits(to_int(to_real(bits(x)) * 0.666666667f + 355.0e6f));
}

/* A d with F(d) near v T, from v^2/d^2 as a sum of the powers of v that the terms of F have alone. */
KERNEL real arc_start(arc k, real v, const int below)
{
    real v2 = v * v, p = k.p, t = k.q2;
    if (below) {
        real inverse = (1.43172f * v - 0.461627f * v2) + t * (0.628066f * v + 0.071245f * v2);
        return (2.0f * k.q * v) * arc_inverse_root(inverse);
    }
    real v43 = arc_two_thirds(v2),
         inverse = (0.151813f * v43 - 0.050724f * v2) + t * (-0.122628f * v43 - 0.12813f * v2);
    real p2 = p * p, straight = (0.390562f - 0.568917f * p) + p2 * 0.280348f;
    inverse = (inverse + p * (0.024493f * v2 - 0.118976f * v43)) + p2 * straight;
    inverse = inverse + k.q * (0.248745f * v + (0.285757f * v) * t);
    return v * arc_inverse_root(max(inverse, set(1e-36f)));
}

/* Of a normal at azimuth a: ss cos a, ss sin a, and its visible part cc + ss cos a. */
typedef struct azimuth {
    real cosine, sine, visible;
} azimuth;

/* sqrt(2) sin(d/2)/d from d^2, 0 <= d <= pi; least largest relative error: 6e-9. */
KERNEL real arc_sine(real d2)
{
    real d4 = d2 * d2;
    return (0.707106778f - 0.0294627649f * d2) +
           d4 * ((0.000368271161f - 2.18843126e-6f * d2) + d4 * 7.18680978e-9f);
}

/* sin d and 1 - cos d, 0 <= d <= pi, both with their digits where they are small. */
KERNEL turn arc_turn(real d)
{
    real rest = 3.14159265f - d, sine = d * arc_sine(d * d), cosine = rest * arc_sine(rest * rest);
    const turn t = {sine * cosine, sine * sine};
    return t;
}

/* One step from d. With P = q sin d - r cos d and Q = q cos d + r sin d the derivatives of F are cc + P, Q, -P; all are
 * turned by the step. */
KERNEL azimuth arc_step(arc k, real d, real goal)
{
    turn t = arc_turn(d);
    real sn = t.sine, vs = t.cosine, cs = 1.0f - vs, f1 = k.p + (k.q * sn + k.r * vs);
    real f = ((k.p * d - goal) + k.q * vs) + k.r * (d - sn);
    real p = k.q * sn - k.r * cs, q = k.q * cs + k.r * sn, fq = f * q, f12 = f1 * f1;
    real below = f1 * (f12 - fq) - (f * f * (p * 0.166666667f) - 1e-36f), step = f * (0.5f * fq - f12) / below;
    step = max(min(step, min(set(0.25f), k.length - d)), max(set(-0.25f), -d));
    real s2 = step * step, ds = 1.0f - s2 * 0.166666667f, dc = step * (0.5f - s2 * 0.0416666667f);
    real more = step * (q * ds - p * dc);
    azimuth a = {p + more, q - step * (q * dc + p * ds), f1 + more};
    return a;
}

/* u1 runs from behind wi (0) along one side to the azimuth of wi (1/2), and along the other side behind it again (1).
 * v in [0, 1] is the fraction of the half arc. */
KERNEL real arc_half(real u1)
{
    return 2.0f * min(u1, 1.0f - u1);
}

KERNEL azimuth arc_side(azimuth bare, real u1)
{
    azimuth a = bare;
    a.sine = with_sign(a.sine, u1 - 0.5f);
    return a;
}

KERNEL azimuth arc_draw(arc k, real u1, const int below)
{
    real v = arc_half(u1);
    return arc_side(arc_step(k, arc_start(k, v, below), v * k.mass), u1);
}

/* u1 of a normal whose azimuth has this cosine and sine, up to a common positive factor. */
KERNEL real arc_invert(arc k, real along, real aside)
{
    real d = max(k.length - angle_of(abs(aside), along), set(0.0f));
    turn t = arc_turn(d);
    real v = min(((k.p * d + k.q * t.cosine) + k.r * (d - t.sine)) / k.mass, set(1.0f)) * 0.5f;
    return select(lt(aside, set(0.0f)), v, 1.0f - v);
}

#endif
