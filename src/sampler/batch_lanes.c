/* See batch_lanes.h. Lanes past the end of a block repeat what the block held before and are not written. */
#include "sampler/batch_lanes.h"

#if VNDF_HAS_LANES && VNDF_LANES > 1

#include "sampler/batch_sort.h"
#include "sampler/ggx_draw.h"

/* The search for the cells of radii: weights and targets; codes of windows, which become cells. */
typedef struct radial_search {
    float c[VNDF_BLOCK_SAMPLES], k[VNDF_BLOCK_SAMPLES], target[VNDF_BLOCK_SAMPLES];
    uint32_t cell[VNDF_BLOCK_SAMPLES];
} radial_search;

/* A block as it is worked on. Each step goes over all groups of lanes before the next begins: a group's steps wait
 * for each other, groups do not. */
typedef struct fronts {
    vndf_bearing bearing[VNDF_BLOCK_GROUPS];
    vndf_place place[VNDF_BLOCK_GROUPS];
    lanes_m plain[VNDF_BLOCK_GROUPS];
    radial_search radii;
} fronts;

/* The search for the cells of azimuths; `at` is where a cell is among those of all rows. */
typedef struct row_search {
    float first[VNDF_BLOCK_SAMPLES], middle[VNDF_BLOCK_SAMPLES], last[VNDF_BLOCK_SAMPLES];
    float part[VNDF_BLOCK_SAMPLES];
    uint32_t row[VNDF_BLOCK_SAMPLES], cell[VNDF_BLOCK_SAMPLES], at[VNDF_BLOCK_SAMPLES];
} row_search;

typedef struct wedges {
    uint32_t span[VNDF_BLOCK_SAMPLES], cut[VNDF_BLOCK_SAMPLES];
    vndf_azimuth_row row[VNDF_BLOCK_GROUPS];
    row_search azimuths;
    vndf_bearing bearing[VNDF_BLOCK_GROUPS];
    vndf_radial_law law[VNDF_BLOCK_GROUPS];
    vndf_place place[VNDF_BLOCK_GROUPS];
    lanes_m plain[VNDF_BLOCK_GROUPS];
    radial_search radii;
} wedges;

/* ---- cells of radii ---- */

/* Of samples from `i` on. Wide windows, which are few, are narrowed at once. */
VNDF_INLINE void ask_radii(const vndf_distribution *d, radial_search *s, uint32_t i, const vndf_bearing *b,
                           lanes_f u2)
{
    lanes_u narrow = lanes_set_u((1u << VNDF_WINDOW_SHIFT) - 1);
    uint32_t wide = lanes_mask_bits(lanes_without(lanes_all(), lanes_at_most_u(b->code, narrow)));
    lanes_store(s->c + i, b->c);
    lanes_store(s->k + i, b->k);
    lanes_store(s->target + i, u2 * b->total);
    lanes_store_u(s->cell + i, b->code);
    for (; wide != 0; wide &= wide - 1) {
        uint32_t at = i + (uint32_t)__builtin_ctz(wide);
        vndf_window window = vndf_window_from(s->cell[at]);
        s->cell[at] = vndf_radial_narrow(&d->knots, window, s->c[at], s->k[at], s->target[at]);
    }
}

/* Of all, one after the other, when the last has been asked: what is stored by vectors and loaded by numbers, or
 * the other way round, is waited for. `whole` for c, k >= 0. */
VNDF_INLINE void find_radii(const vndf_distribution *d, radial_search *s, uint32_t count, int whole)
{
    const vndf_knots knots = d->knots;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t first = s->cell[i];
        s->cell[i] = first + (whole ? vndf_radial_count_whole(&knots, first + 1, s->c[i], s->k[i], s->target[i])
                                    : vndf_radial_count_above(&knots, first + 1, s->c[i], s->k[i], s->target[i]));
    }
}

VNDF_INLINE void limit_cells(uint32_t *cell, lanes_u most)
{
    lanes_store_u(cell, lanes_limit_u(lanes_load_u(cell), most));
}

/* Cells that have long been found. */
VNDF_INLINE vndf_radial_lanes load_cells(const vndf_distribution *d, const uint32_t *cell)
{
    lanes_lines lines = lanes_lines_from(&d->cells->f0, sizeof *d->cells / sizeof(float), cell);
    return vndf_radial_load_lines(&lines);
}

/* ---- in front of wi ---- */

