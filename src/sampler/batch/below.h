/* The draw of the exact tier (tabulated/exact.h) for directions below the horizon, in lanes of doubles. The steps, and
 * their order of operations, are those of exact.c, exact_azimuth.c and exact_radius.c, which serve one: the bits are
 * the same. What is rare there clears `trusted` here. */
#ifndef VNDF_SAMPLER_BATCH_BELOW_H
#define VNDF_SAMPLER_BATCH_BELOW_H

#include "sampler/tabulated/azimuth.h"
#include "sampler/tabulated/density_wedge.h"
#include "sampler/tabulated/exact.h"

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

/* The azimuth with the mass `target` of a row before it, in the cell that was found. */
VNDF_INLINE vndf_below_azimuth vndf_below_draw_azimuth(const vndf_wedge *w, const vndf_wedge_near *near,
                                                       doubles target)
{
    const double least = 1e-7; /* at a right angle from wi nothing is visible */
    const vndf_shares *s = &near->shares;
    doubles_u j = near->azimuth;
    doubles from = vndf_cell_end(w, 0, j), to = vndf_cell_end(w, 1, j), h = to - from;
    vndf_mixed_cell mixed = vndf_shares_cell(w, s, j);
    vndf_exact_cell cell = {mixed.begin * h, mixed.end * h, mixed.mass};
    vndf_exact_place in = vndf_exact_cell_invert(&cell, target - vndf_below_mass_before(w, s, j));
    doubles q = from + in.xi * h, rest = (1.0 - to) + in.eta * h;
    doubles along = s->p * rest * (1.0 + q), aside = 2.0 * s->r * q,
            n = doubles_root(along * along + aside * aside);
    doubles some = least * n;
    vndf_below_azimuth a = {doubles_pick(doubles_less(some, along), along, some), aside, n};
    return a;
}

/* ---- radius: k = 1 ---- */

VNDF_INLINE doubles_four vndf_below_cell(const vndf_distribution *d, doubles_u j)
{
    vndf_radial_location at;
    at.cell = j;
    return vndf_radial_location_cell(d, &at);
}

/* The knots of a cell, W there, below 0 where a knot is not visible, and the mass beyond the cell. */
typedef struct vndf_below_knots {
    doubles x0, z0, x1, z1, w0, w1, beyond;
} vndf_below_knots;

VNDF_INLINE vndf_below_knots vndf_below_knots_of(const vndf_distribution *d, doubles c, doubles_u j)
{
    doubles_lines knots = doubles_lines_at(&d->knots.at->x, 2, j),
                  tail = doubles_lines_at(&d->knots.tail[1].s, 2, j);
    doubles_four k = doubles_load_four(&knots, 0), sums = doubles_load_four(&tail, 0);
    vndf_below_knots at = {k.a, k.b, k.c, k.d, c * k.b + k.a, doubles_positive(c * k.d + k.c), sums.a};
    at.beyond += at.w1 * sums.b;
    return at;
}

/* The mass of the law, whose cut is in a cell: its outer part is visible, so the cubic is turned. */
VNDF_INLINE doubles vndf_below_mass(const vndf_distribution *d, doubles c, doubles_u cut)
{
    vndf_below_knots at = vndf_below_knots_of(d, c, cut);
    doubles_four f = vndf_below_cell(d, cut);
    vndf_bump bump = vndf_bump_of(f), bend = {bump.a + bump.b, doubles_set(0.0) - bump.b};
    doubles h = vndf_visible_part(at.w1, at.w0);
    return at.w1 * h * vndf_bump_part(f.b, f.a, bend, h) + at.beyond;
}

