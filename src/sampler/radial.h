/* Stage 2 of the engine: the slope length R = X/Z for a given azimuth, density f(xi) (c Z + k X) dxi in each
 * cell of the radial table, where c Z + k X > 0. Drawing from it is in radial_draw.h.
 *
 * The weight W = c Z + k X is linear in xi. Masses come from the moments of a cell, W0 mu0 + W1 mu1, sums from
 * the prefix of the side where nothing cancels. Inside a cell f W is drawn by a rational cell; in the cell that
 * holds the cut W = 0, and in the two beside it, by a weighted one (math/weighted_cell.h), with a weight V that
 * is W for the cell at the cut and the first beside it. The cell at the cut is used on its visible part alone,
 * with its mass and its value at the cut from the cubic.
 *
 * So that no law jumps as the cut moves, V of the second cell beside it depends on the visible part h of the
 * cell at the cut: it is W at h = 0, where the cut leaves the first, and from h = 1/16 constant, that is a
 * plain cell. V is W at the knot away from the cut, and 16 h of the way from W there to that value at the knot
 * towards it. W and a constant follow a law f W equally well, what is between them less so: a way as long as h
 * would raise the TV of 16 KiB from 6e-5 to 1.4e-4 (gtr:1.5), in the first cell to 5e-4; this one raises it to
 * 7e-5. */
#ifndef VNDF_SAMPLER_RADIAL_H
#define VNDF_SAMPLER_RADIAL_H

#include "math/weighted_cell.h"
#include "table/guide.h"
#include "table/table.h"

/* The law of R: everything that does not depend on the uniform number. Its mass is 1, so no square of a mass
 * vanishes where next to nothing is visible. Above the horizon the weights themselves are scaled to that; below
 * it they are (c/k, 1), since k may be 1e-12 where the sums of the table are 1e-29, and masses are multiplied
 * by `gain`. */
typedef struct vndf_radial_law {
    const vndf_distribution *table;
    float c, k;               /* weights of Z and X */
    float scale;              /* by which they were multiplied; 0 if nothing is visible: the horizon is drawn */
    float gain;               /* factor of all masses: 1 above the horizon */
    uint32_t cut;             /* the cell that holds the cut; radial_count if there is none */
    float part;               /* length of that cell's visible part in xi; without a cut 0 */
    float part_mass;          /* its mass, less the gain */
    float part_f0, part_f1;   /* f times that length at its ends, from the pole outwards */
    float part_w0, part_w1;   /* W there */
} vndf_radial_law;

/* A place in the table. */
typedef struct vndf_radius {
    uint32_t cell;
    float xi, eta; /* from the inner knot and from the outer: their sum is 1, each is exact where it is small */
} vndf_radius;

VNDF_INLINE float vndf_radial_weight(const vndf_radial_law *law, uint32_t j)
{
    float w = law->c * law->table->knots.z[j] + law->k * law->table->knots.x[j];
    return w > 0.0f ? w : 0.0f; /* rounding may bring a weight at the cut below 0 */
}

/* Mass from the pole to knot j (c > 0). */
VNDF_INLINE float vndf_radial_before(const vndf_radial_law *law, uint32_t j)
{
    return law->c * law->table->knots.e[j] + vndf_radial_weight(law, j) * law->table->knots.g[j];
}

/* The same where c, k >= 0. */
VNDF_INLINE float vndf_radial_before_whole(const vndf_radial_law *law, uint32_t j)
{
    return law->c * law->table->knots.f0[j] + law->k * law->table->knots.f1[j];
}

/* Mass beyond knot j, less the gain (k > 0). */
VNDF_INLINE float vndf_radial_beyond(const vndf_radial_law *law, uint32_t j)
{
    return law->k * law->table->knots.s[j] + vndf_radial_weight(law, j) * law->table->knots.t[j];
}

/* f at xi from the cubic. */
VNDF_INLINE float vndf_radial_f(const vndf_radial_cell *cell, float xi)
{
    float f = cell->f0 * (1.0f - xi) + cell->f1 * xi + xi * (1.0f - xi) * (cell->a + cell->b * xi);
    return f > 0.0f ? f : 0.0f; /* where it touches 0, rounding */
}

/* integral_0^1 f(h t) (1 - t) dt for the cubic from f0 to f1 with the bump t (1-t) (a + b t); a thousandth of
 * what the straight line gives at least: where the cubic is any good that is far away, and no cell is empty. */
