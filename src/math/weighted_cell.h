/* A cell of a density f(xi) W(xi) on [0, 1], where f is smooth and W = w0 (1-xi) + w1 xi >= 0 is a linear
 * weight that vanishes at an end, or nearly. In the variable
 *
 *     zeta = (W^2 - w0^2) / (w1^2 - w0^2) = xi (w0 + W) / (w0 + w1),      dzeta = 2 W / (w0 + w1) dxi
 *
 * the density is f alone, times (w0 + w1)/2, and a rational cell (rational_cell.h) through its end values follows
 * it to third order. So the end densities are f0 (w0 + w1)/2 and f1 (w0 + w1)/2 per unit of zeta; the mass
 * stays. */
#ifndef VNDF_MATH_WEIGHTED_CELL_H
#define VNDF_MATH_WEIGHTED_CELL_H

#include "math/rational_cell.h"

VNDF_INLINE float vndf_weighted_zeta(float w0, float w1, float xi)
{
    float w = w0 * (1.0f - xi) + w1 * xi, sum = w0 + w1;
    float zeta = sum > 0.0f ? xi * (w0 + w) / sum : xi;
    return zeta < 1.0f ? zeta : 1.0f;
}

#endif
