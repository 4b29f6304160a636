/* One cell of a piecewise density whose mass and end densities are given: the monotone rational
 * quadratic of Gregory & Delbourgo ("Piecewise rational quadratic interpolation to monotonic data",
 * IMA J. Numer. Anal. 2, 1982). On xi in [0, 1] with end densities d0, d1 >= 0 (relative to the mean),
 *
 *     F(xi) = (xi^2 + d0 xi (1-xi)) / (1 + (d0 + d1 - 2) xi (1-xi)),       F(0) = 0, F(1) = 1
 *     F'(xi) = (d1 xi^2 + 2 xi (1-xi) + d0 (1-xi)^2) / (1 + (d0 + d1 - 2) xi (1-xi))^2
 *
 * F' > 0 inside for any d0, d1, so a cell never has a hole; F is inverted by one square root; and F'
 * follows a smooth density to third order in the cell's width, where a linear one reaches the second. */
#ifndef VNDF_MATH_RATIONAL_CELL_H
#define VNDF_MATH_RATIONAL_CELL_H

#include <math.h>

typedef struct vndf_rational_cell {
    float d0, d1;
} vndf_rational_cell;

static inline float vndf_rational_cdf(vndf_rational_cell cell, float xi)
{
    float w = xi * (1.0f - xi);
    return (xi * xi + cell.d0 * w) / (1.0f + (cell.d0 + cell.d1 - 2.0f) * w);
}

static inline float vndf_rational_density(vndf_rational_cell cell, float xi)
{
    float eta = 1.0f - xi, w = xi * eta;
    float q = 1.0f + (cell.d0 + cell.d1 - 2.0f) * w;
    return (cell.d1 * xi * xi + 2.0f * w + cell.d0 * eta * eta) / (q * q);
}

/* xi with F(xi) = u: the root in [0, 1] of a xi^2 + b xi = u, where a + b = 1. */
static inline float vndf_rational_invert(vndf_rational_cell cell, float u)
{
    float b = cell.d0 - u * (cell.d0 + cell.d1 - 2.0f), a = 1.0f - b;
    float discriminant = b * b + 4.0f * a * u;
    float root = sqrtf(discriminant > 0.0f ? discriminant : 0.0f);
    float xi = b >= 0.0f ? 2.0f * u / (b + root) : (root - b) / (2.0f * a); /* either way no difference of equals */
    return xi < 1.0f ? xi : 1.0f;
}

#endif
