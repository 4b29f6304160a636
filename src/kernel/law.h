/* Visible normals of a table in its unit problem: the law of the slope length R.
 *
 * Seen from (s, 0, c), s + |c| = 1, rho = |c|/s, y = R/rho, the visible normals have the marginal
 *
 *     (|c|/(pi A)) k(y) f(R),      k = acos(-1/y) + sqrt(y^2 - 1) for y > 1, pi below, above the horizon;
 *                                  k = sqrt(y^2 - 1) - acos(1/y) for y > 1, 0 below, below the horizon.
 *
 * What is drawn has k~ instead, whose integrals are sums of one-dimensional moments of f, the same for all directions:
 *
 *     above  k~ = a_1 y + a_0 + a_-1/y + a_-4/y^4 beyond a knot near rho, pi before it,
 *     below  k~ = b_0 (y - 1) + b_1 (y - 1)^2/y, with shares that are a function of rho,
 *
 * and is exact in all else, so weights are within 6.5e-2, 4.7e-3 or 7.2e-4 of their mean above the horizon, for 2, 3 or
 * 4 terms and any D (least-maximum fits: |k~ - k| <= e k for y >= 1, the terms over pi sum to 1;
 * tools/evidence/fits.py). Cell by cell the law is the monotone rational quadratic of Gregory & Delbourgo (IMA J.
 * Numer. Anal. 2, 1982) through the mass and the densities at both ends. */
#ifndef VNDF_KERNEL_LAW_H
#define VNDF_KERNEL_LAW_H

#include "kernel/arc.h"

/* a_1, a_0, a_-1, a_-4, over pi, for 2, 3 and 4 terms. */
static const float law_terms[12] = {0.297494729f, 0.702505271f, 0.0f,         0.0f,
                                    0.319817399f, 0.473797580f, 0.206385021f, 0.0f,
                                    0.318081264f, 0.504334526f, 0.151012047f, 0.026572163f};

/* ---- rows of a table (layout.h) ---- */

typedef struct knot_row {
    real r, z, width, turn;
} knot_row;

KERNEL knot_row load_knot(table t, integer i)
{
    quad q = load_row(t, VNDF_KNOT, i);
    knot_row row = {q.x, q.y, q.z, q.w};
    return row;
}

typedef struct law_row {
    real left, right, m0, m1;
} law_row;

KERNEL law_row load_law(table t, integer i)
{
    quad q = load_row(t, VNDF_LAW, i);
    law_row row = {q.x, q.y, q.z, q.w};
    return row;
}

typedef struct shares_row {
    real m2, cube, b0, b1;
} shares_row;

KERNEL shares_row load_shares(table t, integer i)
{
    quad q = load_row(t, VNDF_SHARES, i);
    shares_row row = {q.x, q.y, q.z, q.w};
    return row;
}

typedef struct tail_row {
    real along, all, over, over4;
} tail_row;

KERNEL tail_row load_tail(table t, integer i)
{
    quad q = load_row(t, VNDF_TAIL, i);
    tail_row row = {q.x, q.y, q.z, q.w};
    return row;
}

typedef struct area_row {
    real t1, t2, area, slope;
} area_row;

KERNEL area_row load_area(table t, integer i)
{
    quad q = load_row(t, VNDF_AREA, i);
    area_row row = {q.x, q.y, q.z, q.w};
    return row;
}

/* Weights of the measures f R, f, f/R, f/R^4. */
typedef struct weights {
    real w1, w0, wq, w4;
} weights;

/* The law of R that a table draws from one direction. */
typedef struct radial_law {
    real s, c, rho;
    integer first; /* above: the knot where k~ begins; below: the cell of rho */
    weights
        w; /* above: the terms of k~; below: shares b_0, b_1, then mass and end density of the cell cut at rho */
    real near; /* above: the mass before `first`; below: the visible part of the cell cut at rho, in xi */
    real total;
} radial_law;

#ifndef VNDF_KERNEL_FINDS /* searches that the page does not have */

/* The last knot R with R^2 under <= square. A slope sqrt(square/under) is found without a root or a division. */
KERNEL integer find_knot(table t, real square, real under)
{
    integer i = set_int(0);
    int step = t.highest;
    for (int n = 0; n < t.steps; n++) {
        integer next = min_int(i + step, set_int(t.cells));
        real r = load_knot(t, next).r;
        i = select_int(le((r * r) * under, square), next, i);
        step = step / 2;
    }
    return i;
}

/* The last knot beyond which at least `left` of the law lies. All terms fall from knot to knot, so rounded sums fall
 * too. */
