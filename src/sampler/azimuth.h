/* Stage 1 of the engine: an azimuth p in [0, pi/2] from one row of cells, or two that are mixed.
 *
 * The row's variable is q in [0, 1], a half-angle tangent with an aspect (p, r) that follows the width of
 * the density:  (cos, sin) = (p (1 - q^2), r 2 q) / N,  N^2 = p^2 (1 - q^2)^2 + 4 r^2 q^2,
 *               dphi/dq = 2 p r (1 + q^2) / N^2.
 * With p = r this is the plain half-angle tangent. */
#ifndef VNDF_SAMPLER_AZIMUTH_H
#define VNDF_SAMPLER_AZIMUTH_H

#include "math/rational_cell.h"
#include "table/table.h"

/* weight_a a + weight_b b, cell by cell. */
typedef struct vndf_azimuth_row {
    const vndf_azimuth_node *a, *b;
    const float *q; /* cells + 1 */
    float weight_a, weight_b;
    uint32_t cells;
    float p, r;
} vndf_azimuth_row;

/* cos and sin >= 0 of the azimuth. */
typedef struct vndf_turn {
    float cos_phi, sin_phi;
} vndf_turn;

static inline float vndf_azimuth_cdf_at(const vndf_azimuth_row *row, uint32_t j)
{
    return row->weight_a * row->a[j].cdf + row->weight_b * row->b[j].cdf;
}

static inline float vndf_azimuth_mass(const vndf_azimuth_row *row, uint32_t j)
{
    return row->weight_a * row->a[j].mass + row->weight_b * row->b[j].mass;
}

static inline float vndf_azimuth_width(const vndf_azimuth_row *row, uint32_t j)
{
    return row->q[j + 1] - row->q[j];
}

/* The cell's density relative to its mean: row densities are per unit of q. */
static inline vndf_rational_cell vndf_azimuth_cell(const vndf_azimuth_row *row, uint32_t j)
{
    float per_mean = vndf_azimuth_width(row, j) / vndf_azimuth_mass(row, j);
    vndf_rational_cell cell = {
        (row->weight_a * row->a[j].density + row->weight_b * row->b[j].density) * per_mean,
        (row->weight_a * row->a[j + 1].density + row->weight_b * row->b[j + 1].density) * per_mean};
    return cell;
}

/* q where the mass before it is `target`. */
static inline float vndf_azimuth_invert(const vndf_azimuth_row *row, float target)
{
    uint32_t j = 0, n = row->cells;
    while (n > 1) { /* the last cell whose mass before it is <= target */
        uint32_t half = n / 2;
        j = vndf_azimuth_cdf_at(row, j + half) <= target ? j + half : j;
        n -= half;
    }
    float u = (target - vndf_azimuth_cdf_at(row, j)) / vndf_azimuth_mass(row, j);
    float xi = vndf_rational_invert(vndf_azimuth_cell(row, j), u < 1.0f ? (u > 0.0f ? u : 0.0f) : 1.0f);
    return row->q[j] + xi * vndf_azimuth_width(row, j);
}

static inline uint32_t vndf_azimuth_find(const vndf_azimuth_row *row, float q, float *xi)
{
    uint32_t j = 0, n = row->cells;
    while (n > 1) {
        uint32_t half = n / 2;
        j = row->q[j + half] <= q ? j + half : j;
        n -= half;
    }
    float at = (q - row->q[j]) / vndf_azimuth_width(row, j);
    *xi = at > 0.0f ? (at < 1.0f ? at : 1.0f) : 0.0f;
    return j;
}

/* Mass before q. */
static inline float vndf_azimuth_cdf(const vndf_azimuth_row *row, float q)
{
    float xi;
    uint32_t j = vndf_azimuth_find(row, q, &xi);
    return vndf_azimuth_cdf_at(row, j) + vndf_azimuth_mass(row, j) * vndf_rational_cdf(vndf_azimuth_cell(row, j), xi);
}

/* Mass per radian of azimuth at q. */
static inline float vndf_azimuth_density(const vndf_azimuth_row *row, float q)
{
    float xi;
    uint32_t j = vndf_azimuth_find(row, q, &xi);
    float per_q = vndf_azimuth_mass(row, j) / vndf_azimuth_width(row, j) * vndf_rational_density(vndf_azimuth_cell(row, j), xi);
    float c = row->p * (1.0f - q * q), s = row->r * 2.0f * q;
    return per_q * (c * c + s * s) / (2.0f * row->p * row->r * (1.0f + q * q));
}

static inline vndf_turn vndf_azimuth_turn(const vndf_azimuth_row *row, float q)
{
    float c = row->p * (1.0f - q * q), s = row->r * 2.0f * q;
    float scale = 1.0f / sqrtf(c * c + s * s);
    vndf_turn turn = {c * scale, s * scale};
    return turn;
}

static inline float vndf_azimuth_q(const vndf_azimuth_row *row, vndf_turn turn)
{
    float c = row->r * turn.cos_phi, s = row->p * turn.sin_phi;
    float q = s / (c + sqrtf(c * c + s * s));
    return q < 1.0f ? q : 1.0f;
}

#endif
