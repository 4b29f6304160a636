/* The uniform numbers of a given normal under a table, for one or for lanes, in double from the view that draws in
 * float. It serves directions above the horizon and the cells that density.h trusts; exact.c serves all. Draws take
 * the view's masses, its stretched direction (s, 0, c) and its heading (p, q) as floats, so these are the numbers to
 * invert with: their rounding drops out.
 *
 * The normal is (X cos a, X sin a, Z) in the turned frame and has any length, so it needs no division: with A = ax ay,
 * and p^2 + q^2, which is 1 but for rounding,
 *
 *     X cos a = p ay wm.x + q ax wm.y,   X sin a = p ax wm.y - q ay wm.x,   Z = A (p^2 + q^2) wm.z.
 *
 * |2 u1 - 1| is a part of half a turn's mass; u2 is a part of the law of the radius with the weights (c X, s X cos a),
 * c and k of theory.h. Each part is one quotient, and so is its rate, per radian.
 *
 * Draws and this file together are off by less than 4 steps of 2^-24 of u1 and 8 of u2. A step of u1 turns the normal,
 * and changes the law of the radius: at a slope R its part changes, per radian of a, by
 *
 *     bend = s |sin a| c |F0 F1(R) - F1 F0(R)|/mass^2,    mass = c F0 + k F1, F0 and F1 up to the cut.
 *
 * So the normal comes back within
 *
 *     2^-21 (sin(theta)/rate1 + bend/(rate1 rate2) + 1/rate2),
 *
 * theta being its angle to z in the unit problem. Where this is below 2e-5 the numbers are sure, and the normal comes
 * back within 1e-5, since most of a draw's error repeats when it is drawn again (test engine_inverse; 8e-6 was the
 * worst of 16 million). */
#ifndef VNDF_SAMPLER_TABULATED_INVERSE_H
#define VNDF_SAMPLER_TABULATED_INVERSE_H

#include "sampler/tabulated/density_wedge.h"

/* What a view holds of a direction above the horizon, s + c = 1, and the masses of half a turn. */
typedef struct vndf_inverse_view {
    doubles s, c, front, wedge;
} vndf_inverse_view;

/* The normal in the turned frame; across is X. */
typedef struct vndf_turned {
    doubles x, y, across, z;
} vndf_turned;

/* Uniform numbers; whether they may be trusted, and whether they are sure too. */
typedef struct vndf_inverse {
    doubles u1, u2;
    doubles_m trusted, sure;
} vndf_inverse;

/* ---- normal ---- */

/* Roughness times the scale, and the heading, as the view has them. */
typedef struct vndf_inverse_frame {
    doubles ax, ay, cosine, sine;
} vndf_inverse_frame;

VNDF_INLINE vndf_turned vndf_turned_of(const vndf_inverse_frame *f, doubles x, doubles y, doubles z)
{
    doubles p = f->cosine, q = f->sine, along = f->ay * x, aside = f->ax * y;
    doubles turned_x = p * along + q * aside, turned_y = p * aside - q * along;
    vndf_turned n = {turned_x, turned_y, doubles_root(turned_x * turned_x + turned_y * turned_y),
                     f->ax * f->ay * (p * p + q * q) * z};
    return n;
}

/* Whether the normal may be looked up: no NaN, and not 0. */
VNDF_INLINE doubles_m vndf_turned_is_valid(const vndf_turned *n)
{
    return doubles_both(
        doubles_both(doubles_less(doubles_set(0.0), n->across), doubles_less(n->across, doubles_set(1e60))),
        doubles_at_most(doubles_set(0.0), n->z));
}

/* ---- parts of a mass ---- */

/* The part before/below, and its rate rise/run. */
typedef struct vndf_part {
    doubles before, below, rise, run;
} vndf_part;

/* In a rational cell with the densities e0, e1 and the mass m (math/rational_cell.h), at a place with the distances
 * a, b from its ends and h = a + b: the mass before it is before/below, and the mass per xi density/below^2. */
typedef struct vndf_cell_part {
    doubles before, below, density;
} vndf_cell_part;

VNDF_INLINE vndf_cell_part vndf_cell_part_at(doubles e0, doubles e1, doubles m, doubles a, doubles b, doubles h)
{
    doubles ab = a * b, twice = 2.0 * m, mh = m * h;
    vndf_cell_part part = {m * a * (m * a + e0 * b), m * (h * h) + (e0 + e1 - twice) * ab,
                           (e1 * (a * a) + twice * ab + e0 * (b * b)) * (mh * mh)};
    return part;
}

/* ---- azimuth: parts of half a turn's mass ---- */

/* The density of the azimuth in front is even + odd cos a. The mass between the azimuth and the side, with y = sin(b/2)
 * for the angle b between them, takes the polynomial of front.h. */
