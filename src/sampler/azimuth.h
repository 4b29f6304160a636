/* Stage 1 of the engine, in the wedge: an azimuth phi in [0, pi/2] from a mix of three rows of cells.
 *
 * The rows' variable is q in [0, 1], a half-angle tangent with an aspect (p, r) that follows the width of
 * the density:  (cos phi, sin phi) = (p (1 - q^2), r 2 q) / N,  N^2 = p^2 (1 - q^2)^2 + 4 r^2 q^2,
 *               dphi/dq = 2 p r (1 + q^2) / N^2.
 * With p = r this is the plain half-angle tangent. */
#ifndef VNDF_SAMPLER_AZIMUTH_H
#define VNDF_SAMPLER_AZIMUTH_H

#include <stdint.h>

#include "math/rational_cell.h"
#include "table/table.h"

/* One row: mass before each cell (padded to `stride` beyond every target), in it, density at its ends. */
typedef struct vndf_azimuth_part {
    const float *cdf, *mass, *density;
    float weight;
} vndf_azimuth_part;

/* The weighted sum of its parts, cell by cell. */
typedef struct vndf_azimuth_row {
    vndf_azimuth_part a, b, c;
    const float *q;         /* cells + 1 */
    uint32_t cells, stride;
    float p, r;
} vndf_azimuth_row;

/* An azimuth as (c, s)/n, s >= 0, n^2 = c^2 + s^2, and the row's mass per radian there. */
typedef struct vndf_azimuth {
    float c, s, n, density;
} vndf_azimuth;

VNDF_INLINE float vndf_azimuth_mix(const vndf_azimuth_row *row, const float *a, const float *b, const float *c,
                                   uint32_t j)
{
    return row->a.weight * a[j] + row->b.weight * b[j] + row->c.weight * c[j];
}

VNDF_INLINE float vndf_azimuth_before(const vndf_azimuth_row *row, uint32_t j)
{
    return vndf_azimuth_mix(row, row->a.cdf, row->b.cdf, row->c.cdf, j);
}

/* A cell of the mix, and its width in q. */
VNDF_INLINE vndf_rational_cell vndf_azimuth_cell(const vndf_azimuth_row *row, uint32_t j, float *width)
{
    const float *a = row->a.density, *b = row->b.density, *c = row->c.density;
    float h = row->q[j + 1] - row->q[j];
    *width = h;
    vndf_rational_cell cell = {vndf_azimuth_mix(row, a, b, c, j) * h, vndf_azimuth_mix(row, a, b, c, j + 1) * h,
                               vndf_azimuth_mix(row, row->a.mass, row->b.mass, row->c.mass, j)};
    return cell;
}

/* The azimuth at q, where the mass per `width` of q is `density`. */
VNDF_INLINE vndf_azimuth vndf_azimuth_at(const vndf_azimuth_row *row, float q, float density, float width)
{
    float c = row->p * (1.0f - q * q), s = row->r * 2.0f * q, n2 = c * c + s * s;
    vndf_azimuth at = {c, s, sqrtf(n2), density * n2 / (2.0f * row->p * row->r * (1.0f + q * q) * width)};
    return at;
}

/* The azimuth with mass `target` before it. All cells are counted through: no step waits for another. */
VNDF_INLINE vndf_azimuth vndf_azimuth_draw(const vndf_azimuth_row *row, float target)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < row->stride; i++)
        count += vndf_azimuth_before(row, i) <= target;
    uint32_t j = count > 0 ? count - 1 : 0;
    float width;
    vndf_rational_cell cell = vndf_azimuth_cell(row, j, &width);
    vndf_rational_place in = vndf_rational_invert(&cell, target - vndf_azimuth_before(row, j));
    return vndf_azimuth_at(row, row->q[j] + in.xi * width, in.density, width);
}

/* Place of the azimuth (cos, sin) in the row: its cell of q, and xi within. */
VNDF_INLINE void vndf_azimuth_place(const vndf_azimuth_row *row, float cos_phi, float sin_phi, uint32_t *j,
                                    float *xi)
{
    float c = row->r * cos_phi, s = row->p * sin_phi, q = s / (c + sqrtf(c * c + s * s));
    uint32_t count = 0;
    q = q < 1.0f ? q : 1.0f;
    for (uint32_t i = 1; i < row->cells; i++)
        count += row->q[i] <= q;
    float at = (q - row->q[count]) / (row->q[count + 1] - row->q[count]);
    *j = count;
    *xi = at > 0.0f ? (at < 1.0f ? at : 1.0f) : 0.0f;
}

/* Mass before an azimuth. */
VNDF_INLINE float vndf_azimuth_cdf(const vndf_azimuth_row *row, float cos_phi, float sin_phi)
{
    uint32_t j;
    float xi, width;
    vndf_azimuth_place(row, cos_phi, sin_phi, &j, &xi);
    vndf_rational_cell cell = vndf_azimuth_cell(row, j, &width);
    return vndf_azimuth_before(row, j) + vndf_rational_cdf(&cell, xi);
}

#endif
