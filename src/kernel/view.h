/* One surface seen from a direction: samples, densities and areas, for any kind of distribution. Kinds are told apart
 * here; distributions are VNDF_GGX, VNDF_BECKMANN or, of any other number, a table.
 *
 * Who includes this says before what a `surface` and a `view` are (sampler/state.h, tools/export/views.h):
 *
 *     place(surface, w)                        the direction w on the surface, a `placed`
 *     frame_below(f)                           whether it is below the horizon
 *     s.kind, view_table(s), view_frame(s)     the same of a view s
 *     s.below                                  whether it is that of a table from below the horizon
 *     view_law, view_ggx, view_beckmann        what its distribution makes of the direction
 *     view_weighs                              whether samples want a weight
 *     sides_apart                              whether each side of the horizon has code of its own */
#ifndef VNDF_KERNEL_VIEW_H
#define VNDF_KERNEL_VIEW_H

#include "kernel/ggx.h"
#include "kernel/beckmann.h"
#include "kernel/sample.h"

/* ---- distributions ---- */

/* P22 over z^4 of a normal of the unit problem: D times |det M|. */
KERNEL real unit_p22(int kind, table t, unit_normal n)
{
    if (kind == VNDF_GGX)
        return ggx_p22(n.x, n.y, n.z);
    if (kind == VNDF_BECKMANN)
        return beckmann_p22(n.x, n.y, n.z);
    return table_p22(t, table_given(t, n.x, n.y, n.z));
}

/* The projected area in the unit problem. Above the horizon a table wants the knot of rho alone, not the law. */
KERNEL real unit_area(int kind, table t, frame f)
{
    if (kind == VNDF_GGX)
        return ggx_area(f.ux, f.uy, f.uz);
    if (kind == VNDF_BECKMANN)
        return beckmann_area(f.ux, f.uy, f.uz);
    const int below = frame_below(f);
    table_direction w = table_direction_of(f);
    radial_law v;
    v.s = w.s;
    v.c = w.c;
    v.rho = w.rho;
    if (below)
        v = law_see_below(t, w.s, w.c, w.rho, find_knot(t, w.square, w.under));
    return law_area(t, v, below) * frame_reach(f);
}

/* ---- surfaces ---- */

/* D(wm) per steradian; wm is unit, here and below. */
KERNEL real placed_ndf(int kind, table t, frame f, vec3 wm)
{
    const mask is_up = le(0.0f, wm.z);
    if (!any(is_up))
        return 0.0f;
    const real density = unit_p22(kind, t, frame_normal(f, wm.x, wm.y, wm.z)) / f.determinant;
    return select(is_up, min(density, 3.4028234e38f), 0.0f);
}

CALL real vndf_ndf(surface m, vec3 wm)
{
    const placed p = place(m, vec3(0.0f, 0.0f, 1.0f));
    if (!any(lt(0.0f, p.f.max_pdf))) /* the surface is not valid */
        return 0.0f;
    return placed_ndf(p.kind, p.t, p.f, wm);
}

/* A(w). */
CALL real vndf_projected_area(surface m, vec3 w)
{
    const placed p = place(m, w);
    return unit_area(p.kind, p.t, p.f) * p.f.size;
}

/* Lambda(w) = A(w)/cos - 1, where cos is w.z less what the mean slope takes of it. */
CALL real vndf_lambda(surface m, vec3 w)
{
    const placed p = place(m, w);
    return lambda_of(unit_area(p.kind, p.t, p.f) * p.f.size, p.f.uz * p.f.size);
}

CALL real vndf_g1(surface m, vec3 w)
{
    const placed p = place(m, w);
    return g1_of(unit_area(p.kind, p.t, p.f) * p.f.size, p.f.uz * p.f.size);
}

/* Masking and shadowing of two directions on the same side, height-correlated: 1/(1 + Lambda_i + Lambda_o). With 1 +
 * Lambda = 1/G1 it is the smaller G1 times a factor of at least 1/2: a product of two small ones would underflow. */
KERNEL real g2_of(real gi, real go)
{
    real lesser = min(gi, go), greater = max(gi, go);
    if (lesser == 0.0f)
        return 0.0f;
    return lesser * (greater / (greater + lesser * (1.0f - greater)));
}

KERNEL real g2(surface m, vec3 wi, vec3 wo)
{
    return g2_of(vndf_g1(m, wi), vndf_g1(m, wo));
}

/* ---- views ---- */

/* A(wi) in the unit problem. */
KERNEL real seen_unit_area(view s)
{
    const frame f = view_frame(s);
    if (s.kind == VNDF_GGX)
        return view_ggx(s).area;
    if (s.kind == VNDF_BECKMANN)
        return beckmann_area(f.ux, f.uy, f.uz);
    return law_area(view_table(s), view_law(s).v, s.below) * frame_reach(f);
}

/* A(wi). */
KERNEL real area(view s)
{
    return seen_unit_area(s) * view_frame(s).size;
}

/* The area of what is drawn. */
KERNEL real drawn_area(view s)
{
    const frame f = view_frame(s);
    real all = f.size;
    if (s.kind == VNDF_GGX || s.kind == VNDF_BECKMANN)
        all = area(s);
    else
        all = law_drawn_area(view_law(s).v, s.below) * frame_reach(f) * f.size;
    return select(lt(0.0f, f.max_pdf), all, 0.0f);
}