VNDF_INLINE void draw_fronts(const vndf_distribution *d, const vndf_sorted *from, uint32_t end, fronts *w,
                             vndf_results *to)
{
    for (uint32_t i = 0, g = 0; i < end; i += VNDF_LANES, g++) {
        vndf_incidence at = vndf_sorted_incidence(from, i);
        vndf_sector sector = vndf_sorted_sector(from, i);
        w->bearing[g] = vndf_bear_front(d, &at, &sector, lanes_load(from->u2 + i));
        ask_radii(d, &w->radii, i, &w->bearing[g], lanes_load(from->u2 + i));
    }
    find_radii(d, &w->radii, end, 1);
    for (uint32_t i = 0; i < end; i += VNDF_LANES)
        limit_cells(w->radii.cell + i, lanes_set_u(d->radial_count - 1));
    for (uint32_t i = 0, g = 0; i < end; i += VNDF_LANES, g++) {
        vndf_incidence at = vndf_sorted_incidence(from, i);
        vndf_radial_lanes cell = load_cells(d, w->radii.cell + i);
        w->plain[g] = lanes_all();
        w->place[g] = vndf_place_front(d, &at, &w->bearing[g], &cell, lanes_load_u(w->radii.cell + i),
                                       lanes_load(from->u2 + i), &w->plain[g]);
    }
    for (uint32_t i = 0, g = 0; i < end; i += VNDF_LANES, g++) {
        vndf_drawn n = vndf_drawn_at(&w->bearing[g].level, &w->place[g], &w->plain[g]);
        vndf_results_keep(to, i, &n, w->plain[g]);
    }
}

/* ---- in the wedge ---- */

/* Rows of directions, and their cells where the azimuths are. */
VNDF_INLINE void ask_azimuths(const vndf_distribution *d, const vndf_sorted *from, uint32_t first, uint32_t count,
                              wedges *w)
{
    row_search *s = &w->azimuths;
    for (uint32_t i = 0; i < count; i += VNDF_LANES)
        lanes_store_u(w->span + i, vndf_wedge_span(&d->above, vndf_sorted_incidence(from, first + i).c));
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        lanes_lines lines = lanes_lines_from(&d->above.row_span->begin, VNDF_ROW_SPAN_FLOATS, w->span + i);
        vndf_sector sector = vndf_sorted_sector(from, first + i);
        w->row[g] = vndf_wedge_row_from(&d->above, vndf_sorted_incidence(from, first + i).c,
                                        lanes_load_u(w->span + i), &lines);
        lanes_store(s->first + i, w->row[g].first);
        lanes_store(s->middle + i, w->row[g].middle);
        lanes_store(s->last + i, w->row[g].last);
        lanes_store(s->part + i, vndf_wedge_part(lanes_abs(sector.apart), sector.mass));
        lanes_store_u(s->row + i, w->row[g].row);
    }
    for (uint32_t i = 0; i < count; i++) {
        s->cell[i] = vndf_azimuth_find(&d->above, s->row[i], s->first[i], s->middle[i], s->last[i], s->part[i]);
        s->at[i] = s->row[i] * d->above.stride + s->cell[i];
    }
}

/* Azimuths, and where their laws of the radius are cut. */
VNDF_INLINE void draw_azimuths(const vndf_distribution *d, const vndf_sorted *from, uint32_t first, uint32_t count,
                               wedges *w)
{
    const row_search *s = &w->azimuths;
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        lanes_lines lines = lanes_lines_from(&d->above.row_cell->before, 4, s->at + i);
        vndf_azimuth_cell cell = vndf_azimuth_cell_from(&w->row[g], lanes_load_u(s->cell + i), &lines);
        w->plain[g] = vndf_wedge_is_plain(&w->row[g]);
        vndf_azimuth a = vndf_azimuth_draw(&w->row[g], &cell, lanes_load(s->part + i), &w->plain[g]);
        vndf_incidence at = vndf_sorted_incidence(from, first + i);
        vndf_sector sector = vndf_sorted_sector(from, first + i);
        w->bearing[g] = vndf_bear_wedge(d, &at, &sector, &a, lanes_load(from->u2 + first + i));
    }
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++)
        lanes_store_u(w->cut + i, vndf_radial_cut(d, w->bearing[g].c, w->bearing[g].k));
}

