/* Stage 1 of the engine, in the wedge: an azimuth phi in [0, pi/2] from a mix of three rows of cells.
 *
 * The rows' variable is q in [0, 1], a half-angle tangent with an aspect (p, r) that follows the width of
 * the density:  (cos phi, sin phi) = (p (1 - q^2), r 2 q) / N,  N^2 = p^2 (1 - q^2)^2 + 4 r^2 q^2,
 *               dphi/dq = 2 p r (1 + q^2) / N^2.
 * With p = r, q is the half-angle tangent itself. */
#ifndef VNDF_SAMPLER_TABULATED_AZIMUTH_H
#define VNDF_SAMPLER_TABULATED_AZIMUTH_H

#include <stdint.h>

#include "simd/count.h"
#include "simd/lanes_lines.h"
#include "math/rational_cell.h"
#include "sampler/trust.h"
#include "table/table.h"

/* The mass of a row that draws, a square: powers of a cell's mass must not underflow (math/rational_cell.h). */
#define VNDF_ROW_MASS 64.0f
#define VNDF_ROW_MASS_ROOT 8.0f

/* The weighted sum of three successive rows of a wedge, cell by cell. Its mass is VNDF_ROW_MASS, and so its weights and
 * its aspect are as many times as large. */
typedef struct vndf_azimuth_row {
    const vndf_wedge *wedge;
    lanes_u row;                       /* the first */
    lanes_f first, middle, last, p, r; /* weights; aspect */
} vndf_azimuth_row;

/* An azimuth as (c, s)/n, s >= 0, n^2 = c^2 + s^2, and the part of the row's mass per radian there. */
typedef struct vndf_azimuth {
    lanes_f c, s, n, density;
} vndf_azimuth;

/* A cell of the mix, the mass before it, its first q and its width in q. */
typedef struct vndf_azimuth_cell {
    vndf_rational_cell cell;
    lanes_f before, q, width;
} vndf_azimuth_cell;

/* The first end of cell j in q, or with `end` = 1 the second. */
VNDF_INLINE lanes_f vndf_azimuth_q(const vndf_wedge *wedge, uint32_t end, lanes_u j)
{
#if VNDF_LANES > 1
    if (wedge->stride <= VNDF_FEW) /* q is padded to that */
        return lanes_few(wedge->q + end, wedge->stride, j);
#endif
    return lanes_gather(wedge->q + end, j);
}

/* The same cell of three rows: mass before it, its mass, densities at its ends. */
typedef struct vndf_azimuth_parts {
    lanes_four a, b, c;
} vndf_azimuth_parts;

/* The mix of cell j of three rows. */
VNDF_INLINE vndf_azimuth_cell vndf_azimuth_mix(const vndf_azimuth_row *row, lanes_u j,
                                               const vndf_azimuth_parts *parts)
{
    const lanes_four a = parts->a, b = parts->b, c = parts->c;
    lanes_f u = row->first, v = row->middle, t = row->last, q = vndf_azimuth_q(row->wedge, 0, j);
    lanes_f h = vndf_azimuth_q(row->wedge, 1, j) - q;
    vndf_azimuth_cell cell = {
        {(u * a.c + v * b.c + t * c.c) * h, (u * a.d + v * b.d + t * c.d) * h, u * a.b + v * b.b + t * c.b},
        u * a.a + v * b.a + t * c.a,
        q,
        h};
    return cell;
}

/* Radians per xi at a place of a cell. */
VNDF_INLINE lanes_f vndf_azimuth_turned(const vndf_azimuth_row *row, const vndf_azimuth_cell *cell, lanes_f xi)
{
    lanes_f q = cell->q + xi * cell->width, q2 = q * q, c = row->p * (1.0f - q2), s = row->r * 2.0f * q;
    return 2.0f * row->p * row->r * (1.0f + q2) * cell->width / (c * c + s * s);
}

/* The azimuth at a place of a cell, its c and s times in->under^2. Clears *trusted where the density is steep. */
VNDF_INLINE vndf_azimuth vndf_azimuth_at(const vndf_azimuth_row *row, const vndf_azimuth_cell *cell,
                                         const vndf_rational_place *in, lanes_m *trusted)
{
    lanes_f under2 = in->under * in->under, q = cell->q * in->under + in->over * cell->width, q2 = q * q;
    lanes_f c = row->p * (under2 - q2), s = row->r * 2.0f * (q * in->under), n2 = c * c + s * s;
    lanes_f turn = 2.0f * row->p * row->r * (under2 + q2) * cell->width;
    vndf_azimuth at = {c, s, lanes_root(n2), in->root * n2 / (in->below * (VNDF_ROW_MASS * turn))};
    *trusted = lanes_both(*trusted, vndf_trusts_azimuth(vndf_change_at(&cell->cell, in), turn * under2, n2));
    *trusted = lanes_both(*trusted, vndf_trusts_azimuth_density(at.density));
    return at;
}

