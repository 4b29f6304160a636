/* The density of a given normal in a wedge (density.h): behind wi above the horizon, towards it below.
 *
 * The azimuth's density is that of the mixed row (wedge.h) at q = s(n + s)/h and 1 - q = c(n + s + c)/h,
 * h = (c + n)(n + s), for (c, s) ~ (r |cos a|, p |sin a|) of any length n. Shares of the rows are not divided by
 * the distance of their knots either. The part h of xi in the cell of the cut (radial.h) is visible. */
#ifndef VNDF_SAMPLER_TABULATED_DENSITY_WEDGE_H
#define VNDF_SAMPLER_TABULATED_DENSITY_WEDGE_H

#include "sampler/tabulated/density.h"

/* ---- azimuth ---- */

/* Three rows of a wedge, their shares times `square`, and the aspect times that. */
typedef struct vndf_shares {
    doubles_u row;
    doubles first, middle, last, square, p, r;
} vndf_shares;

VNDF_INLINE vndf_shares vndf_shares_from(doubles_u i, doubles y, doubles from, doubles to)
{
    doubles m = y - from, rest = to - y, width = to - from;
    vndf_shares s = {i * 2u, rest * rest, 2.0 * rest * m, m * m, width * width, m, m};
    return s;
}

#if VNDF_DOUBLES == 8

/* For no more than VNDF_FEW knots of rows: finds and reads all in registers. */
VNDF_INLINE vndf_shares vndf_shares_few(const vndf_wedge *w, doubles y)
{
    doubles_u i = doubles_set_u(0);
    for (uint32_t step = VNDF_FEW / 2; step > 0; step /= 2)
        i = doubles_pick_u(doubles_at_most(doubles_few_f(w->row_y, i + step), y), i + step, i);
    i = doubles_least_u(i, doubles_set_u(w->row_count / 2 - 1)); /* at the last knot, too, there are three */
    vndf_shares s = vndf_shares_from(i, y, doubles_few_f(w->row_y, i), doubles_few_f(w->row_y + 1, i));
    const uint32_t knots = w->row_count / 2 + 1;
    const float *p = w->few_aspects, *pm = p + knots, *r = pm + knots, *rm = r + knots;
    s.p = s.first * doubles_few_f(p, i) + s.middle * doubles_few_f(pm, i) + s.last * doubles_few_f(p + 1, i);
    s.r = s.first * doubles_few_f(r, i) + s.middle * doubles_few_f(rm, i) + s.last * doubles_few_f(r + 1, i);
    return s;
}

#endif

/* The guide finds the knot but for the rounding of y. */
VNDF_INLINE vndf_shares vndf_shares_at(const vndf_wedge *w, doubles y)
{
#if VNDF_DOUBLES == 8
    if (w->few_aspects)
        return vndf_shares_few(w, y);
#endif
    const doubles_u one = doubles_set_u(1), none = doubles_set_u(0);
    doubles_u i = vndf_guide_doubles(&w->row_guide, doubles_narrow(y));
    doubles_m early = doubles_both(doubles_less(y, doubles_gather(w->row_y, i)), doubles_at_most_u(one, i));
    i -= doubles_pick_u(early, one, none);
    doubles_lines lines = doubles_lines_at(&w->row_span->begin, sizeof *w->row_span / sizeof(float), i);
    doubles_four a = doubles_load_four(&lines, 0), b = doubles_load_four(&lines, 4); /* begin, per_width, p, r */
    vndf_shares s = vndf_shares_from(i, y, a.a, doubles_gather(w->row_y + 1, i));
    s.p = s.first * a.c + s.middle * a.d + s.last * b.a;
    s.r = s.first * b.b + s.middle * b.c + s.last * b.d;
    return s;
}

/* A cell of the mix: its mass and the densities at its ends, times `square`. */
typedef struct vndf_mixed_cell {
    doubles mass, begin, end;
} vndf_mixed_cell;

VNDF_INLINE vndf_mixed_cell vndf_shares_cell(const vndf_wedge *w, const vndf_shares *s, doubles_u j)
{
    const uint32_t ends = w->cell_count + 1;
    const size_t stride = 2 * (size_t)ends;
    doubles_lines lines = doubles_lines_at(&w->row_cell->mass, 2, s->row * ends + j);
    doubles_four a = doubles_load_four(&lines, 0), b = doubles_load_four(&lines, stride);
    doubles_four c = doubles_load_four(&lines, 2 * stride);
    vndf_mixed_cell cell = {s->first * a.a + s->middle * b.a + s->last * c.a,
                            s->first * a.b + s->middle * b.b + s->last * c.b,
                            s->first * a.d + s->middle * b.d + s->last * c.d};
    return cell;
}

