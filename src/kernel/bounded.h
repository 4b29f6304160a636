/* Visible normals bounded by the horizon: those of wi that reflect it to above the surface; no sample is lost. With E =
 * M^T M and w = M^T wi, wi.z > 0, a normal (x, y, z) of the unit problem is one where
 *
 *     vz (E11 x^2 + 2 E12 x y + E22 y^2 - z^2) < 2 (vx x + vy y) z,                                         (1)
 *
 * a disc of slopes that holds the pole. A first coordinate is drawn, then a second one on the chord of the disc on its
 * line, both by inverting distribution functions: the density is that of visible normals over `inside`, the part of the
 * line that is in the disc, times a constant where the first law is cut or weighted too. Published bounds (Tokuyoshi &
 * Eto, "Bounded VNDF Sampling for Smith-GGX Reflections", SIGGRAPH Asia 2023) are for GGX and loose; this one is
 * tight. */
#ifndef VNDF_KERNEL_BOUNDED_H
#define VNDF_KERNEL_BOUNDED_H

#include "kernel/beckmann.h"

/* A drawn normal, its density that of bounded normals, and what that of visible normals is divided by: `inside` times
 * the constant, which for GGX of unequal roughness exceeds 1 in places. */
typedef struct bounded {
    drawn n;
    real inside;
} bounded;

/* E in the frame where w has no y. */
typedef struct ellipse {
    real e11, e12, e22;
} ellipse;

HERE ellipse ellipse_turned(real cosine, real sine, real exx, real exy, real eyy)
{
    real cc = cosine * cosine, cs = cosine * sine, ss = sine * sine;
    const ellipse e = {cc * exx + 2.0f * cs * exy + ss * eyy, cs * (eyy - exx) + (cc - ss) * exy,
                       ss * exx - 2.0f * cs * exy + cc * eyy};
    return e;
}

/* ---- GGX ----
 *
 * With azimuth psi about w = (s, 0, c), n = cos(g) w + sin(g) u, u = cos(psi) (-c, 0, s) + sin(psi) (0, 1, 0), visible
 * normals are uniform in sin(g)^2 dpsi (Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 2018), up to
 *
 *     1 in front, where cos(psi) >= 0;      c^2/(c^2 + s^2 cos(psi)^2) in the wedge,
 *
 * with psi uniform in front, and tan(psi) = -tan(v)/c with v uniform in the wedge. In t = tan(g), with M0 and M1 the
 * stretched w and u, (1) is c |M1|^2 t^2 + 2 (c M0.M1 - s cos(psi)) t + c (|M0|^2 - 2) < 0. w is in the disc where
 * |M0|^2 < 2, for all roughness up to sqrt(2): sin(g)^2 goes from 0 to that of the root. Otherwise psi is drawn between
 * the two tangents and sin(g)^2 between two roots. The front keeps more than the wedge: psi is drawn with the mass of
 * the wedge times its largest inside part, at psi = pi or at a side. */
typedef struct ggx_bounds {
    real cosine, sine, s, c;
    ellipse e;
    real c0;   /* c (|M0|^2 - 2) */
    real area; /* of w */
    real front, in_front, in_wedge, begin,
        span; /* the part of psi in front; `inside` over that of the chord; of u1 */
} ggx_bounds;

/* Of an azimuth, cos(psi) and sin(psi): the middle and half the width of the chord times a = c |M1|^2, and a; sin(g)^2
 * and cos(g)^2 at both ends; and what is inside of all that is visible. */
typedef struct ggx_chord {
    real a, lean, root, sine0, cosine0, sine1, cosine1, inside;
} ggx_chord;