KERNEL integer find_sum(table t, real w1, real w0, real wq, real w4, real left)
{
    integer i = set_int(0);
    int step = t.highest;
    for (int n = 0; n < t.steps; n++) {
        integer next = min_int(i + step, set_int(t.cells));
        tail_row tail = load_tail(t, next);
        i = select_int(le(left, (w1 * tail.along + w0 * tail.all) + (wq * tail.over + w4 * tail.over4)), next, i);
        step = step / 2;
    }
    return i;
}

#endif

/* ---- above the horizon ---- */

/* In cell 0 (where f/R has no finite moment), in the tail cell, and for rho outside the look-up range, k~ is
 * a_1 y + pi. */
KERNEL weights law_weights_at(weights w, real c, mask end)
{
    weights at = {w.w1, select(end, c, w.w0), select(end, set(0.0f), w.wq), select(end, set(0.0f), w.w4)};
    return at;
}

KERNEL real law_sum(weights w, tail_row tail)
{
    return (w.w1 * tail.along + w.w0 * tail.all) + (w.wq * tail.over + w.w4 * tail.over4);
}

/* Index of the eighth of an octave that holds rho (table/layout.h). */
KERNEL integer law_eighth(real rho)
{
    return min_int(max_int((bits(rho) >> 20) - VNDF_RHO_FIRST, set_int(0)), set_int(VNDF_RHO_PARTS - 1));
}

/* Below knot `first` every normal is visible and the law is c f; its mass there is c (1 - tail.all). If `first` is 0
 * that is the mass of cell 0, since knot 0 holds the sums of knot 1 (table/layout.h). A mass below 1e-12 of all is
 * dropped: u2 = 0 alone would draw it, far too often. */
KERNEL radial_law law_see_above(table t, real s, real c, real rho)
{
    radial_law v;
    v.s = s;
    v.c = c;
    v.rho = rho;
    integer eighth = law_eighth(rho);
    v.first = first_knot(t, eighth);
    tail_row tail = load_tail(t, v.first);
    real reach = min(rho, set(1e9f)), square = reach * reach;
    int n = 4 * (t.moments - 2);
    mask low = lt(rho, set(1e-3f)); /* where R^-4 adds next to nothing, and denormal numbers */
    weights w = {s * law_terms[n], c * law_terms[n + 1], c * reach * law_terms[n + 2],
                 select(low, set(0.0f), c * (square * square) * law_terms[n + 3])};
    v.w = law_weights_at(w, c, either(eq(v.first, t.cells), eq(eighth, VNDF_RHO_PARTS - 1)));
    real near = c * max(1.0f - tail.all, set(0.0f));
    v.total = near + law_sum(v.w, tail);
    v.near = select(either(eq(v.first, 0), lt(near, 1e-12f * v.total)), set(0.0f), near);
    return v;
}

/* ---- a cell ---- */

/* The density of one cell: its mass, both end densities, and both ends of its slopes. `width` is dx/dxi at the left
 * end. */
typedef struct cell_density {
    real mass, per, e0, e1, sum; /* per: 1/mass; e0 + e1 */
    real from, x0, z0, x1, z1;   /* the slope where it begins */
    real edge0, edge1, width;    /* edge: s x - |c| z */
    mask last;
} cell_density;

KERNEL cell_density law_cell_at(table t, real s, real c, integer i, knot_row k)
{
    cell_density at;
    at.last = eq(i, t.cells);
    at.from = k.r;
    at.z0 = k.z;
    at.x0 = k.r * k.z;
    at.width = k.width;
    at.x1 = select(at.last, set(1.0f), at.x0 + k.width);
    at.z1 = select(at.last, set(0.0f), at.z0 - k.width);
    at.edge0 = s * at.x0 - c * at.z0;
    at.edge1 = s * at.x1 - c * at.z1;
    return at;
}

/* Completes a cell with its mass and end densities; the latter are kept over the mass. */
KERNEL cell_density law_cell_of(cell_density bare, real mass, real d0, real d1)
{
    cell_density at = bare;
    at.mass = max(mass, set(1e-36f));
    at.per = 1.0f / at.mass;
    at.e0 = d0 * at.per;
    at.e1 = d1 * at.per;
    at.sum = (d0 + d1) * at.per;
    return at;
}

/* Denominator of the rational quadratic at xi = over/(over + rest), times (over + rest)^2. */
KERNEL real law_denominator(cell_density at, real over, real rest)
{
    real under = over + rest;
    return under * under + (at.sum - 2.0f) * (over * rest);
}

