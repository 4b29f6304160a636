/* The draw of the exact tier (exact.h) for directions below the horizon, in lanes of doubles. The steps, and their order
 * of operations, are those of exact.c, exact_azimuth.c and exact_radius.c, which serve one: the bits are the same. What
 * is rare there clears `trusted` here. */
#ifndef VNDF_SAMPLER_TABULATED_BELOW_H
#define VNDF_SAMPLER_TABULATED_BELOW_H

#include "sampler/tabulated/azimuth.h"
#include "sampler/tabulated/density_wedge.h"
#include "sampler/tabulated/exact_cell.h"

/* The stretched direction (stretch.h): s and c, and the azimuth to turn to as floats. */
typedef struct vndf_below_view {
    doubles s, c, cos_phi, sin_phi;
} vndf_below_view;

VNDF_INLINE vndf_below_view vndf_below_view_of(const vndf_direction *wi, doubles_m *trusted)
{
    doubles x = wi->ax * wi->x, y = wi->ay * wi->y, across2 = x * x + y * y, across = doubles_root(across2);
    doubles per = 1.0 / (across + doubles_abs(wi->z)), per_across = 1.0 / across;
    vndf_below_view w = {across * per, wi->z * per, doubles_widen(doubles_narrow(x * per_across)),
                         doubles_widen(doubles_narrow(y * per_across))};
    *trusted = doubles_both(*trusted, doubles_less(doubles_set(1e-20), across2));
    return w;
}

/* ---- azimuth ---- */

/* Cosine and sine of |a|, both times n. */
typedef struct vndf_below_azimuth {
    doubles cosine, sine, n;
} vndf_below_azimuth;

/* The cell of each lane's row: the search is in float. */
VNDF_INLINE doubles_u vndf_below_find_azimuth(const vndf_wedge *w, const vndf_shares *s, doubles target)
{
    uint32_t row[VNDF_DOUBLES], cell[VNDF_DOUBLES];
    float first[VNDF_DOUBLES], middle[VNDF_DOUBLES], last[VNDF_DOUBLES], goal[VNDF_DOUBLES];
    doubles_spill_u(row, s->row);
    doubles_store_f(first, doubles_narrow(s->first));
    doubles_store_f(middle, doubles_narrow(s->middle));
    doubles_store_f(last, doubles_narrow(s->last));
    doubles_store_f(goal, doubles_narrow(target));
    for (int i = 0; i < VNDF_DOUBLES; i++)
        cell[i] = vndf_azimuth_find(w, row[i], first[i], middle[i], last[i], goal[i]);
    return doubles_load_u(cell);
}

/* Mass before cell j of the mix. */
VNDF_INLINE doubles vndf_below_mass_before(const vndf_wedge *w, const vndf_shares *s, doubles_u j)
{
    doubles_u at = s->row * w->stride + j;
    return s->first * doubles_gather(w->cdf, at) + s->middle * doubles_gather(w->cdf + w->stride, at) +
           s->last * doubles_gather(w->cdf + 2 * (size_t)w->stride, at);
}

/* The azimuth with the part `part` of the row's mass before it. */
VNDF_INLINE vndf_below_azimuth vndf_below_draw_azimuth(const vndf_wedge *w, doubles y, doubles part,
                                                       vndf_wedge_near *near)
{
    const double least = 1e-7; /* at a right angle from wi nothing is visible */
    vndf_shares s = near->shares = vndf_shares_at(w, y);
    doubles target = part * s.square;
    doubles_u j = near->azimuth = vndf_below_find_azimuth(w, &s, target);
    doubles from = vndf_cell_end(w, 0, j), to = vndf_cell_end(w, 1, j), h = to - from;
    vndf_mixed_cell mixed = vndf_shares_cell(w, &s, j);
    vndf_exact_cell cell = {mixed.begin * h, mixed.end * h, mixed.mass};
    vndf_exact_place in = vndf_exact_cell_invert(&cell, target - vndf_below_mass_before(w, &s, j));
    doubles q = from + in.xi * h, rest = (1.0 - to) + in.eta * h;
    doubles along = s.p * rest * (1.0 + q), aside = 2.0 * s.r * q, n = doubles_root(along * along + aside * aside);
    doubles some = least * n;
    vndf_below_azimuth a = {doubles_pick(doubles_less(some, along), along, some), aside, n};
    return a;
}