HERE ggx_chord ggx_chord_of(ggx_bounds b, real cosine, real sine)
{
    real cx = b.c * cosine, sx = b.s * cosine, across = cx * b.e.e11 - sine * b.e.e12;
    ggx_chord h;
    h.a = b.c * most(cx * across + (sine * (sine * b.e.e22 - cx * b.e.e12) + sx * sx), set(1e-30f));
    h.lean = -(b.s * (b.c * across + b.s * sx));
    h.root = root(most(h.lean * h.lean - h.a * b.c0, set(0.0f)));
    mask out = less(set(0.0f), b.c0), away = less(set(0.0f), h.lean);
    real far = pick(away, -b.c0, h.root - h.lean) / pick(away, h.lean + h.root, h.a), t1 = least(far, set(1e15f));
    real t0 = least(most(b.c0, set(0.0f)) / most(h.root - h.lean, set(1e-15f)), set(1e15f)),
         wedge = least(sx, set(0.0f)) / b.c;
    h.cosine1 = 1.0f / (1.0f + t1 * t1);
    h.sine1 = t1 * t1 * h.cosine1;
    h.cosine0 = 1.0f / (1.0f + t0 * t0);
    h.sine0 = t0 * t0 * h.cosine0;
    real both_roots = -4.0f * (h.lean / h.a) * (h.root / h.a) * h.cosine0 * h.cosine1;
    real part = pick(out, pick(less(h.lean, set(0.0f)), both_roots, set(0.0f)), h.sine1);
    h.inside = least(part * (1.0f + wedge * wedge), set(1.0f));
    return h;
}

/* The part of psi, from -pi, up to the direction (cosine, sine) of any length. */
HERE real ggx_azimuth_part(ggx_bounds b, real cosine, real sine)
{
    real front = b.front * (0.636619772f * angle_of(size(sine), most(cosine, set(0.0f))));
    real wedge = 1.0f - (1.0f - b.front) * (0.636619772f * angle_of(b.c * size(sine), most(-cosine, set(0.0f))));
    return 0.5f + 0.5f * with_sign(pick(less(cosine, set(0.0f)), wedge, front), sine);
}

/* The two azimuths where the chord ends: roots of d11 x^2 + 2 d12 x y + d22 y^2, what is under the root of the chord;
 * b.begin and b.span from them. */
HERE ggx_bounds ggx_tangents(ggx_bounds b)
{
    real c = b.c, s = b.s, b1 = -(s * (c * c * b.e.e11 + s * s)), b2 = c * s * b.e.e12, ac = b.c0 * c;
    real d11 = b1 * b1 - ac * (c * c * b.e.e11 + s * s), d12 = b1 * b2 + ac * (c * b.e.e12),
         d22 = b2 * b2 - ac * b.e.e22;
    real q = -(d12 + with_sign(root(most(difference_of_products(d12, d12, d11, d22), set(0.0f))), d12));
    real side0 = -with_sign(set(1.0f), b1 * q + b2 * d11), side1 = -with_sign(set(1.0f), b1 * d22 + b2 * q);
    real x0 = side0 * q, y0 = side0 * d11, x1 = side1 * d22, y1 = side1 * q;
    mask swap = less(x0 * y1, y0 * x1);
    real part0 = ggx_azimuth_part(b, x0, y0), part1 = ggx_azimuth_part(b, x1, y1);
    b.begin = pick(swap, part1, part0);
    b.span = pick(swap, part0, part1) - b.begin;
    b.span = b.span + pick(less(b.span, set(0.0f)), set(1.0f), set(0.0f));
    b.in_front = b.span;
    b.in_wedge = b.span;
    return b;
}

HERE ggx_bounds ggx_bounds_of(real vx, real vy, real vz, real exx, real exy, real eyy)
{
    ggx_direction w = ggx_direction_of(vx, vy, vz);
    real per = 1.0f / root(w.across * w.across + vz * vz);
    ggx_bounds b;
    b.cosine = w.cosine;
    b.sine = w.sine;
    b.s = w.across * per;
    b.c = most(vz * per, set(1e-7f));
    b.e = ellipse_turned(w.cosine, w.sine, exx, exy, eyy);
    b.c0 = b.c * (b.s * b.s * b.e.e11 + (b.c * b.c - 2.0f));
    b.area = ggx_area(vx, vy, vz);
    mask out = less(set(0.0f), b.c0);
    ggx_chord away = ggx_chord_of(b, set(-1.0f), set(0.0f)),
              beside = ggx_chord_of(b, set(0.0f), with_sign(set(1.0f), -b.e.e12));
    real wedge = pick(out, set(1.0f), most(away.inside, beside.inside)), all = 1.0f + b.c * wedge;
    b.front = 1.0f / all;
    b.in_front = all / (1.0f + b.c);
    b.in_wedge = b.in_front / wedge;
    b.begin = set(0.0f);
    b.span = set(1.0f);
    if (any(out)) {
        ggx_bounds t = ggx_tangents(b);
        b.begin = pick(out, t.begin, b.begin);
        b.span = pick(out, t.span, b.span);
        b.in_front = pick(out, t.span, b.in_front);
        b.in_wedge = pick(out, t.span, b.in_wedge);
    }
    return b;
}

