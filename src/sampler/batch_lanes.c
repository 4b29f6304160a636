/* See batch_lanes.h. Lanes past the end of a block repeat what the block held before and are not written. */
#include "sampler/batch_lanes.h"

#include "math/lanes_split.h"
#include "sampler/ggx_draw.h"
#include "sampler/surface.h"

#if VNDF_HAS_LANES && VNDF_LANES > 1

enum { GROUPS = VNDF_BLOCK_SAMPLES / VNDF_LANES };

/* Samples sorted: those in front of wi from the beginning on, those in the wedge from the end down (lanes_split.h).
 * What all share stands in `shared` alone. */
typedef struct sorted {
    float ax[VNDF_BLOCK_SAMPLES], ay[VNDF_BLOCK_SAMPLES], s[VNDF_BLOCK_SAMPLES], c[VNDF_BLOCK_SAMPLES];
    float cos_phi[VNDF_BLOCK_SAMPLES], sin_phi[VNDF_BLOCK_SAMPLES], spread[VNDF_BLOCK_SAMPLES];
    float mass[VNDF_BLOCK_SAMPLES], apart[VNDF_BLOCK_SAMPLES], u2[VNDF_BLOCK_SAMPLES];
    vndf_incidence shared;
    int is_shared;
} sorted;

/* What is drawn of them; the density is negative where that is not good enough. */
typedef struct results {
    float x[VNDF_BLOCK_SAMPLES], y[VNDF_BLOCK_SAMPLES], z[VNDF_BLOCK_SAMPLES], density[VNDF_BLOCK_SAMPLES];
} results;

/* The search for the cells of radii. */
typedef struct search {
    float c[VNDF_BLOCK_SAMPLES], k[VNDF_BLOCK_SAMPLES], target[VNDF_BLOCK_SAMPLES];
    uint32_t cell[VNDF_BLOCK_SAMPLES];
} search;

/* A block as it is worked on. Each step goes over all groups of lanes before the next begins: a group's steps wait
 * for each other, groups do not. */
typedef struct fronts {
    vndf_bearing bearing[GROUPS];
    vndf_place place[GROUPS];
    lanes_m plain[GROUPS];
    search cells;
} fronts;

/* The search for the cells of azimuths; `at` is where a cell is among those of all rows. */
typedef struct row_search {
    float first[VNDF_BLOCK_SAMPLES], middle[VNDF_BLOCK_SAMPLES], last[VNDF_BLOCK_SAMPLES], part[VNDF_BLOCK_SAMPLES];
    uint32_t row[VNDF_BLOCK_SAMPLES], cell[VNDF_BLOCK_SAMPLES], at[VNDF_BLOCK_SAMPLES];
} row_search;

typedef struct wedges {
    uint32_t span[VNDF_BLOCK_SAMPLES], cut[VNDF_BLOCK_SAMPLES];
    vndf_azimuth_row row[GROUPS];
    row_search azimuths;
    vndf_bearing bearing[GROUPS];
    vndf_radial_law law[GROUPS];
    vndf_place place[GROUPS];
    lanes_m plain[GROUPS];
    search cells;
} wedges;

/* How a group was sorted, which of it can be drawn here, and for which of those that is good enough so far. */
typedef struct origin {
    lanes_split split;
    lanes_m usable, plain;
} origin;

static lanes_f clamp_unit(lanes_f u)
{
    return lanes_least(lanes_positive(u), lanes_set(1.0f));
}

/* Indices of the lanes in `m`, from `first` on, that are below `end`. */
VNDF_INLINE uint32_t append(uint32_t *list, uint32_t count, lanes_m m, uint32_t first, uint32_t end)
{
    uint32_t bits = lanes_mask_bits(m);
    if (end - first < VNDF_LANES)
        bits &= (1u << (end - first)) - 1;
    for (; bits != 0; bits &= bits - 1)
        list[count++] = first + (uint32_t)__builtin_ctz(bits);
    return count;
}

/* Those that cannot be drawn here, and those that the call of one would draw and then do carefully. */
VNDF_INLINE void leave(vndf_sample_block *b, lanes_m unready, lanes_m delicate, uint32_t first)
{
    b->left_count = append(b->left, b->left_count, unready, first, b->count);
    uint32_t from = b->left_count;
    b->left_count = append(b->left, from, delicate, first, b->count);
    for (; from < b->left_count; from++)
        b->left[from] |= VNDF_DELICATE;
}

VNDF_INLINE void store(vndf_sample_block *b, uint32_t i, const vndf_drawn *n)
{
    lanes_store(b->x + i, n->x);
    lanes_store(b->y + i, n->y);
    lanes_store(b->z + i, n->z);
    lanes_store(b->density + i, n->density);
}