/* ---- radius: k = 1 ---- */

/* A part of the law (vndf_engine_piece), and the knots of its cell. */
typedef struct vndf_below_piece {
    vndf_exact_cell cell;
    doubles v0, v1, begin, length;
    doubles_four knots; /* x0, z0, x1, z1 */
    doubles beyond;     /* mass beyond the cell */
} vndf_below_piece;

VNDF_INLINE doubles_four vndf_below_cell(const vndf_distribution *d, doubles_u j)
{
    vndf_radial_location at;
    at.cell = j;
    return vndf_radial_location_cell(d, &at);
}

/* What cells have in common: knots, and W at both. */
VNDF_INLINE vndf_below_piece vndf_below_knots(const vndf_distribution *d, doubles c, doubles_u j, doubles *w0,
                                              doubles *w1)
{
    doubles_lines knots = doubles_lines_at(&d->knots.at->x, 2, j),
                  tail = doubles_lines_at(&d->knots.tail[1].s, 2, j);
    doubles_four sums = doubles_load_four(&tail, 0);
    vndf_below_piece p;
    p.knots = doubles_load_four(&knots, 0);
    *w0 = c * p.knots.b + p.knots.a;
    *w1 = doubles_positive(c * p.knots.d + p.knots.c);
    p.beyond = sums.a + *w1 * sums.b;
    return p;
}

/* The visible part of the cell of the cut: the outer one, so the cubic is turned. */
VNDF_INLINE vndf_below_piece vndf_below_at_cut(const vndf_distribution *d, doubles c, doubles_u cut)
{
    const doubles nothing = doubles_set(0.0);
    doubles end, w;
    vndf_below_piece p = vndf_below_knots(d, c, cut, &end, &w);
    doubles_four f = vndf_below_cell(d, cut);
    vndf_bump bump = vndf_bump_of(f), bend = {bump.a + bump.b, nothing - bump.b};
    doubles h = vndf_visible_part(w, end), half = 0.5 * w * h;
    doubles cubic = f.b * (1.0 - h) + f.a * h + h * (1.0 - h) * (bend.a + bend.b * h);
    p.cell.e0 = doubles_positive(cubic) * half;
    p.cell.e1 = f.b * half;
    p.cell.mass = w * h * vndf_bump_part(f.b, f.a, bend, h);
    p.v0 = nothing;
    p.v1 = w;
    p.begin = 1.0 - h;
    p.length = h;
    return p;
}

/* A cell beyond it, where V is W. */
VNDF_INLINE vndf_below_piece vndf_below_beyond(const vndf_distribution *d, doubles c, doubles_u j)
{
    doubles w0, w1;
    vndf_below_piece p = vndf_below_knots(d, c, j, &w0, &w1);
    doubles_four f = vndf_below_cell(d, j);
    w0 = doubles_positive(w0);
    doubles half = 0.5 * (w0 + w1);
    p.cell.e0 = f.a * half;
    p.cell.e1 = f.b * half;
    p.cell.mass = w0 * f.c + w1 * f.d;
    p.v0 = w0;
    p.v1 = w1;
    p.begin = doubles_set(0.0);
    p.length = doubles_set(1.0);
    return p;
}

VNDF_INLINE vndf_below_piece vndf_below_pick(doubles_m m, const vndf_below_piece *yes, const vndf_below_piece *no)
{
    vndf_below_piece p = *no; /* one cell has one pair of knots, and one mass beyond it */
    p.cell.e0 = doubles_pick(m, yes->cell.e0, no->cell.e0);
    p.cell.e1 = doubles_pick(m, yes->cell.e1, no->cell.e1);
    p.cell.mass = doubles_pick(m, yes->cell.mass, no->cell.mass);
    p.v0 = doubles_pick(m, yes->v0, no->v0);
    p.v1 = doubles_pick(m, yes->v1, no->v1);
    p.begin = doubles_pick(m, yes->begin, no->begin);
    p.length = doubles_pick(m, yes->length, no->length);
    return p;
}

