/* Visible normals of a table in the unit problem: draws, densities and inverses.
 *
 * A sample from the direction (s, 0, c) with the random numbers u1, u2:
 *
 *     1. m = u2 times the mass of the law of R                          table_aim
 *     2. find the cell with the mass m in it                            table_find, table_cell
 *     3. invert the rational quadratic of the cell: xi, then R          law_invert, table_length  (law.h)
 *     4. the arc of azimuths that are visible at R                      table_arc
 *     5. solve Kepler's equation for the azimuth of u1                  arc_draw                  (arc.h)
 *     6. the normal and its density                                     table_normal
 *     7. if asked, the true density over the drawn one                  table_weight
 *
 * Each step is a function: batches take it for a block of samples before the next, since a processor overlaps short
 * bodies better than one long one (sample.h has them in a row). */
#ifndef VNDF_KERNEL_DRAW_H
#define VNDF_KERNEL_DRAW_H

#include "kernel/law.h"

/* The mass `at` before the sampled slope and `left` beyond it, in the law with these weights. */
typedef struct target {
    weights w;
    real at, left;
} target;

/* The weights of the law; it is c f before `first` (near). */
KERNEL weights table_weights(radial_law v, mask near)
{
    weights w = {select(near, set(0.0f), v.w.w1), select(near, v.c, v.w.w0), select(near, set(0.0f), v.w.wq),
                 select(near, set(0.0f), v.w.w4)};
    return w;
}

KERNEL target table_aim(radial_law v, real u2, const int below)
{
    real at = min(u2, set(0.99999994f)) * v.total;
    target a = {v.w, at, v.total - at};
    if (!below) {
        mask near = lt(at, v.near);
        a.w = table_weights(v, near);
        a.left = select(near, v.c - at, a.left);
    }
    return a;
}

/* The cell of the slope, and the mass beyond its knot. Rounding may put the cell across `first`; the sample is then
 * clamped to that knot. */
typedef struct knot_hit {
    integer i;
    real beyond;
} knot_hit;

KERNEL knot_hit table_find(table t, radial_law v, target a, const int below)
{
    knot_hit r;
    if (below) {
        r.i = law_find_below(t, v, a.left);
        r.beyond = law_beyond(t, v, r.i);
    } else {
        r.i = find_sum(t, a.w.w1, a.w.w0, a.w.wq, a.w.w4, a.left);
        r.beyond = law_sum(a.w, load_tail(t, r.i));
    }
    return r;
}

/* The cell of the slope, and the mass in it before the slope. */
typedef struct cell_hit {
    cell_density at;
    real before;
} cell_hit;

KERNEL cell_hit table_cell(table t, radial_law v, target a, knot_hit r, const int below)
{
    cell_hit f;
    f.before = r.beyond - a.left;
    if (below) {
        f.at = law_cell_below(t, v, r.i);
        f.before = select(le(to_real(r.i), to_real(v.first)), a.at, f.before);
    } else {
        f.at = law_cell_above(t, v, a.w, r.i);
        f.before = select(eq(r.i, 0), a.at, f.before);
    }
    return f;
}

/* A sampled slope length, scaled as law.h scales it, and its density. */
typedef struct length_sample {
    slope_length r;
    real density; /* over x total */
} length_sample;

KERNEL length_sample table_length(table t, radial_law v, cell_hit f, cell_place in, const int below)
{
    length_sample d;
    d.r = law_length(t, v, f.at, in, below);
    d.density = (f.at.mass * in.root) / (in.denominator * law_width(t, f.at, in) * (d.r.x * v.total));
    return d;
}

KERNEL arc table_arc(radial_law v, slope_length r, const int below)
{
    if (below)
        return arc_of(-v.c * r.z, v.s * r.x, r.edge, below);
    return arc_of(v.c * r.z, v.s * r.x, r.edge, below);
}

/* The normal, not of unit length, in the frame whose x points towards the direction. */
KERNEL normal_sample table_normal(radial_law v, length_sample d, arc k, azimuth a)
{
    real reach = k.sum / v.s, facing = max(a.visible, set(1e-7f) * k.mass);
    normal_sample n = {a.cosine * reach, a.sine * reach, d.r.z, (d.density / (2.0f * k.mass)) * facing};
    return n;
}