VNDF_INLINE doubles vndf_inverse_beyond(doubles even, doubles odd, doubles y)
{
    doubles y2 = y * y, y4 = y2 * y2;
    doubles low = 0.99999998 + 0.16667076 * y2 + y4 * (0.074840751 + 0.046982405 * y2);
    doubles high = 0.013773087 + 0.084478642 * y2 + y4 * (-0.10345663 + 0.11751909 * y2);
    return 2.0 * (even * y * (low + y4 * y4 * high) + odd * y2);
}

/* Where next to nothing of the front is left, the number is not sure. */
VNDF_INLINE vndf_part vndf_inverse_of_front(const vndf_distribution *d, const vndf_inverse_view *w,
                                            const vndf_turned *n, doubles_m *sure)
{
    doubles even = w->c * d->f0_total, odd = w->s * d->f1_total, total = w->front + w->wedge;
    doubles y = n->x / doubles_root(2.0 * n->across * (n->across + doubles_abs(n->y)));
    doubles rest = vndf_inverse_beyond(even, odd, y);
    *sure = doubles_less(0x1p-20 * total, rest);
    vndf_part part = {w->front - rest, total, even * n->across + odd * n->x, n->across * total};
    return part;
}

/* Mass before cell j of the mixed row and in it, and the densities at its ends, times `square`. */
typedef struct vndf_inverse_cell {
    doubles before, mass, begin, end;
} vndf_inverse_cell;

VNDF_INLINE vndf_inverse_cell vndf_inverse_cell_of(const vndf_wedge *w, const vndf_shares *s, doubles_u j)
{
    const float *first = w->cdf, *middle = first + w->stride, *last = middle + w->stride;
    vndf_mixed_cell cell = vndf_shares_cell(w, s, j);
    doubles_u at = s->row * w->stride + j;
    doubles before = s->first * doubles_gather(first, at) + s->middle * doubles_gather(middle, at) +
                     s->last * doubles_gather(last, at);
    vndf_inverse_cell row = {before, cell.mass, cell.begin, cell.end};
    return row;
}

/* Rows count their mass from the far side. */
VNDF_INLINE vndf_part vndf_inverse_of_wedge(const vndf_distribution *d, const vndf_inverse_view *w,
                                            const vndf_turned *n)
{
    const vndf_wedge *wedge = &d->above;
    vndf_shares s = vndf_shares_at(wedge, w->c);
    vndf_row_place at = vndf_row_place_at(wedge, &s, doubles_abs(n->x), doubles_abs(n->y), NULL);
    vndf_inverse_cell row = vndf_inverse_cell_of(wedge, &s, at.cell);
    vndf_cell_part cell =
        vndf_cell_part_at(row.begin * at.width, row.end * at.width, row.mass, at.inner, at.outer, at.width);
    doubles x = s.p * at.rest * (1.0 + at.q), y = 2.0 * s.r * at.q, total = (w->front + w->wedge) * s.square;
    vndf_part part = {(w->front * s.square + w->wedge * (s.square - row.before)) * cell.below -
                          w->wedge * cell.before,
                      total * cell.below, w->wedge * cell.density * (x * x + y * y),
                      total * (cell.below * cell.below) * (at.width * (2.0 * s.p * s.r * (1.0 + at.q * at.q)))};
    return part;
}

/* ---- radius ---- */

/* The law with the weights (c, k): its mass, and F0 and F1 up to the cut. */
typedef struct vndf_inverse_law {
    doubles c, k, mass, f0, f1;
} vndf_inverse_law;

/* The part of the law up to a place, and |F0 F1(R) - F1 F0(R)|, the larger at the two ends of the cell. */
typedef struct vndf_radius_part {
    vndf_part part;
    doubles apart;
} vndf_radius_part;

/* Mass before the cell of a place, k < 0: a sum of positive terms. */
VNDF_INLINE doubles vndf_inverse_before(const vndf_distribution *d, const vndf_radial_location *at,
                                        const vndf_inverse_law *law, doubles w0)
{
    doubles_lines pole = doubles_lines_at(&d->knots.pole->e, 2, at->cell);
    doubles_four sums = doubles_load_four(&pole, 0);
    return law->c * sums.a + doubles_positive(w0) * sums.b;
}

VNDF_INLINE vndf_radius_part vndf_inverse_of_radius(const vndf_distribution *d, const vndf_radial_location *at,
                                                    const vndf_inverse_law *law, int behind)
{
    doubles_lines lines = doubles_lines_at(&d->cells->f0, sizeof *d->cells / sizeof(float), at->cell);
    doubles_four f = doubles_load_four(&lines, 0), sums = doubles_load_four(&lines, 4); /* of which two */
    doubles w0 = law->c * at->z0 + law->k * at->x0, w1 = law->c * at->z1 + law->k * at->x1;
    doubles whole = at->inner + at->outer;
    doubles before = law->c * sums.a + law->k * sums.b;
    if (behind)
        before = vndf_inverse_before(d, at, law, w0);
    vndf_cell_part cell = vndf_cell_part_at(f.a * w0, f.b * w1, w0 * f.c + w1 * f.d, at->inner, at->outer, whole);
    doubles x = vndf_radial_location_between(at, at->x0, at->x1),
            z = vndf_radial_location_between(at, at->z0, at->z1);
    vndf_part part = {before * cell.below + cell.before, law->mass * cell.below, cell.density * (x * x + z * z),
                      cell.below * cell.below * (whole * whole) * (law->mass * vndf_radial_location_width(at))};
    doubles from = doubles_abs(law->f0 * sums.b - law->f1 * sums.a);
    doubles to = doubles_abs(law->f0 * (sums.b + (at->x0 * f.c + at->x1 * f.d)) -
                             law->f1 * (sums.a + (at->z0 * f.c + at->z1 * f.d)));
    vndf_radius_part radius = {part, doubles_pick(doubles_less(from, to), to, from)};
    return radius;
}

