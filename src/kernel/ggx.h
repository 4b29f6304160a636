/* GGX (Trowbridge-Reitz) in the unit problem: w = (vx, vy, vz) is the stretched direction, on either side of the
 * horizon, its length within 1/100 and 100; roughness is 1. By spherical caps (Dupuy & Benyoub,
 * "Sampling Visible GGX Normals with Spherical Caps", HPG 2023) in half angles: a visible normal bisects w and a
 * direction that is uniform on the cap z >= -c. With (s, c) sine and cosine of theta, S and C of theta/2, v = 1 - u2
 * and phi = 2 pi u1 - pi
 *
 *     (w + cap)/(2 C) = (S + T cos(phi), T sin(phi), v C),     T^2 = u2 (S^2 + v C^2),                     (1)
 *     S + T cos(phi) = (S - T) + 2 T sin(pi u1)^2,     S - T = v (S^2 - u2 C^2)/(S + T),
 *
 * homogeneous in S and C: tan(theta/2) = s/(1 + c) = (1 - c)/s gives both without a root. Nothing cancels but where
 * another component dominates, from theta = 0 to 180 degrees. The length n of (1) is (w.n)/C, hence K = 1/(pi C
 * n^2). */
#ifndef VNDF_KERNEL_GGX_H
#define VNDF_KERNEL_GGX_H

#include "kernel/math.h"

/* The azimuth of w; S, C and their squares; the area. */
typedef struct ggx_view {
    real cosine, sine, half_sine, half_cosine, sine2, cosine2, area;
} ggx_view;

/* Of a direction: its azimuth, its length across z, the square of that and L + |vz|, by which areas and half angles are
 * sums. Closer than 1e-10 to z a direction has no azimuth and that length: x is it. */
typedef struct ggx_direction {
    real cosine, sine, across, across2, around;
} ggx_direction;

KERNEL ggx_direction ggx_direction_of(real vx, real vy, real vz)
{
    real across2 = vx * vx + vy * vy, across = max(sqrt(across2), set(1e-10f)), per = 1.0f / across;
    mask leans = lt(set(1e-20f), across2);
    const ggx_direction w = {select(leans, vx * per, set(1.0f)), select(leans, vy * per, set(0.0f)), across,
                             max(across2, set(1e-20f)), sqrt(across2 + vz * vz) + abs(vz)};
    return w;
}

/* The projected area without a difference: (L + vz)/2, below the horizon (L^2 - vz^2)/(2 (L - vz)). Measured: 3e-7. */
KERNEL real ggx_area_of(ggx_direction w, real vz)
{
    return 0.5f * select(lt(vz, set(0.0f)), w.across2 / w.around, w.around);
}

KERNEL real ggx_area(real vx, real vy, real vz)
{
    return ggx_area_of(ggx_direction_of(vx, vy, vz), vz);
}

KERNEL ggx_view ggx_see(real vx, real vy, real vz)
{
    ggx_direction w = ggx_direction_of(vx, vy, vz);
    mask below = lt(vz, set(0.0f));
    real sine = select(below, w.around, w.across), cosine = select(below, w.across, w.around);
    const ggx_view v = {w.cosine, w.sine, sine, cosine, sine * sine, cosine * cosine, ggx_area_of(w, vz)};
    return v;
}

/* P22 of the slope over z^4: D = p22 len^4/|det M|. */
KERNEL real ggx_p22(real x, real y, real z)
{
    real square = (x * x + y * y) + z * z;
    return 0.318309886f / (square * square);
}

/* The factor K of a normal that faces w, facing = w.(x, y, z) > 0. */
KERNEL real ggx_density(ggx_view v, real x, real y, real z, real facing)
{
    real square = (x * x + y * y) + z * z;
    return 0.318309886f * facing / (square * square * v.area);
}

/* (1) times S + T, which spares a division. u1 turns, once about z, from behind w (0) through the side of w (1/2) and
 * round; u2 lowers. The density is that of ggx_density within 1e-6 for 99.9 % of the samples above the horizon, 3e-6
 * below, measured. */
KERNEL normal_sample ggx_draw(ggx_view v, real u1, real u2)
{
    turn half = half_turn(u1);
    real rest = max(1.0f - u2, set(1.49011612e-8f)), t2 = u2 * (v.sine2 + rest * v.cosine2), t = sqrt(t2);
    real sum = v.half_sine + t, twice = 2.0f * (t * sum) * half.sine;
    real along = rest * (v.sine2 - u2 * v.cosine2) + twice * half.sine, aside = -(twice * half.cosine);
    real up = rest * v.half_cosine * sum, square = (along * along + aside * aside) + up * up;
    const normal_sample n = {v.cosine * along - v.sine * aside, v.sine * along + v.cosine * aside, up,
                             0.318309886f / (v.half_cosine * (sum * square))};
    return n;
}

/* The numbers that draw a normal: T and phi are polar coordinates of (1) about (S, 0), and its third part is v C. Each
 * of u2 and 1 - u2 keeps its digits where it is small. Measured: within 1e-6 for u2, 2e-5 for u1. */
KERNEL pair ggx_invert(ggx_view v, real x, real y, real z)
{
    real along = v.cosine * x + v.sine * y, across = v.cosine * y - v.sine * x;
    real facing = 2.0f * (v.half_sine * v.half_cosine) * along +
                  (v.half_cosine - v.half_sine) * (v.half_cosine + v.half_sine) * z;
    real scale = facing / (v.half_cosine * ((along * along + across * across) + z * z));
    real from = scale * along - v.half_sine, aside = scale * across, rest = scale * z / v.half_cosine;
    real part = (from * from + aside * aside) / (v.sine2 + rest * v.cosine2);
    real half = with_sign(0.159154943f * angle_of(abs(aside), from), aside);
    const pair u = {0.5f + half, min(max(select(lt(rest, set(0.5f)), 1.0f - rest, part), set(0.0f)), set(1.0f))};
    return u;
}
#endif