/* True over drawn density of a sample whose slope lies at `in` of cell i; 0 from below if the area is under 1e-30. */
KERNEL real table_weight(table t, radial_law v, integer i, cell_hit f, cell_place in, slope_length r, arc k,
                         real area, const int below)
{
    cell_density all = law_cell_all(t, i);
    real over = in.over, rest = in.rest, under = over + rest, part = set(1.0f);
    real z = max(r.z, 1e-36f * r.x); /* which rounding makes 0 at the very end */
    if (below) {                     /* from the place in what is seen of the cell to that in the cell */
        part = select(le(to_real(i), to_real(v.first)), v.near, part);
        rest = rest * part;
        over = under - rest;
    }
    real below_all = law_denominator(all, over, rest),
         f_mass = law_of_f(all, over, rest, r.x, z) * f.at.per / (below_all * below_all);
    real weight =
        f_mass * part * ((in.denominator * v.total) / (in.root * area)) * (0.318309886f * k.mass * k.sum / z);
    if (below)
        weight = select(lt(set(1e-30f), area), weight, set(0.0f));
    return weight;
}

/* ---- given normals ---- */

/* Slope and cell of a normal (x, y, z) of any length, in the frame of the direction. */
typedef struct query {
    real square, under;         /* squares of the slope's two parts, by which its cell is found */
    real across, up, per, x, z; /* slope = across/up; 1/(across + up), and both times that */
    integer cell;
} query;

KERNEL query table_given_slope(real x, real y, real z)
{
    query g;
    g.square = min(x * x + y * y, set(3.4028234e38f)); /* not infinite, which no end of the knots would exceed */
    g.under = z * z;
    g.across = sqrt(g.square);
    g.up = max(z, g.across * 1e-28f);
    g.per = 1.0f / (g.across + g.up);
    g.x = g.across * g.per;
    g.z = g.up * g.per;
    g.cell = set_int(0);
    return g;
}

KERNEL query table_given(table t, real x, real y, real z)
{
    query g = table_given_slope(x, y, z);
    g.cell = find_knot(t, g.square, g.under);
    return g;
}

/* The density of the law in cell i. */
KERNEL cell_density table_given_cell(table t, radial_law v, integer i, const int below)
{
    if (below)
        return law_cell_below(t, v, i);
    return law_cell_above(t, v, table_weights(v, lt(to_real(i), to_real(v.first))), i);
}

KERNEL arc table_given_arc(radial_law v, query g, const int below)
{
    real edge = v.s * g.x - abs(v.c) * g.z;
    if (below)
        edge = (g.across - v.rho * g.up) * (g.per * v.s);
    return arc_of(abs(v.c) * g.z, v.s * g.x, edge, below);
}

/* Density of a given normal, over len^3/|det| per steradian (math.h); facing = (s, 0, c) . n. */
KERNEL real table_density(table t, radial_law v, query g, real facing, const int below)
{
    integer i = g.cell;
    if (below)
        i = max_int(i, v.first);
    cell_density at = table_given_cell(t, v, i, below);
    cell_place in = law_place(t, at, g.across, g.up, g.per);
    arc k = table_given_arc(v, g, below);
    real x = select(eq(i, 0), at.x0 * in.rest + at.x1 * in.over, g.x),
         per = g.per * g.per; /* held away from the pole */
    real per_x =
        law_shape(at, in.over, in.rest) / (in.denominator * in.denominator * law_width(t, at, in) * (x * v.total));
    return per_x * (max(facing * g.per, 1e-7f * (k.mass * k.sum)) / (2.0f * k.mass * k.sum)) * (per * g.per);
}

/* P22/z^4 of a given normal, which is D |det|/len^4. */
KERNEL real table_p22(table t, query g)
{
    cell_density all = law_cell_all(t, g.cell);
    cell_place in = law_place(t, all, g.across, g.up, g.per);
    real per = g.per * g.per, density = law_of_f(all, in.over, in.rest, g.x, g.z);
    density = density / (in.denominator * in.denominator * law_width(t, all, in));
    real x = select(eq(g.cell, 0), all.x1 * in.over, g.x);
    return density / (6.28318531f * x * g.z) * (per * per);
}

/* Inverse of a sample: the numbers u1, u2 that draw a given normal, within some roundings. */
KERNEL pair table_invert(table t, radial_law v, query g, real x, real y, const int below)
{
    integer i = g.cell;
    if (below)
        i = max_int(i, v.first);
    cell_density at = table_given_cell(t, v, i, below);
    cell_place in = law_place(t, at, g.across, g.up, g.per);
    real before = at.mass * in.over * (in.over + at.e0 * in.rest) / in.denominator;
    real sum = before;
    if (below)
        sum = select(le(to_real(i), to_real(v.first)), before, (v.total - law_beyond(t, v, i)) + before);
    else {
        tail_row tail = load_tail(t, i);
        mask near = lt(to_real(i), to_real(v.first));
        sum = select(near, v.c * (1.0f - tail.all) + before, (v.total - law_sum(v.w, tail)) + before);
        sum = select(eq(i, 0), before, sum);
    }
    pair u = {arc_invert(table_given_arc(v, g, below), x, y), min(max(sum / v.total, set(0.0f)), set(1.0f))};
    return u;
}

#endif
