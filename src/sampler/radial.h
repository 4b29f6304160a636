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
    float w = law->c * law->table->knots.z[j] + law->k * law->table->knots.x[j];
    return w > 0.0f ? w : 0.0f; /* rounding may bring a weight at the cut below 0 */
}

/* Mass from the pole to knot j (c > 0). */
static inline float vndf_radial_before(const vndf_radial_law *law, uint32_t j)
{
    return law->c * law->table->knots.e[j] + vndf_radial_weight(law, j) * law->table->knots.g[j];
}

/* Mass beyond knot j (k > 0). */
static inline float vndf_radial_beyond(const vndf_radial_law *law, uint32_t j)
{
    return law->k * law->table->knots.s[j] + vndf_radial_weight(law, j) * law->table->knots.t[j];
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
    float w0 = vndf_radial_weight(law, j), w1 = law->c * d->knots.z[j + 1] + law->k * d->knots.x[j + 1];
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
    float w0 = law->c * d->knots.z[j] + law->k * d->knots.x[j], w1 = vndf_radial_weight(law, j + 1);
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

/* How many of the knots k[from .. from + n) have no more than `target` before them (c >= 0). */
static inline uint32_t vndf_radial_count_before(const vndf_knots *k, uint32_t from, uint32_t n, const vndf_radial_law *law, float target)
{
    uint32_t count = 0;
    float c = law->c, kx = law->k;
    for (uint32_t i = from; i < from + n; i++) {
        float w = c * k->z[i] + kx * k->x[i];
        count += c * k->e[i] + (w > 0.0f ? w : 0.0f) * k->g[i] <= target;
    }
    return count;
}

/* How many have more than `target` beyond them (c < 0). */
static inline uint32_t vndf_radial_count_beyond(const vndf_knots *k, uint32_t from, uint32_t n, const vndf_radial_law *law, float target)
{
    uint32_t count = 0;
    float c = law->c, kx = law->k;
    for (uint32_t i = from; i < from + n; i++) {
        float w = c * k->z[i] + kx * k->x[i];
        count += kx * k->s[i] + (w > 0.0f ? w : 0.0f) * k->t[i] > target;
    }
    return count;
}

/* The cell of a mass: first its block, then within; a knot outside the visible part counts as its end. */
static inline uint32_t vndf_radial_search(const vndf_radial_law *law, float target)
{
    const vndf_distribution *d = law->table;
    uint32_t last = d->radial_count - 1, j;
    if (law->c < 0.0f) {
        uint32_t block = vndf_radial_count_beyond(&d->blocks, 0, d->blocks.count, law, target);
        block = block > 0 ? (block - 1) * VNDF_BLOCK : 0;
        j = block + vndf_radial_count_beyond(&d->knots, block, VNDF_BLOCK, law, target);
        j = j > 0 ? j - 1 : 0;
        return j < law->cut ? law->cut : (j < last ? j : last);
    }
    uint32_t block = vndf_radial_count_before(&d->blocks, 0, d->blocks.count, law, target);
    block = block > 0 ? (block - 1) * VNDF_BLOCK : 0;
    j = block + vndf_radial_count_before(&d->knots, block, VNDF_BLOCK, law, target);
    j = j > 0 ? j - 1 : 0;
    last = law->cut < last ? law->cut : last;
    return j < last ? j : last;
}

/* Part of the mass per unit of xi at a place, divided by W, X and the cell's width: smooth up to the cut, and
 * finite at the pole. `zeta` is the place as the piece's shape counts it. */
static inline float vndf_radial_density(const vndf_radial_law *law, const vndf_radial_piece *piece, vndf_radius at, float zeta)
{
    const vndf_distribution *d = law->table;
    float sum = piece->cell.w0 + piece->cell.w1;
    if (at.cell == 0 && at.xi < 1e-6f) { /* f and X both begin at 0: the limit of their quotient */
        at.xi = 1e-6f;
        zeta = vndf_weighted_zeta(&piece->cell, (at.xi - piece->begin) / piece->length);
    }
    float x = d->knots.x[at.cell] + at.xi * (d->knots.x[at.cell + 1] - d->knots.x[at.cell]);
    float below = law->total * piece->length * x * d->cells[at.cell].width * sum;
    return below > 0.0f ? 2.0f * piece->mass * vndf_rational_density(piece->cell.shape, zeta) / below : 0.0f;
}

/* Place with a part u of the mass before it, and the density there. Below the horizon mass is counted from infinity inwards. */
static inline vndf_radius vndf_radial_draw(const vndf_radial_law *law, float u, float *density)
{
    int below = law->c < 0.0f;
    float target = (below ? 1.0f - u : u) * law->total;
    uint32_t j = vndf_radial_search(law, target);
    vndf_radial_piece piece = vndf_radial_piece_of(law, j);
    float rest = target - (below ? vndf_radial_beyond(law, j + 1) : vndf_radial_before(law, j));
    float inside = piece.mass > 0.0f ? rest / piece.mass : 0.5f;
    inside = inside < 1.0f ? (inside > 0.0f ? inside : 0.0f) : 1.0f;
    float zeta = vndf_rational_invert(piece.cell.shape, below ? 1.0f - inside : inside);
    vndf_radius at = {j, piece.begin + piece.length * vndf_weighted_xi(&piece.cell, zeta)};
    at.xi = at.xi < 1.0f ? at.xi : 1.0f;
    *density = vndf_radial_density(law, &piece, at, zeta);
    return at;
}

/* zeta of a place in its piece. */
static inline float vndf_radial_zeta(const vndf_radial_piece *piece, float xi)
{
    float inside = (xi - piece->begin) / piece->length;
    return vndf_weighted_zeta(&piece->cell, inside > 0.0f ? (inside < 1.0f ? inside : 1.0f) : 0.0f);
}

/* Part of the mass before a place. */
static inline float vndf_radial_cdf(const vndf_radial_law *law, vndf_radius at)
{
    vndf_radial_piece piece = vndf_radial_piece_of(law, at.cell);
    float inside = vndf_rational_cdf(piece.cell.shape, vndf_radial_zeta(&piece, at.xi));
    if (law->c < 0.0f)
        return 1.0f - (vndf_radial_beyond(law, at.cell + 1) + (1.0f - inside) * piece.mass) / law->total;
    return (vndf_radial_before(law, at.cell) + inside * piece.mass) / law->total;
}

#endif
