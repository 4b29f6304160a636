/* Stage 2 of the engine: the slope length R = X/Z for a given azimuth, density f(xi) (c Z + k X) dxi in each
 * cell of the radial table, where c Z + k X > 0.
 *
 * The weight W = c Z + k X is linear in xi. Masses come from the moments of a cell, W0 mu0 + W1 mu1, sums from
 * the prefix of the side where nothing cancels. Inside a cell f W is drawn by a rational cell; in the
 * cell that holds the cut W = 0, and in its neighbour, by a weighted one (math/weighted_cell.h). The cell at the
 * cut is used on its visible part alone, with its mass and its value at the cut from the cubic. */
#ifndef VNDF_SAMPLER_RADIAL_H
#define VNDF_SAMPLER_RADIAL_H

#include "math/weighted_cell.h"
#include "table/guide.h"
#include "table/table.h"

/* The law of R: everything that does not depend on the uniform number. */
typedef struct vndf_radial_law {
    const vndf_distribution *table;
    float c, k;               /* weights of Z and X */
    float scale;              /* by which they were multiplied */
    float total;              /* mass of the law */
    uint32_t cut;             /* the cell that holds the cut; radial_count if there is none */
    float part;               /* length of that cell's visible part in xi */
    float part_mass;          /* its mass */
    float part_f0, part_f1;   /* f times that length at its ends, from the pole outwards */
    float part_w0, part_w1;   /* W there */
} vndf_radial_law;

/* A place in the table. */
typedef struct vndf_radius {
    uint32_t cell;
    float xi;
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

/* Mass beyond knot j (k > 0). */
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
    float slope = f1 - f0;
    float cubic = f0 / 2.0f + h * ((slope + a) / 6.0f + h * ((b - a) / 12.0f - h * b / 20.0f));
    float least = 1e-3f * (f0 / 2.0f + h * slope / 6.0f);
    return cubic > least ? cubic : least;
}

VNDF_INLINE void vndf_radial_cut_above(vndf_radial_law *law)
{
    const vndf_distribution *d = law->table;
    uint32_t j = vndf_guide_find(&d->slope_guide, d->slope, d->radial_count + 1, law->c / -law->k);
    float w0 = vndf_radial_weight(law, j), w1 = law->c * d->knots.z[j + 1] + law->k * d->knots.x[j + 1];
    const vndf_radial_cell *cell = &d->cells[j];
    law->cut = j;
    law->part = w1 < 0.0f ? w0 / (w0 - w1) : 1.0f;
    law->part_mass = w0 * law->part * vndf_radial_part(cell->f0, cell->f1, cell->a, cell->b, law->part);
    law->part_f0 = cell->f0 * law->part;
    law->part_f1 = vndf_radial_f(cell, law->part) * law->part;
    law->part_w0 = w0;
    law->total = vndf_radial_before(law, j) + law->part_mass;
}

VNDF_INLINE void vndf_radial_cut_below(vndf_radial_law *law)
{
    const vndf_distribution *d = law->table;
    uint32_t j = vndf_guide_find(&d->slope_guide, d->slope, d->radial_count + 1, -law->c / law->k);
    float w0 = law->c * d->knots.z[j] + law->k * d->knots.x[j], w1 = vndf_radial_weight(law, j + 1);
    const vndf_radial_cell *cell = &d->cells[j];
    law->cut = j;
    law->part = w0 < 0.0f ? w1 / (w1 - w0) : 1.0f;
    law->part_mass = w1 * law->part * vndf_radial_part(cell->f1, cell->f0, cell->a + cell->b, -cell->b, law->part);
    law->part_f0 = vndf_radial_f(cell, 1.0f - law->part) * law->part;
    law->part_f1 = cell->f1 * law->part;
    law->part_w1 = w1;
    law->total = vndf_radial_beyond(law, j + 1) + law->part_mass;
}

