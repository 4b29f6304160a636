/* The density of a given normal under a table, for one or for lanes, in double from the caller's own numbers. It serves
 * the cases where it is trusted, with two square roots and two divisions in front of wi; exact.c serves all. The
 * normal is (X cos a, X sin a, Z) = (ay wm.x, ax wm.y, ax ay wm.z), the direction (S, 0, +-U) as stretched. Neither is
 * made unit, since a density is a quotient that drops both lengths. With A = ax ay,
 *
 *     S X cos a = A (wi.x wm.x + wi.y wm.y) = K,       S X |sin a| = |ax wi.x (ax wm.y) - ay wi.y (ay wm.x)|,
 *
 * the law of the radius has the weights (C, K), C = +-U X, times X. In a cell with the densities e0, e1 at its
 * ends and the mass m under that law (math/rational_cell.h), at a place (x, z),
 *
 *     mass per xi = p m^2/b^2,    p = e1 xi^2 + 2 m xi eta + e0 eta^2,  b = m + (e0 + e1 - 2 m) xi eta,
 *     density     = azimuth/mass of the law   p m^2/b^2   (x + z)^3 A^2 / (width x (X + Z)^3),
 *
 * and in front of wi azimuth/mass of the law = 1/(X total), total = 2 (front + wedge), the area.
 *
 * Trusted are cells with two others between them and the cut, and below the horizon all cells but the cell of the cut,
 * unless something underflows. */
#ifndef VNDF_SAMPLER_TABULATED_DENSITY_H
#define VNDF_SAMPLER_TABULATED_DENSITY_H

#include "sampler/tabulated/area.h"
#include "sampler/tabulated/location.h"

/* A normal and its surface and direction. */
typedef struct vndf_query {
    vndf_direction wi;
    doubles x, y, z;
} vndf_query;

#if VNDF_LANES == 1

VNDF_INLINE vndf_query vndf_query_of(const vndf_view *view, vndf_vec3 wm)
{
    vndf_vec3 wi = view->wi;
    vndf_query g = {{view->alpha_x, view->alpha_y, wi.x, wi.y, wi.z}, wm.x, wm.y, wm.z};
    return g;
}

#endif

/* wi . wm with one rounding: vndf_exact_dot. */
VNDF_INLINE doubles vndf_query_facing(const vndf_query *g)
{
    doubles x = g->wi.x * g->x, y = g->wi.y * g->y, z = g->wi.z * g->z, level = x + y, back = level - x;
    doubles lost = (x - (level - back)) + (y - back);
    return (level + z) + lost;
}

/* The level part of wi . wm. */
VNDF_INLINE doubles vndf_query_level(const vndf_query *g)
{
    return g->wi.x * g->x + g->wi.y * g->y;
}

/* A number with the sign of cos a. For wi straight up or down the azimuth is the normal's own. */
VNDF_INLINE doubles vndf_query_along(const vndf_query *g)
{
    doubles across2 = g->wi.x * g->wi.x + g->wi.y * g->wi.y;
    return doubles_pick(doubles_less(doubles_set(0.0), across2), vndf_query_level(g), g->x);
}

/* The normal in the unit problem, turned, with the length that the head of this file gives it. */
typedef struct vndf_bare {
    doubles x, y, across, z, product; /* product: A */
} vndf_bare;

VNDF_INLINE vndf_bare vndf_bare_of(const vndf_query *g)
{
    doubles product = g->wi.ax * g->wi.ay, x = g->wi.ay * g->x, y = g->wi.ax * g->y;
    vndf_bare bare = {x, y, doubles_root(x * x + y * y), product * g->z, product};
    return bare;
}

/* ---- D ---- */

/* D of a table, for a valid normal. */
VNDF_INLINE doubles vndf_query_ndf(const vndf_distribution *d, const vndf_bare *n)
{
    vndf_radial_location at = vndf_radial_location_at(d, n->across, n->z);
    vndf_quotient p22 = vndf_radial_location_p22(d, &at);
    doubles length = n->across + n->z, square = length * length, a2 = n->product * n->product;
    return doubles_positive(p22.above * (a2 * n->product) / (p22.below * (square * square)));
}

/* ---- the cell of the radius ---- */

/* The part that all cells share. p is the numerator of a rational cell, over X in the first cell where f begins at 0 as
 * X does; b^2 is its denominator, and m the cell's mass. xi, eta, x and x + z are all multiplied by inner + outer,
 * which drops out. */
VNDF_INLINE vndf_quotient vndf_query_quotient(const vndf_radial_location *at, const vndf_bare *n, doubles_m first,
                                              doubles m, doubles p, doubles b)
{
    doubles x = doubles_pick(first, at->x1, vndf_radial_location_between(at, at->x0, at->x1)),
            part = m * n->product;
    doubles sum = vndf_radial_location_between(at, at->x0 + at->z0, at->x1 + at->z1), length = n->across + n->z;
    vndf_quotient q = {p * (part * part) * (sum * sum * sum),
                       b * b * (vndf_radial_location_width(at) * x) * (length * length * length)};
    return q;
}