/* The place with the mass `before` before it in the piece (exact_radius.c, place_in_piece). */
VNDF_INLINE vndf_exact_place vndf_below_place(const vndf_below_piece *p, doubles before)
{
    vndf_exact_place zeta = vndf_exact_cell_invert(&p->cell, before);
    doubles v = doubles_root(p->v0 * p->v0 * zeta.eta + p->v1 * p->v1 * zeta.xi);
    doubles_m seen = doubles_less(doubles_set(0.0), v), part = doubles_less(p->length, doubles_set(1.0));
    doubles xi = doubles_pick(seen, zeta.xi * (p->v1 + v), zeta.xi);
    doubles eta = doubles_pick(seen, zeta.eta * (p->v0 + v), zeta.eta), per = p->length / (xi + eta);
    vndf_exact_place at = {doubles_pick(part, p->begin + xi * per, xi), doubles_pick(part, eta * per, eta)};
    return at;
}

VNDF_INLINE doubles_u vndf_below_find_radius(const vndf_distribution *d, doubles c, doubles_u cut, doubles target)
{
    uint32_t from[VNDF_DOUBLES], cell[VNDF_DOUBLES];
    float weight[VNDF_DOUBLES], goal[VNDF_DOUBLES];
    doubles_spill_u(from, cut);
    doubles_store_f(weight, doubles_narrow(c));
    doubles_store_f(goal, doubles_narrow(target));
    for (int i = 0; i < VNDF_DOUBLES; i++)
        cell[i] = vndf_find_beyond(d, weight[i], from[i], goal[i]);
    return doubles_load_u(cell);
}

/* A slope X/Z. */
typedef struct vndf_below_slope {
    doubles x, z;
} vndf_below_slope;

/* The slope of the law with the weights c < 0 and 1. */
VNDF_INLINE vndf_below_slope vndf_below_draw_radius(const vndf_distribution *d, doubles c, doubles u,
                                                    vndf_wedge_near *near, doubles_m *trusted)
{
    doubles_u cut = near->cut = vndf_radial_location_at(d, doubles_abs(c), doubles_set(1.0)).cell;
    vndf_below_piece p = vndf_below_at_cut(d, c, cut);
    doubles mass = p.cell.mass + p.beyond, target = (1.0 - u) * mass;
    *trusted = doubles_both(*trusted, doubles_less(doubles_set(0.0), mass));
    doubles_u j = near->cell = vndf_below_find_radius(d, c, cut, target);
    vndf_below_piece beyond = vndf_below_beyond(d, c, j);
    p = vndf_below_pick(doubles_at_most_u(j, cut), &p, &beyond);
    vndf_exact_place at = vndf_below_place(&p, p.cell.mass - (target - p.beyond));
    vndf_below_slope slope = {at.eta * p.knots.a + at.xi * p.knots.c, at.eta * p.knots.b + at.xi * p.knots.d};
    return slope;
}

/* ---- both ---- */

/* The normal for uniform numbers u1, as half = 2 u1 - 1, and u2; rounded to float. g holds wi, and gets the normal. */
VNDF_INLINE void vndf_below_draw(const vndf_distribution *d, vndf_query *g, doubles half, doubles u2,
                                 vndf_wedge_near *near, doubles_m *trusted)
{
    const doubles one = doubles_set(1.0);
    vndf_below_view w = vndf_below_view_of(&g->wi, trusted);
    vndf_below_azimuth a = vndf_below_draw_azimuth(&d->below, w.s, doubles_abs(half), near);
    doubles k = w.s * a.cosine;
    *trusted = doubles_both(*trusted, doubles_less(doubles_set(0.0), k));
    doubles c = w.c * a.n / doubles_pick(*trusted, k, one);
    vndf_below_slope slope = vndf_below_draw_radius(d, c, u2, near, trusted);
    doubles sine = doubles_sign(a.sine, half);
    doubles x = slope.x * g->wi.ax * (w.cos_phi * a.cosine - w.sin_phi * sine);
    doubles y = slope.x * g->wi.ay * (w.sin_phi * a.cosine + w.cos_phi * sine), z = slope.z * a.n;
    doubles per = 1.0 / doubles_root(x * x + y * y + z * z);
    g->x = doubles_widen(doubles_narrow(x * per));
    g->y = doubles_widen(doubles_narrow(y * per));
    g->z = doubles_widen(doubles_narrow(z * per));
}

#endif
