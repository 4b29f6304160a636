/* Draws blocks of samples of a table in lanes (lanes_sample.h). Lanes past the end of a block draw like the others, and
 * nobody reads their results. */
#ifndef VNDF_SAMPLER_BATCH_TABULATED_H
#define VNDF_SAMPLER_BATCH_TABULATED_H

#include "sampler/batch/search.h"

/* Intermediate results of a block; weights where the block asks for them. Each step goes over all groups of lanes
 * before the next step begins: the steps of one group wait for each other, groups do not. */
typedef struct fronts {
    lanes_f about[VNDF_BLOCK_GROUPS];
    vndf_azimuth_sample bearing[VNDF_BLOCK_GROUPS];
    vndf_place place[VNDF_BLOCK_GROUPS];
    lanes_m trusted[VNDF_BLOCK_GROUPS];
    lanes_f weight[VNDF_BLOCK_GROUPS];
    vndf_radial_search radii;
} fronts;

typedef struct wedges {
    vndf_row_search azimuths;
    uint32_t cut[VNDF_BLOCK_SAMPLES];
    vndf_azimuth_sample bearing[VNDF_BLOCK_GROUPS];
    vndf_radial_law law[VNDF_BLOCK_GROUPS];
    vndf_place place[VNDF_BLOCK_GROUPS];
    lanes_m trusted[VNDF_BLOCK_GROUPS];
    lanes_f weight[VNDF_BLOCK_GROUPS];
    vndf_radial_search radii;
} wedges;

/* ---- in front of wi ---- */

VNDF_INLINE void draw_fronts(const vndf_distribution *d, const vndf_sorted *from, uint32_t end, int weighted,
                             fronts *w, vndf_results *to)
{
    for (uint32_t i = 0, g = 0; i < end; i += VNDF_LANES, g++) {
        vndf_incidence at = vndf_sorted_incidence(from, i);
        vndf_azimuth_range range = vndf_sorted_range(from, i);
        w->about[g] = vndf_azimuth_about(d, &at, &range);
    }
    for (uint32_t i = 0, g = 0; i < end; i += VNDF_LANES, g++) {
        vndf_incidence at = vndf_sorted_incidence(from, i);
        vndf_azimuth_range range = vndf_sorted_range(from, i);
        lanes_f u2 = lanes_load(from->u2 + i);
        vndf_azimuth_sample b = vndf_azimuth_sample_from(d, &at, &range, w->about[g], u2);
        b.code = lanes_set_u(0); /* nobody looks a window up here (vndf_find_radii) */
        w->bearing[g] = b;
        vndf_ask_radii(&w->radii, i, &b, u2);
    }
    vndf_find_radii_in_front(d, &w->radii, from->u2, end);
    for (uint32_t i = 0; i < end; i += VNDF_LANES)
        vndf_limit_cells(w->radii.cell + i, lanes_set_u(d->radial_count - 1));
    for (uint32_t i = 0, g = 0; i < end; i += VNDF_LANES, g++) {
        vndf_incidence at = vndf_sorted_incidence(from, i);
        vndf_radial_lanes cell = vndf_load_cells(d, w->radii.cell + i);
        w->trusted[g] = lanes_all();
        w->place[g] = vndf_place_front(d, &at, &w->bearing[g], &cell, lanes_load_u(w->radii.cell + i),
                                       lanes_load(from->u2 + i), &w->trusted[g], weighted ? &w->weight[g] : NULL);
    }
    for (uint32_t i = 0, g = 0; i < end; i += VNDF_LANES, g++) {
        vndf_drawn n = vndf_drawn_at(&w->bearing[g].level, &w->place[g], &w->trusted[g]);
        vndf_results_keep(to, i, &n, w->trusted[g]);
        if (weighted)
            lanes_store(to->weight + i, w->weight[g]);
    }
}

/* ---- in the wedge ---- */