/* What the density of visible normals is divided by. */
HERE real ggx_inside(ggx_bounds b, real x, real y, real z)
{
    real along = b.cosine * x + b.sine * y, sine = b.cosine * y - b.sine * x, cosine = b.s * z - b.c * along;
    real length = root(cosine * cosine + sine * sine), per = 1.0f / most(length, set(1e-30f));
    cosine = pick(less(set(1e-30f), length), cosine * per, set(1.0f));
    ggx_chord h = ggx_chord_of(b, cosine, sine * per);
    return most(h.inside * pick(less(cosine, set(0.0f)), b.in_wedge, b.in_front), set(1e-28f));
}

/* The factor K of a normal in the disc, facing = w.(x, y, z). */
HERE real ggx_bounded_density(ggx_bounds b, real x, real y, real z, real facing)
{
    return ggx_p22(x, y, z) * facing / (b.area * ggx_inside(b, x, y, z));
}

/* u1 turns the normal about w, from below it through the side (1/4) and the top (1/2) round, and u2 moves it away. */
HERE bounded ggx_draw_bounded(ggx_bounds b, real u1, real u2)
{
    real u = b.begin + b.span * u1, half = 2.0f * (u - pick(less(set(1.0f), u), set(1.0f), set(0.0f))) - 1.0f;
    real part = size(half);
    mask behind = less(b.front, part);
    real turned = 0.5f * pick(behind, (part - b.front) / most(1.0f - b.front, set(1e-30f)), part / b.front);
    turn v = half_turn(least(turned, set(0.5f)));
    real cosine = pick(behind, -b.c * v.sine, v.cosine), sine = with_sign(pick(behind, v.cosine, v.sine), half);
    real per = 1.0f / root(cosine * cosine + sine * sine);
    cosine = cosine * per;
    sine = sine * per;
    ggx_chord h = ggx_chord_of(b, cosine, sine);
    real sg = root((1.0f - u2) * h.sine0 + u2 * h.sine1), cg = root((1.0f - u2) * h.cosine0 + u2 * h.cosine1);
    real along = cg * b.s - sg * b.c * cosine, aside = sg * sine;
    real inside = most(h.inside * pick(behind, b.in_wedge, b.in_front), set(1e-28f));
    const drawn n = {b.cosine * along - b.sine * aside, b.sine * along + b.cosine * aside,
                     most(cg * b.c + sg * b.s * cosine, set(0.0f)), 0.636619772f * cg / ((1.0f + b.c) * inside)};
    const bounded drawn_inside = {n, inside};
    return drawn_inside;
}

/* ---- Beckmann ----
 *
 * Slopes (x, y), x along w: with h = s/c the disc is the ellipse E11 x^2 + 2 E12 x y + E22 y^2 + 2 h x < 1, of extent
 * x0 < x < x1 and chords y = (-E12 x +- sqrt(det (x1 - x) (x - x0)))/E22. u1 moves x through the part of the law of x
 * between x0 and x1, u2 moves y through the part of the normal law on the chord; `inside` is the product of both parts.
 * y is counted from the tail where the middle of the chord is, so that a chord far out keeps its digits. From 5 on,
 * where the normal law is nearly that, y^2 is drawn exponentially instead, and densities are relative to the near
 * end. */
typedef struct beckmann_bounds {
    beckmann_view view;
    ellipse e;
    real det, x0, x1, begin, span; /* the part of the law before x0 and up to x1 */
} beckmann_bounds;

HERE beckmann_bounds beckmann_bounds_of(real vx, real vy, real vz, real exx, real exy, real eyy)
{
    beckmann_bounds b;
    b.view = beckmann_see(vx, vy, most(vz, set(1e-7f)));
    real k = b.view.law.bound;
    b.e = ellipse_turned(b.view.law.cosine, b.view.law.sine, exx, exy, eyy);
    b.det = most(difference_of_products(b.e.e11, b.e.e22, b.e.e12, b.e.e12), set(1e-36f));
    real across = b.e.e22 / k, sum = across + root(across * across + b.det * b.e.e22);
    b.x0 = -least(sum / b.det, set(1e15f));
    b.x1 = b.e.e22 / sum;
    b.begin = beckmann_part(b.view.law, b.x0, k - b.x0);
    b.span = most(beckmann_part(b.view.law, b.x1, k - b.x1) - b.begin, set(1e-28f));
    return b;
}