/* The place with the mass `target` beyond it in a cell beyond the cut, where V is W (exact_radius.c). */
VNDF_INLINE vndf_exact_place vndf_below_place(const vndf_distribution *d, const vndf_below_knots *at, doubles_u j,
                                              doubles target)
{
    doubles_four f = vndf_below_cell(d, j);
    doubles w0 = doubles_positive(at->w0), w1 = at->w1, half = 0.5 * (w0 + w1), mass = w0 * f.c + w1 * f.d;
    vndf_exact_cell cell = {f.a * half, f.b * half, mass};
    vndf_exact_place zeta = vndf_exact_cell_invert(&cell, mass - (target - at->beyond));
    doubles v = doubles_root(w0 * w0 * zeta.eta + w1 * w1 * zeta.xi);
    doubles_m seen = doubles_less(doubles_set(0.0), v);
    vndf_exact_place in = {doubles_pick(seen, zeta.xi * (w1 + v), zeta.xi),
                           doubles_pick(seen, zeta.eta * (w0 + v), zeta.eta)};
    return in;
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

/* ---- the steps ---- */

/* A sample between its steps. Each step goes over several groups of lanes before the next begins: the operations of
 * one group wait for each other, groups do not. */
typedef struct vndf_below_sample {
    vndf_query g; /* wi; in the end the normal, rounded to float */
    vndf_below_view w;
    vndf_wedge_near near;
    vndf_below_azimuth a;
    doubles half, target,
        c; /* 2 u1 - 1; the mass to find; the weight of the law of the radius, where the other is 1 */
    doubles_m trusted;
} vndf_below_sample;

/* Uniform numbers are u1, as half, and u2. */
VNDF_INLINE void vndf_below_begin(const vndf_distribution *d, vndf_below_sample *n)
{
    n->w = vndf_below_view_of(&n->g.wi, &n->trusted);
    n->near.shares = vndf_shares_at(&d->below, n->w.s);
    n->target = doubles_abs(n->half) * n->near.shares.square;
}

VNDF_INLINE void vndf_below_turn(const vndf_distribution *d, vndf_below_sample *n)
{
    n->near.azimuth = vndf_below_find_azimuth(&d->below, &n->near.shares, n->target);
}

/* The law of the radius at the azimuth. */
VNDF_INLINE void vndf_below_cut(const vndf_distribution *d, doubles u2, vndf_below_sample *n)
{
    const doubles one = doubles_set(1.0), nothing = doubles_set(0.0);
    n->a = vndf_below_draw_azimuth(&d->below, &n->near, n->target);
    doubles k = n->w.s * n->a.cosine;
    n->trusted = doubles_both(n->trusted, doubles_less(nothing, k));
    n->c = n->w.c * n->a.n / doubles_pick(n->trusted, k, one);
    n->near.cut = vndf_radial_location_at(d, doubles_abs(n->c), one).cell;
    doubles mass = vndf_below_mass(d, n->c, n->near.cut);
    n->target = (1.0 - u2) * mass;
    n->trusted = doubles_both(n->trusted, doubles_less(nothing, mass));
}

VNDF_INLINE void vndf_below_reach(const vndf_distribution *d, vndf_below_sample *n)
{
    n->near.cell = vndf_below_find_radius(d, n->c, n->near.cut, n->target);
}

/* The normal at the slope in the cell that was found. In the cell of the cut its density would not be trusted. */
VNDF_INLINE void vndf_below_end(const vndf_distribution *d, vndf_below_sample *n)
{
    const vndf_below_azimuth *a = &n->a;
    const vndf_below_view *w = &n->w;
    vndf_below_knots k = vndf_below_knots_of(d, n->c, n->near.cell);
    vndf_exact_place at = vndf_below_place(d, &k, n->near.cell, n->target);
    n->trusted = doubles_both(n->trusted, doubles_at_most_u(n->near.cut + 1u, n->near.cell));
    doubles across = at.eta * k.x0 + at.xi * k.x1, up = at.eta * k.z0 + at.xi * k.z1;
    doubles sine = doubles_sign(a->sine, n->half);
    doubles x = across * n->g.wi.ax * (w->cos_phi * a->cosine - w->sin_phi * sine);
    doubles y = across * n->g.wi.ay * (w->sin_phi * a->cosine + w->cos_phi * sine), z = up * a->n;
    doubles per = 1.0 / doubles_root(x * x + y * y + z * z);
    n->g.x = doubles_widen(doubles_narrow(x * per));
    n->g.y = doubles_widen(doubles_narrow(y * per));
    n->g.z = doubles_widen(doubles_narrow(z * per));
}

#endif
