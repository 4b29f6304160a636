/* Visible normals bounded by the horizon: fewer reflect wi to below the surface, where samples are lost. Numbers u1, u2
 * that draw only such normals are left out, so the density is that of visible normals over the part that is kept. With
 * E = M^T M and w = M^T wi, wi.z > 0, a normal (x, y, z) of the unit problem reflects wi to above the horizon where
 *
 *     wz (E11 x^2 + 2 E12 x y + E22 y^2 - z^2) < 2 (wx x + wy y) z.                                         (1) */
#ifndef VNDF_KERNEL_BOUNDED_H
#define VNDF_KERNEL_BOUNDED_H

#include "kernel/view.h"

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

KERNEL table_bounds table_bounds_of(table t, table_view law, real alpha)
{
    table_bounds b = {alpha, min(law.v.s / (alpha * law.v.c), set(1e15f)), set(1.0f)};
    real steep = b.slant + sqrt(1.0f + b.slant * b.slant), per = 1.0f / (steep + alpha);
    query g = table_given(t, steep, set(0.0f), alpha);
    pair u = table_invert(t, law.v, g, steep * per, set(0.0f), 0);
    b.part = max(u.b, set(1e-6f));
    return b;
}

KERNEL normal_sample table_draw_bounded(table t, table_view law, table_bounds b, real u1, real u2)
{
    target a = table_aim(law.v, u2 * b.part, 0);
    knot_hit at = table_find(t, law.v, a, 0);
    cell_hit f = table_cell(t, law.v, a, at, 0);
    length_sample d = table_length(t, law.v, f, law_invert(f.at, f.before), 0);
    arc k = table_arc(law.v, d.r, 0);
    real arc_part = bounded_arc(k, bounded_cosine(b.alpha, b.slant, d.r.x, d.r.z));
    normal_sample n =
        table_turned(law.ex, law.ey, table_normal(law.v, d, k, arc_draw(k, 0.5f + (u1 - 0.5f) * arc_part, 0)));
    real inside = b.part * arc_part;
    n.density = n.density / inside;
    return n;
}

/* The part of the visible normals of its slope length, and of all lengths, that is kept. */
KERNEL real table_bounded_inside(table t, table_view law, table_bounds b, unit_normal n)
{
    query g = table_given(t, n.x, n.y, n.z);
    return b.part * bounded_arc(table_given_arc(law.v, g, 0), bounded_cosine(b.alpha, b.slant, g.x, g.z));
}

/* ---- any distribution ---- */

/* wi . wm with all its digits: at grazing angles it is a small rest of its terms. */
KERNEL real facing_of(vec3 wi, vec3 wm)
{
    real a = wi.x * wm.x, b = wi.y * wm.y, c = wi.z * wm.z, ab = a + b, abc = ab + c, t = ab - a, u = abc - ab;
    real rest = (product_rest(wi.x, wm.x, a) + product_rest(wi.y, wm.y, b)) + product_rest(wi.z, wm.z, c);
    return abc + ((((a - (ab - t)) + (b - t)) + ((ab - (abc - u)) + (c - u))) + rest);
}

/* Whether a view is from above, of a surface without a mean slope: all others draw visible normals as they are. */
KERNEL int is_bounded(view s)
{
    const frame f = view_frame(s);
    return select_int(both(lt(0.0f, f.uz), le(abs(f.m.mean_x) + abs(f.m.mean_y), 0.0f)), 1, 0);
}

/* Whether it is of a table that is as rough along as across, whose arcs are shortened. */
KERNEL int is_even_table(view s)
{
    const ellipse e = ellipse_of(view_frame(s).m);
    const mask even = both(le(abs(e.e12), 1e-5f * e.e11), le(abs(e.e11 - e.e22), 1e-5f * e.e11));
    if (s.kind == VNDF_GGX || s.kind == VNDF_BECKMANN)
        return 0;
    return select_int(even, 1, 0);
}

/* The numbers that closed forms keep; tables of unequal roughness keep all. */
KERNEL number_box view_box(view s)
{
    const number_box all = {0.0f, 1.0f, 0.0f, 1.0f};
    if (s.kind == VNDF_GGX)
        return ggx_box(view_frame(s));
    if (s.kind == VNDF_BECKMANN)
        return beckmann_box(view_beckmann(s), ellipse_of(view_frame(s).m));
    return all;
}

KERNEL table_bounds view_bounds(view s)
{
    return table_bounds_of(view_table(s), view_law(s), sqrt(ellipse_of(view_frame(s).m).e11));
}

/* The density with which bounded_sample draws wm. */
KERNEL real bounded_pdf(view s, vec3 wm)
{
    const vec3 wi = view_wi(s);
    const frame f = view_frame(s);
    if (is_bounded(s) == 0)
        return pdf(s, wm);
    if (!(wm.z >= 0.0f) || !(2.0f * facing_of(wi, wm) * wm.z > wi.z))
        return 0.0f;
    const number_box box = view_box(s);
    real kept = box.span1 * box.span2; /* of the visible normals like this one */
    if (is_even_table(s) != 0)
        kept = table_bounded_inside(view_table(s), view_law(s), view_bounds(s), frame_normal(f, wm.x, wm.y, wm.z));
    return frame_density(f, pdf(s, wm) / kept);
}

/* A drawn normal with its weight, the visible density over the drawn one; facing = wi . wm. */
KERNEL sampled weighed_normal(view s, vec3 wm, real facing, real density)
{
    real weight = 0.0f;
    if (density > 0.0f)
        weight = seen_ndf(s, wm) / density * (max(facing, 0.0f) / max(area(s), 1e-37f));
    const sampled n = {wm, density, weight};
    return n;
}

/* If rounding sent wo to below the horizon, wm is that of a wo just above it: wi + wo is twice (wi.wm) wm. */
KERNEL sampled bounded_raised(view s, sampled n)
{
    const vec3 wi = view_wi(s);
    const real facing = facing_of(wi, n.wm);
    if (2.0f * facing * n.wm.z > wi.z)
        return n;
    const real x = 2.0f * facing * n.wm.x, y = 2.0f * facing * n.wm.y, z = wi.z + 1e-6f,
               per = 1.0f / sqrt(x * x + y * y + z * z);
    const vec3 wm = vec3(x * per, y * per, z * per);
    return weighed_normal(s, wm, facing_of(wi, wm), bounded_pdf(s, wm));
}

/* Draws a visible normal that reflects wi to above the horizon, or of tables of unequal roughness any visible one. */
KERNEL sampled bounded_sample(view s, real w1, real w2)
{
    const real u1 = unit_number(w1), u2 = unit_number(w2);
    if (is_bounded(s) == 0)
        return sample(s, u1, u2);
    if (is_even_table(s) != 0) {
        const normal_sample m = table_draw_bounded(view_table(s), view_law(s), view_bounds(s), u1, u2);
        const surface_sample n = frame_sampled(view_frame(s), m);
        const vec3 wm = vec3(n.x, n.y, n.z);
        return bounded_raised(s, weighed_normal(s, wm, facing_of(view_wi(s), wm), n.pdf));
    }
    const number_box b = view_box(s);
    sampled d = sample(s, b.begin1 + b.span1 * u1, b.begin2 + b.span2 * u2);
    d.pdf = d.pdf / (b.span1 * b.span2);
    d.weight = d.weight * (b.span1 * b.span2);
    return d;
}

#endif
