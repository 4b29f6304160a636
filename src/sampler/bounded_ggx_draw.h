/* Bounded visible normals of GGX where all is of plain size and nothing cancels: bounded_ggx.c in float, to be part
 * of the caller: calls would be a tenth of the cost.
 *
 * With (e1, e12; e12, e2) the matrix R^T A^2 R of the level directions and u' = N u for (X, Y) = N (cos psi, sin
 * psi),
 *
 *     |M0|^2 = s^2 e1 + c^2,     |M1|^2 N^2 = X^2 (c^2 e1 + s^2) - 2 c X Y e12 + Y^2 e2,
 *     (c M0.M1 - s cos psi) N = -s (s^2 + c^2 e1) X + c s e12 Y,
 *
 * so the root of the chord, t/N = above/below, takes no vectors. N = 1 in front; in the wedge (X, Y) = (-c cos v,
 * sin v) and N^2 is the largest sin(g)^2. Either way kept is (t/N)^2/(1 + t^2), times the factor of the side, and
 * sin(g)^2/N^2 is u2 times that. */
#ifndef VNDF_SAMPLER_BOUNDED_GGX_DRAW_H
#define VNDF_SAMPLER_BOUNDED_GGX_DRAW_H

#include "math/half_turn.h"
#include "math/vector.h"
#include "sampler/bounded_ggx.h"

/* ---- directions ---- */

/* What a sample takes of the direction, beside the laws in `bounds`. */
typedef struct vndf_outlook {
    float s, c, e1, e12, e2;
    float b1, b2, c0; /* half the linear term, per X and Y; the constant term, below 0 where w is in the disc */
} vndf_outlook;

/* It is kept where a view of GGX has room. */
enum { VNDF_GGX_E1 = 5, VNDF_GGX_E12, VNDF_GGX_E2, VNDF_GGX_B1, VNDF_GGX_B2, VNDF_GGX_C0 };

VNDF_INLINE vndf_outlook vndf_outlook_of(const vndf_view *v)
{
    const float *of = v->closed;
    vndf_outlook o = {v->s, v->c, of[VNDF_GGX_E1], of[VNDF_GGX_E12], of[VNDF_GGX_E2],
                      of[VNDF_GGX_B1], of[VNDF_GGX_B2], of[VNDF_GGX_C0]};
    return o;
}

/* Of a plain view, which has its direction, of length 1, but not turned. */
VNDF_INLINE void vndf_outlook_set(vndf_view *v)
{
    float wx = v->closed[0], wy = v->closed[1], c = v->closed[2], s2 = wx * wx + wy * wy, c2 = c * c;
    float s = sqrtf(s2), per = 1.0f / s, x = wx * per, y = wy * per, a2 = v->ax * v->ax, b2 = v->ay * v->ay;
    float e1 = a2 * x * x + b2 * y * y, e12 = (b2 - a2) * x * y;
    v->s = s;
    v->c = c;
    v->cos_phi = x;
    v->sin_phi = y;
    v->spread = 0.159154943f * v->closed[4];
    v->closed[VNDF_GGX_E1] = e1;
    v->closed[VNDF_GGX_E12] = e12;
    v->closed[VNDF_GGX_E2] = a2 * y * y + b2 * x * x;
    v->closed[VNDF_GGX_B1] = -s * (s2 + c2 * e1);
    v->closed[VNDF_GGX_B2] = c * s * e12;
    v->closed[VNDF_GGX_C0] = c * (s2 * e1 + c2 - 2.0f);
}

/* Away from where w leaves the disc. */
VNDF_INLINE int vndf_outlook_is_plain(const vndf_view *view, const vndf_outlook *o)
{
    return view->plain && o->c0 < -0.1f * o->c;
}

/* 1 or 0, for sums of which one part is not wanted: which one nothing foresees, and compilers would branch. */
VNDF_INLINE float vndf_is_positive(float x)
{
    return 0.5f + copysignf(0.5f, x);
}

/* ---- the law of psi ---- */

/* The front counts as if all were kept there, which is nearly so; of the wedge the larger kept of its middle and
 * of the sides: fractions n/d with (M1, N) (c^2 e1 + s^2, c) c^2 and (e2, 1). The quotients do not wait for each
 * other. */
VNDF_INLINE void vndf_bounds_ggx_plain(const vndf_outlook *o, double bounds[VNDF_BOUNDS])
{
    float c = o->c, c2 = c * c, b = -c * o->b1, away = b + sqrtf(b * b - c * c2 * (c2 * o->e1 + o->s * o->s) * o->c0);
    float middle = o->c0 * o->c0, below = away * away + c2 * middle;
    float beside = fabsf(o->b2) + sqrtf(o->b2 * o->b2 - c * o->e2 * o->c0), side = beside * beside;
    float below_side = c2 * (o->e2 * o->e2) + side;
    float sides = vndf_is_positive(side * below - middle * below_side), rest = 1.0f - sides;
    float n = sides * side + rest * middle, d = sides * below_side + rest * below, all = d + c * n, one = 1.0f + c;
    bounds[VNDF_GGX_FRONT] = d / all;
    bounds[VNDF_GGX_IN_FRONT] = all / (d * one);
    bounds[VNDF_GGX_IN_WEDGE] = all / (n * one);
    bounds[VNDF_GGX_RATE] = 0.5f * all / (c * n);
    bounds[VNDF_GGX_BEGIN] = 0.0;
    bounds[VNDF_GGX_SPAN] = 1.0;
}

/* ---- drawing ---- */

