/* The inverses of the closed forms, for one or for lanes, in double; they hold for every valid view and every valid
 * normal. ggx.h and beckmann.h say what their draws turn uniform numbers into. */
#ifndef VNDF_SAMPLER_ANALYTIC_INVERSE_H
#define VNDF_SAMPLER_ANALYTIC_INVERSE_H

#include "math/elementary.h"
#include "sampler/analytic_density.h"
#include "sampler/tabulated/density.h"

/* Two uniform numbers, each a float in [0, 1]. */
typedef struct vndf_uniforms {
    doubles_f u1, u2;
} vndf_uniforms;

/* A number of [0, 1] but for rounding; NaN becomes 0. */
VNDF_INLINE doubles_f vndf_uniform_of(doubles u)
{
    return doubles_narrow(doubles_between(doubles_positive(u), 0.0, 1.0));
}

/* ---- the unit problem ---- */

/* The direction (s, 0, c) of length 1, two floats, and the normal in its frame, of any length. */
typedef struct vndf_unit_query {
    doubles s, c;
    vndf_normal n;
} vndf_unit_query;

VNDF_INLINE doubles vndf_rounded(doubles x)
{
    return doubles_widen(doubles_narrow(x));
}

/* The frame of vndf_analytic_frame (frame.h), and the normal times its heading's square and ax ay, which needs no
 * division. A direction along z has no heading; x is it. */
VNDF_INLINE vndf_unit_query vndf_unit_query_of(const vndf_query *g)
{
    const doubles nothing = doubles_set(0.0), one = doubles_set(1.0);
    doubles ax = g->wi.ax, ay = g->wi.ay, x = ax * g->wi.x, y = ay * g->wi.y, z = g->wi.z, across2 = x * x + y * y;
    doubles across = doubles_root(across2), length = doubles_root(across2 + z * z);
    doubles both = 1.0 / (across * length), per = across * both, per_across = length * both;
    doubles_m leans = doubles_less(nothing, across);
    doubles a = vndf_rounded(doubles_pick(leans, x * per_across, one));
    doubles b = vndf_rounded(doubles_pick(leans, y * per_across, nothing));
    doubles mx = ay * g->x, my = ax * g->y;
    vndf_unit_query q = {vndf_rounded(doubles_pick(leans, across * per, nothing)),
                         vndf_rounded(doubles_pick(leans, z * per, doubles_sign(one, z))),
                         {a * mx + b * my, a * my - b * mx, ax * ay * (a * a + b * b) * g->z}};
    return q;
}

/* ---- GGX ---- */

/* Sine and cosine of theta/2 times sqrt(2) 2^30: vndf_half_angle_of (ggx.h); and one over the cosine, or 0. */
typedef struct vndf_half_angles {
    doubles sine, cosine, per_cosine;
} vndf_half_angles;

VNDF_INLINE vndf_half_angles vndf_half_angles_of(doubles s, doubles c)
{
    const doubles nothing = doubles_set(0.0), one = doubles_set(1.0);
    doubles root = doubles_root(0x1p60 + 0x1p60 * doubles_abs(c)), product = 0x1p60 * s;
    doubles_m below = doubles_less(c, nothing), leans = doubles_less(nothing, s);
    doubles with = doubles_pick(leans, product, one), both = 1.0 / (root * with);
    doubles per_root = with * both, other = product * per_root;
    doubles per_other = doubles_pick(leans, root * (root * both), nothing);
    vndf_half_angles h = {doubles_pick(below, root, other), doubles_pick(below, other, root),
                          doubles_pick(below, per_other, per_root)};
    return h;
}

/* The sum, with the factor of S and C, is mu wm with mu = 2 (w . wm)/C; then T and phi are polar coordinates of
 * its first two components about (S, 0), and the third is v C. u2 = T^2/(S^2 + v C^2) keeps the digits of a small
 * u2, and 1 - v those of a small 1 - u2, where one step of 2^-24 moves the normals of the far tail by 1e-4. */