/* Numerator of the density: mass per xi times denominator^2, over (over + rest)^2. */
KERNEL real law_shape(cell_density at, real over, real rest)
{
    return at.mass * (at.e1 * (over * over) + 2.0f * (over * rest) + at.e0 * (rest * rest));
}

/* w_1 x^2 + w_0 x z + w_q z^2: the weight over z^2. */
KERNEL real law_weight_at(weights w, real x, real z)
{
    return x * (w.w1 * x + w.w0 * z) + w.wq * (z * z);
}

/* The term R^-4 is R^-1 times the cell's mean of R^-3, so its mass is exact. */
KERNEL cell_density law_cell_above(table t, radial_law v, weights of_all, integer i)
{
    knot_row k = load_knot(t, i);
    law_row l = load_law(t, i);
    shares_row more = load_shares(t, i);
    cell_density at = law_cell_at(t, v.s, v.c, i, k);
    weights w = law_weights_at(of_all, v.c, eq(i, 0));
    w.wq = w.wq + w.w4 * more.cube;
    real a = w.w1 * k.r, line = a + w.w0, m = w.w1 * more.m2 + (line + a) * l.m1 + (line * k.r + w.wq) * l.m0;
    return law_cell_of(at, m, l.left * law_weight_at(w, at.x0, at.z0), l.right * law_weight_at(w, at.x1, at.z1));
}

/* The cell of f itself, not of the law. The tail cell holds f R, which is smooth for heavy tails too; law_of_f divides
 * R out. */
KERNEL cell_density law_cell_all(table t, integer i)
{
    knot_row k = load_knot(t, i);
    law_row l = load_law(t, i);
    shares_row more = load_shares(t, i);
    cell_density at = law_cell_at(t, set(1.0f), set(0.0f), i, k);
    real m = l.m1 + k.r * l.m0, slope = more.m2 + k.r * (l.m1 + m), z0 = select(at.last, at.x0, at.z0),
         z1 = select(at.last, at.x1, at.z1);
    return law_cell_of(at, select(at.last, slope, m), l.left * (at.x0 * z0), l.right * (at.x1 * z1));
}

/* law_shape of that cell at the slope length x/z. */
KERNEL real law_of_f(cell_density at, real over, real rest, real x, real z)
{
    real m = law_shape(at, over, rest);
    return select(at.last, m * (z / x), m);
}

/* ---- below the horizon ---- */

/* Mass beyond the knot r, as a sum of positive terms; beyond = r - rho >= 0. */
KERNEL real law_sum_below(weights w, real r, real beyond, tail_row tail, area_row low)
{
    real e = w.w1 * r + w.w0 * beyond;
    return (w.w1 + w.w0) * (low.t2 + beyond * low.t1) + e * (low.t1 + beyond * tail.over);
}

/* The weight W/z^2 at R = x/z, where beyond/z = R - rho. */
KERNEL real law_weight_below(weights w, real x, real beyond)
{
    return beyond * (w.w1 * x + w.w0 * beyond);
}

/* The cell cut at rho: mass (wq) and end density (w4) of its visible part. The density starts at 0; it is estimated
 * from the densities of f/R at both ends, scaled so that the mass is exact if rho is the knot. The end density is at
 * most 1e4 times the mean, which keeps the places of law_invert moderate. `part` is the visible part in xi. */
KERNEL weights law_partial(weights of_all, real rho, mask last, knot_row k, knot_row after, law_row l, real m2,
                           real part)
{
    weights w = of_all;
    real x1 = select(last, set(1.0f), after.r * after.z), one = set(1.0f);
    real beyond = select(last, one, max(after.r - rho, set(0.0f)) * after.z);
    real at_knot = select(last, one, (after.r - k.r) * after.z);
    real all = (w.w1 + w.w0) * m2 + w.w1 * k.r * l.m1, third = 0.333333333f * l.right + 0.166666667f * l.left;
    real near = law_weight_below(w, x1, at_knot) * third, end = part * law_weight_below(w, x1, beyond);
    real here = third + 0.166666667f * (1.0f - part) * (l.right - l.left),
         factor = all / max(near, 1e-3f * all + 1e-36f);
    w.wq = max(end * here * factor, set(1e-34f));
    w.w4 = min(end * l.right, 1e4f * w.wq);
    return w;
}

