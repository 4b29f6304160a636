/* A cell of a density f(xi) W(xi) on [0, 1], where f is smooth and W = w0 (1-xi) + w1 xi >= 0 is a linear
 * weight that may vanish at an end. In the variable
 *
 *     zeta = (W^2 - w0^2) / (w1^2 - w0^2) = xi (w0 + W) / (w0 + w1),      dzeta = 2 W / (w0 + w1) dxi
 *
 * the density is that of f alone: a rational cell (rational_cell.h) through f's end values and its mean
 * mass / ((w0 + w1)/2) follows it to third order whatever the weight, a cut (w0 or w1 = 0) included. The part
 * of the mass before xi is the shape's cdf at zeta; its derivative by xi the shape's density times dzeta/dxi. */
#ifndef VNDF_MATH_WEIGHTED_CELL_H
#define VNDF_MATH_WEIGHTED_CELL_H

#include "math/rational_cell.h"

typedef struct vndf_weighted_cell {
    vndf_rational_cell shape; /* of f in zeta */
    float w0, w1;
} vndf_weighted_cell;

/* f0, f1: end values; mass = integral f W dxi. */
static inline vndf_weighted_cell vndf_weighted_cell_from(float f0, float f1, float w0, float w1, float mass)
{
    float per_mean = mass > 0.0f ? 0.5f * (w0 + w1) / mass : 0.0f;
    vndf_weighted_cell cell = {{f0 * per_mean, f1 * per_mean}, w0, w1};
    return cell;
}

static inline float vndf_weighted_zeta(const vndf_weighted_cell *cell, float xi)
{
    float w = cell->w0 * (1.0f - xi) + cell->w1 * xi, sum = cell->w0 + cell->w1;
    float zeta = sum > 0.0f ? xi * (cell->w0 + w) / sum : xi;
    return zeta < 1.0f ? zeta : 1.0f;
}

static inline float vndf_weighted_xi(const vndf_weighted_cell *cell, float zeta)
{
    float sum = cell->w0 + cell->w1;
    float w = sqrtf(cell->w0 * cell->w0 * (1.0f - zeta) + cell->w1 * cell->w1 * zeta);
    float xi = cell->w0 + w > 0.0f ? zeta * sum / (cell->w0 + w) : zeta;
    return xi < 1.0f ? xi : 1.0f;
}

#endif