/* The last knot of q at or below. */
VNDF_INLINE doubles_u vndf_cell_of_q(const vndf_wedge *w, doubles q)
{
    doubles_u j = doubles_set_u(0);
    for (uint32_t i = 1; i < w->cell_count; i++)
        j += doubles_pick_u(doubles_at_most(doubles_set((double)w->q[i]), q), doubles_set_u(1), doubles_set_u(0));
    return j;
}

/* The ends of cell j of q. */
VNDF_INLINE doubles vndf_cell_end(const vndf_wedge *w, uint32_t end, doubles_u j)
{
#if VNDF_DOUBLES == 8
    if (w->stride <= VNDF_FEW) /* q is padded to that */
        return doubles_few_f(w->q + end, j);
#endif
    return doubles_gather(w->q + end, j);
}

/* Where a normal was drawn: the shares of rows, and the cells of its azimuth, of the cut and of its slope. A search
 * that begins there ends at once. */
typedef struct vndf_wedge_near {
    vndf_shares shares;
    doubles_u azimuth, cut, cell;
} vndf_wedge_near;

/* The last knot of q at or below, from cell j. */
VNDF_INLINE doubles_u vndf_cell_of_q_near(const vndf_wedge *w, doubles q, doubles_u j)
{
    const doubles_u one = doubles_set_u(1), none = doubles_set_u(0);
    for (;;) {
        doubles_m back = doubles_both(doubles_less(q, vndf_cell_end(w, 0, j)), doubles_at_most_u(one, j));
        doubles_m more = doubles_at_most_u(j + 2u, doubles_set_u(w->cell_count));
        doubles_m on = doubles_both(doubles_at_most(vndf_cell_end(w, 1, j), q), more);
        doubles_u step = doubles_pick_u(on, one, none) - doubles_pick_u(back, one, none);
        if (!doubles_differ_u(step, none))
            return j;
        j += step;
    }
}

/* Where an azimuth stands in the rows: q, 1 - q, its cell, the distances to the cell's ends and its width. */
typedef struct vndf_row_place {
    doubles_u cell;
    doubles q, rest, inner, outer, width;
} vndf_row_place;

/* Cosine and sine >= 0 and of any length; `near` may be NULL, here and below. */
VNDF_INLINE vndf_row_place vndf_row_place_at(const vndf_wedge *w, const vndf_shares *s, doubles cosine,
                                             doubles sine, const vndf_wedge_near *near)
{
    doubles along = s->r * cosine, aside = s->p * sine, n = doubles_root(along * along + aside * aside);
    doubles reach = n + aside, per = 1.0 / ((along + n) * reach);
    doubles q = aside * reach * per, rest = along * (reach + along) * per;
    doubles_u j = near ? vndf_cell_of_q_near(w, q, near->azimuth) : vndf_cell_of_q(w, q);
    doubles from = vndf_cell_end(w, 0, j), to = vndf_cell_end(w, 1, j);
    vndf_row_place at = {j, q, rest, q - from, rest - (1.0 - to), to - from};
    return at;
}

/* Mass per radian of the row there, times `square`, as above/below. */
VNDF_INLINE vndf_quotient vndf_row_density(const vndf_wedge *w, const vndf_shares *s, const vndf_row_place *at)
{
    vndf_mixed_cell cell = vndf_shares_cell(w, s, at->cell);
    doubles q = at->q, a = at->inner, b = at->outer, h = at->width, ab = a * b;
    doubles twice = 2.0 * cell.mass, e0 = cell.begin * h, e1 = cell.end * h;
    doubles over = e1 * (a * a) + twice * ab + e0 * (b * b), under = cell.mass * (h * h) + (e0 + e1 - twice) * ab;
    doubles x = s->p * at->rest * (1.0 + q), y = 2.0 * s->r * q, mass = cell.mass;
    vndf_quotient density = {over * (mass * mass) * (h * (x * x + y * y)),
                             under * under * (2.0 * s->p * s->r * (1.0 + q * q))};
    return density;
}

/* ---- radius ---- */

/* integral_0^1 f(h t) (1 - t) dt of the cubic from f0 to f1 with a bump (sampler/tabulated/radial.h). */
VNDF_INLINE doubles vndf_bump_part(doubles f0, doubles f1, vndf_bump bump, doubles h)
{
    const double sixth = 1.0 / 6.0, twelfth = 1.0 / 12.0;
    doubles slope = f1 - f0, bend = twelfth * (bump.b - bump.a) - h * (0.05 * bump.b);
    doubles whole = 0.5 * f0 + h * (sixth * (slope + bump.a) + h * bend);
    doubles least = 1e-3 * (0.5 * f0 + h * (sixth * slope));
    return doubles_pick(doubles_less(least, whole), whole, least);
}