/* ---- sorting ---- */

VNDF_INLINE void sort_incidence(sorted *to, const lanes_split *split, const vndf_incidence *w)
{
    lanes_split_store(split, to->ax, w->ax);
    lanes_split_store(split, to->ay, w->ay);
    lanes_split_store(split, to->s, w->s);
    lanes_split_store(split, to->c, w->c);
    lanes_split_store(split, to->cos_phi, w->cos_phi);
    lanes_split_store(split, to->sin_phi, w->sin_phi);
    lanes_split_store(split, to->spread, w->spread);
}

/* Directions of a block's samples, and where they are good enough. */
VNDF_INLINE void aim_block(const vndf_distribution *d, const vndf_sample_block *b, float scale, vndf_aim *aim,
                           origin *from)
{
    for (uint32_t g = 0; g * VNDF_LANES < b->count; g++) {
        uint32_t i = g * VNDF_LANES;
        lanes_f ax = lanes_load(b->alpha_x + i) * scale, ay = lanes_load(b->alpha_y + i) * scale;
        lanes_m ready = lanes_all();
        aim[g] = vndf_aim_towards(ax * lanes_load(b->wi_x + i), ay * lanes_load(b->wi_y + i),
                                  lanes_load(b->wi_z + i), &ready);
        from[g].usable = lanes_both(ready, vndf_aim_is_plain(ax, ay, aim[g].c));
    }
    for (uint32_t g = 0; g * VNDF_LANES < b->count; g++)
        vndf_aim_weigh(d, &aim[g], &from[g].usable);
}

/* Samples from `i` on of a block, between *low and *high. What cannot be drawn goes with the fronts. */
VNDF_INLINE void sort_group(const vndf_sample_block *b, uint32_t i, float scale, const vndf_aim *aim, sorted *to,
                            origin *from, uint32_t *low, uint32_t *high)
{
    lanes_f half = 2.0f * clamp_unit(lanes_load(b->u1 + i)) - 1.0f, u2 = clamp_unit(lanes_load(b->u2 + i));
    vndf_incidence w = vndf_incidence_from(lanes_load(b->alpha_x + i) * scale, lanes_load(b->alpha_y + i) * scale, aim);
    vndf_sector sector = vndf_sector_at(aim->front, aim->wedge, half);
    from->plain = lanes_both(from->usable, vndf_sector_is_plain(&sector, aim->front, half, u2));
    from->split = lanes_split_by(lanes_either(sector.in_front, lanes_without(lanes_all(), from->usable)), low, high);
    sort_incidence(to, &from->split, &w);
    lanes_split_store(&from->split, to->mass, sector.mass);
    lanes_split_store(&from->split, to->apart, sector.apart);
    lanes_split_store(&from->split, to->u2, u2);
}

/* The same where all have one view, which is plain. */
VNDF_INLINE void sort_shared(const vndf_sample_block *b, uint32_t i, sorted *to, origin *from, uint32_t *low,
                             uint32_t *high)
{
    lanes_f half = 2.0f * clamp_unit(lanes_load(b->u1 + i)) - 1.0f, u2 = clamp_unit(lanes_load(b->u2 + i));
    lanes_f front = lanes_set(b->view->front);
    vndf_sector sector = vndf_sector_at(front, lanes_set(b->view->wedge), half);
    from->usable = lanes_all();
    from->plain = vndf_sector_is_plain(&sector, front, half, u2);
    from->split = lanes_split_by(sector.in_front, low, high);
    lanes_split_store(&from->split, to->mass, sector.mass);
    lanes_split_store(&from->split, to->apart, sector.apart);
    lanes_split_store(&from->split, to->u2, u2);
}

/* All of a block; how many are in front, or cannot be drawn. */
VNDF_INLINE uint32_t sort_block(const vndf_distribution *d, const vndf_sample_block *b, sorted *to, origin *from)
{
    uint32_t low = 0, high = (b->count + VNDF_LANES - 1) / VNDF_LANES * VNDF_LANES;
    float scale = vndf_unit_scale_float(d);
    vndf_aim aim[GROUPS];
    to->is_shared = b->view != NULL;
    if (b->view)
        to->shared = vndf_incidence_of(b->view);
    else
        aim_block(d, b, scale, aim, from);
    for (uint32_t g = 0; g * VNDF_LANES < b->count; g++)
        if (b->view)
            sort_shared(b, g * VNDF_LANES, to, &from[g], &low, &high);
        else
            sort_group(b, g * VNDF_LANES, scale, &aim[g], to, &from[g], &low, &high);
    return low;
}