/* Azimuths, and the cells where the laws of the radius are cut. */
VNDF_INLINE void draw_azimuths(const vndf_distribution *d, const vndf_sorted *from, uint32_t first, uint32_t count,
                               wedges *w)
{
    const vndf_row_search *s = &w->azimuths;
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        vndf_azimuth_cell cell = vndf_azimuth_cell_of(d, from, i, s);
        w->trusted[g] = lanes_all();
        vndf_azimuth a = vndf_azimuth_draw(&s->rows[g], &cell, lanes_load(s->part + i), &w->trusted[g]);
        vndf_incidence at = vndf_sorted_incidence(from, first + i);
        vndf_azimuth_range range = vndf_sorted_range(from, first + i);
        w->bearing[g] = vndf_azimuth_sample_wedge(d, &at, &range, &a, lanes_load(from->u2 + first + i));
        w->bearing[g].code = lanes_set_u(0);
    }
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++)
        lanes_store_u(w->cut + i, vndf_radial_cut(d, w->bearing[g].c, w->bearing[g].k));
}

VNDF_INLINE void draw_radii(const vndf_distribution *d, const vndf_sorted *from, uint32_t first, uint32_t count,
                            int weighted, wedges *w)
{
    const float *u2 = from->u2 + first;
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        vndf_azimuth_sample *b = &w->bearing[g];
        vndf_radial_lanes cell = vndf_load_cells(d, w->cut + i);
        w->law[g] = vndf_radial_law_cut(b->c, b->k, lanes_load_u(w->cut + i), &cell, &b->total);
        vndf_ask_radii(&w->radii, i, b, lanes_load(u2 + i));
    }
    vndf_find_radii(d, &w->radii, u2, count, 0);
    for (uint32_t i = 0; i < count; i += VNDF_LANES)
        vndf_limit_cells(w->radii.cell + i, lanes_load_u(w->cut + i));
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        vndf_incidence at = vndf_sorted_incidence(from, first + i);
        vndf_radial_lanes cell = vndf_load_cells(d, w->radii.cell + i);
        w->place[g] = vndf_place_wedge(d, &at, &w->bearing[g], &w->law[g], &cell, lanes_load_u(w->radii.cell + i),
                                       lanes_load(u2 + i), &w->trusted[g], weighted ? &w->weight[g] : NULL);
    }
}

/* Draws `count` samples from `first` on. */
VNDF_INLINE void draw_wedges(const vndf_distribution *d, const vndf_sorted *from, uint32_t first, uint32_t count,
                             int weighted, wedges *w, vndf_results *to)
{
    vndf_find_azimuths(d, from, first, count, &w->azimuths);
    draw_azimuths(d, from, first, count, w);
    draw_radii(d, from, first, count, weighted, w);
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        vndf_drawn n = vndf_drawn_at(&w->bearing[g].level, &w->place[g], &w->trusted[g]);
        vndf_results_keep(to, first + i, &n, w->trusted[g]);
        if (weighted)
            lanes_store(to->weight + first + i, w->weight[g]);
    }
}

/* ---- tables ---- */

VNDF_INLINE uint32_t whole_groups(uint32_t count)
{
    return (count + VNDF_LANES - 1) / VNDF_LANES * VNDF_LANES;
}

/* The last group of fronts may reach into the wedges, and the first group of wedges into the fronts, so each kind has
 * its own results. */
static inline void vndf_draw_table(const vndf_distribution *d, vndf_sample_block *b)
{
    vndf_sorted sorted;
    vndf_origin from[VNDF_BLOCK_GROUPS];
    vndf_results front, wedge;
    union {
        fronts in_front;
        wedges in_wedge;
    } work; /* one after the other, in the same lines of the cache */
    uint32_t end = whole_groups(b->count), border = vndf_sort_block(d, b, &sorted, from);
    uint32_t count = whole_groups(end - border);
    draw_fronts(d, &sorted, whole_groups(border), b->weight != NULL, &work.in_front, &front);
    draw_wedges(d, &sorted, end - count, count, b->weight != NULL, &work.in_wedge, &wedge);
    vndf_unsort_block(b, from, &front, &wedge);
}

#endif
