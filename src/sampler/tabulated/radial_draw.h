/* Drawing the slope length: search for the cell, in a window of knots (table/window.h) or by blocks, then
 * its inverse. One function for each of the three kinds of laws (radial.h); they take the weights before scaling,
 * so that the search need not wait for the division by the mass. */
#ifndef VNDF_SAMPLER_TABULATED_RADIAL_DRAW_H
#define VNDF_SAMPLER_TABULATED_RADIAL_DRAW_H

#include "sampler/tabulated/radial_cut.h"

/* A drawn place, its piece, and the place in the piece's rational cell. */
typedef struct vndf_radial_drawn {
    vndf_radius at;
    vndf_radial_piece piece;
    vndf_rational_place inside;
} vndf_radial_drawn;

/* How many have more than `target` beyond them (c < 0). */
VNDF_INLINE uint32_t vndf_radial_count_beyond(const vndf_knots *knots, uint32_t from, uint32_t n, float c, float k,
                                              float target)
{
    const vndf_knot *at = knots->at + from;
    const vndf_tail_sums *tail = knots->tail + from;
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i++) {
        float w = c * at[i].z + k * at[i].x;
        count += k * tail[i].s + (w > 0.0f ? w : 0.0f) * tail[i].t > target;
    }
    return count;
}

/* The cell of a mass below the horizon, counted from infinity inwards; a knot that is not visible counts as the
 * cut. */
VNDF_INLINE uint32_t vndf_radial_search_beyond(const vndf_radial_law *law, float target)
{
    const vndf_distribution *d = law->table;
    uint32_t last = d->radial_count - 1;
    uint32_t block = vndf_radial_count_beyond(&d->blocks, 0, d->blocks.count, law->c, law->k, target);
    block = block > 0 ? (block - 1) * VNDF_BLOCK : 0;
    uint32_t j = block + vndf_radial_count_beyond(&d->knots, block, VNDF_BLOCK, law->c, law->k, target);
    j = j > 0 ? j - 1 : 0;
    j = j > law->cut ? j : law->cut;
    return j < last ? j : last;
}

/* The place with a mass `rest` of cell j before it. */
VNDF_INLINE vndf_radial_drawn vndf_radial_draw_in(const vndf_radial_law *law, uint32_t j, vndf_radial_piece piece,
                                                  float rest)
{
    vndf_radial_drawn r = {{j, 1.0f, 0.0f}, piece, vndf_rational_invert(&piece.cell, rest > 0.0f ? rest : 0.0f)};
    float xi = r.inside.xi, eta = 1.0f - xi;
    if (piece.weighted) {
        float within = vndf_weighted_xi(piece.v0, piece.v1, xi);
        xi = piece.begin + piece.length * within;
        eta = piece.begin > 0.0f ? piece.length * (1.0f - within) : 1.0f - xi;
    }
    if (!(eta > 0.0f && law->scale > 0.0f))
        return r; /* where nothing is visible the horizon stands for it */
    r.at.xi = xi;
    r.at.eta = eta;
    return r;
}

/* The place with a part u of the mass before it; c, k >= 0. */
VNDF_INLINE vndf_radial_drawn vndf_radial_draw_whole(const vndf_distribution *d, float c, float k, float u)
{
    float total = vndf_radial_total(d, c, k), target = u * total;
    uint32_t last = d->radial_count - 1, j = vndf_radial_find_one(d, vndf_window_of(d, c, k, u), c, k, target, 1);
    j = j < last ? j : last;
    vndf_radial_law law = vndf_radial_law_whole(d, c, k);
    law = vndf_radial_scaled(law, total);
    vndf_radial_lanes cell = vndf_radial_load(d, j);
    return vndf_radial_draw_in(&law, j, vndf_radial_piece_of(&law, j), u - vndf_radial_before_whole(&law, &cell));
}

/* c > 0 > k. */
VNDF_INLINE vndf_radial_drawn vndf_radial_draw_above(const vndf_distribution *d, float c, float k, float u)
{
    float total;
    vndf_radial_law law = vndf_radial_law_above(d, c, k, &total);
    uint32_t j = vndf_radial_find_one(d, vndf_window_of(d, c, k, u), c, k, u * total, 0);
    j = j < law.cut ? j : law.cut;
    law = vndf_radial_scaled(law, total);
    vndf_radial_lanes cell = vndf_radial_load(d, j);
    return vndf_radial_draw_in(&law, j, vndf_radial_piece_of(&law, j), u - vndf_radial_before(&law, &cell));
}

/* c < 0, k > 0; or k = 0 and nothing is visible. Mass is counted from infinity inwards. */
VNDF_RARE vndf_radial_drawn vndf_radial_draw_below(const vndf_distribution *d, float c, float k, float u)
{
    vndf_radial_law law = vndf_radial_law_for(d, c, k);
    uint32_t j = law.gain > 0.0f ? vndf_radial_search_beyond(&law, (1.0f - u) / law.gain) : law.cut;
    vndf_radial_piece piece = vndf_radial_piece_of(&law, j);
    float beyond = law.gain * vndf_radial_beyond(&law, j + 1);
    return vndf_radial_draw_in(&law, j, piece, piece.cell.mass - ((1.0f - u) - beyond));
}

#endif