VNDF_INLINE vndf_incidence incidence_at(const sorted *w, uint32_t i)
{
    vndf_incidence at = {lanes_load(w->ax + i), lanes_load(w->ay + i), lanes_load(w->s + i), lanes_load(w->c + i),
                         lanes_load(w->cos_phi + i), lanes_load(w->sin_phi + i), lanes_load(w->spread + i),
                         lanes_all()};
    return w->is_shared ? w->shared : at;
}

VNDF_INLINE vndf_sector sector_at(const sorted *w, uint32_t i)
{
    vndf_sector sector = {lanes_all(), lanes_load(w->mass + i), lanes_load(w->apart + i)};
    return sector;
}

/* Results to where their samples were; what is not good enough is left. */
VNDF_INLINE void unsort_block(vndf_sample_block *b, const origin *from, const results *front, const results *wedge)
{
    for (uint32_t i = 0; i < b->count; i += VNDF_LANES) {
        const origin *o = &from[i / VNDF_LANES];
        vndf_drawn n = {lanes_split_load(&o->split, front->x, wedge->x),
                        lanes_split_load(&o->split, front->y, wedge->y),
                        lanes_split_load(&o->split, front->z, wedge->z),
                        lanes_split_load(&o->split, front->density, wedge->density)};
        store(b, i, &n);
        lanes_m good = lanes_both(o->plain, lanes_less(lanes_set(0.0f), n.density));
        leave(b, lanes_without(lanes_all(), o->usable), lanes_without(o->usable, good), i);
    }
}

VNDF_INLINE void keep(results *to, uint32_t i, const vndf_drawn *n, lanes_m plain)
{
    lanes_store(to->x + i, n->x);
    lanes_store(to->y + i, n->y);
    lanes_store(to->z + i, n->z);
    lanes_store(to->density + i, lanes_pick(plain, n->density, lanes_set(-1.0f)));
}

/* ---- in front of wi ---- */

VNDF_INLINE vndf_radial_search search_in(search *cells)
{
    vndf_radial_search in = {cells->c, cells->k, cells->target, cells->cell};
    return in;
}

VNDF_INLINE void limit_cells(uint32_t *cell, lanes_u most)
{
    lanes_store_u(cell, lanes_limit_u(lanes_load_u(cell), most));
}

VNDF_INLINE void draw_fronts(const vndf_distribution *d, const sorted *from, uint32_t count, fronts *w, results *to)
{
    uint32_t end = (count + VNDF_LANES - 1) / VNDF_LANES * VNDF_LANES;
    vndf_radial_search cells = search_in(&w->cells);
    for (uint32_t i = 0; i < end; i += VNDF_LANES) {
        vndf_incidence at = incidence_at(from, i);
        vndf_sector sector = sector_at(from, i);
        vndf_bearing b = vndf_bear_front(d, &at, &sector, lanes_load(from->u2 + i));
        vndf_radial_ask(d, &cells, i, b.code, b.c, b.k, lanes_load(from->u2 + i) * b.total);
        w->bearing[i / VNDF_LANES] = b;
    }
    vndf_radial_answer(d, &cells, end, 1);
    for (uint32_t i = 0; i < end; i += VNDF_LANES)
        limit_cells(cells.cell + i, lanes_set_u(d->radial_count - 1));
    for (uint32_t i = 0, g = 0; i < end; i += VNDF_LANES, g++) {
        vndf_incidence at = incidence_at(from, i);
        vndf_radial_lanes cell = vndf_radial_load_found(d, cells.cell + i);
        w->plain[g] = lanes_all();
        w->place[g] = vndf_place_front(d, &at, &w->bearing[g], &cell, lanes_load_u(cells.cell + i),
                                       lanes_load(from->u2 + i), &w->plain[g]);
    }
    for (uint32_t i = 0, g = 0; i < end; i += VNDF_LANES, g++) {
        vndf_drawn n = vndf_drawn_at(&w->bearing[g].level, &w->place[g], &w->plain[g]);
        keep(to, i, &n, w->plain[g]);
    }
}

/* ---- in the wedge ---- */

