/* Sorts a block of samples into samples in front of wi and samples in the wedge, so that all lanes draw in the same
 * way; and puts results back in order. */
#ifndef VNDF_SAMPLER_BATCH_SORT_H
#define VNDF_SAMPLER_BATCH_SORT_H

#include "simd/lanes_split.h"
#include "sampler/batch/lanes_sample.h"
#include "sampler/tabulated/draw.h"
#include "sampler/surface.h"
#include "simd/list.h"

enum { VNDF_BLOCK_GROUPS = VNDF_BLOCK_SAMPLES / VNDF_LANES };

/* Sorted samples: fronts from the beginning on, wedges from the end down (simd/lanes_split.h). If all samples share one
 * incidence, only `shared` holds it. */
typedef struct vndf_sorted {
    float ax[VNDF_BLOCK_SAMPLES], ay[VNDF_BLOCK_SAMPLES], s[VNDF_BLOCK_SAMPLES], c[VNDF_BLOCK_SAMPLES];
    float cos_phi[VNDF_BLOCK_SAMPLES], sin_phi[VNDF_BLOCK_SAMPLES], spread[VNDF_BLOCK_SAMPLES];
    float mass[VNDF_BLOCK_SAMPLES], apart[VNDF_BLOCK_SAMPLES], u2[VNDF_BLOCK_SAMPLES];
    vndf_incidence shared;
    int is_shared;
} vndf_sorted;

/* The normals that were drawn. A negative density marks a sample that float may not draw. */
typedef struct vndf_results {
    float x[VNDF_BLOCK_SAMPLES], y[VNDF_BLOCK_SAMPLES], z[VNDF_BLOCK_SAMPLES], density[VNDF_BLOCK_SAMPLES];
    float weight[VNDF_BLOCK_SAMPLES]; /* where the block asks for it */
} vndf_results;

/* How a group was sorted, which of its samples can be drawn here, and which of these float may draw so far. */
typedef struct vndf_origin {
    lanes_split split;
    lanes_m usable, trusted;
} vndf_origin;

/* ---- a block ---- */

/* Uniform numbers, held to [0, 1]. */
VNDF_INLINE lanes_f vndf_block_u(const float *from)
{
    return lanes_least(lanes_positive(lanes_load(from)), lanes_set(1.0f));
}

/* Indices of the lanes in `m`, from `first` on, that are below `end`. */
VNDF_INLINE uint32_t vndf_block_append(uint32_t *list, uint32_t count, lanes_m m, uint32_t first, uint32_t end)
{
    return vndf_list_bits(list, count, lanes_mask_bits(m), first, VNDF_LANES, end);
}

/* Leaves samples that were not drawn here, and samples that the scalar call is to draw again exactly. */
VNDF_INLINE void vndf_block_leave(vndf_sample_block *b, lanes_m unready, lanes_m delicate, uint32_t first)
{
    b->left_count = vndf_block_append(b->left, b->left_count, unready, first, b->count);
    uint32_t from = b->left_count;
    b->left_count = vndf_block_append(b->left, from, delicate, first, b->count);
    for (; from < b->left_count; from++)
        b->left[from] |= VNDF_DELICATE;
}

VNDF_INLINE void vndf_block_store(vndf_sample_block *b, uint32_t i, const vndf_drawn *n)
{
    lanes_store(b->x + i, n->x);
    lanes_store(b->y + i, n->y);
    lanes_store(b->z + i, n->z);
    lanes_store(b->density + i, n->density);
}

/* ---- sorting ---- */

VNDF_INLINE void vndf_sort_incidence(vndf_sorted *to, const lanes_split *split, const vndf_incidence *w)
{
    lanes_split_store(split, to->ax, w->ax);
    lanes_split_store(split, to->ay, w->ay);
    lanes_split_store(split, to->s, w->s);
    lanes_split_store(split, to->c, w->c);
    lanes_split_store(split, to->cos_phi, w->cos_phi);
    lanes_split_store(split, to->sin_phi, w->sin_phi);
    lanes_split_store(split, to->spread, w->spread);
}

VNDF_INLINE void vndf_sort_range(vndf_sorted *to, const lanes_split *split, const vndf_azimuth_range *range,
                                 lanes_f u2)
{
    lanes_split_store(split, to->mass, range->mass);
    lanes_split_store(split, to->apart, range->apart);
    lanes_split_store(split, to->u2, u2);
}

/* The stretched views of a block's samples, and which of them are usable. */
VNDF_INLINE void vndf_stretch_block(const vndf_distribution *d, const vndf_sample_block *b, float scale,
                                    vndf_stretched_view *stretched, vndf_origin *from)
{
    for (uint32_t g = 0; g * VNDF_LANES < b->count; g++) {
        uint32_t i = g * VNDF_LANES;
        lanes_f ax = lanes_load(b->alpha_x + i) * scale, ay = lanes_load(b->alpha_y + i) * scale;
        lanes_m trusted = lanes_all();
        stretched[g] = vndf_stretched_view_towards(ax * lanes_load(b->wi_x + i), ay * lanes_load(b->wi_y + i),
                                                   lanes_load(b->wi_z + i), &trusted);
        from[g].usable = lanes_both(trusted, vndf_trusts_scale(ax, ay, stretched[g].c));
    }
    for (uint32_t g = 0; g * VNDF_LANES < b->count; g++)
        vndf_stretched_view_weigh(d, &stretched[g], &from[g].usable);
}