/* A(w) of another direction, and its projection on the mean plane: w.z without a mean slope. */
KERNEL real area_along(view s, vec3 w)
{
    const frame f = frame_of(view_frame(s).m, w.x, w.y, w.z);
    return unit_area(s.kind, view_table(s), f) * f.size;
}

KERNEL real cosine_along(view s, vec3 w)
{
    return affine_stretched(view_frame(s).m, w.x, w.y, w.z).z;
}

/* D(wm). */
KERNEL real seen_ndf(view s, vec3 wm)
{
    return placed_ndf(s.kind, view_table(s), view_frame(s), wm);
}

/* The factor K of the density with which a normal of the unit problem is drawn. */
KERNEL real unit_density(view s, unit_normal n)
{
    if (s.kind == VNDF_GGX)
        return ggx_density(view_ggx(s), n.x, n.y, n.z, n.facing);
    if (s.kind == VNDF_BECKMANN)
        return beckmann_density(view_beckmann(s), n.x, n.y, n.z, n.facing);
    const table_view v = view_law(s);
    const int below = s.below;
    const real reach = frame_reach(view_frame(s));
    unit_normal turned = n;
    if (below)
        turned = table_unturned(v.ex, v.ey, n);
    if (sides_apart && below)
        return table_pdf(view_table(s), v, turned, reach, 1);
    if (sides_apart)
        return table_pdf(view_table(s), v, turned, reach, 0);
    return table_pdf(view_table(s), v, turned, reach, below);
}

/* The density with which `sample` draws wm. */
KERNEL real pdf(view s, vec3 wm)
{
    const frame f = view_frame(s);
    const unit_normal n = frame_normal(f, wm.x, wm.y, wm.z);
    const mask is_seen = both(lt(0.0f, n.facing), le(0.0f, wm.z));
    if (!any(is_seen))
        return 0.0f;
    return select(is_seen, frame_density(f, unit_density(s, n) / f.determinant), 0.0f);
}

/* The visible normals D(wm) (wi . wm)/A(wi), from which a table differs by what it states. */
KERNEL real visible(view s, vec3 wm)
{
    const frame f = view_frame(s);
    const unit_normal n = frame_normal(f, wm.x, wm.y, wm.z);
    if (!(n.facing > 0.0f) || !(wm.z >= 0.0f))
        return 0.0f;
    if (s.kind == VNDF_GGX || s.kind == VNDF_BECKMANN)
        return frame_density(f, unit_density(s, n) / f.determinant);
    const real p22 = unit_p22(s.kind, view_table(s), n), area = max(seen_unit_area(s), 1e-37f);
    return frame_density(f, p22 / f.determinant * (n.facing / area));
}

/* ---- views: samples ---- */

/* A normal, the density per steradian with which it is drawn, and the quotient (visible density)/density: weights of
 * estimators have it as a factor. */
typedef struct sampled {
    vec3 wm;
    real pdf, weight;
} sampled;

KERNEL weighted_sample unit_draw(view s, real u1, real u2)
{
    weighted_sample w;
    w.weight = 1.0f;
    if (s.kind == VNDF_GGX)
        w.n = ggx_draw(view_ggx(s), u1, u2);
    else if (s.kind == VNDF_BECKMANN)
        w.n = beckmann_draw(view_beckmann(s), u1, u2);
    else
        w = table_draw_weighed(view_table(s), view_law(s), u1, u2, s.below, view_weighs(s));
    return w;
}

/* A slope length of all normals, which are those that are visible straight from above, `up`. */
KERNEL any_slope unit_slope(int kind, table t, frame up, real u2)
{
    if (kind == VNDF_GGX)
        return ggx_slope(u2);
    if (kind == VNDF_BECKMANN)
        return beckmann_slope(u2);
    return table_slope(t, table_view_of(t, up, 0), u2);
}

KERNEL sampled sample_on(frame f, weighted_sample w)
{
    const surface_sample n = frame_sampled(f, w.n);
    const sampled r = {vec3(n.x, n.y, n.z), n.pdf, w.weight};
    return r;
}

/* Draws a visible normal with two uniform numbers in [0, 1]. */
KERNEL sampled sample(view s, real u1, real u2)
{
    return sample_on(view_frame(s), unit_draw(s, unit_number(u1), unit_number(u2)));
}

/* The numbers that `sample` makes wm of. */
KERNEL pair invert(view s, vec3 wm)
{
    const unit_normal n = frame_normal(view_frame(s), wm.x, wm.y, max(wm.z, 0.0f));
    pair u;
    if (s.kind == VNDF_GGX)
        u = ggx_invert(view_ggx(s), n.x, n.y, n.z);
    else if (s.kind == VNDF_BECKMANN)
        u = beckmann_invert(view_beckmann(s), n.x, n.y, n.z);
    else
        u = table_numbers(view_table(s), view_law(s), n, s.below);
    u.a = unit_number(u.a);
    u.b = unit_number(u.b);
    return u;
}

#endif