/* How many cells of one lane's row have no more than `target` before them. The count visits every cell, so that no
 * step waits for another. */
VNDF_INLINE uint32_t vndf_azimuth_count(const vndf_wedge *wedge, uint32_t row, float first, float middle,
                                        float last, float target)
{
    const float *a = wedge->cdf + (size_t)row * wedge->stride, *b = a + wedge->stride, *c = b + wedge->stride;
    return vndf_count_three(a, b, c, wedge->stride, first, middle, last, target);
}

/* The cell of one lane's row in which the mass `target` ends. */
VNDF_INLINE uint32_t vndf_azimuth_find(const vndf_wedge *wedge, uint32_t row, float first, float middle,
                                       float last, float target)
{
    uint32_t count = vndf_azimuth_count(wedge, row, first, middle, last, target);
    return count > 0 ? count - 1 : 0;
}

/* The azimuth in a cell with the mass `target` before it. */
VNDF_INLINE vndf_azimuth vndf_azimuth_draw(const vndf_azimuth_row *row, const vndf_azimuth_cell *cell,
                                           lanes_f target, lanes_m *trusted)
{
    vndf_rational_place in = vndf_rational_invert(&cell->cell, target - cell->before);
    return vndf_azimuth_at(row, cell, &in, trusted);
}

#if VNDF_LANES == 1

/* Cell j of a row. */
VNDF_INLINE lanes_four vndf_azimuth_part(const vndf_wedge *wedge, uint32_t row, uint32_t j)
{
    const vndf_row_cell *cell = vndf_row_cells(wedge, row) + j;
    lanes_four part = {wedge->cdf[(size_t)row * wedge->stride + j], cell[0].mass, cell[0].density,
                       cell[1].density};
    return part;
}

VNDF_INLINE vndf_azimuth_cell vndf_azimuth_cell_at(const vndf_azimuth_row *row, uint32_t j)
{
    const vndf_wedge *wedge = row->wedge;
    vndf_azimuth_parts parts = {vndf_azimuth_part(wedge, row->row, j), vndf_azimuth_part(wedge, row->row + 1, j),
                                vndf_azimuth_part(wedge, row->row + 2, j)};
    return vndf_azimuth_mix(row, j, &parts);
}

/* The azimuth of a row with the mass `target` before it. */
VNDF_INLINE vndf_azimuth vndf_azimuth_draw_one(const vndf_azimuth_row *row, float target, lanes_m *trusted)
{
    const vndf_wedge *wedge = row->wedge;
    uint32_t j = vndf_azimuth_find(wedge, row->row, row->first, row->middle, row->last, target);
    vndf_azimuth_cell cell = vndf_azimuth_cell_at(row, j);
    return vndf_azimuth_draw(row, &cell, target, trusted);
}

#else

/* The cell of each row in which the mass `target` ends, and the mass before it, for a row that begins with row 2 span.
 * Rows are so few that registers hold them. */
VNDF_INLINE lanes_u vndf_azimuth_find_few(const vndf_azimuth_row *row, lanes_u span, lanes_f target,
                                          lanes_f *before)
{
    const vndf_wedge *wedge = row->wedge;
    const uint32_t rows = wedge->row_count, knots = rows / 2 + 1;
    const float *cdf = wedge->few_cdf;
    lanes_u cell = lanes_set_u(0);
    *before = lanes_set(0.0f);
    for (uint32_t j = 1; j < wedge->cell_count; j++, cdf += rows) {
        lanes_f a = lanes_few(cdf, knots, span), b = lanes_few(cdf + knots, knots, span);
        lanes_f mixed = row->first * a + row->middle * b + row->last * lanes_few(cdf + 1, knots, span);
        lanes_m is_before = lanes_at_most(mixed, target);
        cell = lanes_count(cell, is_before);
        *before = lanes_pick(is_before, mixed, *before);
    }
    return cell;
}

/* Cells j with a mass before them; `at` is their index among the cells of all rows. */
VNDF_INLINE vndf_azimuth_cell vndf_azimuth_cell_on(const vndf_azimuth_row *row, lanes_u j, lanes_f before,
                                                   const uint32_t *at)
{
    const vndf_wedge *wedge = row->wedge;
    const float *first = &wedge->row_cell->mass;
    const size_t stride = 2 * ((size_t)wedge->cell_count + 1);
    const lanes_source source[3] = {{first, 2}, {first + stride, 2}, {first + 2 * stride, 2}};
    lanes_four from[3]; /* mass, density, and those of the next cell */
    lanes_load_fours(from, source, 3, at);
    vndf_azimuth_parts parts = {{before, from[0].a, from[0].b, from[0].d},
                                {before, from[1].a, from[1].b, from[1].d},
                                {before, from[2].a, from[2].b, from[2].d}};
    vndf_azimuth_cell cell = vndf_azimuth_mix(row, j, &parts);
    cell.before = before;
    return cell;
}

#endif

#endif
