/* Lanes search their cells side by side where registers hold what they search through: rows of azimuths in most tables,
 * radial cells in small ones. Else they search one sample after the other, each in eight knots at once, after all
 * samples of a block are stored: to read singly what a vector has just stored, or the other way round, takes a wait.
 * Searches have loops of their own, since a processor that waits for one group takes up the next only if a loop is
 * short. */
#ifndef VNDF_SAMPLER_BATCH_SEARCH_H
#define VNDF_SAMPLER_BATCH_SEARCH_H

#include "sampler/batch/sort.h"

/* ---- cells of radii ---- */

/* Weights and targets of samples. `cell` holds the codes of windows first, then the cells. */
typedef struct vndf_radial_search {
    float c[VNDF_BLOCK_SAMPLES], k[VNDF_BLOCK_SAMPLES], target[VNDF_BLOCK_SAMPLES];
    uint32_t cell[VNDF_BLOCK_SAMPLES];
} vndf_radial_search;

/* Stores the search of the group from sample `i` on. */
VNDF_INLINE void vndf_ask_radii(vndf_radial_search *s, uint32_t i, const vndf_azimuth_sample *b, lanes_f u2)
{
    lanes_store(s->c + i, b->c);
    lanes_store(s->k + i, b->k);
    lanes_store(s->target + i, u2 * b->total);
}

/* Looks up the first cells of windows. Wide windows are few; they are listed and narrowed last, so that no branch on
 * them is mispredicted. */
VNDF_INLINE void vndf_open_windows(const vndf_distribution *d, vndf_radial_search *s, const float *u2,
                                   uint32_t count)
{
    lanes_u narrow = lanes_set_u((1u << VNDF_WINDOW_SHIFT) - 1);
    uint32_t list[VNDF_BLOCK_SAMPLES + VNDF_LANES], wide = 0;
    for (uint32_t i = 0; i < count; i += VNDF_LANES) {
        lanes_u code = vndf_window_of(d, lanes_load(s->c + i), lanes_load(s->k + i), lanes_load(u2 + i));
        lanes_store_u(s->cell + i, code);
        wide = lanes_append(list, wide, lanes_without(lanes_all(), lanes_at_most_u(code, narrow)), i);
    }
    for (uint32_t n = 0; n < wide; n++) {
        uint32_t i = list[n];
        vndf_window window = vndf_window_from(s->cell[i]);
        s->cell[i] = vndf_radial_narrow(&d->knots, window, s->c[i], s->k[i], s->target[i]);
    }
}

/* Turns the searches of `count` samples into cells. `whole` says that c, k >= 0. */
VNDF_INLINE void vndf_find_radii(const vndf_distribution *d, vndf_radial_search *s, const float *u2,
                                 uint32_t count, int whole)
{
    const vndf_knots knots = d->knots;
    vndf_open_windows(d, s, u2, count);
#pragma GCC unroll 4
    for (uint32_t i = 0; i < count; i++) {
        uint32_t first = s->cell[i];
        s->cell[i] = first + (whole ? vndf_radial_count_whole(&knots, first + 1, s->c[i], s->k[i], s->target[i])
                                    : vndf_radial_count_above(&knots, first + 1, s->c[i], s->k[i], s->target[i]));
    }
}

/* The last knots with sums of no more than `target` before them, c, k >= 0: among every eighth knot, then among the
 * seven behind that. Sums ascend, so a window finds the same. */
VNDF_INLINE lanes_u vndf_find_in_few_cells(const vndf_distribution *d, lanes_f c, lanes_f k, lanes_f target)
{
    const uint32_t steps = vndf_step_count(d);
    const float *f0 = d->few_sums, *f1 = f0 + (VNDF_STEP - 1) * steps;
    lanes_u step = lanes_set_u(0);
    for (uint32_t n = VNDF_STEP; n < d->radial_count; n += VNDF_STEP)
        step = lanes_count(step, lanes_at_most(c * d->knots.f0[n] + k * d->knots.f1[n], target));
    lanes_u cell = step * VNDF_STEP;
    for (uint32_t t = 1; t < VNDF_STEP; t++, f0 += steps, f1 += steps) {
        lanes_f sum = c * lanes_few(f0, VNDF_LANES, step) + k * lanes_few(f1, VNDF_LANES, step);
        cell = lanes_count(cell, lanes_at_most(sum, target));
    }
    return cell;
}