/* The law of the radius: its mass, and the cell of its cut. */
typedef struct vndf_cut_law {
    doubles mass;
    doubles_u cut;
} vndf_cut_law;

/* The visible part of a cell. W is w at its visible end, and `end` at the other. */
VNDF_INLINE doubles vndf_visible_part(doubles w, doubles end)
{
    return doubles_pick(doubles_less(end, doubles_set(0.0)), w / (w - end), doubles_set(1.0));
}

/* c > 0 > k. */
VNDF_INLINE vndf_cut_law vndf_cut_law_above(const vndf_distribution *d, doubles c, doubles k,
                                            const vndf_wedge_near *near)
{
    vndf_radial_location at =
        near ? vndf_radial_location_near(d, c, -k, near->cut) : vndf_radial_location_at(d, c, -k);
    doubles_lines pole = doubles_lines_at(&d->knots.pole->e, 2, at.cell);
    doubles_four f = vndf_radial_location_cell(d, &at), sums = doubles_load_four(&pole, 0);
    doubles w = doubles_positive(c * at.z0 + k * at.x0), h = vndf_visible_part(w, c * at.z1 + k * at.x1);
    doubles part = w * h * vndf_bump_part(f.a, f.b, vndf_bump_of(f), h);
    vndf_cut_law law = {c * sums.a + w * sums.b + part, at.cell};
    return law;
}

/* c < 0 < k. */
VNDF_INLINE vndf_cut_law vndf_cut_law_below(const vndf_distribution *d, doubles c, doubles k,
                                            const vndf_wedge_near *near)
{
    vndf_radial_location at =
        near ? vndf_radial_location_near(d, -c, k, near->cut) : vndf_radial_location_at(d, -c, k);
    doubles_lines tail = doubles_lines_at(&d->knots.tail[1].s, 2, at.cell);
    doubles_four f = vndf_radial_location_cell(d, &at), sums = doubles_load_four(&tail, 0);
    doubles w = doubles_positive(c * at.z1 + k * at.x1), h = vndf_visible_part(w, c * at.z0 + k * at.x0);
    vndf_bump bump = vndf_bump_of(f), turned = {bump.a + bump.b, -bump.b};
    doubles part = w * h * vndf_bump_part(f.b, f.a, turned, h);
    vndf_cut_law law = {k * sums.a + w * sums.b + part, at.cell};
    return law;
}

/* ---- both ---- */

/* The density of a normal by its azimuth and its radius. */
VNDF_INLINE doubles vndf_query_of_wedge(const vndf_distribution *d, const vndf_query *g, int below,
                                        const vndf_wedge_near *near, doubles_m *trusted)
{
    const vndf_wedge *w = below ? &d->below : &d->above;
    doubles across = vndf_direction_across(&g->wi), up = doubles_abs(g->wi.z), sum = across + up;
    vndf_bare n = vndf_bare_of(g);
    doubles k = vndf_query_level(g) * n.product, c = (below ? -up : up) * n.across;
    doubles_m leans = doubles_less(doubles_set(0.0), across);
    doubles cosine = doubles_abs(doubles_pick(leans, k, n.x));
    doubles sine = doubles_abs(doubles_pick(leans, g->wi.ax * g->wi.x * n.y - g->wi.ay * g->wi.y * n.x, n.y));
    vndf_shares shares = near ? near->shares : vndf_shares_at(w, (below ? across : up) / sum);
    vndf_row_place place = vndf_row_place_at(w, &shares, cosine, sine, near);
    vndf_quotient azimuth = vndf_row_density(w, &shares, &place);
    vndf_cut_law law = below ? vndf_cut_law_below(d, c, k, near) : vndf_cut_law_above(d, c, k, near);
    vndf_radial_location at =
        near ? vndf_radial_location_near(d, n.across, n.z, near->cell) : vndf_radial_location_at(d, n.across, n.z);
    vndf_quotient q = below ? vndf_query_in_weighted_cell(d, &at, &n, c, k) : vndf_query_in_cell(d, &at, &n, c, k);
    *trusted = doubles_both(*trusted, below ? doubles_at_most_u(law.cut + doubles_set_u(1), at.cell)
                                            : doubles_at_most_u(at.cell + doubles_set_u(3), law.cut));
    doubles above = q.above * azimuth.above, under = q.below * azimuth.below * (shares.square * law.mass);
    if (below) /* the wedge is all there is */
        return vndf_query_density(0.5 * above, under, trusted);
    doubles wedge = vndf_query_wedge(d, across, up), total = 2.0 * (vndf_query_front(d, across, up) + wedge);
    return vndf_query_density(above * wedge, under * total, trusted);
}

#endif
