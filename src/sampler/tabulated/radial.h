/* Stage 2 of the engine: the slope length R = X/Z for a given azimuth, density f(xi) (c Z + k X) dxi in each
 * cell of the radial table, where c Z + k X > 0. This file serves one and lanes: the laws of a direction above the
 * horizon, and cells away from the cut. exact_radius.c has all laws and all cells.
 *
 * The weight W = c Z + k X is linear in xi. The mass of a cell comes from its moments, W0 mu0 + W1 mu1, and sums of
 * masses from the side where nothing cancels. Most cells draw f W by a rational cell. The cell of the cut W = 0, all
 * cells beyond it and the two inside it draw by a weighted cell (math/weighted_cell.h), whose weight V is W. The
 * cell at the cut is used on its visible part alone; the cubic gives its mass and its value at the cut.
 *
 * Below the horizon all visible normals lie beyond the cut, so that no law jumps as the cut moves. Above it most
 * cells lie far inside the cut, where a constant V saves a root; the second cell inside leads from one form to the
 * other. Its V depends on the visible part h of the cell at the cut: at h = 0, where the cut leaves the first cell, V
 * is W; from h = 1/16 on it is constant. At the knot away from the cut V is W, and at the knot towards the cut it has
 * gone 16 h of the way from W there to that value. W and a constant follow a law f W equally well; a V between them
 * misses by 1e-3 of the cell's mass where W doubles in it. Above the horizon such a cell holds little. Below it would
 * hold up to three quarters of the visible mass, and raise the TV from 6e-5 to 4.5e-4 wherever the cut is about to pass
 * a knot. */
#ifndef VNDF_SAMPLER_TABULATED_RADIAL_H
#define VNDF_SAMPLER_TABULATED_RADIAL_H

#include "simd/count.h"
#include "simd/lanes_lines.h"
#include "math/rational_cell.h"
#include "sampler/trust.h"
#include "table/guide.h"
#include "table/table.h"
#include "table/window.h"

/* The law of R above the horizon: everything that does not depend on the uniform number. */
typedef struct vndf_radial_law {
    lanes_f c, k;    /* weights of Z and X */
    lanes_u cut;     /* the cell that holds the cut; radial_count if there is none */
    lanes_f part;    /* length of that cell's visible part in xi; without a cut 0 */
    lanes_m trusted; /* whether rounding the cut changes its mass little */
} vndf_radial_law;

/* A cell, lane by lane: the members of vndf_radial_cell, both knots, the bend, and the sums up to the first. */
typedef struct vndf_radial_lanes {
    lanes_f f0, f1, mu0, mu1, x0, x1, z0, z1, before0, before1, width, smooth, a, b, e, g;
} vndf_radial_lanes;

/* From the two fours of d's cells, and those of its knots, bends and sums. The compiler leaves out loads that nobody
 * reads. */
VNDF_INLINE vndf_radial_lanes vndf_radial_of_fours(const lanes_four from[5])
{
    const lanes_four ends = from[0], mass = from[1], knots = from[2], bend = from[3], sums = from[4];
    vndf_radial_lanes cell = {ends.c, ends.d, mass.a, mass.b, knots.a, knots.c, knots.b, knots.d,
                              mass.c, mass.d, ends.a, ends.b, bend.a,  bend.b,  sums.a,  sums.b};
    return cell;
}

enum { VNDF_CELL_FLOATS = sizeof(vndf_radial_cell) / sizeof(float) };

#if VNDF_LANES == 1

VNDF_INLINE vndf_radial_lanes vndf_radial_load(const vndf_distribution *d, lanes_u j)
{
    lanes_lines cells = lanes_lines_at(&d->cells->width, VNDF_CELL_FLOATS, j);
    lanes_lines at = lanes_lines_at(&d->knots.at->x, 2, j), bends = lanes_lines_at(&d->bends->a, 2, j);
    lanes_lines pole = lanes_lines_at(&d->knots.pole->e, 2, j);
    const lanes_four from[5] = {lanes_load_four(&cells, 0), lanes_load_four(&cells, 4), lanes_load_four(&at, 0),
                                lanes_load_four(&bends, 0), lanes_load_four(&pole, 0)};
    return vndf_radial_of_fours(from);
}

#else

