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

/* A sample in three steps; a root or a division ends each of the first two and begins the last. Lanes take each step
 * for several groups in turn (batch/analytic.h), so that the processor divides for one group while it multiplies for
 * others. h is multiplied by (1 + T) and by the square of its half azimuth.
 *
 * The cap: T^2 and T; what both of h's level parts hold, and its height, before T is known. */
typedef struct vndf_ggx_cap {
    lanes_f t2, t, square, along, across, aside, up;
} vndf_ggx_cap;

VNDF_INLINE vndf_ggx_cap vndf_ggx_cap_at(const vndf_ggx_incidence *w, lanes_f u1, lanes_f u2)
{
    vndf_half_azimuth half = vndf_half_azimuth_at(u1);
    lanes_f v = 1.0f - u2, t2 = u2 + u2 * v * w->q, twice = 2.0f * half.sine;
    vndf_ggx_cap cap = {t2,
                        lanes_root(t2),
                        half.square,
                        v * (1.0f - u2 * w->q) * half.square,
                        twice * half.sine,
                        twice * half.cosine,
                        v * (1.0f + w->c)};
    return cap;
}

/* m = (ax hx, ay hy, hz), |m|^2 and |m|, and what |m| is divided by. */
typedef struct vndf_ggx_stretched {
    lanes_f x, y, z, m2, length, below;
} vndf_ggx_stretched;

/* Good where *trusted stays. */
VNDF_INLINE vndf_ggx_stretched vndf_ggx_stretched_at(const vndf_ggx_incidence *w, const vndf_ggx_cap *cap,
                                                     lanes_m *trusted)
{
    lanes_f t = cap->t, tr = t + cap->t2, r = cap->square + cap->square * t;
    lanes_f along = cap->along + tr * cap->across, aside = tr * cap->aside;
    lanes_f x = w->x * along + w->y * aside, y = w->y * along - w->x * aside, z = cap->up * r;
    lanes_f mx = w->ax * x, my = w->ay * y, z2 = z * z;
    lanes_f h2 = (x * x + y * y) + z2, m2 = (mx * mx + my * my) + z2;
    *trusted = lanes_both(w->trusted, vndf_trusts_ggx_halfway(r, h2));
    vndf_ggx_stretched m = {mx, my, z, m2, lanes_root(m2), w->spread * r * h2};
    return m;
}

VNDF_INLINE vndf_drawn vndf_ggx_drawn(const vndf_ggx_stretched *m)
{
    lanes_f both = 1.0f / (m->length * m->below), per = m->below * both;
    vndf_drawn n = {m->x * per, m->y * per, m->z * per, m->m2 * m->m2 * both};
    return n;
}

/* All three: good where *trusted stays. The normal is that of vndf_ggx_sample, but for roundings. */
VNDF_INLINE vndf_drawn vndf_ggx_draw(const vndf_ggx_incidence *w, lanes_f u1, lanes_f u2, lanes_m *trusted)
{
    vndf_ggx_cap cap = vndf_ggx_cap_at(w, u1, u2);
    vndf_ggx_stretched m = vndf_ggx_stretched_at(w, &cap, trusted);
    return vndf_ggx_drawn(&m);
}

#endif
