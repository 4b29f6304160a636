/* Visible normals bounded by the horizon: fewer reflect wi to below the surface, where samples are lost. Numbers u1, u2
 * that draw only such normals are left out, so the density is that of visible normals over the part that is kept. With
 * E = M^T M and w = M^T wi, wi.z > 0, a normal (x, y, z) of the unit problem reflects wi to above the horizon where
 *
 *     wz (E11 x^2 + 2 E12 x y + E22 y^2 - z^2) < 2 (wx x + wy y) z.                                         (1) */
#ifndef VNDF_KERNEL_BOUNDED_H
#define VNDF_KERNEL_BOUNDED_H

#include "kernel/beckmann.h"
#include "kernel/sample.h"

/* The numbers that are kept: begin + span u, of each. */
typedef struct number_box {
    real begin1, span1, begin2, span2;
} number_box;

/* E in a frame of the unit problem. */
typedef struct ellipse {
    real e11, e12, e22;
} ellipse;

KERNEL ellipse ellipse_of(affine_map m)
{
    const ellipse e = {m.xx * m.xx + m.yx * m.yx, m.xx * m.xy + m.yx * m.yy, m.xy * m.xy + m.yy * m.yy};
    return e;
}

KERNEL ellipse ellipse_turned(ellipse e, real cosine, real sine)
{
    real cc = cosine * cosine, cs = cosine * sine, ss = sine * sine;
    const ellipse t = {cc * e.e11 + 2.0f * cs * e.e12 + ss * e.e22, cs * (e.e22 - e.e11) + (cc - ss) * e.e12,
                       ss * e.e11 - 2.0f * cs * e.e12 + cc * e.e22};
    return t;
}

/* The cap that GGX is drawn from ends at -k c where normals of the least roughness a, at most 1, end (Eto & Tokuyoshi,
 * "Bounded VNDF Sampling for Smith-GGX Reflections", SIGGRAPH Asia 2023). a^2 is the least eigenvalue of E. */
KERNEL number_box ggx_box(frame f)
{
    ellipse e = ellipse_of(f.m);
    real apart = 0.5f * (e.e11 - e.e22),
         most_square = 0.5f * (e.e11 + e.e22) + sqrt(apart * apart + e.e12 * e.e12);
    real least_square = min(f.determinant / most_square * f.determinant, set(1.0f));
    real across = f.wx * f.wx + f.wy * f.wy, sum = sqrt(across + f.wz * f.wz) + sqrt(across), square = sum * sum;
    real k = (1.0f - least_square) * square / (square + least_square * (f.wz * f.wz));
    real length = sqrt((f.ux * f.ux + f.uy * f.uy) + f.uz * f.uz);
    const number_box b = {set(0.0f), set(1.0f), set(0.0f), (length + k * f.uz) / (length + f.uz)};
    return b;
}

/* Slopes (x, y), x along w, are in the ellipse E11 x^2 + 2 E12 x y + E22 y^2 + 2 h x < 1 with h = s/c of w, which holds
 * 0. Beckmann's, which are independent, are drawn from the rectangle around it; both ends of a side have the product
 * of which the nearer one is made. */
KERNEL number_box beckmann_box(beckmann_view v, ellipse of)
{
    real h = 1.0f / max(v.law.bound, set(1e-7f));
    ellipse e = ellipse_turned(of, v.law.cosine, v.law.sine);
    real det = max(difference_of_products(e.e11, e.e22, e.e12, e.e12), set(1e-36f)),
         spread_y = det + h * h * e.e22;
    real sum = e.e22 * h + sqrt(e.e22 * spread_y), x0 = -min(sum / det, set(1e15f)), x1 = e.e22 / sum;
    real far = min((h * abs(e.e12) + sqrt(e.e11 * spread_y)) / det, set(1e15f)),
         near = (e.e11 + h * h) / (far * det);
    mask low = lt(e.e12, set(0.0f));
    real begin1 = beckmann_part(v.law, x0, v.law.bound - x0), begin2 = half_erfc(select(low, far, near));
    const number_box b = {begin1, max(beckmann_part(v.law, x1, v.law.bound - x1) - begin1, set(1e-28f)), begin2,
                          half_erfc(-select(low, near, far)) - begin2};
    return b;
}

/* ---- tables ----
 *
 * With the same roughness along and across, alpha, a normal at slope length alpha R and azimuth a reflects wi to above
 * the horizon where cos a > b = (alpha^2 R^2 - 1)/(2 alpha R tan(theta)): everywhere where b < -1, nowhere where b > 1,
 * which is where alpha R exceeds (1 + sin(theta))/cos(theta). So u2 is multiplied by the part of the law up to there,
 * and the arc is shortened: no sample is lost. */

/* The cosine b. s and c are those of the view: tan(theta) is slant = s/(alpha c). */
KERNEL real bounded_cosine(real alpha, real slant, real x, real z)
{
    real r = alpha * x;
    return ((r - z) * (r + z)) / max(2.0f * (r * z) * slant, set(1e-37f));
}

/* The part of half the arc that is not bounded away, from the azimuth of wi on. */
KERNEL real bounded_arc(arc k, real b)
{
    real cosine = min(max(b, set(-1.0f)), set(1.0f)),
         sine = sqrt(max((1.0f - cosine) * (1.0f + cosine), set(0.0f)));
    real u = arc_invert(k, cosine, sine); /* from 1/2 towards wi to 1 behind it */
    return min(max(2.0f * (u - 0.5f), set(1e-6f)), set(1.0f));
}

/* What a direction bounds: roughness, the tangent of the stretched direction, and the part of the law of the slope
 * length up to the largest that reflects upwards. */
typedef struct table_bounds {
    real alpha, slant, part;
} table_bounds;

KERNEL table_bounds table_bounds_of(table t, table_view view, real alpha)
{
    table_bounds b = {alpha, min(view.v.s / (alpha * view.v.c), set(1e15f)), set(1.0f)};
    real steep = b.slant + sqrt(1.0f + b.slant * b.slant), per = 1.0f / (steep + alpha);
    query g = table_given(t, steep, set(0.0f), alpha);
    pair u = table_invert(t, view.v, g, steep * per, set(0.0f), 0);
    b.part = max(u.b, set(1e-6f));
    return b;
}

KERNEL normal_sample table_draw_bounded(table t, table_view view, table_bounds b, real u1, real u2)
{
    target a = table_aim(view.v, u2 * b.part, 0);
    knot_hit at = table_find(t, view.v, a, 0);
    cell_hit f = table_cell(t, view.v, a, at, 0);
    length_sample d = table_length(t, view.v, f, law_invert(f.at, f.before), 0);
    arc k = table_arc(view.v, d.r, 0);
    real arc_part = bounded_arc(k, bounded_cosine(b.alpha, b.slant, d.r.x, d.r.z));
    normal_sample n =
        table_turned(view.ex, view.ey, table_normal(view.v, d, k, arc_draw(k, 0.5f + (u1 - 0.5f) * arc_part, 0)));
    real inside = b.part * arc_part;
    n.density = n.density / inside;
    return n;
}

/* The part of the visible normals of its slope length, and of all lengths, that is kept. */
KERNEL real table_bounded_inside(table t, table_view view, table_bounds b, unit_normal n)
{
    query g = table_given(t, n.x, n.y, n.z);
    return b.part * bounded_arc(table_given_arc(view.v, g, 0), bounded_cosine(b.alpha, b.slant, g.x, g.z));
}

#endif