KERNEL radial_law law_see_below(table t, real s, real c, real rho, integer cell)
{
    radial_law v;
    v.s = s;
    v.c = c;
    v.rho = rho;
    v.first = cell;
    mask last = eq(v.first, t.cells);
    integer next = select_int(last, v.first, v.first + 1);
    knot_row k = load_knot(t, v.first), after = load_knot(t, next);
    shares_row more = load_shares(t, v.first), shares = load_shares(t, next);
    real beyond = max(after.r - v.rho, set(0.0f)), tail = min(s / k.z, set(1.0f));
    for (int n = 0; n < t.squarings; n++)
        tail = sqrt(tail);
    v.near = min(max(select(last, tail, s * (beyond * after.z) / k.width), set(1e-9f)), set(1.0f));
    real xi = 1.0f - v.near;
    weights w = {more.b0 + xi * (shares.b0 - more.b0), more.b1 + xi * (shares.b1 - more.b1), set(0.0f), set(0.0f)};
    v.w = law_partial(w, v.rho, last, k, after, load_law(t, v.first), more.m2, v.near);
    real rest = law_sum_below(v.w, after.r, beyond, load_tail(t, next), load_area(t, next));
    v.total = v.w.wq + select(last, set(0.0f), rest);
    return v;
}

/* The mass beyond knot i, which is at rho or beyond it. */
KERNEL real law_beyond(table t, radial_law v, integer i)
{
    real r = load_knot(t, i).r;
    return law_sum_below(v.w, r, max(r - v.rho, set(0.0f)), load_tail(t, i), load_area(t, i));
}

/* True if the sample lies at or beyond knot `next`. Rounded sums need not fall from knot to knot here, so the cell
 * found depends on the order of the steps: all searches take the same. */
KERNEL mask law_passes(table t, radial_law v, integer next, real beyond, real left)
{
    return either(le(to_real(next), to_real(v.first)),
                  both(le(to_real(next), to_real(set_int(t.cells))), le(left, beyond)));
}

/* The last knot, from the cell of rho on, beyond which at least `left` of the law lies. */
KERNEL integer law_find_below(table t, radial_law v, real left)
{
    integer i = set_int(0);
    int step = t.highest;
    for (int n = 0; n < t.steps; n++) {
        integer next = i + step;
        real beyond = law_beyond(t, v, min_int(next, set_int(t.cells)));
        i = select_int(law_passes(t, v, next, beyond, left), next, i);
        step = step / 2;
    }
    return i;
}

KERNEL cell_density law_cell_below(table t, radial_law v, integer i)
{
    knot_row k = load_knot(t, i);
    law_row l = load_law(t, i);
    shares_row more = load_shares(t, i);
    cell_density at = law_cell_at(t, v.s, v.c, i, k);
    real beyond = max(k.r - v.rho, set(0.0f)), e = v.w.w1 * k.r + v.w.w0 * beyond, b = v.w.w1 + v.w.w0;
    real m = b * more.m2 + (b * beyond + e) * l.m1 + beyond * e * l.m0, start = beyond * at.z0;
    real end = select(at.last, set(1.0f), k.width * (1.0f + k.r) + beyond * at.z1);
    real d0 = l.left * law_weight_below(v.w, at.x0, start), d1 = l.right * law_weight_below(v.w, at.x1, end);
    mask partial = le(to_real(i), to_real(v.first));
    at.from = select(partial, v.rho, at.from);
    at.x0 = select(partial, -v.c, at.x0);
    at.z0 = select(partial, v.s, at.z0);
    at.width = select(partial, select(at.last, k.width * (v.s / k.z), k.width * v.near), at.width);
    at.edge0 = select(partial, set(0.0f), v.s * start);
    at.edge1 = select(at.last, v.s, at.edge0 + at.width);
    return law_cell_of(at, select(partial, v.w.wq, m), select(partial, set(0.0f), d0),
                       select(partial, v.w.w4, d1));
}

/* ---- places in a cell ---- */

/* xi as a fraction: xi = over/under, 1 - xi = rest/under, under = over + rest; neither is a difference. The density per
 * xi is mass root under^2/denominator. */
typedef struct cell_place {
    real over, rest, root, denominator;
} cell_place;

/* Solves for xi with the mass m before it, by the form of the quadratic's root that has no cancellation. */
KERNEL cell_place law_invert(cell_density at, real m)
{
    real q = min(max(m * at.per, set(1e-12f)), set(0.99999994f)), p = 1.0f - q;
    real middle = at.e0 - q * at.sum, square = sqrt(middle * middle + (4.0f * q) * p);
    mask rising = le(set(0.0f), middle + 2.0f * q);
    cell_place in = {select(rising, 2.0f * q, square - middle), select(rising, square + middle, 2.0f * p), square,
                     set(0.0f)};
    in.denominator = law_denominator(at, in.over, in.rest);
    return in;
}

