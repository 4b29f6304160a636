/* The exact tier of tables draws, evaluates and inverts in double, for every direction and every normal. Only here do
 * cells at the cut and beside it stand, and no threshold is asked. The fast tier draws in float (draw.h) and evaluates
 * in lanes of doubles (density.h); it leaves every special case to this one. Both tiers look up a place by location.h
 * and mix rows by density_wedge.h; searches stay in float.
 *
 *     exact_azimuth.c  the azimuth: its density, draw and inverse
 *     exact_radius.c   the same for the slope length at one azimuth
 *     exact.c          both together: what theory.h declares */
#ifndef VNDF_SAMPLER_TABULATED_EXACT_H
#define VNDF_SAMPLER_TABULATED_EXACT_H

#include <math.h>

#include "simd/count.h"
#include "sampler/stretch.h"
#include "sampler/tabulated/density_wedge.h"
#include "sampler/tabulated/theory.h"

/* ---- azimuths of one direction ---- */

/* Rows of cells and their shares. */
typedef struct vndf_exact_row {
    const vndf_row_cell *cell[3]; /* of each row */
    const float *q;
    double share[3], p, r;
    uint32_t cells;
} vndf_exact_row;

/* What all azimuths of the stretched direction (s, 0, c) have in common. */
struct vndf_azimuth_fan {
    const vndf_distribution *table;
    double s, c;
    double mass, per;   /* of the wedge above the horizon, 1 below it; per mass of a whole turn */
    vndf_exact_row row; /* of the wedge, if it was asked for */
};
vndf_azimuth_fan vndf_azimuth_fan_of(const vndf_distribution *d, double s, double c, int wedge);

/* ---- rational cells (math/rational_cell.h), for one or for lanes (batch/below.h) ---- */

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

/* ---- the search below the horizon, for k = 1 ---- */

/* How many of n knots, a multiple of eight, have more than `target` beyond them. */
VNDF_INLINE uint32_t vndf_count_beyond(const vndf_knots *knots, uint32_t from, uint32_t n, float c, float target)
{
    return vndf_count_more(&knots->at[from].x, &knots->tail[from].s, n, c, target);
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

#if VNDF_LANES == 1

/* ---- densities and masses of cells ---- */

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

/* ---- parts of a mass ---- */

/* The part of a mass before a place, and how fast it grows there. */
typedef struct vndf_exact_part {
    double part, rate;
} vndf_exact_part;

/* ---- azimuth ---- */

/* Cosine and sine >= 0 of |a|, both times n, and whether rows drew it. */
typedef struct vndf_exact_azimuth {
    double cosine, sine, n;
    int in_wedge;
} vndf_exact_azimuth;

/* Mass per radian, 1 in a whole turn. */
double vndf_azimuth_fan_density(const vndf_azimuth_fan *fan, double cosine, double sine);

/* The azimuth |a| with the part `half` of half a turn's mass between the side of wi and it. In a wedge *near gets the
 * shares of rows and the cell. */
vndf_exact_azimuth vndf_exact_azimuth_draw(const vndf_view *view, const vndf_stretched *w, float half,
                                           vndf_wedge_near *near);

/* The part of half a turn's mass before an azimuth, and its rate per radian. */
vndf_exact_part vndf_exact_azimuth_part(const vndf_view *view, const vndf_stretched *w, double cosine,
                                        double sine);

/* ---- radius ---- */

/* Finds the cut, its part and the mass of a law with the weights c and k. */
void vndf_exact_law_find(vndf_azimuth_slice *law);

/* A normal (X, Z) of any length. */
typedef struct vndf_exact_slope {
    double x, z;
} vndf_exact_slope;

/* The slope with the part u of the mass before it, and its cell; the horizon where nothing is visible. */
vndf_exact_slope vndf_exact_law_draw(const vndf_azimuth_slice *law, double u, uint32_t *cell);

/* The part before a slope, and its rate per radian between the normal and z: 0 at the cut and beside it. */
vndf_exact_part vndf_exact_law_part(const vndf_azimuth_slice *law, vndf_exact_slope slope);

#endif
#endif