/* ---- both ---- */

/* Whether numbers overflow or lose digits. */
VNDF_INLINE doubles_m vndf_inverse_in_range(doubles x)
{
    return doubles_both(doubles_less(doubles_set(1e-280), x), doubles_less(x, doubles_set(1e280)));
}

/* What the head of this file asks, times both rates and `high`, which is about |(X, Z)|. */
VNDF_INLINE doubles_m vndf_inverse_is_sure(const vndf_inverse_view *w, const vndf_turned *n,
                                           const vndf_part *azimuth, const vndf_radius_part *radius,
                                           const vndf_inverse_law *law)
{
    const double steps = 0x1p-21 / 2e-5;
    const vndf_part *slope = &radius->part;
    doubles high = doubles_pick(doubles_less(n->across, n->z), n->z, n->across);
    doubles bend = w->c * w->s * (doubles_abs(n->y) * n->across) * radius->apart / (law->mass * law->mass);
    doubles turns = azimuth->run * (n->across * slope->rise + high * bend * slope->run);
    doubles off = steps * (turns + high * azimuth->rise * slope->run), both = high * azimuth->rise * slope->rise;
    doubles_m ranged = doubles_both(vndf_inverse_in_range(off), vndf_inverse_in_range(both));
    return doubles_both(ranged, doubles_less(off, both));
}

VNDF_INLINE vndf_inverse vndf_inverse_from(const vndf_turned *n, const vndf_part *azimuth, const vndf_part *radius,
                                           doubles_m trusted)
{
    const doubles nothing = doubles_set(0.0);
    doubles half = 0.5 * doubles_between(azimuth->before / azimuth->below, 0.0, 1.0);
    doubles_m ranged = doubles_both(vndf_inverse_in_range(azimuth->below), vndf_inverse_in_range(radius->below));
    vndf_inverse inverse = {0.5 + doubles_pick(doubles_less(n->y, nothing), nothing - half, half),
                            doubles_between(radius->before / radius->below, 0.0, 1.0),
                            doubles_both(trusted, ranged), trusted};
    return inverse;
}

/* cos a >= 0. */
VNDF_INLINE vndf_inverse vndf_inverse_in_front(const vndf_distribution *d, const vndf_inverse_view *w,
                                               const vndf_turned *n)
{
    vndf_radial_location at = vndf_radial_location_at(d, n->across, n->z);
    doubles c = w->c * n->across, k = w->s * n->x, f0 = doubles_set(d->f0_total), f1 = doubles_set(d->f1_total);
    vndf_inverse_law law = {c, k, c * f0 + k * f1, f0, f1};
    vndf_radius_part radius = vndf_inverse_of_radius(d, &at, &law, 0);
    doubles_m trusted = doubles_at_most_u(at.cell + 3u, doubles_set_u(d->radial_count)), left;
    vndf_part azimuth = vndf_inverse_of_front(d, w, n, &left);
    vndf_inverse inverse = vndf_inverse_from(n, &azimuth, &radius.part, trusted);
    inverse.sure =
        doubles_both(doubles_both(inverse.trusted, left), vndf_inverse_is_sure(w, n, &azimuth, &radius, &law));
    return inverse;
}

/* cos a < 0. */
VNDF_INLINE vndf_inverse vndf_inverse_in_wedge(const vndf_distribution *d, const vndf_inverse_view *w,
                                               const vndf_turned *n)
{
    doubles c = w->c * n->across, k = w->s * n->x;
    vndf_cut_law cut = vndf_cut_law_above(d, c, k, NULL);
    vndf_radial_location at = vndf_radial_location_at(d, n->across, n->z);
    doubles f1 = doubles_gather(d->knots.f1 + 1, cut.cut); /* a cell too far, which does not matter */
    vndf_inverse_law law = {c, k, cut.mass, (cut.mass - k * f1) / c, f1};
    vndf_radius_part radius = vndf_inverse_of_radius(d, &at, &law, 1);
    vndf_part azimuth = vndf_inverse_of_wedge(d, w, n);
    vndf_inverse inverse = vndf_inverse_from(n, &azimuth, &radius.part, doubles_at_most_u(at.cell + 3u, cut.cut));
    inverse.sure = doubles_both(inverse.trusted, vndf_inverse_is_sure(w, n, &azimuth, &radius, &law));
    return inverse;
}

#endif
