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
 * The start follows Kepler's equation where one of its terms is alone: d^-2 is a sum of theirs, right at both ends,
 * within 8% between. One step of Householder's of order three follows. |F(d)/T - u| is at most 2e-5, where the
 * eccentricity is near 1 and u small, and 1e-7 in the mean (tests/sampler/test_kepler.c). */
#ifndef VNDF_KERNEL_ARC_H
#define VNDF_KERNEL_ARC_H

#include "kernel/math.h"

/* Of a slope: what is above, its arc A and half mass T, all over `sum`. */
typedef struct arc {
    real cc, p, q, r;
    real length, mass; /* A and T */
    real sum;          /* |c| z + s x */
} arc;

/* From cz = |c| z, sx = s x and edge = sx - cz, which keeps its digits where it is small. */
HERE arc arc_of(real cz, real sx, real edge, const int below)
{
    real sum = cz + sx, per = 1.0f / sum, cc = cz * per, ss = sx * per, e = edge * per;
    real q2 = least(most(e, set(0.0f)), set(1.0f));
    if (below)
        q2 = most(q2, set(1e-10f)); /* cubes of q^2 occur */
    real q = root(q2), g = arc_rest(q2), bend = 2.0f * q * (1.0f - q2 * g);
    arc k = {cc, most(-e, set(0.0f)), q, least(cc, ss), 3.14159265f - bend, cc, sum};
    k.mass = cc * k.length + q;
    if (below) {
        k.cc = -cc;
        k.p = set(0.0f);
        k.r = -cc;
        k.length = bend;
        k.mass = q * q2 * (1.0f + g * (1.0f - q2));
    }
    return k;
}

/* 1/sqrt(x) within 0.2%, from the bits of x > 0 and one step of Newton's. */
HERE real arc_inverse_root(real x)
{
    real y = of_bits(0x5f375a86 - bits(x) / 2);
    return y * (1.5f - 0.5f * x * (y * y));
}

/* x^(2/3) within 5%, x >= 0, from the bits of x. */
HERE real arc_two_thirds(real x)
{
    return of_bits(to_whole(to_real(bits(x)) * 0.666666667f + 355.0e6f));
}

/* A d with F(d) near v T. */
HERE real arc_start(arc k, real v, const int below)
{
    real goal = v * k.mass, slope = k.mass / k.length, half = 0.5f * k.q, begin = half * goal, end = half * k.mass;
    if (!below) {
        real pp = k.p * k.p, r6 = k.r * 0.166666667f;
        begin = begin + pp + arc_two_thirds(r6 * (goal * goal));
        end = end + pp + arc_two_thirds(r6 * (k.mass * k.mass));
    }
    real inverse = most(begin + (slope * slope - end) * (v * v), set(1e-36f));
    return least(goal * arc_inverse_root(inverse), k.length);
}

/* Of a normal at azimuth a: ss cos a, ss sin a, and cc + ss cos a, which is what is seen of it. */
typedef struct bearing {
    real along, aside, facing;
} bearing;

/* sin(h)/h from h^2, |h| <= pi/2; relative error 6e-9. */
HERE real arc_sine(real h2)
{
    real h4 = h2 * h2;
    return (0.999999995f - 0.166666567f * h2) + h4 * ((0.00833302514f - 0.000198074187f * h2) + h4 * 2.60190307e-6f);
}

/* One step from d. With P = q sin d - r cos d and Q = q cos d + r sin d the derivatives of F are cc + P, Q, -P; all are
 * turned by the step. */
HERE bearing arc_step(arc k, real d, real goal)
{
    real h = 0.5f * d, rest = 1.57079633f - h, sine = h * arc_sine(h * h), cosine = rest * arc_sine(rest * rest);
    real sn = 2.0f * sine * cosine, vs = 2.0f * sine * sine, cs = 1.0f - vs;
    real f = (k.p * d + k.q * vs) + k.r * (d - sn) - goal, f1 = k.p + (k.q * sn + k.r * vs);
    real p = k.q * sn - k.r * cs, q = k.q * cs + k.r * sn, fq = f * q, f12 = f1 * f1;
    real step = f * (0.5f * fq - f12) / (f1 * (f12 - fq) - f * f * (p * 0.166666667f) + 1e-36f);
    step = most(least(step, set(0.25f)), set(-0.25f));
    step = most(least(step, k.length - d), -d);
    real s2 = step * step, ds = step - step * s2 * 0.166666667f, dc = s2 * (0.5f - s2 * 0.0416666667f);
    bearing a = {p - p * dc + q * ds, q - q * dc - p * ds, f1 - p * dc + q * ds};
    return a;
}

/* The azimuth that u1 stands for: from behind wi (0) on one side through that of wi (1/2) to behind it on the other. */
HERE bearing arc_draw(arc k, real u1, const int below)
{
    real v = 2.0f * least(u1, 1.0f - u1);
    bearing a = arc_step(k, arc_start(k, v, below), v * k.mass);
    a.aside = with_sign(a.aside, u1 - 0.5f);
    return a;
}

/* The number u1 of a normal whose azimuth has this cosine and sine, both times a positive number. */
HERE real arc_invert(arc k, real along, real aside)
{
    real d = most(k.length - angle_of(size(aside), along), set(0.0f)), h = 0.5f * d, rest = 1.57079633f - h;
    real sine = h * arc_sine(h * h), sn = 2.0f * sine * (rest * arc_sine(rest * rest)), vs = 2.0f * sine * sine;
    real v = least(((k.p * d + k.q * vs) + k.r * (d - sn)) / k.mass, set(1.0f)) * 0.5f;
    return pick(less(aside, set(0.0f)), v, 1.0f - v);
}

#endif