/* (X, Y) of a sample, N^2, and the factor of its side. The angle of (X, Y), but for c, goes from 0 to pi/2 in front
 * and on to pi in the wedge, slower and then faster: the larger of two lines. */
typedef struct vndf_ggx_azimuth {
    float x, y, n2, factor;
} vndf_ggx_azimuth;

VNDF_INLINE vndf_ggx_azimuth vndf_ggx_draw_azimuth(const vndf_outlook *o, const double bounds[VNDF_BOUNDS], float half)
{
    float front = (float)bounds[VNDF_GGX_FRONT], in_front = (float)bounds[VNDF_GGX_IN_FRONT];
    float in_wedge = (float)bounds[VNDF_GGX_IN_WEDGE], rate = (float)bounds[VNDF_GGX_RATE], part = fabsf(half);
    float slow = part * (in_front * (0.5f + 0.5f * o->c)), fast = 0.5f + (part - front) * rate;
    float turned = lanes_most(slow, fast), sine = vndf_sine_quarter(lanes_least(turned, 1.0f - turned));
    float cosine = vndf_sine_quarter(0.5f - turned), x = lanes_most(cosine, o->c * cosine);
    float factor = in_wedge + vndf_is_positive(cosine) * (in_front - in_wedge);
    vndf_ggx_azimuth a = {x, copysignf(sine, half), x * x + sine * sine, factor};
    return a;
}

/* The root of the chord and what sin(g)^2/N^2 and cos(g)^2 are at u2. */
typedef struct vndf_ggx_chord {
    float square, root, kept, sine2, cosine2, rest; /* |M1|^2 N^2; 1 - sin(g)^2 at the end */
} vndf_ggx_chord;

VNDF_INLINE vndf_ggx_chord vndf_ggx_draw_chord(const vndf_outlook *o, const vndf_ggx_azimuth *at, float u2)
{
    float x = at->x, y = at->y, s = o->s, c = o->c;
    float square = x * x * (c * c * o->e1 + s * s) - 2.0f * c * (x * y) * o->e12 + y * y * o->e2;
    float a = c * square, b = o->b1 * x + o->b2 * y, root = sqrtf(b * b - a * o->c0);
    float away = vndf_is_positive(b), toward = 1.0f - away, sum = root + fabsf(b);
    float above = toward * sum - away * o->c0, below = away * sum + toward * a;
    float above2 = above * above, below2 = below * below, all = at->n2 * above2, per = 1.0f / (below2 + all);
    float kept = above2 * per;
    vndf_ggx_chord h = {square, root, kept, u2 * kept, (below2 + (1.0f - u2) * all) * per, below2 * per};
    return h;
}

/* A sample: the stretched normal, as it comes, and what it was made of. */
typedef struct vndf_ggx_bounded {
    vndf_ggx_azimuth at;
    vndf_ggx_chord chord;
    float x, y, z, length2, sine, cosine, kept;
} vndf_ggx_bounded;

VNDF_INLINE vndf_ggx_bounded vndf_ggx_draw_bounded(const vndf_view *v, const vndf_outlook *o,
                                                   const double bounds[VNDF_BOUNDS], float u1, float u2)
{
    vndf_ggx_azimuth at = vndf_ggx_draw_azimuth(o, bounds, 2.0f * u1 - 1.0f);
    vndf_ggx_chord h = vndf_ggx_draw_chord(o, &at, u2);
    float sine = sqrtf(h.sine2), cosine = sqrtf(h.cosine2);
    float x = o->c * at.x, gx = v->ax * (v->cos_phi * x + v->sin_phi * at.y);
    float gy = v->ay * (v->sin_phi * x - v->cos_phi * at.y), hx = v->ax * v->closed[0], hy = v->ay * v->closed[1];
    float mx = cosine * hx - sine * gx, my = cosine * hy - sine * gy, z = cosine * o->c + sine * (o->s * at.x);
    float length2 = mx * mx + my * my + z * z;
    vndf_ggx_bounded n = {at, h, mx, my, z, length2, sine, cosine, h.kept * at.factor};
    return n;
}

/* Whether wo is above the horizon, and away from it. */
VNDF_INLINE int vndf_ggx_is_inside(const vndf_outlook *o, const vndf_ggx_bounded *n)
{
    float c = o->c, cosine = n->cosine;
    return 1.00001f * (c * n->length2) < 2.0f * cosine * n->z && 0.02f * c * cosine < n->z && 0.03f < cosine;
}

/* Whether kept is that of the normal as it is rounded. That turns psi by some 1e-7/(reach sin(g)) - reach is 1 for
 * the normal itself -, and d log(t)/d psi is below (2 root E/|M1| + c E |M0| + s)/root, E^2 = e1 + e2, which bears on
 * kept by twice cos(g)^2 at the end; the matrix may hide what is small in E. That bound is far above what is
 * measured: at 150 the density is within 4e-6. In front and in the wedge kept differs. */
VNDF_INLINE int vndf_ggx_is_settled(const vndf_outlook *o, const vndf_ggx_bounded *drawn, float reach)
{
    const vndf_ggx_azimuth *at = &drawn->at;
    const vndf_ggx_chord *h = &drawn->chord;
    float n = sqrtf(at->n2), e2 = o->e1 + o->e2, gain = o->c * (0.7f + 0.7f * e2) + o->s, sine = reach * drawn->sine;
    float change = h->rest * (2.0f * h->root * (h->square + at->n2 * e2) + gain * h->square * n);
    int calm = change < 150.0f * (sine * n) * h->root * h->square && 1e-6f < fabsf(at->x) * sine;
    return calm && 0.01f < sine * n && at->n2 * e2 < 100.0f * h->square;
}

#endif
