/* Bounded visible normals of GGX where float is trusted: ggx.c in float. All is inline: a call would be a tenth of the
 * cost.
 *
 * The level direction is not made unit: with (x, y) = s (cos phi, sin phi), (E1, E12; E12, E2) = s^2 R^T A^2 R the
 * matrix of the level directions, and N u for (X, Y) = N (cos psi, sin psi),
 *
 *     s^2 |M1|^2 N^2 = X^2 (c^2 E1 + s^4) - 2 c X Y E12 + Y^2 E2,      |M0|^2 = E1 + c^2,
 *     s (c M0.M1 - s cos psi) N = -(s^4 + c^2 E1) X + c E12 Y,
 *
 * so the root of the chord, t/(s N) = above/below, takes no vectors. N = 1 in front; in the wedge (X, Y) = (-c
 * cos v, sin v) and N^2 is the largest sin(g)^2. Either way the inside mass is (t/N)^2/(1 + t^2), times the factor
 * of the side, and sin(g)^2/N^2 is u2 times that. */
#ifndef VNDF_SAMPLER_BOUNDED_GGX_DRAW_H
#define VNDF_SAMPLER_BOUNDED_GGX_DRAW_H

#include "math/vector.h"
#include "sampler/bounded/ggx.h"
#include "sampler/analytic/ggx_draw.h"

/* ---- directions ---- */

/* A direction, as samples use it beside its law. */
typedef struct vndf_outlook {
    float x, y, c, s2;
    float q, e12, e2; /* c^2 E1 + s^4, half of it is the linear term in front; E12 and E2 */
    float c0;         /* the constant term, below 0 where w is in the disc */
} vndf_outlook;

/* Of a view that is trusted. */
VNDF_INLINE vndf_outlook vndf_outlook_of(const vndf_view *v, const struct vndf_ggx_bounds *b)
{
    const struct vndf_ggx_view *w = &v->of.ggx;
    vndf_outlook o = {w->x, w->y, w->c, b->s2, b->q, b->e12, b->e2, b->c0};
    return o;
}

/* Of a trusted view: it holds the direction, of length 1, but not turned. */
VNDF_INLINE vndf_outlook vndf_outlook_set(const vndf_view *v, struct vndf_ggx_bounds *b)
{
    float x = v->of.ggx.x, y = v->of.ggx.y, c = v->of.ggx.c, a2 = v->ax * v->ax, b2 = v->ay * v->ay;
    float x2 = x * x, y2 = y * y, s2 = x2 + y2, e1 = a2 * x2 + b2 * y2, c2 = c * c;
    vndf_outlook o = {
        x, y, c, s2, c2 * e1 + s2 * s2, (b2 - a2) * (x * y), a2 * y2 + b2 * x2, c * (e1 + (c2 - 2.0f))};
    b->s2 = o.s2;
    b->q = o.q;
    b->e12 = o.e12;
    b->e2 = o.e2;
    b->c0 = o.c0;
    return o;
}

/* Away from where w leaves the disc. */
VNDF_INLINE int vndf_outlook_is_trusted(const vndf_view *view, const vndf_outlook *o)
{
    return view->trusted && o->c0 < VNDF_TRUST_CHORD_INSIDE * o->c;
}

/* 1 or 0. Sums take one part or the other by it: a compiler would branch, and no processor foresees that branch. */
VNDF_INLINE float vndf_is_positive(float x)
{
    return 0.5f + copysignf(0.5f, x);
}

/* ---- the law of psi ---- */

/* `slow` and `fast` are half of one over the part in front, and over that in the wedge; `in_front` and `in_wedge` are
 * the inside mass over that of the roots there. The front counts as if all of it were inside, which is nearly so. The
 * wedge counts with its larger inside mass, in its middle or at its sides. */
VNDF_INLINE void vndf_ggx_law_set(struct vndf_ggx_bounds *law, const vndf_outlook *o)
{
    float c = o->c, c2 = c * c, b = c * o->q, away = b + sqrtf(b * b - c * c2 * o->q * o->c0);
    float middle = o->s2 * (o->c0 * o->c0), below = away * away + c2 * middle, b2 = c * o->e12;
    float beside = fabsf(b2) + sqrtf(b2 * b2 - c * o->e2 * o->c0), side = o->s2 * (beside * beside);
    float below_side = c2 * (o->e2 * o->e2) + side;
    float cr = c * lanes_most(middle / below, side / below_side), inverse = 1.0f / cr, per = 1.0f / (1.0f + c);
    law->slow = 0.5f + 0.5f * cr;
    law->fast = 0.5f + 0.5f * inverse;
    law->in_front = per + per * cr;
    law->in_wedge = c * (per + per * inverse);
}

/* ---- drawing ---- */

/* (X, Y) of a sample but for a factor, which N has too; (s N)^2; and the factor of its side. The angle of (X, Y),
 * but for c, goes from 0 to pi/2 in front and on to pi in the wedge, slower and then faster: the larger of two
 * lines. */
typedef struct vndf_ggx_azimuth {
    float x, y, n2, factor;
} vndf_ggx_azimuth;