/* The same for cells that were stored long before (lanes_load_fours). */
VNDF_INLINE vndf_radial_lanes vndf_radial_load_from(const vndf_distribution *d, const uint32_t *j)
{
    const lanes_source source[5] = {{&d->cells->width, VNDF_CELL_FLOATS},
                                    {&d->cells->mu0, VNDF_CELL_FLOATS},
                                    {&d->knots.at->x, 2},
                                    {&d->bends->a, 2},
                                    {&d->knots.pole->e, 2}};
    lanes_four from[5];
    lanes_load_fours(from, source, 5, j);
    return vndf_radial_of_fours(from);
}

VNDF_INLINE vndf_radial_lanes vndf_radial_load(const vndf_distribution *d, lanes_u j)
{
    uint32_t cell[VNDF_LANES];
    lanes_store_u(cell, j);
    return vndf_radial_load_from(d, cell);
}

#endif

/* integral_0^1 f(h t) (1 - t) dt for the cubic from f0 to f1 with the bump t (1-t) (a + b t), but at least a thousandth
 * of the integral of the straight line: a good cubic is far above that, and no cell becomes empty. */
VNDF_INLINE lanes_f vndf_radial_part(lanes_f f0, lanes_f f1, lanes_f a, lanes_f b, lanes_f h)
{
    const float sixth = 1.0f / 6.0f;
    lanes_f slope = f1 - f0;
    lanes_f cubic = 0.5f * f0 + h * (sixth * (slope + a) + h * (0.5f * sixth * (b - a) - h * (0.05f * b)));
    lanes_f least = 1e-3f * (0.5f * f0 + h * (sixth * slope));
    return lanes_pick(lanes_less(least, cubic), cubic, least);
}

/* Mass from the pole to the cell (c > 0). Rounding may bring a weight at the cut below 0. */
VNDF_INLINE lanes_f vndf_radial_before(const vndf_radial_law *law, const vndf_radial_lanes *cell)
{
    return law->c * cell->e + lanes_positive(law->c * cell->z0 + law->k * cell->x0) * cell->g;
}

/* The same where c, k >= 0. */
VNDF_INLINE lanes_f vndf_radial_before_whole(const vndf_radial_law *law, const vndf_radial_lanes *cell)
{
    return law->c * cell->before0 + law->k * cell->before1;
}

/* The law scaled from the mass `total` to the mass 1: no square of a mass vanishes where next to nothing is visible. */
VNDF_INLINE vndf_radial_law vndf_radial_scaled(vndf_radial_law law, lanes_f total, float lift)
{
    lanes_f scale = lanes_keep(lanes_less(lanes_set(1e-36f), total), lift / total);
    law.c *= scale;
    law.k *= scale;
    return law;
}

/* Mass of the law with weights c, k >= 0. */
VNDF_INLINE lanes_f vndf_radial_total(const vndf_distribution *d, lanes_f c, lanes_f k)
{
    return c * d->f0_total + k * d->f1_total;
}

/* The law for c, k >= 0. It is not scaled, which saves a division: in front of wi the mass is the density of the
 * azimuth, and drops out of the density of the normal. */
VNDF_INLINE vndf_radial_law vndf_radial_law_whole(const vndf_distribution *d, lanes_f c, lanes_f k)
{
    vndf_radial_law law = {c, k, lanes_set_u(d->radial_count), lanes_set(0.0f), lanes_all()};
    return law;
}

/* The cell of the cut for c > 0 > k. */
VNDF_INLINE lanes_u vndf_radial_cut(const vndf_distribution *d, lanes_f c, lanes_f k)
{
    return vndf_guide_lanes(&d->slope_guide, c / -k);
}

/* The law with its cut in cell j, which is *cell. It is not scaled yet; *total is its mass. */
VNDF_INLINE vndf_radial_law vndf_radial_law_cut(lanes_f c, lanes_f k, lanes_u j, const vndf_radial_lanes *cell,
                                                lanes_f *total)
{
    lanes_f zero = lanes_set(0.0f), one = lanes_set(1.0f);
    vndf_radial_law law = {c, k, j, one, lanes_all()};
    lanes_f w0 = lanes_positive(c * cell->z0 + k * cell->x0), w1 = c * cell->z1 + k * cell->x1;
    law.part = lanes_pick(lanes_less(w1, zero), w0 / (w0 - w1), one);
    lanes_f mass = w0 * law.part * vndf_radial_part(cell->f0, cell->f1, cell->a, cell->b, law.part);
    *total = vndf_radial_before(&law, cell) + mass;
    law.trusted =
        vndf_trusts_cut(-k * cell->x0 * cell->g, mass, cell->x1 * cell->z0, *total, cell->width * law.part);
    return law;
}