VNDF_INLINE vndf_radial_law vndf_radial_law_unscaled(const vndf_distribution *table, float c, float k)
{
    vndf_radial_law law = {table, c, k, 1.0f, 0.0f, table->radial_count, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    if (c > 0.0f && k < 0.0f)
        vndf_radial_cut_above(&law);
    else if (c < 0.0f && k > 0.0f)
        vndf_radial_cut_below(&law);
    else if (c >= 0.0f && k >= 0.0f)
        law.total = vndf_radial_before(&law, table->radial_count);
    else
        law.cut = table->radial_count - 1; /* nothing is visible: the horizon stands for it */
    return law;
}

/* The law for the weights (c, k). Where next to nothing is visible they are scaled up, so that no square of a mass vanishes. */
VNDF_INLINE vndf_radial_law vndf_radial_law_for(const vndf_distribution *table, float c, float k)
{
    vndf_radial_law law = vndf_radial_law_unscaled(table, c, k);
    if (law.total < 1e-10f && law.total > 1e-36f) {
        float scale = 1.0f / law.total;
        law = vndf_radial_law_unscaled(table, c * scale, k * scale);
        law.scale = scale;
    }
    return law;
}

/* A cell as far as it is visible: where that part begins in xi and how long it is. */
typedef struct vndf_radial_piece {
    vndf_rational_cell cell; /* in xi of the part, or in zeta if weighted */
    int weighted;
    float w0, w1, begin, length;
} vndf_radial_piece;

VNDF_INLINE vndf_radial_piece vndf_radial_piece_of(const vndf_radial_law *law, uint32_t j)
{
    const vndf_radial_cell *cell = &law->table->cells[j];
    vndf_radial_piece piece;
    float f0 = cell->f0, f1 = cell->f1, mass;
    piece.w0 = vndf_radial_weight(law, j);
    piece.w1 = vndf_radial_weight(law, j + 1);
    mass = piece.w0 * cell->mu0 + piece.w1 * cell->mu1;
    piece.begin = 0.0f;
    piece.length = 1.0f;
    piece.weighted = j + 1 >= law->cut && j <= law->cut + 1;
    if (j == law->cut) {
        f0 = law->part_f0;
        f1 = law->part_f1;
        piece.w0 = law->part_w0;
        piece.w1 = law->part_w1;
        mass = law->part_mass;
        piece.length = law->part;
        piece.begin = law->c < 0.0f ? 1.0f - law->part : 0.0f;
    }
    float half = 0.5f * (piece.w0 + piece.w1);
    piece.cell = vndf_rational_cell_from(f0 * (piece.weighted ? half : piece.w0), f1 * (piece.weighted ? half : piece.w1), mass);
    return piece;
}

/* How many of the knots k[from .. from + n) have no more than `target` before them (c >= 0). */
VNDF_INLINE uint32_t vndf_radial_count_before(const vndf_knots *k, uint32_t from, uint32_t n, const vndf_radial_law *law, float target)
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
VNDF_INLINE uint32_t vndf_radial_count_beyond(const vndf_knots *k, uint32_t from, uint32_t n, const vndf_radial_law *law, float target)
{
    uint32_t count = 0;
    float c = law->c, kx = law->k;
    for (uint32_t i = from; i < from + n; i++) {
        float w = c * k->z[i] + kx * k->x[i];
        count += kx * k->s[i] + (w > 0.0f ? w : 0.0f) * k->t[i] > target;
    }
    return count;
}

/* The cell of a mass below the horizon: first its block, then within; a knot that is not visible counts as the cut. */
VNDF_INLINE uint32_t vndf_radial_search_below(const vndf_radial_law *law, float target)
{
    const vndf_distribution *d = law->table;
    uint32_t last = d->radial_count - 1, block = vndf_radial_count_beyond(&d->blocks, 0, d->blocks.count, law, target);
    block = block > 0 ? (block - 1) * VNDF_BLOCK : 0;
    uint32_t j = block + vndf_radial_count_beyond(&d->knots, block, VNDF_BLOCK, law, target);
    j = j > 0 ? j - 1 : 0;
    j = j > law->cut ? j : law->cut;
    return j < last ? j : last;
}

/* Above: in the window that u has without a cut, or as below. */
VNDF_INLINE uint32_t vndf_radial_search_above(const vndf_radial_law *law, float u, float target)
{
    const vndf_distribution *d = law->table;
    uint32_t last = d->radial_count - 1, j, range = (uint32_t)(u * VNDF_STARTS);
    uint32_t start = d->start[range < VNDF_STARTS ? range : VNDF_STARTS - 1];
    if (law->cut > last && start != VNDF_NO_START)
        j = start + vndf_radial_count_before(&d->knots, start, VNDF_WINDOW, law, target);
    else {
        uint32_t block = vndf_radial_count_before(&d->blocks, 0, d->blocks.count, law, target);
        block = block > 0 ? (block - 1) * VNDF_BLOCK : 0;
        j = block + vndf_radial_count_before(&d->knots, block, VNDF_BLOCK, law, target);
        last = law->cut < last ? law->cut : last;
    }
    j = j > 0 ? j - 1 : 0;
    return j < last ? j : last;
}

/* Where the piece's rational cell stands at xi of the whole cell. */
VNDF_INLINE float vndf_radial_inside(const vndf_radial_piece *piece, float xi)
{
    float inside = (xi - piece->begin) / piece->length;
    inside = inside > 0.0f ? (inside < 1.0f ? inside : 1.0f) : 0.0f;
    return piece->weighted ? vndf_weighted_zeta(piece->w0, piece->w1, inside) : inside;
}

/* Part of the mass per unit of xi at a place, divided by X and the cell's width: finite at the pole, where f and
 * X begin at 0. `w` is W of the very normal whose density is asked for, (direction . normal): what c and k make
 * of W near the cut differs between sample and pdf by rounding, in the cell's mass and in its W alike. */
VNDF_INLINE float vndf_radial_density(const vndf_radial_law *law, const vndf_radial_piece *piece, vndf_radius at, float inside, float w)
{
    const vndf_distribution *d = law->table;
    if (at.cell == 0 && at.xi < 1e-6f) {
        at.xi = 1e-6f;
        inside = vndf_radial_inside(piece, at.xi);
    }
    float x = d->knots.x[at.cell] + at.xi * (d->knots.x[at.cell + 1] - d->knots.x[at.cell]);
    float own_w = piece->weighted ? 0.5f * (piece->w0 + piece->w1) : piece->w0 + at.xi * (piece->w1 - piece->w0);
    float below = law->total * piece->length * x * d->cells[at.cell].width * own_w;
    return below > 0.0f ? w * law->scale * vndf_rational_density(&piece->cell, inside) / below : 0.0f;
}

/* Whether a normal and its rounded self may differ in density by more than a few millionths: where the density changes
 * by more than a factor e^10 per e-fold of the slope - per mean density of the cell, or what it has about `inside` -
 * and beside a knot, which may be a jump of D. */
VNDF_INLINE int vndf_radial_is_delicate(const vndf_radial_law *law, const vndf_radial_piece *piece, vndf_radius at, float inside)
{
    const vndf_knots *k = &law->table->knots;
    float rise = piece->cell.e1 - piece->cell.e0, here = piece->cell.e0 + rise * inside, mass = piece->cell.mass;
    float change = fabsf(rise) * k->x[at.cell + 1] * k->z[at.cell];
    return change > 10.0f * (here < mass ? here : mass) * law->table->cells[at.cell].width || at.xi > 0.999f || at.xi < 0.001f;
}

/* A drawn place, its piece and where that stands. */
typedef struct vndf_radial_draw_result {
    vndf_radius at;
    vndf_radial_piece piece;
    float inside;
} vndf_radial_draw_result;

/* The place with a part u of the mass before it. Below the horizon mass is counted from infinity inwards. */
VNDF_INLINE vndf_radial_draw_result vndf_radial_draw(const vndf_radial_law *law, float u)
{
    int below = law->c < 0.0f;
    float target = (below ? 1.0f - u : u) * law->total;
    uint32_t j = below ? vndf_radial_search_below(law, target) : vndf_radial_search_above(law, u, target);
    vndf_radial_draw_result r;
    r.piece = vndf_radial_piece_of(law, j);
    float rest = target - (below ? vndf_radial_beyond(law, j + 1) : vndf_radial_before(law, j));
    rest = below ? r.piece.cell.mass - rest : rest;
    r.inside = vndf_rational_invert(&r.piece.cell, rest > 0.0f ? rest : 0.0f);
    float xi = r.inside;
    if (r.piece.weighted)
        xi = r.piece.begin + r.piece.length * vndf_weighted_xi(r.piece.w0, r.piece.w1, xi);
    r.at.cell = j;
    r.at.xi = xi < 1.0f && law->total > 0.0f ? xi : 1.0f; /* where nothing is visible the horizon stands for it */
    return r;
}

/* Part of the mass before a place. */
VNDF_INLINE float vndf_radial_cdf(const vndf_radial_law *law, vndf_radius at)
{
    vndf_radial_piece piece = vndf_radial_piece_of(law, at.cell);
    float inside = vndf_rational_cdf(&piece.cell, vndf_radial_inside(&piece, at.xi));
    if (law->c < 0.0f)
        return 1.0f - (vndf_radial_beyond(law, at.cell + 1) + (piece.cell.mass - inside)) / law->total;
    return (vndf_radial_before(law, at.cell) + inside) / law->total;
}

#endif
