/* One cell of a piecewise density, known by its mass and its densities at both ends: the monotone rational
 * quadratic of Gregory & Delbourgo ("Piecewise rational quadratic interpolation to monotonic data",
 * IMA J. Numer. Anal. 2, 1982). For xi in [0, 1], eta = 1 - xi, mass m, end densities e0, e1 >= 0 per unit of
 * xi, and k = (e0 + e1)/m,
 *
 *     F(xi)  = m (xi^2 + e0/m xi eta) / (1 + (k - 2) xi eta),              F(0) = 0, F(1) = m
 *     F'(xi) = (e1 xi^2 + 2 m xi eta + e0 eta^2) / (1 + (k - 2) xi eta)^2.
 *
 * F' > 0 inside for any e0, e1, so a cell never has a hole. One square root inverts F. F' follows a smooth density
 * to third order in the width of the cell; a linear density would reach the second.
 *
 * All quotients are multiplied by m, so that none depends on the division in k: with e = e0 + e1 the denominator
 * is m + (e - 2 m) xi eta. */
#ifndef VNDF_MATH_RATIONAL_CELL_H
#define VNDF_MATH_RATIONAL_CELL_H

#include "simd/lanes.h"

typedef struct vndf_rational_cell {
    lanes_f e0, e1, mass;
} vndf_rational_cell;

/* m + (e - 2 m) xi eta: positive unless the cell has neither mass nor density. */
VNDF_INLINE lanes_f vndf_rational_below(const vndf_rational_cell *cell, lanes_f w)
{
    return cell->mass + (cell->e0 + cell->e1 - 2.0f * cell->mass) * w;
}

/* m over vndf_rational_below; 0 in an empty cell. */
VNDF_INLINE lanes_f vndf_rational_part(const vndf_rational_cell *cell, lanes_f w)
{
    lanes_f below = vndf_rational_below(cell, w), nothing = lanes_set(0.0f);
    return lanes_keep(lanes_less(nothing, below), cell->mass / below);
}

/* Mass per unit of xi. */
VNDF_INLINE lanes_f vndf_rational_density(const vndf_rational_cell *cell, lanes_f xi)
{
    lanes_f eta = 1.0f - xi, w = xi * eta, part = vndf_rational_part(cell, w);
    return (cell->e1 * xi * xi + 2.0f * cell->mass * w + cell->e0 * eta * eta) * part * part;
}

/* A place in a cell: xi = over/under, 1 - xi = rest/under, and the mass per unit of xi there, root under^2/below.
 * Callers form these quotients together with their own, or do without. `below` grows with the fifth power of the cell's
 * mass, and underflows where that is 1e-8: callers keep masses near 1. */
typedef struct vndf_rational_place {
    lanes_f over, rest, under, root, below;
} vndf_rational_place;

/* The xi with mass t >= 0 before it; a t that rounding made larger than the mass counts as the mass. xi is the
 * root in [0, 1] of a xi^2 + b xi = t, where b = e0 - t (k - 2), a = m - b. The discriminant b^2 + 4 a t is
 * written as (b - 2 t)^2 + 4 t (m - t), a shorter chain. Its root is the derivative of a xi^2 + b xi, hence F'(xi)
 * = root/(1 + (k - 2) xi eta). xi/eta is 2 t/(root + b - 2 t) or, seen from the other end, (root - b + 2 t)/
 * (2 (m - t)). The code holds b - 2 t, root and both pairs times m. */
VNDF_INLINE vndf_rational_place vndf_rational_invert(const vndf_rational_cell *cell, lanes_f t)
{
    lanes_f m = cell->mass;
    t = lanes_least(t, m); /* beyond the end the root would not be the density */
    lanes_f sum = cell->e0 + cell->e1, twice = 2.0f * t * m, left = 2.0f * m * (m - t);
    lanes_f middle = cell->e0 * m - t * sum;
    lanes_f root = lanes_root(middle * middle + twice * left);       /* rounded, but not below |middle| */
    lanes_m rising = lanes_at_most(lanes_set(0.0f), middle + twice); /* nearly always */
    lanes_f over = lanes_pick(rising, twice, root - middle), rest = lanes_pick(rising, root + middle, left);
    lanes_f under = over + rest;
    vndf_rational_place place = {over, rest, under, root, m * (under * under) + (sum - 2.0f * m) * (over * rest)};
    return place;
}

#endif