VNDF_INLINE vndf_radial_law vndf_radial_law_above(const vndf_distribution *d, lanes_f c, lanes_f k, lanes_f *total)
{
    lanes_u j = vndf_radial_cut(d, c, k);
    vndf_radial_lanes cell = vndf_radial_load(d, j);
    return vndf_radial_law_cut(c, k, j, &cell, total);
}

/* A cell away from the cut, where W > 0 without a guard. */
VNDF_INLINE vndf_rational_cell vndf_radial_cell_away(const vndf_radial_law *law, const vndf_radial_lanes *cell)
{
    lanes_f g0 = law->c * cell->z0 + law->k * cell->x0;
    lanes_f g1 = law->c * cell->z1 + law->k * cell->x1;
    vndf_rational_cell away = {cell->f0 * g0, cell->f1 * g1, g0 * cell->mu0 + g1 * cell->mu1};
    return away;
}

/* Whether cell j is away from the cut for c > 0 > k: the second cell inside is where h is above 1/16, and so is every
 * cell further inside. */
VNDF_INLINE lanes_m vndf_radial_is_away(const vndf_radial_law *law, lanes_u j)
{
    return lanes_at_most_u(lanes_count(j + 2u, lanes_less(law->part, lanes_set(0.0626f))), law->cut);
}

/* ---- search, one lane at a time ---- */

/* How many of the eight knots from `from` on have no more than `target` before them (c > 0 > k). */
VNDF_INLINE uint32_t vndf_radial_count_above(const vndf_knots *knots, uint32_t from, float c, float k,
                                             float target)
{
    return vndf_count_positive(&knots->at[from].x, &knots->pole[from].e, c, k, target);
}

/* The same for c, k >= 0. */
VNDF_INLINE uint32_t vndf_radial_count_whole(const vndf_knots *knots, uint32_t from, float c, float k,
                                             float target)
{
    return vndf_count_two(knots->f0 + from, knots->f1 + from, c, k, target);
}

/* Narrows a wide window to eight cells; looks at every step-th knot of it. */
VNDF_RARE uint32_t vndf_radial_narrow(const vndf_knots *knots, vndf_window w, float c, float k, float target)
{
    for (; w.step > 1; w.step /= VNDF_WINDOW) {
        uint32_t count = 0;
        for (uint32_t i = 1; i < VNDF_WINDOW; i++) {
            uint32_t at = w.first + i * w.step, j = at < knots->count ? at : knots->count - 1;
            float weight = c * knots->at[j].z + k * knots->at[j].x;
            count += (k < 0.0f ? c * knots->pole[j].e + (weight > 0.0f ? weight : 0.0f) * knots->pole[j].g
                               : c * knots->f0[j] + k * knots->f1[j]) <= target;
        }
        w.first += count * w.step;
    }
    const uint32_t most = knots->count - VNDF_WINDOW - 1; /* unused lanes may have sums that do not ascend */
    return w.first < most ? w.first : most;
}

/* The cell in which the mass `target` ends, from the code of its window. `whole` says c, k >= 0; else c > 0 > k. */
VNDF_INLINE uint32_t vndf_radial_find_one(const vndf_distribution *d, uint32_t code, float c, float k,
                                          float target, int whole)
{
    vndf_window w = vndf_window_from(code);
    if (w.step > 1)
        w.first = vndf_radial_narrow(&d->knots, w, c, k, target);
    return w.first + (whole ? vndf_radial_count_whole(&d->knots, w.first + 1, c, k, target)
                            : vndf_radial_count_above(&d->knots, w.first + 1, c, k, target));
}

/* ---- whether the density at a place is the density of its rounded normal ---- */

VNDF_INLINE lanes_m vndf_radial_is_trusted(const vndf_radial_lanes *at, const vndf_rational_cell *cell,
                                           const vndf_rational_place *in)
{
    return vndf_trusts_radius(vndf_change_at(cell, in), at->width, at->x1 * at->z0);
}

#endif
