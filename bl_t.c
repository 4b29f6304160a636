/* See batch_lanes.h. Lanes past the end of a block repeat what the block held before and are not written. */
#include "sampler/batch_lanes.h"

#include "sampler/ggx_draw.h"
#include "sampler/surface.h"

#if VNDF_HAS_LANES && VNDF_LANES > 1
#include <x86intrin.h>
unsigned long long ph[40]; unsigned long long t_; int last_;

enum { GROUPS = VNDF_BLOCK_SAMPLES / VNDF_LANES };

/* A block as it is worked on. Each step goes over all groups of lanes before the next begins: a group's steps wait
 * for each other, groups do not. */
typedef struct work {
    vndf_incidence at[GROUPS];
    lanes_f half[GROUPS], u2[GROUPS];
    vndf_bearing bearing[GROUPS];
    lanes_u cell[GROUPS];
    vndf_place place[GROUPS];
    lanes_m plain[GROUPS];
    uint32_t wedge[VNDF_BLOCK_SAMPLES + VNDF_LANES]; /* the samples that are in the wedge */
    uint32_t wedge_count;
} work;

/* The wedge's samples, side by side. */
typedef struct wedge_work {
    vndf_incidence at[GROUPS];
    lanes_f half[GROUPS], u2[GROUPS], part[GROUPS];
    vndf_azimuth_row row[GROUPS];
    lanes_u count[GROUPS], cell[GROUPS];
    lanes_m plain[GROUPS];
    vndf_azimuth azimuth[GROUPS];
    vndf_bearing bearing[GROUPS];
    vndf_radial_law law[GROUPS];
    vndf_place place[GROUPS];
} wedge_work;

static lanes_f clamp_unit(lanes_f u)
{
    return lanes_limit(lanes_positive(u), 1.0f);
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

/* Of samples from `i` on; plain only where a view in float is good enough. */
VNDF_INLINE vndf_incidence incidence_at(const vndf_distribution *d, const vndf_sample_block *b, uint32_t i,
                                        float scale)
{
    lanes_f ax = lanes_load(b->alpha_x + i) * scale, ay = lanes_load(b->alpha_y + i) * scale;
    lanes_m ready = lanes_all();
    lanes_f x = ax * lanes_load(b->wi_x + i), y = ay * lanes_load(b->wi_y + i), z = lanes_load(b->wi_z + i);
    vndf_aim aim = d->kind == VNDF_KIND_GGX ? vndf_aim_unit(x, y, z, &ready) : vndf_aim_at(d, x, y, z, &ready);
    vndf_incidence w = vndf_incidence_from(ax, ay, &aim);
    w.plain = lanes_both(w.plain, ready);
    return w;
}

VNDF_INLINE void store(vndf_sample_block *b, uint32_t i, const vndf_drawn *n)
{
    lanes_store(b->x + i, n->x);
    lanes_store(b->y + i, n->y);
    lanes_store(b->z + i, n->z);
    lanes_store(b->density + i, n->density);
}

/* The same member of the groups, of samples `index`: what lies `stride` floats from group to group. */
VNDF_INLINE lanes_f gathered(const lanes_f *member, size_t stride, lanes_u index)
{
    lanes_u group = index / VNDF_LANES, lane = index & (VNDF_LANES - 1u);
    return lanes_gather((const float *)member, group * (uint32_t)(stride / sizeof(float)) + lane);
}

VNDF_INLINE vndf_incidence gathered_incidence(const vndf_incidence *all, lanes_u index)
{
    const size_t stride = sizeof *all;
    vndf_incidence w = {gathered(&all->ax, stride, index), gathered(&all->ay, stride, index),
                        gathered(&all->s, stride, index), gathered(&all->c, stride, index),
                        gathered(&all->cos_phi, stride, index), gathered(&all->sin_phi, stride, index),
                        gathered(&all->front, stride, index), gathered(&all->wedge, stride, index),
                        gathered(&all->spread, stride, index), lanes_all()};
    return w;
}

/* ---- in front of wi: all lanes as they come ---- */

VNDF_INLINE void aim(const vndf_distribution *d, const vndf_sample_block *b, work *w)
{
    float scale = vndf_unit_scale_float(d);
    vndf_incidence shared;
    if (b->view)
        shared = vndf_incidence_of(b->view);
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=1;}
    for (uint32_t g = 0; g * VNDF_LANES < b->count; g++) {
        uint32_t i = g * VNDF_LANES;
        w->at[g] = b->view ? shared : incidence_at(d, b, i, scale);
        w->half[g] = 2.0f * clamp_unit(lanes_load(b->u1 + i)) - 1.0f;
        w->u2[g] = clamp_unit(lanes_load(b->u2 + i));
    }
}