/* y from low to high, its middle not above 0 after `side` has turned it; the part of the normal law below it and on it.
 * Far out: the near end, and 1 - exp(near^2 - low^2); else near is 0. */
typedef struct beckmann_chord {
    real low, high, side, before, part, near, rise;
} beckmann_chord;

/* Short chords have their part from three points of Gauss. */
HERE beckmann_chord beckmann_chord_of(beckmann_bounds b, real x)
{
    real per = 1.0f / b.e.e22, middle = -(b.e.e12 * x * per), away = size(middle);
    real half = root(most(b.det * (b.x1 - x) * (x - b.x0), set(0.0f))) * per, fall = 4.0f * half * away;
    beckmann_chord h = {
        -away - half, half - away, -with_sign(set(1.0f), middle), half_erfc(away + half), set(0.0f),
        set(0.0f),    set(0.0f)};
    h.part = half_erfc(away - half) - h.before;
    h.near = pick(less(set(5.0f), away - half), away - half, set(0.0f));
    h.rise = pick(less(fall, set(0.01f)), fall - 0.5f * fall * fall, 1.0f - exp_of(-fall)) + 1e-30f;
    mask narrow = less(half * (1.0f + away), set(0.125f));
    if (any(narrow)) {
        real step = 0.774596669f * half, a = away - step, c = away + step;
        real sum = 8.0f * exp_of(-(away * away)) + 5.0f * (exp_of(-(a * a)) + exp_of(-(c * c)));
        h.part = pick(narrow, half * sum * 0.062687728f, h.part);
    }
    h.part = most(h.part, set(1e-28f));
    return h;
}

/* The factor K of slopes. */
HERE real beckmann_bounded_slopes(beckmann_bounds b, beckmann_chord h, real x, real y, real d)
{
    real away = size(y), fall = (away - h.near) * (away + h.near) + beckmann_exponent(b.view.law, x, d);
    real across = pick(less(set(0.0f), h.near), 2.0f * away / h.rise, 0.564189584f / h.part);
    real k =
        2.0f * exp_near(-least(most(fall, set(-80.0f)), set(80.0f))) * d * across / (b.view.law.whole * b.span);
    return least(most(k, set(1e-30f)), set(1e30f));
}

HERE real beckmann_bounded_density(beckmann_bounds b, real x, real y, real z, real facing)
{
    beckmann_law v = b.view.law;
    real per = 1.0f / most(z, 1e-9f * (size(x) + size(y)) + 1e-37f);
    real along = -((v.cosine * x + v.sine * y) * per), across = (v.cosine * y - v.sine * x) * per;
    return beckmann_bounded_slopes(b, beckmann_chord_of(b, along), along, across, facing * per / v.across) * per *
           per * per;
}

HERE bounded beckmann_draw_bounded(beckmann_bounds b, real u1, real u2)
{
    beckmann_law v = b.view.law;
    real rim = 1e-6f * (b.x1 - b.x0); /* at x0 and x1 chords have no length */
    real x = most(least(beckmann_along(b.view, b.begin + b.span * u1).x, b.x1 - rim), b.x0 + rim);
    beckmann_chord h = beckmann_chord_of(b, x);
    real u = 0.5f + h.side * (u2 - 0.5f), y = erf_quantile(h.before + u * h.part);
    mask far = less(set(0.0f), h.near);
    if (any(far))
        y = pick(
            far,
            -root(h.near * h.near - log_of(least(most((1.0f - h.rise) + u * h.rise, set(1e-30f)), set(1.0f)))), y);
    y = h.side * most(least(y, h.high), h.low);
    const drawn n = {v.sine * y - v.cosine * x, -(v.sine * x + v.cosine * y), set(1.0f),
                     beckmann_bounded_slopes(b, h, x, y, v.bound - x)};
    const bounded drawn_inside = {n, most(b.span * h.part, set(1e-28f))};
    return drawn_inside;
}
#endif