VNDF_INLINE doubles_m vndf_query_is_first(const vndf_radial_location *at, doubles f0)
{
    return doubles_both(vndf_radial_location_is_first(at), doubles_at_most(f0, doubles_set(0.0)));
}

/* Mass per xi, with the other factors of the density, as above/below, for the weights (c, k). */
VNDF_INLINE vndf_quotient vndf_query_in_cell(const vndf_distribution *d, const vndf_radial_location *at,
                                             const vndf_bare *n, doubles c, doubles k)
{
    doubles_four f = vndf_radial_location_cell(d, at);
    doubles w0 = c * at->z0 + k * at->x0, w1 = c * at->z1 + k * at->x1, e0 = f.a * w0, e1 = f.b * w1;
    doubles m = w0 * f.c + w1 * f.d, xi = at->inner, eta = at->outer, twice = 2.0 * m, whole = xi + eta;
    doubles b = m * (whole * whole) + (e0 + e1 - twice) * (xi * eta);
    doubles_m first = vndf_query_is_first(at, f.a);
    doubles over = e1 * xi + twice * eta, p = doubles_pick(first, over, xi * over + e0 * (eta * eta));
    return vndf_query_quotient(at, n, first, m, p, b);
}

/* The same for a weighted cell (math/weighted_cell.h) whose V is W, as beyond the cut. */
VNDF_INLINE vndf_quotient vndf_query_in_weighted_cell(const vndf_distribution *d, const vndf_radial_location *at,
                                                      const vndf_bare *n, doubles c, doubles k)
{
    doubles_four f = vndf_radial_location_cell(d, at);
    doubles w0 = doubles_positive(c * at->z0 + k * at->x0), w1 = doubles_positive(c * at->z1 + k * at->x1);
    doubles xi = at->inner, eta = at->outer, whole = xi + eta, w = w0 * eta + w1 * xi, half = 0.5 * (w0 + w1);
    doubles m = w0 * f.c + w1 * f.d, e0 = f.a * half, e1 = f.b * half, twice = 2.0 * m;
    doubles from = w0 * whole + w, zeta = xi * from, rest = eta * (w1 * whole + w), both = zeta + rest;
    doubles b = m * (both * both) + (e0 + e1 - twice) * (zeta * rest);
    doubles_m first = vndf_query_is_first(at, f.a);
    doubles over = e1 * zeta + twice * rest;
    doubles p = doubles_pick(first, over * from, zeta * over + e0 * (rest * rest));
    vndf_quotient q = vndf_query_quotient(at, n, first, m, p, b);
    q.above *= 2.0 * w * both;
    q.below *= whole;
    return q;
}

/* The quotient. Clears *trusted where underflow or overflow may cost digits. */
VNDF_INLINE doubles vndf_query_density(doubles above, doubles below, doubles_m *trusted)
{
    const doubles least = doubles_set(1e-280), most = doubles_set(1e280);
    doubles_m low = doubles_both(doubles_less(least, above), doubles_less(least, below));
    doubles_m high = doubles_both(doubles_less(above, most), doubles_less(below, most));
    *trusted = doubles_both(*trusted, doubles_both(low, high));
    return above / below;
}

/* ---- in front of wi ---- */

/* Masses of the front and of the wedge for a direction above the horizon, times its length. */
VNDF_INLINE doubles vndf_query_front(const vndf_distribution *d, doubles across, doubles up)
{
    const double quarter_turn = 1.57079632679489662;
    return up * (d->f0_total * quarter_turn) + across * d->f1_total;
}

VNDF_INLINE doubles vndf_query_wedge(const vndf_distribution *d, doubles across, doubles up)
{
    doubles sum = across + up;
    return sum * vndf_wedge_mass(&d->above, up / sum);
}

/* The density for wi.z >= 0, cos a >= 0. */
VNDF_INLINE doubles vndf_query_in_front(const vndf_distribution *d, const vndf_query *g, doubles_m *trusted)
{
    doubles across = vndf_direction_across(&g->wi), up = doubles_abs(g->wi.z);
    doubles total = 2.0 * (vndf_query_front(d, across, up) + vndf_query_wedge(d, across, up));
    vndf_bare n = vndf_bare_of(g);
    vndf_radial_location at = vndf_radial_location_at(d, n.across, n.z);
    vndf_quotient q = vndf_query_in_cell(d, &at, &n, up * n.across, vndf_query_level(g) * n.product);
    *trusted = doubles_both(*trusted, doubles_at_most_u(at.cell + 3u, doubles_set_u(d->radial_count)));
    return vndf_query_density(q.above, q.below * (n.across * total), trusted);
}

#endif
