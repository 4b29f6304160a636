/* What lanes leave to the scalar path: the laws below the horizon, the cell at the cut and those beside it, and
 * the distribution function. radial.h has the mathematics. */
#ifndef VNDF_SAMPLER_TABULATED_RADIAL_CUT_H
#define VNDF_SAMPLER_TABULATED_RADIAL_CUT_H

#include "math/weighted_cell.h"
#include "sampler/tabulated/radial.h"

/* A place in the table. */
typedef struct vndf_radius {
    uint32_t cell;
    float xi, eta; /* from the inner knot and from the outer: their sum is 1, each is exact where it is small */
} vndf_radius;

VNDF_INLINE float vndf_radial_weight(const vndf_radial_law *law, uint32_t j)
{
    float w = law->c * law->table->knots.z[j] + law->k * law->table->knots.x[j];
    return w > 0.0f ? w : 0.0f;
}

/* Mass beyond knot j, less the gain (k > 0). */
VNDF_INLINE float vndf_radial_beyond(const vndf_radial_law *law, uint32_t j)
{
    return law->k * law->table->knots.s[j] + vndf_radial_weight(law, j) * law->table->knots.t[j];
}

/* c < 0 < k. In the last cell, beyond which there is no mass, all masses are per visible part. */
VNDF_INLINE vndf_radial_law vndf_radial_law_below(const vndf_distribution *d, float c, float k)
{
    float rho = -c / k;
    uint32_t j = vndf_guide_find(&d->slope_guide, rho);
    vndf_radial_law law = {d, -rho, 1.0f, 0.0f, 0.0f, j, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1};
    vndf_radial_lanes cell = vndf_radial_load(d, j);
    float w0 = d->knots.x[j] - rho * d->knots.z[j], w1 = vndf_radial_weight(&law, j + 1);
    law.part = w0 < 0.0f ? w1 / (w1 - w0) : 1.0f;
    float unit = j + 1 < d->radial_count ? law.part : 1.0f;
    law.part_mass = w1 * unit * vndf_radial_part(cell.f1, cell.f0, cell.a + cell.b, -cell.b, law.part);
    law.part_f0 = vndf_radial_f(&cell, 1.0f - law.part) * unit;
    law.part_f1 = cell.f1 * unit;
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
        return vndf_radial_scaled(vndf_radial_law_whole(d, c, k), vndf_radial_total(d, c, k));
    vndf_radial_law nothing = {d,    0.0f, 0.0f, 0.0f, 0.0f, d->radial_count - 1, 1.0f, 0.0f,
                               0.0f, 0.0f, 0.0f, 0.0f, 1};
    return nothing;
}

/* A cell as far as it is visible: where that part begins in xi and how long it is. */
typedef struct vndf_radial_piece {
    vndf_rational_cell cell; /* in xi of the part, or in zeta of V if weighted */
    int weighted;
    float v0, v1, begin, length; /* V at the ends of the part */
} vndf_radial_piece;

/* Away from the cut. */
VNDF_INLINE vndf_radial_piece vndf_radial_piece_plain(const vndf_radial_law *law, const vndf_radial_lanes *cell)
{
    vndf_radial_piece piece = {vndf_radial_plain(law, cell), 0, 0.0f, 0.0f, 0.0f, 1.0f};
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
                               1,
                               w0,
                               w1,
                               law->c < 0.0f ? 1.0f - law->part : 0.0f,
                               law->part};
    return piece;
}

/* Any cell beyond the cut, or one of the two inside it; without a cut the last two, where W may vanish. */
VNDF_INLINE vndf_radial_piece vndf_radial_piece_weighted(const vndf_radial_law *law, uint32_t j,
                                                         vndf_radial_piece piece)
{
    const vndf_radial_cell *cell = &law->table->cells[j];
    int second = j + 1 < law->cut;
    float w0 = vndf_radial_weight(law, j), w1 = vndf_radial_weight(law, j + 1), way = 16.0f * law->part;
    piece.weighted = 1;
    piece.v0 = w0;
    piece.v1 = second ? w1 + (way < 1.0f ? way : 1.0f) * (w0 - w1) : w1;
    float half = law->gain * (0.5f * (piece.v0 + piece.v1));
    piece.cell.e0 = cell->f0 * vndf_radial_over(w0, piece.v0) * half;
    piece.cell.e1 = cell->f1 * vndf_radial_over(w1, piece.v1) * half;
    return piece;
}

VNDF_INLINE vndf_radial_piece vndf_radial_piece_of(const vndf_radial_law *law, uint32_t j)
{
    if (j == law->cut)
        return vndf_radial_piece_cut(law);
    vndf_radial_lanes cell = vndf_radial_load(law->table, j);
    vndf_radial_piece piece = vndf_radial_piece_plain(law, &cell);
    return j + 2 < law->cut ? piece : vndf_radial_piece_weighted(law, j, piece);
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
    vndf_radial_lanes cell = vndf_radial_load(law->table, at.cell);
    return (law->k < 0.0f ? vndf_radial_before(law, &cell) : vndf_radial_before_whole(law, &cell)) + inside;
}

/* Mass per radian between the normal and z; 0 at the cut and beside it, and where 2^-20 of the mass or less lies
 * between the place and the next cell, which may be empty. */
VNDF_INLINE float vndf_radial_rate(const vndf_radial_law *law, vndf_radius at)
{
    vndf_radial_piece piece = vndf_radial_piece_of(law, at.cell);
    vndf_radial_lanes cell = vndf_radial_load(law->table, at.cell);
    float x = at.eta * cell.x0 + at.xi * cell.x1, z = at.eta * cell.z0 + at.xi * cell.z1;
    float rate = vndf_rational_inner_density(&piece.cell, at.xi) * (x * x + z * z) / cell.width;
    return piece.weighted ? 0.0f : rate;
}

#endif
