/* One cell of a piecewise density, known by its mass and its densities at both ends: the monotone rational
 * quadratic of Gregory & Delbourgo ("Piecewise rational quadratic interpolation to monotonic data",
 * IMA J. Numer. Anal. 2, 1982). For xi in [0, 1], eta = 1 - xi, mass m, end densities e0, e1 >= 0 per unit of
 * xi, and k = (e0 + e1)/m,
 *
 *     F(xi)  = m (xi^2 + e0/m xi eta) / (1 + (k - 2) xi eta),              F(0) = 0, F(1) = m
 *     F'(xi) = (e1 xi^2 + 2 m xi eta + e0 eta^2) / (1 + (k - 2) xi eta)^2.
 *
 * F' > 0 inside for any e0, e1, so a cell never has a hole; F is inverted by one square root; and F'
 * follows a smooth density to third order in the cell's width, where a linear one reaches the second. */
#ifndef VNDF_MATH_RATIONAL_CELL_H
#define VNDF_MATH_RATIONAL_CELL_H

#include <math.h>

#include "core/inline.h"

typedef struct vndf_rational_cell {
    float e0, e1, mass, k;
} vndf_rational_cell;

VNDF_INLINE vndf_rational_cell vndf_rational_cell_from(float e0, float e1, float mass)
{
    vndf_rational_cell cell = {e0, e1, mass, mass > 0.0f ? (e0 + e1) / mass : 2.0f};
    return cell;
}

/* Mass before xi. */
VNDF_INLINE float vndf_rational_cdf(const vndf_rational_cell *cell, float xi)
{
    float w = xi * (1.0f - xi);
    return (cell->mass * xi * xi + cell->e0 * w) / (1.0f + (cell->k - 2.0f) * w);
}

/* Mass per unit of xi. */
VNDF_INLINE float vndf_rational_density(const vndf_rational_cell *cell, float xi)
{
    float eta = 1.0f - xi, w = xi * eta, q = 1.0f + (cell->k - 2.0f) * w;
    return (cell->e1 * xi * xi + 2.0f * cell->mass * w + cell->e0 * eta * eta) / (q * q);
}

/* xi with mass t before it: the root in [0, 1] of a xi^2 + b xi = t, where b = e0 - t (k - 2), a = m - b; the
 * discriminant b^2 + 4 a t is written as (b - 2 t)^2 + 4 t (m - t), which needs fewer steps one after the other. */
VNDF_INLINE float vndf_rational_invert(const vndf_rational_cell *cell, float t)
{
    float middle = cell->e0 - t * cell->k, b = middle + 2.0f * t;
    float square = middle * middle + 4.0f * t * (cell->mass - t);
    float root = sqrtf(square > 0.0f ? square : 0.0f); /* below 0 only by rounding of t beyond m */
    float xi = b >= 0.0f ? (t > 0.0f ? 2.0f * t / (b + root) : 0.0f) : (root - b) / (2.0f * (cell->mass - b)); /* no difference of equals */
    return xi < 1.0f ? xi : 1.0f;
}

#endif