VNDF_INLINE float vndf_radial_part(float f0, float f1, float a, float b, float h)
{
    const float sixth = 1.0f / 6.0f;
    float slope = f1 - f0;
    float cubic = 0.5f * f0 + h * (sixth * (slope + a) + h * (0.5f * sixth * (b - a) - h * (0.05f * b)));
    float least = 1e-3f * (0.5f * f0 + h * (sixth * slope));
    return cubic > least ? cubic : least;
}

/* The law with all its weights multiplied so that `total`, its mass, becomes 1. */
VNDF_INLINE vndf_radial_law vndf_radial_scaled(vndf_radial_law law, float total)
{
    float scale = total > 1e-36f ? 1.0f / total : 0.0f;
    law.c *= scale;
    law.k *= scale;
    law.scale = scale;
    law.part_mass *= scale;
    law.part_w0 *= scale;
    law.part_w1 *= scale;
    return law;
}

/* c, k >= 0. */
VNDF_INLINE vndf_radial_law vndf_radial_law_whole(const vndf_distribution *d, float c, float k)
{
    vndf_radial_law law = {d, c, k, 1.0f, 1.0f, d->radial_count, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    return vndf_radial_scaled(law, c * d->f0_total + k * d->f1_total);
}

/* c > 0 > k; not scaled yet, *total is its mass. */
VNDF_INLINE vndf_radial_law vndf_radial_law_above(const vndf_distribution *d, float c, float k, float *total)
{
    uint32_t j = vndf_guide_find(&d->slope_guide, c / -k);
    vndf_radial_law law = {d, c, k, 1.0f, 1.0f, j, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    const vndf_radial_cell *cell = &d->cells[j];
    float w0 = vndf_radial_weight(&law, j), w1 = c * d->knots.z[j + 1] + k * d->knots.x[j + 1];
    law.part = w1 < 0.0f ? w0 / (w0 - w1) : 1.0f;
    law.part_mass = w0 * law.part * vndf_radial_part(cell->f0, cell->f1, cell->a, cell->b, law.part);
    law.part_f0 = cell->f0 * law.part;
    law.part_f1 = vndf_radial_f(cell, law.part) * law.part;
    law.part_w0 = w0;
    *total = vndf_radial_before(&law, j) + law.part_mass;
    return law;
}

/* c < 0 < k. In the last cell, beyond which there is no mass, all masses are per visible part. */
VNDF_INLINE vndf_radial_law vndf_radial_law_below(const vndf_distribution *d, float c, float k)
{
    float rho = -c / k;
    uint32_t j = vndf_guide_find(&d->slope_guide, rho);
    vndf_radial_law law = {d, -rho, 1.0f, 0.0f, 0.0f, j, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    const vndf_radial_cell *cell = &d->cells[j];
    float w0 = d->knots.x[j] - rho * d->knots.z[j], w1 = vndf_radial_weight(&law, j + 1);
    law.part = w0 < 0.0f ? w1 / (w1 - w0) : 1.0f;
    float unit = j + 1 < d->radial_count ? law.part : 1.0f;
    law.part_mass = w1 * unit * vndf_radial_part(cell->f1, cell->f0, cell->a + cell->b, -cell->b, law.part);
    law.part_f0 = vndf_radial_f(cell, 1.0f - law.part) * unit;
    law.part_f1 = cell->f1 * unit;
    law.part_w1 = w1;
    float total = vndf_radial_beyond(&law, j + 1) + law.part_mass;
    law.gain = total > 1e-36f && k > 1e-36f ? 1.0f / total : 0.0f;
    law.scale = law.gain > 0.0f ? 1.0f / k : 0.0f;
    return law;
}

/* The law for any weights (c, k). */
VNDF_INLINE vndf_radial_law vndf_radial_law_for(const vndf_distribution *d, float c, float k)
{
    if (c > 0.0f && k < 0.0f) {
        float total;
        vndf_radial_law law = vndf_radial_law_above(d, c, k, &total);
        return vndf_radial_scaled(law, total);
    }
    if (c < 0.0f && k > 0.0f)
        return vndf_radial_law_below(d, c, k);
    if (c >= 0.0f && k >= 0.0f)
        return vndf_radial_law_whole(d, c, k);
    vndf_radial_law nothing = {d, 0.0f, 0.0f, 0.0f, 0.0f, d->radial_count - 1, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    return nothing;
}

/* A cell as far as it is visible: where that part begins in xi and how long it is. */
typedef struct vndf_radial_piece {
    vndf_rational_cell cell; /* in xi of the part, or in zeta of V if weighted */
    int weighted;
    float v0, v1, begin, length; /* V at the ends of the part */
} vndf_radial_piece;

/* Away from the cut, where W > 0 without a guard. */
VNDF_INLINE vndf_radial_piece vndf_radial_piece_plain(const vndf_radial_law *law, uint32_t j)
{
    const vndf_radial_cell *cell = &law->table->cells[j];
    const vndf_knots *k = &law->table->knots;
    float w0 = law->c * k->z[j] + law->k * k->x[j], w1 = law->c * k->z[j + 1] + law->k * k->x[j + 1];
    float g0 = law->gain * w0, g1 = law->gain * w1;
    vndf_radial_piece piece = {{cell->f0 * g0, cell->f1 * g1, g0 * cell->mu0 + g1 * cell->mu1},
                               0, 0.0f, 0.0f, 0.0f, 1.0f};
    return piece;
}

/* W/V at a knot; what vanishes does so together. */
VNDF_INLINE float vndf_radial_over(float w, float v)
{
    return v > 0.0f ? w / v : 1.0f;
}

/* The cell at the cut, on its visible part. */
VNDF_INLINE vndf_radial_piece vndf_radial_piece_cut(const vndf_radial_law *law)
{
    float w0 = law->part_w0, w1 = law->part_w1, half = law->gain * (0.5f * (w0 + w1));
    vndf_radial_piece piece = {{law->part_f0 * half, law->part_f1 * half, law->gain * law->part_mass},
                               1, w0, w1, law->c < 0.0f ? 1.0f - law->part : 0.0f, law->part};
    return piece;
}

/* One of the two cells beside it; without a cut the last two, where W may vanish. */
VNDF_INLINE vndf_radial_piece vndf_radial_piece_beside(const vndf_radial_law *law, uint32_t j,
                                                       vndf_radial_piece piece)
{
    const vndf_radial_cell *cell = &law->table->cells[j];
    int beyond = j > law->cut, second = beyond ? j > law->cut + 1 : j + 1 < law->cut;
    float w0 = vndf_radial_weight(law, j), w1 = vndf_radial_weight(law, j + 1);
    float way = 16.0f * law->part, change = second ? (way < 1.0f ? way : 1.0f) * (w0 - w1) : 0.0f;
    piece.weighted = 1;
    piece.v0 = beyond ? w0 - change : w0;
    piece.v1 = beyond ? w1 : w1 + change;
    float half = law->gain * (0.5f * (piece.v0 + piece.v1));
    piece.cell.e0 = cell->f0 * vndf_radial_over(w0, piece.v0) * half;
    piece.cell.e1 = cell->f1 * vndf_radial_over(w1, piece.v1) * half;
    return piece;
}

VNDF_INLINE vndf_radial_piece vndf_radial_piece_of(const vndf_radial_law *law, uint32_t j)
{
    if (j == law->cut)
        return vndf_radial_piece_cut(law);
    vndf_radial_piece piece = vndf_radial_piece_plain(law, j);
    return j + 2 < law->cut || j > law->cut + 2 ? piece : vndf_radial_piece_beside(law, j, piece);
}

/* Where the piece's rational cell stands at a place of the whole cell. */
VNDF_INLINE float vndf_radial_inside(const vndf_radial_piece *piece, vndf_radius at)
{
    float inside = piece->begin > 0.0f ? 1.0f - at.eta / piece->length : at.xi / piece->length;
    inside = inside > 0.0f ? (inside < 1.0f ? inside : 1.0f) : 0.0f;
    return piece->weighted ? vndf_weighted_zeta(piece->v0, piece->v1, inside) : inside;
}

/* Part of the mass before a place. */
VNDF_INLINE float vndf_radial_cdf(const vndf_radial_law *law, vndf_radius at)
{
    vndf_radial_piece piece = vndf_radial_piece_of(law, at.cell);
    float inside = vndf_rational_cdf(&piece.cell, vndf_radial_inside(&piece, at));
    if (law->c < 0.0f) {
        float rest = piece.cell.mass - inside; /* below 0 where nothing is visible */
        return 1.0f - (law->gain * vndf_radial_beyond(law, at.cell + 1) + (rest > 0.0f ? rest : 0.0f));
    }
    return (law->k < 0.0f ? vndf_radial_before(law, at.cell) : vndf_radial_before_whole(law, at.cell)) + inside;
}

#endif
