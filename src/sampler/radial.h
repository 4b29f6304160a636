/* Stage 2 of the engine: the slope length R = X/Z for a given azimuth, density f(xi) (c Z + k X) dxi in each
 * cell of the radial table, where c Z + k X > 0.
 *
 * The weight W = c Z + k X is linear in xi. Masses come from the moments of a cell, W0 mu0 + W1 mu1, sums from
 * the prefix of the side where nothing cancels. Inside a cell f is drawn by a weighted cell (math/weighted_cell.h). The
 * cell that holds the cut W = 0 is used on its visible part alone, with its mass and its end value at the cut from the cubic. */
#ifndef VNDF_SAMPLER_RADIAL_H
#define VNDF_SAMPLER_RADIAL_H

#include "math/weighted_cell.h"
#include "table/guide.h"
#include "table/table.h"

/* The law of R: everything that does not depend on the uniform number. */
typedef struct vndf_radial_law {
    const vndf_distribution *table;
    float c, k;               /* weights of Z and X */
    float total;              /* mass of the law */
    uint32_t cut;             /* the cell that holds the cut; radial_count if there is none */
    float part;               /* length of that cell's visible part in xi */
    float part_mass;          /* its mass */
    vndf_weighted_cell part_cell; /* its shape, from the pole outwards */
} vndf_radial_law;

/* A place in the table. */
typedef struct vndf_radius {
    uint32_t cell;
    float xi;
} vndf_radius;

static inline float vndf_radial_weight(const vndf_radial_law *law, uint32_t j)
{
    float w = law->c * law->table->pole[j].z + law->k * law->table->pole[j].x;
    return w > 0.0f ? w : 0.0f; /* rounding may bring a weight at the cut below 0 */
}

/* Mass from the pole to knot j (c > 0). */
static inline float vndf_radial_before(const vndf_radial_law *law, uint32_t j)
{
    return law->c * law->table->pole[j].e + vndf_radial_weight(law, j) * law->table->pole[j].g;
}

/* Mass beyond knot j (k > 0). */
static inline float vndf_radial_beyond(const vndf_radial_law *law, uint32_t j)
{
    return law->k * law->table->tail[j].s + vndf_radial_weight(law, j) * law->table->tail[j].t;
}

/* f at xi from the cubic. */
static inline float vndf_radial_f(const vndf_radial_cell *cell, float xi)
{
    float f = cell->f0 * (1.0f - xi) + cell->f1 * xi + xi * (1.0f - xi) * (cell->a + cell->b * xi);
    return f > 0.0f ? f : 0.0f; /* where it touches 0, rounding */
}

/* integral_0^1 f(h t) (1 - t) dt for the cubic from f0 to f1 with the bump t (1-t) (a + b t); a thousandth of
 * what the straight line gives at least: where the cubic is any good that is far away, and no cell is empty. */
static inline float vndf_radial_part(float f0, float f1, float a, float b, float h)
{
    float slope = f1 - f0;
    float cubic = f0 / 2.0f + h * ((slope + a) / 6.0f + h * ((b - a) / 12.0f - h * b / 20.0f));
    float least = 1e-3f * (f0 / 2.0f + h * slope / 6.0f);
    return cubic > least ? cubic : least;
}

static inline void vndf_radial_cut_above(vndf_radial_law *law)
{
    const vndf_distribution *d = law->table;
    uint32_t j = vndf_guide_find(&d->slope_guide, d->slope, d->radial_count + 1, law->c / -law->k);
    float w0 = vndf_radial_weight(law, j), w1 = law->c * d->pole[j + 1].z + law->k * d->pole[j + 1].x;
    const vndf_radial_cell *cell = &d->cells[j];
    law->cut = j;
    law->part = w1 < 0.0f ? w0 / (w0 - w1) : 1.0f;
    law->part_mass = w0 * law->part * vndf_radial_part(cell->f0, cell->f1, cell->a, cell->b, law->part);
    law->part_cell = vndf_weighted_cell_from(cell->f0 * law->part, vndf_radial_f(cell, law->part) * law->part, w0, 0.0f, law->part_mass);
    law->total = vndf_radial_before(law, j) + law->part_mass;
}

static inline void vndf_radial_cut_below(vndf_radial_law *law)
{
    const vndf_distribution *d = law->table;
    uint32_t j = vndf_guide_find(&d->slope_guide, d->slope, d->radial_count + 1, -law->c / law->k);
    float w0 = law->c * d->pole[j].z + law->k * d->pole[j].x, w1 = vndf_radial_weight(law, j + 1);
    const vndf_radial_cell *cell = &d->cells[j];
    law->cut = j;
    law->part = w0 < 0.0f ? w1 / (w1 - w0) : 1.0f;
    law->part_mass = w1 * law->part * vndf_radial_part(cell->f1, cell->f0, cell->a + cell->b, -cell->b, law->part);
    law->part_cell = vndf_weighted_cell_from(vndf_radial_f(cell, 1.0f - law->part) * law->part, cell->f1 * law->part, 0.0f, w1, law->part_mass);
    law->total = vndf_radial_beyond(law, j + 1) + law->part_mass;
}