VNDF_INLINE void draw_radii(const vndf_distribution *d, const vndf_sorted *from, uint32_t first, uint32_t count,
                            wedges *w)
{
    const float *u2 = from->u2 + first;
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        vndf_bearing *b = &w->bearing[g];
        vndf_radial_lanes cell = load_cells(d, w->cut + i);
        w->law[g] = vndf_radial_law_cut(d, b->c, b->k, lanes_load_u(w->cut + i), &cell, &b->total);
        ask_radii(d, &w->radii, i, b, lanes_load(u2 + i));
    }
    find_radii(d, &w->radii, count, 0);
    for (uint32_t i = 0; i < count; i += VNDF_LANES)
        limit_cells(w->radii.cell + i, lanes_load_u(w->cut + i));
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        vndf_incidence at = vndf_sorted_incidence(from, first + i);
        vndf_radial_lanes cell = load_cells(d, w->radii.cell + i);
        w->place[g] = vndf_place_wedge(&at, &w->bearing[g], &w->law[g], &cell, lanes_load_u(w->radii.cell + i),
                                       lanes_load(u2 + i), &w->plain[g]);
    }
}

/* Samples from `first` on, `count` of them. */
VNDF_INLINE void draw_wedges(const vndf_distribution *d, const vndf_sorted *from, uint32_t first, uint32_t count,
                             wedges *w, vndf_results *to)
{
    ask_azimuths(d, from, first, count, w);
    draw_azimuths(d, from, first, count, w);
    draw_radii(d, from, first, count, w);
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        vndf_drawn n = vndf_drawn_at(&w->bearing[g].level, &w->place[g], &w->plain[g]);
        vndf_results_keep(to, first + i, &n, w->plain[g]);
    }
}

/* ---- GGX ---- */

VNDF_INLINE vndf_incidence incidence_of_ggx(const vndf_sample_block *b, uint32_t i)
{
    lanes_f ax = lanes_load(b->alpha_x + i), ay = lanes_load(b->alpha_y + i);
    lanes_m ready = lanes_all();
    vndf_aim aim = vndf_aim_unit(ax * lanes_load(b->wi_x + i), ay * lanes_load(b->wi_y + i),
                                 lanes_load(b->wi_z + i), &ready);
    vndf_incidence w = vndf_incidence_from(ax, ay, &aim);
    w.plain = lanes_both(w.plain, ready);
    return w;
}

VNDF_INLINE void draw_ggx(vndf_sample_block *b)
{
    vndf_incidence shared;
    if (b->view)
        shared = vndf_incidence_of(b->view);
    for (uint32_t i = 0; i < b->count; i += VNDF_LANES) {
        vndf_incidence w = b->view ? shared : incidence_of_ggx(b, i);
        lanes_m plain = lanes_all();
        vndf_drawn n = vndf_ggx_draw(&w, vndf_block_u(b->u1 + i), vndf_block_u(b->u2 + i), &plain);
        vndf_block_store(b, i, &n);
        vndf_block_leave(b, lanes_without(lanes_all(), w.plain), lanes_without(w.plain, plain), i);
    }
}

/* ---- tables ---- */

VNDF_INLINE uint32_t whole_groups(uint32_t count)
{
    return (count + VNDF_LANES - 1) / VNDF_LANES * VNDF_LANES;
}

/* The last group in front may end among the wedges, and the first of those begin among the fronts: each kind has
 * results of its own. */
static void draw_table(const vndf_distribution *d, vndf_sample_block *b)
{
    vndf_sorted sorted;
    vndf_origin from[VNDF_BLOCK_GROUPS];
    vndf_results front, wedge;
    fronts in_front;
    wedges in_wedge;
    uint32_t end = whole_groups(b->count), border = vndf_sort_block(d, b, &sorted, from);
    uint32_t count = whole_groups(end - border);
    draw_fronts(d, &sorted, whole_groups(border), &in_front, &front);
    draw_wedges(d, &sorted, end - count, count, &in_wedge, &wedge);
    vndf_unsort_block(b, from, &front, &wedge);
}

#if VNDF_LANES == 16
void vndf_sample_block_avx512(const vndf_distribution *d, vndf_sample_block *b)
#else
void vndf_sample_block_avx2(const vndf_distribution *d, vndf_sample_block *b)
#endif
{
    b->left_count = 0;
    if (d->kind == VNDF_KIND_GGX)
        draw_ggx(b);
    else
        draw_table(d, b);
}

#endif