/* A slope length R = x/z in a cell, with edge = s x - |c| z; all are times over + rest. */
typedef struct slope_length {
    real x, z, edge;
} slope_length;

KERNEL slope_length law_length(table t, radial_law v, cell_density at, cell_place in, const int below)
{
    real under = in.over + in.rest;
    slope_length r = {at.x0 * in.rest + at.x1 * in.over, at.z0 * in.rest + at.z1 * in.over,
                      at.edge0 * in.rest + at.edge1 * in.over};
    if (!below)
        r.edge = v.s * r.x - v.c * r.z;
    if (t.squarings > 0 && any(at.last)) {
        real power = in.rest / under;
        for (int n = 0; n < t.squarings; n++)
            power = power * power;
        r.z = select(at.last, max(at.z0 * power, set(1e-26f)) * under, r.z); /* no slope beyond 1e26 */
        r.x = select(at.last, under - r.z, r.x);
        r.edge = select(at.last, v.s * under - r.z, r.edge);
    }
    return r;
}

/* xi of the slope x/z in its cell; per = 1/(x + z). */
KERNEL cell_place law_place(table t, cell_density at, real x, real z, real per)
{
    real over = (x - at.from * z) * (per * (at.z0 / at.width)), rest = 1.0f - over;
    if (any(at.last)) { /* there 1 - xi is what keeps its digits */
        real eta = z * per / at.z0;
        for (int n = 0; n < t.squarings; n++)
            eta = sqrt(eta);
        rest = select(at.last, eta, rest);
        if (t.squarings > 0)
            over = select(at.last, 1.0f - eta, over);
    }
    over = min(max(over, set(1e-6f)), set(0.9999999f));
    rest = min(max(rest, set(1e-7f)), set(0.999999f));
    cell_place in = {over, rest, set(0.0f), set(0.0f)};
    in.denominator = law_denominator(at, in.over, in.rest);
    return in;
}

/* dx/dxi at a place. */
KERNEL real law_width(table t, cell_density at, cell_place in)
{
    real width = at.width;
    if (t.squarings > 0 && any(at.last)) {
        real power = set(1.0f), eta = in.rest / (in.over + in.rest);
        for (int n = 0; n < t.squarings; n++) { /* eta^(2^n - 1) */
            power = power * eta;
            eta = eta * eta;
        }
        width = select(at.last, width * max(power, set(1e-30f)), width);
    }
    return width;
}

/* ---- area ---- */

/* A/(c + s) above the horizon for the direction (s, 0, |c|): a cubic spline of c/(c + s). `cell` is that of rho. */
KERNEL real law_area_above(table t, radial_law v, integer cell)
{
    mask last = eq(cell, t.cells);
    integer next = select_int(last, cell, cell + 1);
    knot_row k = load_knot(t, cell);
    area_row low = load_area(t, cell), up = load_area(t, next);
    real width = select(last, k.z, k.width), a1 = select(last, set(1.0f), up.area),
         d1 = width * select(last, set(1.0f), up.slope);
    real u = min((v.rho - k.r) * k.z * v.s / width, set(1.0f)), w = 1.0f - u, d0 = width * low.slope;
    real area = w * w * (low.area + u * (2.0f * low.area + d0)) + u * u * (a1 + w * (2.0f * a1 - d1));
    return max(area, abs(v.c)); /* no less than the plane */
}

/* The area of the drawn law, over s + |c|; mixtures share by it since it costs nothing. Straight from below it is 0. */
KERNEL real law_drawn_area(radial_law v, const int below)
{
    if (!below)
        return v.total;
    return select(lt(set(2e-15f), v.s), v.s * v.total * 0.318309886f, set(0.0f));
}

/* The projected area over s + |c|. Above: the spline. Below: the spline less |c| while that difference keeps its
 * digits, blended into the area of the drawn law where it does not. */
KERNEL real law_area_in(table t, radial_law v, integer cell, const int below)
{
    real above = law_area_above(t, v, cell);
    if (!below)
        return above;
    real sampled = law_drawn_area(v, below);
    real mixed = min(max((sampled / above - 4e-4f) * 625.0f, set(0.0f)), set(1.0f));
    return sampled + mixed * ((above - abs(v.c)) - sampled);
}

KERNEL real law_area(table t, radial_law v, const int below)
{
    return law_area_in(t, v, find_knot(t, v.rho * v.rho, set(1.0f)), below);
}

#endif
