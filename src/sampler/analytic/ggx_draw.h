/* GGX where float is trusted: ggx.h in float, for one or for lanes. With h = (w + cap), of which the normal is
 * the direction, and w . n = |h|/2 (Dupuy & Benyoub 2023)
 *
 *     density of n = (w . n) 4/(2 pi (1 + c)) = |h|/(pi (1 + c)),
 *     of the stretched normal m/|m|, m = (ax hx, ay hy, hz):   |m|^3/(ax ay pi (1 + c) |h|^2).
 *
 * The level part (x, y) of w is not made unit to turn with: all of h is in units of its length s instead, where
 * q = ((1 + c)/s)^2 = cot^2(theta/2), v = 1 - u2 and phi = 2 pi u1 - pi give
 *
 *     h = (1 + T cos(phi)) (x, y) + T sin(phi) (-y, x) + v (1 + c) z,    T^2 = u2 (1 + v q),
 *     1 + T cos(phi) = (1 - T) + 2 T sin^2(pi u1),    1 - T = v (1 - u2 q)/(1 + T),
 *
 * and h times (1 + T) and the factor of vndf_half_azimuth needs no division. Three roots and two divisions in all,
 * with the view. |h|^2 is above 0.005 (else ggx.h has it in double); the density is within 7e-6. */
#ifndef VNDF_SAMPLER_ANALYTIC_GGX_DRAW_H
#define VNDF_SAMPLER_ANALYTIC_GGX_DRAW_H

#include "sampler/tabulated/draw.h"

/* Surface and stretched direction (x, y, c), of length 1. */
typedef struct vndf_ggx_incidence {
    lanes_f ax, ay, x, y, c, q, spread; /* spread: pi (1 + c) ax ay, the area times 2 pi */
    lanes_m trusted;
} vndf_ggx_incidence;

/* Near the normal, from q = 1e10 on, products of drawn numbers could overflow; so they could at extreme
 * roughness. Beyond per = 1e26 wi is so short that products here lose digits to denormals, or become 0 where those
 * are flushed: below 1e-38 per = 1e-12 that is nothing beside s > 2e-5. Where products overflow, c is 0 or NaN. */
VNDF_INLINE vndf_ggx_incidence vndf_ggx_incidence_from(lanes_f ax, lanes_f ay, lanes_f wi_x, lanes_f wi_y,
                                                       lanes_f wi_z)
{
    lanes_f x = ax * wi_x, y = ay * wi_y, across2 = x * x + y * y, length = lanes_root(across2 + wi_z * wi_z);
    lanes_f per = 1.0f / (across2 * length), up = length + wi_z; /* of both at once */
    lanes_f c = wi_z * across2 * per, spread = 3.14159265f * (ax * ay);
    vndf_ggx_incidence w = {
        ax, ay, x * across2 * per, y * across2 * per, c, up * up * length * per, spread + spread * c, lanes_all()};
    w.trusted = lanes_both(vndf_trusts_scale(ax, ay, c),
                           lanes_less(lanes_most(w.q, 1e-16f * per), lanes_set(VNDF_TRUST_GGX_COTANGENT)));
    return w;
}

/* Of a view, the same in all lanes. */
VNDF_INLINE vndf_ggx_incidence vndf_ggx_incidence_of(const vndf_view *v)
{
    const struct vndf_ggx_view *w = &v->of.ggx;
    vndf_ggx_incidence of = {
        lanes_set(v->ax), lanes_set(v->ay), lanes_set(w->x),      lanes_set(w->y),
        lanes_set(w->c),  lanes_set(w->q),  lanes_set(w->spread), v->trusted ? lanes_all() : lanes_none()};
    return of;
}

/* Sine and cosine of pi u but for a factor; `square` is the sum of their squares. With w = u (1 - u) for the sine
 * the cosine is (1/2 - u) times a polynomial of degree 4 in w, relative error 3.8e-8 (fitted for that): the angle
 * keeps its digits at both ends and in the middle. */
typedef struct vndf_half_azimuth {
    lanes_f sine, cosine, square;
} vndf_half_azimuth;

VNDF_INLINE vndf_half_azimuth vndf_half_azimuth_at(lanes_f u)
{
    lanes_f w = u * (1.0f - u), w2 = w * w;
    lanes_f low = 0.636619796f + 0.636614653f * w;
    lanes_f high = -0.184363023f + 0.0809643532f * w - 0.0301324956f * w2;
    lanes_f cosine = (0.5f - u) * (low + w2 * high);
    vndf_half_azimuth half = {w, cosine, w2 + cosine * cosine};
    return half;
}

/* Good where *trusted stays. The normal is that of vndf_ggx_sample, but for roundings. h is multiplied by (1 + T)
 * and by the square of its half azimuth. */
VNDF_INLINE vndf_drawn vndf_ggx_draw(const vndf_ggx_incidence *w, lanes_f u1, lanes_f u2, lanes_m *trusted)
{
    vndf_half_azimuth half = vndf_half_azimuth_at(u1);
    lanes_f v = 1.0f - u2, t2 = u2 + u2 * v * w->q, t = lanes_root(t2), tr = t + t2;
    lanes_f r = half.square + half.square * t;
    lanes_f twice = 2.0f * half.sine, aside = tr * (twice * half.cosine);
    lanes_f along = v * (1.0f - u2 * w->q) * half.square + tr * (twice * half.sine);
    lanes_f x = w->x * along + w->y * aside, y = w->y * along - w->x * aside, z = v * (1.0f + w->c) * r;
    lanes_f mx = w->ax * x, my = w->ay * y, z2 = z * z;
    lanes_f h2 = (x * x + y * y) + z2, m2 = (mx * mx + my * my) + z2;
    lanes_f length = lanes_root(m2), below = w->spread * r * h2;
    lanes_f both = 1.0f / (length * below), per = below * both;
    *trusted = lanes_both(w->trusted, vndf_trusts_ggx_halfway(r, h2));
    vndf_drawn n = {mx * per, my * per, z * per, m2 * m2 * both};
    return n;
}

#endif