VNDF_INLINE void draw_fronts(const vndf_distribution *d, vndf_sample_block *b, work *w)
{
    uint32_t groups = (b->count + VNDF_LANES - 1) / VNDF_LANES;
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=2;}
    for (uint32_t g = 0; g < groups; g++)
        w->bearing[g] = vndf_bear_front(d, &w->at[g], w->half[g], w->u2[g]);
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=3;}
    for (uint32_t g = 0; g < groups; g++)
        w->cell[g] = vndf_find_front(d, &w->bearing[g], w->u2[g]);
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=4;}
    for (uint32_t g = 0; g < groups; g++) {
        w->plain[g] = w->at[g].plain;
        w->place[g] = vndf_place_front(d, &w->at[g], &w->bearing[g], w->cell[g], w->half[g], w->u2[g],
                                       &w->plain[g]);
    }
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=5;}
    for (uint32_t g = 0; g < groups; g++) {
        vndf_drawn n = vndf_drawn_at(&w->bearing[g].level, &w->place[g], &w->plain[g]);
        store(b, g * VNDF_LANES, &n);
    }
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=6;}
    for (uint32_t g = 0; g < groups; g++) {
        lanes_m usable = w->at[g].plain, plain = w->plain[g];
        lanes_m front = lanes_less(vndf_draw_target(&w->at[g], w->half[g]), w->at[g].front);
        w->wedge_count = append(w->wedge, w->wedge_count, lanes_without(usable, front), g * VNDF_LANES, b->count);
        leave(b, lanes_without(lanes_all(), usable), lanes_without(lanes_both(usable, front), plain),
              g * VNDF_LANES);
    }
}

/* ---- in the wedge: those that are, gathered ---- */

VNDF_INLINE void gather_wedges(const vndf_distribution *d, const vndf_sample_block *b, const work *from,
                               wedge_work *w)
{
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=7;}
    for (uint32_t g = 0; g * VNDF_LANES < from->wedge_count; g++) {
        lanes_u index = lanes_load_u(from->wedge + g * VNDF_LANES);
        w->at[g] = b->view ? from->at[0] : gathered_incidence(from->at, index);
        w->half[g] = gathered(from->half, sizeof *from->half, index);
        w->u2[g] = gathered(from->u2, sizeof *from->u2, index);
        w->row[g] = vndf_wedge_row(&d->above, w->at[g].c);
        w->part[g] = vndf_wedge_part(lanes_abs(w->half[g]), w->at[g].front, w->at[g].wedge);
    }
}

/* A group's results to where its samples were; what is not good is left. */
VNDF_INLINE void scatter(vndf_sample_block *b, const uint32_t *index, uint32_t count, const vndf_drawn *n,
                         lanes_m good)
{
    float out[4][VNDF_LANES];
    uint32_t bits = lanes_mask_bits(good);
    lanes_store(out[0], n->x);
    lanes_store(out[1], n->y);
    lanes_store(out[2], n->z);
    lanes_store(out[3], n->density);
    for (uint32_t lane = 0; lane < count; lane++) {
        uint32_t to = index[lane];
        b->x[to] = out[0][lane];
        b->y[to] = out[1][lane];
        b->z[to] = out[2][lane];
        b->density[to] = out[3][lane];
        b->left[b->left_count] = to | VNDF_DELICATE;
        b->left_count += !(bits >> lane & 1);
    }
}