/* The law for the weights (c, k), at least one of them positive. */
static inline vndf_radial_law vndf_radial_law_for(const vndf_distribution *table, float c, float k)
{
    vndf_radial_law law = {table, c, k, 0.0f, table->radial_count, 1.0f, 0.0f, {{0.0f, 0.0f}, 0.0f, 0.0f}};
    if (c > 0.0f && k < 0.0f)
        vndf_radial_cut_above(&law);
    else if (c < 0.0f && k > 0.0f)
        vndf_radial_cut_below(&law);
    else if (c >= 0.0f && k >= 0.0f)
        law.total = vndf_radial_before(&law, table->radial_count);
    return law;
}

/* Mass and shape of a cell as far as it is visible, and where that part begins in xi. */
typedef struct vndf_radial_piece {
    vndf_weighted_cell cell;
    float mass, begin, length;
} vndf_radial_piece;

static inline vndf_radial_piece vndf_radial_piece_of(const vndf_radial_law *law, uint32_t j)
{
    vndf_radial_piece piece;
    if (j == law->cut) {
        piece.cell = law->part_cell;
        piece.mass = law->part_mass;
        piece.length = law->part;
        piece.begin = law->c < 0.0f ? 1.0f - law->part : 0.0f;
        return piece;
    }
    const vndf_radial_cell *cell = &law->table->cells[j];
    float w0 = vndf_radial_weight(law, j), w1 = vndf_radial_weight(law, j + 1);
    piece.mass = w0 * cell->mu0 + w1 * cell->mu1;
    piece.cell = vndf_weighted_cell_from(cell->f0, cell->f1, w0, w1, piece.mass);
    piece.begin = 0.0f;
    piece.length = 1.0f;
    return piece;
}

/* The last cell with no more than `target` before it (c >= 0). */
static inline uint32_t vndf_radial_search_before(const vndf_radial_law *law, float target)
{
    uint32_t j = 0, n = law->cut < law->table->radial_count ? law->cut + 1 : law->table->radial_count;
    while (n > 1) {
        uint32_t half = n / 2;
        j = vndf_radial_before(law, j + half) <= target ? j + half : j;
        n -= half;
    }
    return j;
}

/* The last cell with more than `target` beyond its inner end (c < 0). */
static inline uint32_t vndf_radial_search_beyond(const vndf_radial_law *law, float target)
{
    uint32_t j = law->cut, n = law->table->radial_count - law->cut;
    while (n > 1) {
        uint32_t half = n / 2;
        j = vndf_radial_beyond(law, j + half) > target ? j + half : j;
        n -= half;
    }
    return j;
}

/* Place with a part u of the mass before it. Below the horizon mass is counted from infinity inwards. */
static inline vndf_radius vndf_radial_invert(const vndf_radial_law *law, float u)
{
    int below = law->c < 0.0f;
    float target = (below ? 1.0f - u : u) * law->total;
    uint32_t j = below ? vndf_radial_search_beyond(law, target) : vndf_radial_search_before(law, target);
    vndf_radial_piece piece = vndf_radial_piece_of(law, j);
    float rest = target - (below ? vndf_radial_beyond(law, j + 1) : vndf_radial_before(law, j));
    float inside = piece.mass > 0.0f ? rest / piece.mass : 0.5f;
    inside = inside < 1.0f ? (inside > 0.0f ? inside : 0.0f) : 1.0f;
    vndf_radius at = {j, piece.begin + piece.length * vndf_weighted_invert(&piece.cell, below ? 1.0f - inside : inside)};
    at.xi = at.xi < 1.0f ? at.xi : 1.0f;
    return at;
}

/* xi as the piece counts it. */
static inline float vndf_radial_inside(const vndf_radial_piece *piece, float xi)
{
    float at = (xi - piece->begin) / piece->length;
    return at > 0.0f ? (at < 1.0f ? at : 1.0f) : 0.0f;
}

/* Part of the mass before a place. */
static inline float vndf_radial_cdf(const vndf_radial_law *law, vndf_radius at)
{
    vndf_radial_piece piece = vndf_radial_piece_of(law, at.cell);
    float inside = vndf_weighted_cdf(&piece.cell, vndf_radial_inside(&piece, at.xi));
    if (law->c < 0.0f)
        return 1.0f - (vndf_radial_beyond(law, at.cell + 1) + (1.0f - inside) * piece.mass) / law->total;
    return (vndf_radial_before(law, at.cell) + inside * piece.mass) / law->total;
}

/* Part of the mass per unit of xi, divided by X: finite at the pole, where both vanish. */
static inline float vndf_radial_density_over_x(const vndf_radial_law *law, vndf_radius at)
{
    const vndf_pole_knot *knot = &law->table->pole[at.cell];
    vndf_radial_piece piece = vndf_radial_piece_of(law, at.cell);
    float xi = at.cell == 0 && at.xi < 1e-6f ? 1e-6f : at.xi; /* the limit, to the first order in xi */
    float x = knot[0].x + xi * (knot[1].x - knot[0].x);
    float density = vndf_weighted_density(&piece.cell, vndf_radial_inside(&piece, xi));
    return piece.mass / law->total * density / (piece.length * x);
}

#endif
