/* GGX (Trowbridge-Reitz) in the unit problem, by spherical caps (Dupuy & Benyoub, "Sampling Visible GGX Normals
 * with Spherical Caps", HPG 2023) in half angles. Densities: analytic_density.h.
 *
 * The unit problem is what remains of any roughness and direction after the stretch and the rotation about z
 * (design: w = (alpha_x wi.x, alpha_y wi.y, wi.z) / length): roughness 1, incident direction (s, 0, c), s >= 0.
 * s and c are sine and cosine within rounding, c of either sign; each must carry its own relative precision,
 * which is where the precision near c = 0 and c = -1 comes from. Uniform numbers lie in [0, 1].
 *
 * At roughness 1 D is the constant 1/pi, and a visible normal bisects w = (s, 0, c) and a direction that is
 * uniform on the cap z >= -c: with v = 1 - u2 the cap direction has height z = v (1 + c) - c, azimuth phi,
 * and wm is parallel to w + cap. As published this is a difference of nearly equal numbers wherever cap comes
 * close to -w: 0/0 at normal incidence with u2 = 1 and, at grazing and below, noise instead of a normal.
 * With C = cos(theta/2), S = sin(theta/2), that is s = 2 S C, 1 + c = 2 C^2, 1 - c = 2 S^2, the sum is
 *
 *     (w + cap)/(2 C) = (S + T cos(phi), T sin(phi), v C),    T^2 = u2 (1 - u2 C^2) = u2 (S^2 + v C^2)
 *
 * where the factor 2 C, which vanishes at 180 degrees, is gone. With phi = 2 pi u1 - pi
 *
 *     S + T cos(phi) = (S - T) + 2 T sin^2(pi u1),    S - T = v (S^2 - u2 C^2)/(S + T)
 *
 * so nothing cancels except where another component dominates. The length of the sum is (w . wm)/C. */
#ifndef VNDF_SAMPLER_ANALYTIC_GGX_H
#define VNDF_SAMPLER_ANALYTIC_GGX_H

#include <math.h>

#include "math/half_turn.h"
#include "sampler/analytic_density.h"
#include "sampler/analytic/face_repair.h"

/* The uniform numbers that vndf_ggx_sample turns into n, of any length. */
void vndf_ggx_invert(float s, float c, vndf_normal n, float *u1, float *u2);

/* At v = 0 and phi = -pi the sum is (0, 0, 0): a corner of the unit square where the normal turns by a finite
 * angle. A v that is never quite 0 (far below 2^-24, the least that a float u2 < 1 gives) picks the limit. */
static const double vndf_ggx_least_v = 1e-15;

typedef struct vndf_half_angle {
    double sine, cosine;
} vndf_half_angle;

/* sin and cos of theta/2 times sqrt(2) 2^30: the larger by the sum, the smaller by s, so that both keep their
 * digits. The factor is in T and the sum too, where it keeps v C from being a denormal float; otherwise it does
 * not matter. In double, as all from here to the normal: near a corner of the square below the horizon, u1 = 0 or
 * 1 and u2 = 1, roundings of float would come to a dozen steps of u2. */
VNDF_INLINE vndf_half_angle vndf_half_angle_of(float s, float c)
{
    double root = sqrt(0x1p60 + 0x1p60 * fabsf(c)), other = 0x1p60 * s / root;
    vndf_half_angle h = {c < 0.0f ? root : other, c < 0.0f ? other : root};
    return h;
}

/* A visible normal, its length from 5e-7 to 4e9: z >= 0, s x + c z >= 0. u2 lowers and u1 turns, once about z from
 * azimuth -pi to pi, the direction that mirrors (s, 0, c) in the normal; the map is continuous, and u1 = 0 and 1
 * coincide. */
VNDF_INLINE vndf_vec3 vndf_ggx_sample(float s, float c, float u1, float u2)
{
    vndf_half_angle h = vndf_half_angle_of(s, c);
    vndf_turn turn = vndf_half_turn(u1);
    double v = u2 < 1.0f ? 1.0 - u2 : vndf_ggx_least_v;
    double s2 = h.sine * h.sine, c2 = h.cosine * h.cosine;
    double t = sqrt(u2 * (s2 + v * c2)), twice = 2.0 * t * turn.sine;
    /* The small term keeps normal incidence with u2 = 0 from being 0/0; the numerator is 0 there. */
    double x = v * (s2 - u2 * c2) / (h.sine + t + 1e-30) + twice * turn.sine;
    vndf_vec3 n = {(float)x, (float)(-twice * turn.cosine), (float)(v * h.cosine)};
    return vndf_face(s, c, n);
}

#endif