VNDF_INLINE void draw_wedges(const vndf_distribution *d, vndf_sample_block *b, const work *from, wedge_work *w)
{
    uint32_t groups = (from->wedge_count + VNDF_LANES - 1) / VNDF_LANES;
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=8;}
    for (uint32_t g = 0; g < groups; g++)
        w->count[g] = vndf_azimuth_find(&w->row[g], w->part[g]);
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=9;}
    for (uint32_t g = 0; g < groups; g++)
        w->azimuth[g] = vndf_azimuth_draw(&w->row[g], w->count[g], w->part[g]);
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=10;}
    for (uint32_t g = 0; g < groups; g++)
        w->bearing[g] = vndf_bear_wedge(d, &w->at[g], &w->azimuth[g], w->half[g], w->u2[g]);
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=11;}
    for (uint32_t g = 0; g < groups; g++)
        w->law[g] = vndf_law_wedge(d, &w->bearing[g]);
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=12;}
    for (uint32_t g = 0; g < groups; g++)
        w->cell[g] = vndf_find_wedge(d, &w->bearing[g], w->u2[g], w->law[g].cut);
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=13;}
    for (uint32_t g = 0; g < groups; g++) {
        w->plain[g] = vndf_wedge_is_plain(&w->row[g]);
        w->place[g] = vndf_place_wedge(d, &w->at[g], &w->bearing[g], &w->law[g], w->cell[g], w->half[g], w->u2[g],
                                       &w->plain[g]);
    }
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=14;}
    for (uint32_t g = 0; g < groups; g++) {
        vndf_drawn n = vndf_drawn_at(&w->bearing[g].level, &w->place[g], &w->plain[g]);
        uint32_t first = g * VNDF_LANES, left = from->wedge_count - first;
        scatter(b, from->wedge + first, left < VNDF_LANES ? left : VNDF_LANES, &n, w->plain[g]);
    }
}

/* ---- GGX ---- */

VNDF_INLINE void draw_ggx(const vndf_distribution *d, vndf_sample_block *b)
{
    vndf_incidence shared;
    if (b->view)
        shared = vndf_incidence_of(b->view);
    for (uint32_t i = 0; i < b->count; i += VNDF_LANES) {
        vndf_incidence w = b->view ? shared : incidence_at(d, b, i, 1.0f);
        lanes_m plain = lanes_all();
        vndf_drawn n = vndf_ggx_draw(&w, clamp_unit(lanes_load(b->u1 + i)), clamp_unit(lanes_load(b->u2 + i)),
                                     &plain);
        store(b, i, &n);
        leave(b, lanes_without(lanes_all(), w.plain), lanes_without(w.plain, plain), i);
    }
}

static void draw_table(const vndf_distribution *d, vndf_sample_block *b)
{
    work all;
    wedge_work wedges;
    all.wedge_count = 0;
    aim(d, b, &all);
    draw_fronts(d, b, &all);
    for (uint32_t i = 0; i < VNDF_LANES; i++) /* lanes that are not needed repeat a sample */
        all.wedge[all.wedge_count + i] = 0;
    gather_wedges(d, b, &all, &wedges);
    draw_wedges(d, b, &all, &wedges);
    {unsigned long long n_=__rdtsc(); ph[last_]+=n_-t_; t_=n_; last_=0; ph[39]+=b->count;}
}

#if VNDF_LANES == 16
void vndf_sample_block_avx512(const vndf_distribution *d, vndf_sample_block *b)
#else
void vndf_sample_block_avx2(const vndf_distribution *d, vndf_sample_block *b)
#endif
{
    b->left_count = 0;
    if (d->kind == VNDF_KIND_GGX)
        draw_ggx(d, b);
    else
        draw_table(d, b);
}

#endif