/* Rows of directions, and what part of them is before the azimuths. */
VNDF_INLINE void ask_azimuths(const vndf_distribution *d, const sorted *from, uint32_t first, uint32_t count,
                              wedges *w)
{
    row_search *s = &w->azimuths;
    for (uint32_t i = 0; i < count; i += VNDF_LANES)
        lanes_store_u(w->span + i, vndf_wedge_span(&d->above, incidence_at(from, first + i).c));
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        lanes_lines lines = lanes_lines_from(&d->above.row_span->begin, VNDF_ROW_SPAN_FLOATS, w->span + i);
        vndf_sector sector = sector_at(from, first + i);
        w->row[g] = vndf_wedge_row_from(&d->above, incidence_at(from, first + i).c, lanes_load_u(w->span + i), &lines);
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
VNDF_INLINE void draw_azimuths(const vndf_distribution *d, const sorted *from, uint32_t first, uint32_t count,
                               wedges *w)
{
    const row_search *s = &w->azimuths;
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        lanes_lines lines = lanes_lines_from(&d->above.row_cell->before, 4, s->at + i);
        vndf_azimuth_cell cell = vndf_azimuth_cell_from(&w->row[g], lanes_load_u(s->cell + i), &lines);
        w->plain[g] = vndf_wedge_is_plain(&w->row[g]);
        vndf_azimuth a = vndf_azimuth_draw(&w->row[g], &cell, lanes_load(s->part + i), &w->plain[g]);
        vndf_incidence at = incidence_at(from, first + i);
        vndf_sector sector = sector_at(from, first + i);
        w->bearing[g] = vndf_bear_wedge(d, &at, &sector, &a, lanes_load(from->u2 + first + i));
    }
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++)
        lanes_store_u(w->cut + i, vndf_radial_cut(d, w->bearing[g].c, w->bearing[g].k));
}

VNDF_INLINE void draw_radii(const vndf_distribution *d, const sorted *from, uint32_t first, uint32_t count, wedges *w)
{
    const float *u2 = from->u2 + first;
    vndf_radial_search cells = search_in(&w->cells);
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        vndf_bearing *b = &w->bearing[g];
        vndf_radial_lanes cell = vndf_radial_load_found(d, w->cut + i);
        w->law[g] = vndf_radial_law_cut(d, b->c, b->k, lanes_load_u(w->cut + i), &cell, &b->total);
        vndf_radial_ask(d, &cells, i, b->code, b->c, b->k, lanes_load(u2 + i) * b->total);
    }
    vndf_radial_answer(d, &cells, count, 0);
    for (uint32_t i = 0; i < count; i += VNDF_LANES)
        limit_cells(cells.cell + i, lanes_load_u(w->cut + i));
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        vndf_incidence at = incidence_at(from, first + i);
        vndf_radial_lanes cell = vndf_radial_load_found(d, cells.cell + i);
        w->place[g] = vndf_place_wedge(&at, &w->bearing[g], &w->law[g], &cell, lanes_load_u(cells.cell + i),
                                       lanes_load(u2 + i), &w->plain[g]);
    }
}

/* From `begin` on to the end; groups end there, so that the first may begin among the fronts. */
VNDF_INLINE void draw_wedges(const vndf_distribution *d, const sorted *from, uint32_t begin, uint32_t end, wedges *w,
                             results *to)
{
    uint32_t count = (end - begin + VNDF_LANES - 1) / VNDF_LANES * VNDF_LANES, first = end - count;
    ask_azimuths(d, from, first, count, w);
    draw_azimuths(d, from, first, count, w);
    draw_radii(d, from, first, count, w);
    for (uint32_t i = 0, g = 0; i < count; i += VNDF_LANES, g++) {
        vndf_drawn n = vndf_drawn_at(&w->bearing[g].level, &w->place[g], &w->plain[g]);
        keep(to, first + i, &n, w->plain[g]);
    }
}

/* ---- GGX ---- */

VNDF_INLINE vndf_incidence incidence_of_ggx(const vndf_sample_block *b, uint32_t i)
{
    lanes_f ax = lanes_load(b->alpha_x + i), ay = lanes_load(b->alpha_y + i);
    lanes_m ready = lanes_all();
    vndf_aim aim = vndf_aim_unit(ax * lanes_load(b->wi_x + i), ay * lanes_load(b->wi_y + i), lanes_load(b->wi_z + i),
                                 &ready);
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
        vndf_drawn n = vndf_ggx_draw(&w, clamp_unit(lanes_load(b->u1 + i)), clamp_unit(lanes_load(b->u2 + i)),
                                     &plain);
        store(b, i, &n);
        leave(b, lanes_without(lanes_all(), w.plain), lanes_without(w.plain, plain), i);
    }
}

static void draw_table(const vndf_distribution *d, vndf_sample_block *b)
{
    sorted samples;
    origin from[GROUPS];
    results front, wedge;
    fronts in_front;
    wedges in_wedge;
    uint32_t fronts_end = sort_block(d, b, &samples, from);
    draw_fronts(d, &samples, fronts_end, &in_front, &front);
    draw_wedges(d, &samples, fronts_end, (b->count + VNDF_LANES - 1) / VNDF_LANES * VNDF_LANES, &in_wedge, &wedge);
    unsort_block(b, from, &front, &wedge);
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