VNDF_INLINE vndf_uniforms vndf_ggx_inverse(const vndf_unit_query *q)
{
    vndf_half_angles h = vndf_half_angles_of(q->s, q->c);
    vndf_normal n = q->n;
    doubles s2 = h.sine * h.sine, c2 = h.cosine * h.cosine;
    doubles facing = h.sine * h.cosine * n.x + 0.5 * (c2 - s2) * n.z; /* the w that the sampler uses */
    doubles scale = 2.0 * facing * h.per_cosine / (n.x * n.x + n.y * n.y + n.z * n.z);
    doubles across = scale * n.x - h.sine, aside = scale * n.y, v = scale * n.z * h.per_cosine;
    doubles from_top = (across * across + aside * aside) / (s2 + v * c2);
    vndf_uniforms u = {vndf_uniform_of(0.5 + 0.5 * vndf_inverse_pi * vndf_atan2(aside, across)),
                       vndf_uniform_of(doubles_pick(doubles_less(v, doubles_set(0.5)), 1.0 - v, from_top))};
    return u;
}

/* ---- Beckmann ---- */

/* The law of the slope along wi (vndf_beckmann_law), and whether K < 5/4. */
typedef struct vndf_slope_law {
    doubles bound, whole, line;
    doubles_m around;
} vndf_slope_law;

VNDF_INLINE vndf_slope_law vndf_slope_law_at(doubles s, doubles c)
{
    const doubles nothing = doubles_set(0.0), least = doubles_set(1e-30); /* of a float */
    doubles bound = c / doubles_pick(doubles_less(least, s), s, least), square = bound * bound;
    doubles n = vndf_erfc_remainder(doubles_abs(bound)), part = n / (n + doubles_abs(bound));
    doubles_m around = doubles_less(bound, doubles_set(1.25)), seen = doubles_less(nothing, bound);
    doubles line = doubles_pick(seen, 2.0 * vndf_root_pi * bound, nothing);
    doubles factor = vndf_exp_falling(doubles_pick(around, nothing - doubles_pick(seen, square, nothing), square));
    vndf_slope_law law = {bound, part, doubles_pick(around, line * factor, line), around};
    law.whole = law.line + doubles_pick(around, part, factor * part);
    return law;
}

/* vndf_beckmann_part. */
VNDF_INLINE doubles vndf_slope_part(const vndf_slope_law *law, doubles x, doubles d)
{
    const doubles nothing = doubles_set(0.0);
    doubles z = doubles_abs(x), rest = vndf_erfc_remainder(z);
    doubles_m right = doubles_less(nothing, x);
    doubles gauss = vndf_exp_falling(doubles_pick(law->around, d * (d - 2.0 * law->bound), x * x));
    doubles mass = (rest + doubles_pick(right, nothing - d, d)) / (rest + z) * gauss;
    return (mass + doubles_pick(right, law->line, nothing)) / law->whole;
}

/* vndf_half_erfc, which is 0 or 1 to a float where exp underflows. */
VNDF_INLINE doubles vndf_slope_half_erfc(doubles x)
{
    doubles z = doubles_abs(x),
            tail = 0.28209479177387814 * vndf_exp_falling(z * z) / (z + vndf_erfc_remainder(z));
    return doubles_pick(doubles_less(x, doubles_set(0.0)), 1.0 - tail, tail);
}

/* d = (w . n)/(s n.z) keeps digits that K - x would lose. Slopes of more than 1e30 do not show. */
VNDF_INLINE vndf_uniforms vndf_beckmann_inverse(const vndf_unit_query *q)
{
    const doubles nothing = doubles_set(0.0);
    vndf_normal n = q->n;
    vndf_slope_law law = vndf_slope_law_at(q->s, q->c);
    doubles least = 1e-30 * (doubles_abs(n.x) + doubles_abs(n.y) + n.z);
    doubles z = doubles_pick(doubles_less(least, n.z), n.z, least);
    doubles s = doubles_pick(doubles_less(doubles_set(1e-30), q->s), q->s, doubles_set(1e-30));
    doubles front = (q->s * n.x + q->c * n.z) / (s * z);
    vndf_uniforms u = {vndf_uniform_of(vndf_slope_part(&law, (nothing - n.x) / z, doubles_positive(front))),
                       vndf_uniform_of(vndf_slope_half_erfc(n.y / z))};
    return u;
}

#endif
