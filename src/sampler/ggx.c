/* GGX by spherical caps (Dupuy & Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023), in
 * half angles.
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
 * so nothing cancels except where another component dominates. The length of the sum is (w . wm)/C.
 *
 * D and Dv of the real problem need no unit problem: with a = alpha_x alpha_y
 *
 *     D(wm) = a^3/(pi Q^2),    Q = (alpha_y wm.x)^2 + (alpha_x wm.y)^2 + (a wm.z)^2
 *
 * where nothing is divided before the end, and double overflows nowhere for alpha within [1e-18, 1e18]. */
#include "sampler/ggx.h"

#include <math.h>

#include "math/half_turn.h"
#include "math/vector.h"
#include "sampler/facing.h"

static const double inverse_pi = 0.31830988618379067;

/* At v = 0 and phi = -pi the sum is (0, 0, 0): a corner of the unit square where the normal turns by a finite
 * angle. A v that is never quite 0 (far below 2^-24, the least that a float u2 < 1 gives) picks the limit. */
static const double least_v = 1e-15;

typedef struct half_angle {
    double sine, cosine;
} half_angle;

/* sin and cos of theta/2 times sqrt(2): the larger by the sum, the smaller by s, so that both keep their digits.
 * In double, as all from here to the normal: near a corner of the square below the horizon, u1 = 0 or 1 and u2 = 1,
 * roundings of float would come to a dozen steps of u2. */
static half_angle half_angle_of(float s, float c)
{
    double root = sqrt(1.0 + fabsf(c)), other = s / root;
    half_angle h = {c < 0.0f ? root : other, c < 0.0f ? other : root};
    return h;
}

float vndf_ggx_area(float s, float c)
{
    return c < 0.0f ? 0.5f * s * (s / (1.0f - c)) : 0.5f * (1.0f + c);
}

double vndf_ggx_p22(double r2)
{
    double q = 1.0 + r2;
    return inverse_pi / (q * q);
}

double vndf_ggx_ndf(double alpha_x, double alpha_y, vndf_normal wm)
{
    double a = alpha_x * alpha_y, x = alpha_y * wm.x, y = alpha_x * wm.y, z = a * wm.z;
    double q = x * x + y * y + z * z;
    return inverse_pi * (a * a * a) / (q * q);
}

/* In double s^2 does not underflow, so the area stands in full at every angle below 180 degrees. */
double vndf_ggx_visible(const vndf_view *view, vndf_normal wm, double facing)
{
    double s = view->s, c = view->c;
    double per_area = c < 0.0 ? 2.0 * (1.0 - c) / (s * s) : 2.0 / (1.0 + c);
    if (!(view->s > 0.0f) && c < 0.0)
        return 0.0;
    return vndf_ggx_ndf(view->alpha_x, view->alpha_y, wm) * (facing * view->per_length * per_area);
}

/* The factor sqrt(2) in S and C is in T and the sum too, and does not matter. */
vndf_vec3 vndf_ggx_sample(float s, float c, float u1, float u2)
{
    half_angle h = half_angle_of(s, c);
    vndf_turn turn = vndf_half_turn(u1);
    double v = u2 < 1.0f ? 1.0 - u2 : least_v;
    double s2 = h.sine * h.sine, c2 = h.cosine * h.cosine;
    double t = sqrt(u2 * (s2 + v * c2)), twice = 2.0 * t * turn.sine;
    /* The small term keeps normal incidence with u2 = 0 from being 0/0; the numerator is 0 there. */
    double x = v * (s2 - u2 * c2) / (h.sine + t + 1e-30) + twice * turn.sine;
    vndf_vec3 n = {(float)x, (float)(-twice * turn.cosine), (float)(v * h.cosine)};
    return vndf_face(s, c, n);
}

/* The sum, sqrt(2) included, is mu wm with mu = 2 (w . wm)/C; then T and phi are polar coordinates of its first two
 * components about (S, 0), and the third is v C. u2 = T^2/(S^2 + v C^2) keeps the digits of a small u2, and 1 - v
 * those of a small 1 - u2, where one step of 2^-24 moves the normals of the far tail by 1e-3 and more. */
void vndf_ggx_invert(float s, float c, vndf_normal n, float *u1, float *u2)
{
    half_angle h = half_angle_of(s, c);
    double s2 = h.sine * h.sine, c2 = h.cosine * h.cosine;
    double per_cosine = h.cosine > 0.0 ? 1.0 / h.cosine : 0.0;
    double facing = h.sine * h.cosine * n.x + 0.5 * (c2 - s2) * n.z; /* the w that the sampler uses */
    double scale = 2.0 * facing * per_cosine / (n.x * n.x + n.y * n.y + n.z * n.z);
    double across = scale * n.x - h.sine, aside = scale * n.y, v = scale * n.z * per_cosine;
    double from_top = (across * across + aside * aside) / (s2 + v * c2);
    *u2 = vndf_clamp_unit((float)(v < 0.5 ? 1.0 - v : from_top));
    *u1 = vndf_clamp_unit((float)(0.5 + 0.5 * inverse_pi * atan2(aside, across)));
}
