/* Rational cells (math/rational_cell.h) in double, for one or for lanes; and the search for a radial cell below the
 * horizon. */
#ifndef VNDF_SAMPLER_TABULATED_EXACT_CELL_H
#define VNDF_SAMPLER_TABULATED_EXACT_CELL_H

#include "simd/count.h"
#include "simd/doubles.h"
#include "table/table.h"

typedef struct vndf_exact_cell {
    doubles e0, e1, mass;
} vndf_exact_cell;

/* A place between two knots: xi and eta = 1 - xi, each exact where it is small. */
typedef struct vndf_exact_place {
    doubles xi, eta;
} vndf_exact_place;

/* The place with the mass `before` before it, or the nearer end: the root of math/rational_cell.h. */
VNDF_INLINE vndf_exact_place vndf_exact_cell_invert(const vndf_exact_cell *cell, doubles before)
{
    const doubles one = doubles_set(1.0), nothing = doubles_set(0.0);
    doubles m = cell->mass, within = doubles_pick(doubles_less(before, m), before, m);
    doubles t = doubles_pick(doubles_less(nothing, before), within, nothing), twice = 2.0 * t * m;
    doubles middle = cell->e0 * m - t * (cell->e0 + cell->e1), b = middle + twice;
    doubles sum = doubles_abs(b) + doubles_root(middle * middle + twice * (2.0 * m * (m - t)));
    doubles_m rises = doubles_at_most(nothing, b);
    doubles above = doubles_pick(rises, twice, sum), below = doubles_pick(rises, sum, 2.0 * (m * m - b));
    doubles_m there = doubles_less(nothing, below);
    doubles per = doubles_pick(there, 1.0 / below, nothing);
    doubles rest = doubles_pick(doubles_less(above, below), below - above, nothing);
    vndf_exact_place at = {above * per, doubles_pick(there, rest * per, one)};
    return at;
}

#if VNDF_LANES == 1

/* Mass per xi. */
VNDF_INLINE double vndf_exact_cell_density(const vndf_exact_cell *cell, vndf_exact_place at)
{
    double m = cell->mass, w = at.xi * at.eta, q = 1.0 + ((cell->e0 + cell->e1) / m - 2.0) * w;
    return (cell->e1 * at.xi * at.xi + 2.0 * m * w + cell->e0 * at.eta * at.eta) / (q * q);
}

/* Mass before a place. */
VNDF_INLINE double vndf_exact_cell_before(const vndf_exact_cell *cell, vndf_exact_place at)
{
    double m = cell->mass, w = at.xi * at.eta, below = m + (cell->e0 + cell->e1 - 2.0 * m) * w;
    return below > 0.0 ? m * (m * at.xi * at.xi + cell->e0 * w) / below : 0.0;
}

#endif

/* ---- the search below the horizon, for k = 1 ---- */

/* How many of n knots have more than `target` beyond them. */
VNDF_INLINE uint32_t vndf_count_beyond(const vndf_knots *knots, uint32_t from, uint32_t n, float c, float target)
{
    const vndf_knot *at = knots->at + from;
    const vndf_tail_sums *tail = knots->tail + from;
    uint32_t count = 0, i = 0;
    for (; i + 8 <= n; i += 8)
        count += vndf_count_more(&at[i].x, &tail[i].s, c, target);
    for (; i < n; i++) {
        float w = c * at[i].z + at[i].x;
        count += tail[i].s + (w > 0.0f ? w : 0.0f) * tail[i].t > target;
    }
    return count;
}

/* The cell in which the mass `target` beyond begins, by blocks from infinity inwards. A knot that is not visible counts
 * as the cut. */
VNDF_INLINE uint32_t vndf_find_beyond(const vndf_distribution *d, float c, uint32_t cut, float target)
{
    uint32_t last = d->radial_count - 1, block = vndf_count_beyond(&d->blocks, 0, d->blocks.count, c, target);
    block = block > 0 ? (block - 1) * VNDF_BLOCK : 0;
    uint32_t j = block + vndf_count_beyond(&d->knots, block, VNDF_BLOCK, c, target);
    j = j > 0 ? j - 1 : 0;
    j = j > cut ? j : cut;
    return j < last ? j : last;
}

#endif