/* The same for c, k >= 0: in registers, if each number of every eighth knot fits one. */
VNDF_INLINE void vndf_find_radii_in_front(const vndf_distribution *d, vndf_radial_search *s, const float *u2,
                                          uint32_t count)
{
    if (vndf_step_count(d) > VNDF_LANES) {
        vndf_find_radii(d, s, u2, count, 1);
        return;
    }
    for (uint32_t i = 0; i < count; i += VNDF_LANES)
        lanes_store_u(s->cell + i, vndf_find_in_few_cells(d, lanes_load(s->c + i), lanes_load(s->k + i),
                                                          lanes_load(s->target + i)));
}

VNDF_INLINE void vndf_limit_cells(uint32_t *cell, lanes_u most)
{
    lanes_store_u(cell, lanes_limit_u(lanes_load_u(cell), most));
}

/* Loads cells that were found long before. */
VNDF_INLINE vndf_radial_lanes vndf_load_cells(const vndf_distribution *d, const uint32_t *cell)
{
    return vndf_radial_load_from(d, cell);
}

/* ---- cells of azimuths ---- */

/* The row of a view that all samples share, with so few cells that registers hold them. */
typedef struct vndf_mixed_row {
    float before[VNDF_FEW], mass[VNDF_FEW], e0[VNDF_FEW], e1[VNDF_FEW], q[VNDF_FEW], width[VNDF_FEW];
    uint32_t count;
} vndf_mixed_row;

/* For each sample the span of its row, the row with its weights, the part before the azimuth, the cell, the mass before
 * it, and its index among the cells of all rows. */
typedef struct vndf_row_search {
    uint32_t span[VNDF_BLOCK_SAMPLES], row[VNDF_BLOCK_SAMPLES], cell[VNDF_BLOCK_SAMPLES], at[VNDF_BLOCK_SAMPLES];
    float first[VNDF_BLOCK_SAMPLES], middle[VNDF_BLOCK_SAMPLES], last[VNDF_BLOCK_SAMPLES];
    float part[VNDF_BLOCK_SAMPLES], before[VNDF_BLOCK_SAMPLES];
    vndf_azimuth_row rows[VNDF_BLOCK_GROUPS];
    vndf_mixed_row mixed;
} vndf_row_search;

/* Whether all samples share one row of few cells. */
VNDF_INLINE int vndf_has_one_row(const vndf_distribution *d, const vndf_sorted *from)
{
    return from->is_shared && d->above.stride <= VNDF_FEW;
}

VNDF_INLINE float vndf_first_lane(lanes_f x)
{
    float all[VNDF_LANES];
    lanes_store(all, x);
    return all[0];
}

/* Mixes all cells of a row as vndf_azimuth_mix mixes one. */
VNDF_INLINE void vndf_mix_row(const vndf_azimuth_row *row, vndf_mixed_row *to)
{
    const vndf_wedge *wedge = row->wedge;
    const float u = vndf_first_lane(row->first), v = vndf_first_lane(row->middle), t = vndf_first_lane(row->last);
    uint32_t first[VNDF_LANES];
    lanes_store_u(first, row->row);
    const vndf_row_cell *a = vndf_row_cells(wedge, first[0]), *b = vndf_row_cells(wedge, first[0] + 1);
    const vndf_row_cell *c = vndf_row_cells(wedge, first[0] + 2);
    const float *before = wedge->cdf + (size_t)first[0] * wedge->stride;
    to->count = wedge->cell_count;
    for (uint32_t j = 0; j < wedge->cell_count; j++) {
        float h = wedge->q[j + 1] - wedge->q[j];
        to->before[j] = u * before[j] + v * before[wedge->stride + j] + t * before[2 * wedge->stride + j];
        to->mass[j] = u * a[j].mass + v * b[j].mass + t * c[j].mass;
        to->e0[j] = (u * a[j].density + v * b[j].density + t * c[j].density) * h;
        to->e1[j] = (u * a[j + 1].density + v * b[j + 1].density + t * c[j + 1].density) * h;
        to->q[j] = wedge->q[j];
        to->width[j] = h;
    }
}

VNDF_INLINE vndf_azimuth_cell vndf_mixed_cell_of(const vndf_mixed_row *m, lanes_u j)
{
    uint32_t n = m->count;
    vndf_azimuth_cell cell = {{lanes_few(m->e0, n, j), lanes_few(m->e1, n, j), lanes_few(m->mass, n, j)},
                              lanes_few(m->before, n, j),
                              lanes_few(m->q, n, j),
                              lanes_few(m->width, n, j)};
    return cell;
}

