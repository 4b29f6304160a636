/* See batch_lanes.h. Lanes past the end of a block repeat what the block held before and are not written. */
#include "sampler/batch_lanes.h"

#include "sampler/draw.h"
#include "sampler/surface.h"

#if VNDF_HAS_LANES && VNDF_LANES > 1

/* What the wedge needs of the samples that are in it. */
typedef struct wedge_list {
    vndf_incidence at[VNDF_BLOCK_SAMPLES / VNDF_LANES]; /* of all samples, lanes by lanes */
    uint32_t index[VNDF_BLOCK_SAMPLES + VNDF_LANES];
    uint32_t count;
} wedge_list;

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

static vndf_incidence shared_incidence(const vndf_view *v)
{
    vndf_incidence w = {lanes_set(v->ax), lanes_set(v->ay), lanes_set(v->s), lanes_set(v->c),
                        lanes_set(v->cos_phi), lanes_set(v->sin_phi), lanes_set(v->front), lanes_set(v->wedge),
                        lanes_set(v->spread), v->plain ? lanes_all() : lanes_none()};
    return w;
}

/* Of samples from `i` on; plain only where a view in float is good enough. */
VNDF_INLINE vndf_incidence incidence_at(const vndf_distribution *d, const vndf_sample_block *b, uint32_t i, float scale)
{
    lanes_f ax = lanes_load(b->alpha_x + i) * scale, ay = lanes_load(b->alpha_y + i) * scale;
    lanes_m ready = lanes_all();
    vndf_aim aim = vndf_aim_at(d, ax * lanes_load(b->wi_x + i), ay * lanes_load(b->wi_y + i), lanes_load(b->wi_z + i),
                               &ready);
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

/* Number `member` of the incidences of samples `at`: they lie in groups of VNDF_LANES. */
VNDF_INLINE lanes_f incidence_member(const float *member, lanes_u at)
{
    const uint32_t group = sizeof(vndf_incidence) / sizeof(float);
    return lanes_gather(member, (at / VNDF_LANES) * group + (at & (VNDF_LANES - 1u)));
}

VNDF_INLINE vndf_incidence gathered_incidence(const vndf_incidence *all, lanes_u at)
{
    vndf_incidence w = {incidence_member((const float *)&all->ax, at), incidence_member((const float *)&all->ay, at),
                        incidence_member((const float *)&all->s, at), incidence_member((const float *)&all->c, at),
                        incidence_member((const float *)&all->cos_phi, at),
                        incidence_member((const float *)&all->sin_phi, at),
                        incidence_member((const float *)&all->front, at),
                        incidence_member((const float *)&all->wedge, at),
                        incidence_member((const float *)&all->spread, at), lanes_all()};
    return w;
}

/* In front of wi, all lanes; those that are not are listed. */
VNDF_INLINE void draw_fronts(const vndf_distribution *d, vndf_sample_block *b, wedge_list *list)
{
    float scale = vndf_unit_scale_float(d);
    vndf_incidence shared;
    if (b->view)
        shared = shared_incidence(b->view);
    for (uint32_t i = 0; i < b->count; i += VNDF_LANES) {
        vndf_incidence w = b->view ? shared : incidence_at(d, b, i, scale);
        lanes_f half = 2.0f * clamp_unit(lanes_load(b->u1 + i)) - 1.0f;
        lanes_m front = lanes_less(vndf_draw_target(&w, half), w.front), plain = w.plain;
        vndf_drawn n = vndf_draw_front(d, &w, half, clamp_unit(lanes_load(b->u2 + i)), &plain);
        store(b, i, &n);
        if (!b->view)
            list->at[i / VNDF_LANES] = w;
        list->count = append(list->index, list->count, lanes_without(w.plain, front), i, b->count);
        b->left_count = append(b->left, b->left_count,
                               lanes_without(lanes_either(front, lanes_without(lanes_all(), w.plain)), plain), i,
                               b->count);
    }
}

/* The samples in the wedge. */
VNDF_INLINE void draw_wedges(const vndf_distribution *d, vndf_sample_block *b, wedge_list *list)
{
    vndf_incidence shared;
    if (b->view)
        shared = shared_incidence(b->view);
    for (uint32_t i = 0; i < VNDF_LANES; i++)
        list->index[list->count + i] = list->count > 0 ? list->index[0] : 0;
    for (uint32_t i = 0; i < list->count; i += VNDF_LANES) {
        lanes_u at = lanes_load_u(list->index + i);
        vndf_incidence w = b->view ? shared : gathered_incidence(list->at, at);
        lanes_m plain = lanes_all();
        lanes_f half = 2.0f * clamp_unit(lanes_gather(b->u1, at)) - 1.0f;
        vndf_drawn n = vndf_draw_wedge(d, &w, half, clamp_unit(lanes_gather(b->u2, at)), &plain);
        float out[4][VNDF_LANES];
        lanes_store(out[0], n.x);
        lanes_store(out[1], n.y);
        lanes_store(out[2], n.z);
        lanes_store(out[3], n.density);
        uint32_t good = lanes_mask_bits(plain), end = list->count - i < VNDF_LANES ? list->count - i : VNDF_LANES;
        for (uint32_t lane = 0; lane < end; lane++) {
            uint32_t to = list->index[i + lane];
            b->x[to] = out[0][lane];
            b->y[to] = out[1][lane];
            b->z[to] = out[2][lane];
            b->density[to] = out[3][lane];
            b->left[b->left_count] = to;
            b->left_count += !(good >> lane & 1);
        }
    }
}

#if VNDF_LANES == 16
void vndf_sample_block_avx512(const vndf_distribution *d, vndf_sample_block *b)
#else
void vndf_sample_block_avx2(const vndf_distribution *d, vndf_sample_block *b)
#endif
{
    wedge_list list;
    list.count = 0;
    b->left_count = 0;
    draw_fronts(d, b, &list);
    draw_wedges(d, b, &list);
}

#endif