VNDF_INLINE vndf_ggx_azimuth vndf_ggx_draw_azimuth(const vndf_outlook *o, const struct vndf_ggx_bounds *law,
                                                   float half)
{
    float part = fabsf(half), turned = lanes_most(part * law->slow, 1.0f - (1.0f - part) * law->fast);
    vndf_half_azimuth turn = vndf_half_azimuth_at(turned);
    float ahead = vndf_is_positive(0.5f - turned), behind = 1.0f - ahead,
          x = (ahead + behind * o->c) * turn.cosine;
    vndf_ggx_azimuth a = {x, copysignf(turn.sine, half), o->s2 * (x * x + turn.sine * turn.sine),
                          o->s2 * turn.square * (ahead * law->in_front + behind * law->in_wedge)};
    return a;
}

/* The root of the chord, and sin(g)^2/(s N)^2 and cos(g)^2 at u2. */
typedef struct vndf_ggx_chord {
    float square, root, inside_mass, sine2, cosine2, rest; /* |M1|^2 (s N)^2; 1 - sin(g)^2 at the end */
} vndf_ggx_chord;

VNDF_INLINE vndf_ggx_chord vndf_ggx_draw_chord(const vndf_outlook *o, const vndf_ggx_azimuth *at, float u2)
{
    float x = at->x, y = at->y, cy = o->c * (o->e12 * y);
    float square = x * (x * o->q - 2.0f * cy) + (y * y) * o->e2, a = o->c * square, b = cy - o->q * x;
    float root = sqrtf(b * b - a * o->c0), away = vndf_is_positive(b), toward = 1.0f - away, sum = root + fabsf(b);
    float above = toward * sum - away * o->c0, below = away * sum + toward * a;
    float above2 = above * above, below2 = below * below, all = at->n2 * above2, per = 1.0f / (below2 + all);
    float part = above2 * per;
    vndf_ggx_chord h = {square, root, part, u2 * part, (below2 + (1.0f - u2) * all) * per, below2 * per};
    return h;
}

/* A sample: the stretched normal, of any length, and its azimuth and chord. */
typedef struct vndf_ggx_bounded {
    vndf_ggx_azimuth at;
    vndf_ggx_chord chord;
    float x, y, z, length2, sine, cosine, inside_mass; /* sine: over s N */
} vndf_ggx_bounded;

VNDF_INLINE vndf_ggx_bounded vndf_ggx_draw_bounded(const vndf_view *v, const struct vndf_ggx_bounds *law,
                                                   const vndf_outlook *o, float u1, float u2)
{
    vndf_ggx_azimuth at = vndf_ggx_draw_azimuth(o, law, 2.0f * u1 - 1.0f);
    vndf_ggx_chord h = vndf_ggx_draw_chord(o, &at, u2);
    float sine = sqrtf(h.sine2), cosine = sqrtf(h.cosine2), cx = o->c * at.x;
    float gx = v->ax * (o->x * cx + o->y * at.y), gy = v->ay * (o->y * cx - o->x * at.y), gz = o->s2 * at.x;
    float x = cosine * (v->ax * o->x) - sine * gx, y = cosine * (v->ay * o->y) - sine * gy;
    float z = cosine * o->c + sine * gz;
    vndf_ggx_bounded n = {at, h, x, y, z, x * x + y * y + z * z, sine, cosine, h.inside_mass * at.factor};
    return n;
}

/* Whether wo is above the horizon, and away from it. */
VNDF_INLINE int vndf_ggx_is_inside(const vndf_outlook *o, const vndf_ggx_bounded *n)
{
    float c = o->c, cosine = n->cosine;
    return (float)VNDF_TRUST_INSIDE * (c * n->length2) < 2.0f * cosine * n->z &&
           VNDF_TRUST_CHORD_HEIGHT * c * cosine < n->z && VNDF_TRUST_CHORD_COSINE < cosine;
}

/* Whether the inside mass is that of the rounded normal. Rounding turns psi by some 1e-7/(reach sin(g)); reach is 1 for
 * the normal itself. d log(t)/d psi is below (2 root E/|M1| + c E |M0| + s)/root, with E^2 the sum of both squares of
 * the roughness; the inside mass changes by twice cos(g)^2 at the end times that. The matrix may hide small terms of E.
 * The bound is far above the measured change: at 150 the density is within 4e-6. In front and in the wedge the inside
 * mass differs. */
VNDF_INLINE int vndf_ggx_is_settled(const vndf_view *v, const vndf_outlook *o, const vndf_ggx_bounded *drawn,
                                    float reach)
{
    const vndf_ggx_chord *h = &drawn->chord;
    float n2 = drawn->at.n2, n = sqrtf(n2), e2 = v->ax * v->ax + v->ay * v->ay, sine = reach * drawn->sine;
    float gain = o->c * (0.7f + 0.7f * e2) + (0.5f + 0.5f * o->s2), matrix = n2 * e2;
    float change = h->rest * (2.0f * h->root * (h->square + matrix) + gain * h->square * n);
    int smooth = change < VNDF_TRUST_CHORD_STEEP * (sine * n) * h->root * h->square &&
                 VNDF_TRUST_CHORD_SIDE < drawn->at.x * drawn->at.x * (sine * sine) * o->s2;
    return smooth && VNDF_TRUST_CHORD_SINE < sine * n && matrix < VNDF_TRUST_CHORD_MATRIX * h->square;
}

#endif