/* The cells of the azimuths of samples from `first` on, in the one row that all share. */
VNDF_INLINE void vndf_find_in_one_row(const vndf_distribution *d, const vndf_sorted *from, uint32_t first,
                                      uint32_t count, vndf_row_search *s)
{
    const vndf_azimuth_row row = vndf_wedge_row(&d->above, from->shared.c);
    vndf_mix_row(&row, &s->mixed);
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        vndf_azimuth_range range = vndf_sorted_range(from, first + i);
        lanes_f part = vndf_wedge_part(lanes_abs(range.apart), range.mass);
        lanes_store(s->part + i, part);
        lanes_store_u(s->cell + i, vndf_guide_count(s->mixed.before, s->mixed.count + 1, part));
        s->rows[g] = row;
    }
}

/* The same, each sample in the row of its direction, where rows are so few that registers hold them. */
VNDF_INLINE void vndf_find_in_few_rows(const vndf_distribution *d, const vndf_sorted *from, uint32_t first,
                                       uint32_t count, vndf_row_search *s)
{
    const vndf_wedge *wedge = &d->above;
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        vndf_azimuth_range range = vndf_sorted_range(from, first + i);
        lanes_f y = vndf_sorted_incidence(from, first + i).c, before;
        lanes_f part = vndf_wedge_part(lanes_abs(range.apart), range.mass);
        lanes_u span = vndf_wedge_span(wedge, y);
        s->rows[g] = vndf_wedge_row_few(wedge, y, span);
        lanes_u cell = vndf_azimuth_find_few(&s->rows[g], span, part, &before);
        lanes_store(s->part + i, part);
        lanes_store(s->before + i, before);
        lanes_store_u(s->cell + i, cell);
        lanes_store_u(s->at + i, s->rows[g].row * (wedge->cell_count + 1) + cell);
    }
}

/* The same whatever the number of rows, one sample after the other. */
VNDF_INLINE void vndf_find_in_rows(const vndf_distribution *d, const vndf_sorted *from, uint32_t first,
                                   uint32_t count, vndf_row_search *s)
{
    const vndf_wedge *wedge = &d->above;
    const float *span = &wedge->row_span->begin;
    const lanes_source source[2] = {{span, VNDF_ROW_SPAN_FLOATS}, {span + 4, VNDF_ROW_SPAN_FLOATS}};
    for (uint32_t i = 0; i < count; i += VNDF_LANES)
        lanes_store_u(s->span + i, vndf_wedge_span(wedge, vndf_sorted_incidence(from, first + i).c));
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        lanes_four row_span[2];
        lanes_load_fours(row_span, source, 2, s->span + i);
        vndf_azimuth_range range = vndf_sorted_range(from, first + i);
        s->rows[g] = vndf_wedge_row_from(wedge, vndf_sorted_incidence(from, first + i).c,
                                         lanes_load_u(s->span + i), row_span);
        lanes_store(s->first + i, s->rows[g].first);
        lanes_store(s->middle + i, s->rows[g].middle);
        lanes_store(s->last + i, s->rows[g].last);
        lanes_store(s->part + i, vndf_wedge_part(lanes_abs(range.apart), range.mass));
        lanes_store_u(s->row + i, s->rows[g].row);
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t j = vndf_azimuth_find(wedge, s->row[i], s->first[i], s->middle[i], s->last[i], s->part[i]);
        const float *cdf = wedge->cdf + (size_t)s->row[i] * wedge->stride + j;
        s->before[i] =
            s->first[i] * cdf[0] + s->middle[i] * cdf[wedge->stride] + s->last[i] * cdf[2 * wedge->stride];
        s->cell[i] = j;
        s->at[i] = s->row[i] * (wedge->cell_count + 1) + j;
    }
}

/* The cells of the azimuths of samples from `first` on. */
VNDF_INLINE void vndf_find_azimuths(const vndf_distribution *d, const vndf_sorted *from, uint32_t first,
                                    uint32_t count, vndf_row_search *s)
{
    if (vndf_has_one_row(d, from))
        vndf_find_in_one_row(d, from, first, count, s);
    else if (d->above.few_cdf)
        vndf_find_in_few_rows(d, from, first, count, s);
    else
        vndf_find_in_rows(d, from, first, count, s);
}

/* The cells of the group from sample `i` on. */
VNDF_INLINE vndf_azimuth_cell vndf_azimuth_cell_of(const vndf_distribution *d, const vndf_sorted *from, uint32_t i,
                                                   const vndf_row_search *s)
{
    lanes_u cell = lanes_load_u(s->cell + i);
    if (vndf_has_one_row(d, from))
        return vndf_mixed_cell_of(&s->mixed, cell);
    return vndf_azimuth_cell_on(&s->rows[i / VNDF_LANES], cell, lanes_load(s->before + i), s->at + i);
}

#endif