/* Sorts the group from sample `i` on between *low and *high. Unusable samples go with the fronts. */
VNDF_INLINE void vndf_sort_group(const vndf_sample_block *b, uint32_t i, float scale,
                                 const vndf_stretched_view *stretched, vndf_sorted *to, vndf_origin *from,
                                 uint32_t *low, uint32_t *high)
{
    lanes_f half = 2.0f * vndf_block_u(b->u1 + i) - 1.0f, u2 = vndf_block_u(b->u2 + i);
    lanes_f ax = lanes_load(b->alpha_x + i) * scale, ay = lanes_load(b->alpha_y + i) * scale;
    vndf_incidence w = vndf_incidence_from(ax, ay, stretched);
    vndf_azimuth_range range = vndf_azimuth_range_at(stretched->front, stretched->wedge, half);
    from->trusted = lanes_both(from->usable, vndf_trusts_wedge_mass(stretched->front, range.mass));
    lanes_m unusable = lanes_without(lanes_all(), from->usable);
    from->split = lanes_split_by(lanes_either(range.in_front, unusable), low, high);
    vndf_sort_incidence(to, &from->split, &w);
    vndf_sort_range(to, &from->split, &range, u2);
}

/* The same where all samples share one trusted view. */
VNDF_INLINE void vndf_sort_shared(const vndf_sample_block *b, uint32_t i, vndf_sorted *to, vndf_origin *from,
                                  uint32_t *low, uint32_t *high)
{
    lanes_f half = 2.0f * vndf_block_u(b->u1 + i) - 1.0f, u2 = vndf_block_u(b->u2 + i);
    lanes_f front = lanes_set(b->view->of.table.front);
    vndf_azimuth_range range = vndf_azimuth_range_at(front, lanes_set(b->view->of.table.wedge), half);
    from->usable = lanes_all();
    from->trusted = vndf_trusts_wedge_mass(front, range.mass);
    from->split = lanes_split_by(range.in_front, low, high);
    vndf_sort_range(to, &from->split, &range, u2);
}

/* Sorts a block. Returns how many samples are in front or unusable. */
VNDF_INLINE uint32_t vndf_sort_block(const vndf_distribution *d, const vndf_sample_block *b, vndf_sorted *to,
                                     vndf_origin *from)
{
    uint32_t low = 0, high = (b->count + VNDF_LANES - 1) / VNDF_LANES * VNDF_LANES;
    float scale = vndf_unit_scale_float(d);
    vndf_stretched_view stretched[VNDF_BLOCK_GROUPS];
    to->is_shared = b->view != NULL;
    if (b->view) {
        to->shared = vndf_incidence_of(b->view);
        for (uint32_t g = 0; g * VNDF_LANES < b->count; g++)
            vndf_sort_shared(b, g * VNDF_LANES, to, &from[g], &low, &high);
        return low;
    }
    vndf_stretch_block(d, b, scale, stretched, from);
    for (uint32_t g = 0; g * VNDF_LANES < b->count; g++)
        vndf_sort_group(b, g * VNDF_LANES, scale, &stretched[g], to, &from[g], &low, &high);
    return low;
}

VNDF_INLINE vndf_incidence vndf_sorted_incidence(const vndf_sorted *w, uint32_t i)
{
    if (w->is_shared)
        return w->shared;
    vndf_incidence at = {
        lanes_load(w->ax + i),      lanes_load(w->ay + i),      lanes_load(w->s + i),      lanes_load(w->c + i),
        lanes_load(w->cos_phi + i), lanes_load(w->sin_phi + i), lanes_load(w->spread + i), lanes_all()};
    return at;
}

VNDF_INLINE vndf_azimuth_range vndf_sorted_range(const vndf_sorted *w, uint32_t i)
{
    vndf_azimuth_range range = {lanes_all(), lanes_load(w->mass + i), lanes_load(w->apart + i)};
    return range;
}

/* Puts results where their samples were, and leaves samples that float may not draw. */
VNDF_INLINE void vndf_unsort_block(vndf_sample_block *b, const vndf_origin *from, const vndf_results *front,
                                   const vndf_results *wedge)
{
    for (uint32_t i = 0; i < b->count; i += VNDF_LANES) {
        const vndf_origin *o = &from[i / VNDF_LANES];
        vndf_drawn n = {lanes_split_load(&o->split, front->x, wedge->x),
                        lanes_split_load(&o->split, front->y, wedge->y),
                        lanes_split_load(&o->split, front->z, wedge->z),
                        lanes_split_load(&o->split, front->density, wedge->density)};
        vndf_block_store(b, i, &n);
        if (b->weight)
            lanes_store(b->weight + i, lanes_split_load(&o->split, front->weight, wedge->weight));
        lanes_m good = lanes_both(o->trusted, lanes_less(lanes_set(0.0f), n.density));
        vndf_block_leave(b, lanes_without(lanes_all(), o->usable), lanes_without(o->usable, good), i);
    }
}

VNDF_INLINE void vndf_results_keep(vndf_results *to, uint32_t i, const vndf_drawn *n, lanes_m trusted)
{
    lanes_store(to->x + i, n->x);
    lanes_store(to->y + i, n->y);
    lanes_store(to->z + i, n->z);
    lanes_store(to->density + i, lanes_pick(trusted, n->density, lanes_set(-1.0f)));
}

#endif
