/* See lanes_scatter.h. Lanes past the end of a block work on numbers that are in memory, and nobody reads what they
 * make of them.
 *
 * Directions and densities are float, Fresnel terms and masking double. A block goes through three loops: the first
 * reflects, the second weighs in double, the third stores. */
#include "bsdf/batch/lanes_scatter.h"

#if VNDF_HAS_LANES && VNDF_LANES > 1

#  include "bsdf/terms/event.h"
#  include "bsdf/terms/fresnel.h"
#  include "bsdf/terms/masking.h"

/* ---- bits ---- */

VNDF_INLINE void clear_bits(vndf_sample_bits *bits)
{
    memset(bits, 0, sizeof *bits);
}

VNDF_INLINE void set_bits(vndf_sample_bits *bits, uint32_t first, uint32_t mask)
{
    bits->of[first / 32] |= mask << first % 32;
}

VNDF_INLINE uint32_t bits_at(const vndf_sample_bits *bits, uint32_t first)
{
    return bits->of[first / 32] >> first % 32;
}

/* ---- results ---- */

/* 1 for each bit of eight, in bytes. */
VNDF_INLINE uint64_t bytes_of_bits(uint32_t bits)
{
    uint64_t each = (bits & 0xffu) * UINT64_C(0x0101010101010101) & UINT64_C(0x8040201008040201);
    return (each + UINT64_C(0x7f7f7f7f7f7f7f7f)) >> 7 & UINT64_C(0x0101010101010101);
}

VNDF_INLINE void store_lobes(uint8_t *to, lanes_m reflected)
{
    uint32_t bits = lanes_mask_bits(reflected);
    for (int n = 0; n < VNDF_LANES; n += 8) {
        uint64_t lobes = VNDF_LOBE_REFLECTION * bytes_of_bits(bits >> n);
        memcpy(to + n, &lobes, sizeof lobes);
    }
}

/* Other lanes are lost: they go up. */
VNDF_INLINE void store_direction(vndf_normals to, uint32_t i, lanes_m m, vndf_vec3_lanes w, lanes_f z,
                                 float otherwise)
{
    lanes_store(to.x + i, lanes_keep(m, w.x));
    lanes_store(to.y + i, lanes_keep(m, w.y));
    lanes_store(to.z + i, lanes_pick(m, z, lanes_set(otherwise)));
}

VNDF_INLINE lanes_f finite(lanes_f x)
{
    const lanes_f most = lanes_set(FLT_MAX);
    return lanes_pick(lanes_less(x, most), x, lanes_keep(lanes_less(lanes_set(0.0f), x), most));
}

VNDF_INLINE lanes_f positive(lanes_f x)
{
    return lanes_least(lanes_most(x, lanes_set(FLT_MIN)), lanes_set(FLT_MAX));
}

/* ---- hits ---- */

/* A group's hits: which of them see the surface, and which of these float knows. */
typedef struct hits {
    vndf_incident at;
    lanes_f side;
    lanes_m seen, known;
} hits;

VNDF_INLINE hits shared_hits(const vndf_bsdf *b)
{
    const vndf_view *v = &b->view;
    hits h = {{v->distribution,
               {lanes_set(v->wi.x), lanes_set(v->wi.y), lanes_set(v->wi.z)},
               lanes_set(v->ax),
               lanes_set(v->ay),
               lanes_set(b->area),
               b->material->turn,
               v->trusted ? lanes_all() : lanes_none()},
              lanes_set(b->side),
              lanes_all(),
              lanes_all()};
    return h;
}

VNDF_INLINE hits hits_at(const vndf_scatter_block *b, uint32_t i)
{
    const vndf_material *m = b->material;
    const vndf_distribution *d = m->is.distribution;
    float scale = vndf_unit_scale_float(d);
    lanes_f x = lanes_load(b->in[VNDF_SCATTER_WI_X] + i), y = lanes_load(b->in[VNDF_SCATTER_WI_Y] + i);
    lanes_f z = lanes_load(b->in[VNDF_SCATTER_WI_Z] + i), one = lanes_set(1.0f);
    lanes_f up = m->two_sided ? lanes_abs(z) : z, square = x * x + y * y + up * up;
    hits h = {.at = {.distribution = d, .wi = {x, y, up}, .turn = m->turn, .trusted = lanes_all()}};
    h.at.ax = lanes_load(b->in[VNDF_SCATTER_ALPHA_X] + i) * scale;
    h.at.ay = lanes_load(b->in[VNDF_SCATTER_ALPHA_Y] + i) * scale;
    h.side = m->two_sided ? lanes_pick(lanes_less(z, lanes_set(0.0f)), -one, one) : one;
    h.at.area = vndf_law_seen_area(d, h.at.ax, h.at.ay, x, y, up, &h.at.trusted);
    h.seen = lanes_both(vndf_is_near_unit_square(square), lanes_less(lanes_set(0.0f), up));
    h.known = lanes_both(h.seen, h.at.trusted);
    return h;
}

VNDF_INLINE vndf_bsdf_normal normals_at(const vndf_scatter_block *b, const vndf_incident *at, uint32_t i)
{
    const vndf_drawn_block *d = b->drawn;
    vndf_vec3_lanes wi = at->wi, wm = {lanes_load(d->x + i), lanes_load(d->y + i), lanes_load(d->z + i)};
    lanes_f facing = wi.x * wm.x + wi.y * wm.y + wi.z * wm.z;
    vndf_bsdf_normal n = {wm, lanes_load(d->density + i), facing, at->area * lanes_load(d->weight + i),
                          lanes_load(b->in[VNDF_SCATTER_U2] + i)};
    return n;
}

/* ---- reflections ---- */

/* Reflections of a group: those that are scattered, their direction, area and density. */
typedef struct reflections {
    vndf_vec3_lanes wo;
    lanes_f area, density;
    lanes_m good, left;
} reflections;

VNDF_INLINE reflections reflect(const hits *h, const vndf_bsdf_normal *n, vndf_choice choice)
{
    reflections r;
    lanes_m ready;
    r.wo = vndf_reflected(h->at.wi, n->wm, n->facing);
    lanes_m up = lanes_less(lanes_set(0.0f), r.wo.z), met = lanes_both(h->known, up);
    vndf_reflection_trust trust = vndf_trust_reflection(&h->at, n, choice);
    r.area = vndf_law_area_above(h->at.distribution, h->at.ax, h->at.ay, r.wo.x, r.wo.y, r.wo.z, &ready);
    r.density = vndf_reflected_density(&h->at, n, r.wo, trust.as_drawn);
    r.good = lanes_both(met, lanes_both(trust.trusted, ready));
    r.left = lanes_either(lanes_without(h->seen, h->known), lanes_without(met, r.good));
    return r;
}

/* ---- bare reflection ---- */

static void scatter_bare(vndf_scatter_block *b)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 1};
    const vndf_scattered_n *to = &b->to;
    hits shared;
    if (b->hit)
        shared = shared_hits(b->hit);
    for (uint32_t i = 0; i < b->count; i += VNDF_LANES) {
        hits h = b->hit ? shared : hits_at(b, i);
        vndf_bsdf_normal n = normals_at(b, &h.at, i);
        reflections r = reflect(&h, &n, choice);
        lanes_f weight = finite(r.wo.z * n.quotient / vndf_unmasked(&h.at, r.wo, r.area));
        weight = lanes_keep(r.good, weight);
        for (int k = 0; k < b->material->is.wavelengths; k++)
            lanes_store(to->weight[k] + i, weight);
        lanes_store(to->density + i, lanes_keep(r.good, positive(r.density)));
        store_direction(to->wo, i, r.good, r.wo, r.wo.z, 1.0f);
        if (to->wm.x)
            store_direction(to->wm, i, r.good, n.wm, n.wm.z, 0.0f);
        store_lobes(to->lobe + i, r.good);
        set_bits(&b->left, i, lanes_mask_bits(r.left));
    }
}

/* ---- reflection ---- */

/* What the first loop leaves to the others. */
typedef struct work {
    float cos_i[VNDF_SCATTER_BLOCK], cos_o[VNDF_SCATTER_BLOCK], area_i[VNDF_SCATTER_BLOCK];
    float area_o[VNDF_SCATTER_BLOCK], facing[VNDF_SCATTER_BLOCK], quotient[VNDF_SCATTER_BLOCK];
    float side[VNDF_SCATTER_BLOCK], weight[VNDF_SCATTER_BLOCK], f[VNDF_WAVELENGTHS][VNDF_SCATTER_BLOCK];
    vndf_sample_bits good;
} work;

static void reflect_block(vndf_scatter_block *b, work *w)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 0};
    const vndf_scattered_n *to = &b->to;
    hits shared;
    if (b->hit)
        shared = shared_hits(b->hit);
    for (uint32_t i = 0; i < b->count; i += VNDF_LANES) {
        hits h = b->hit ? shared : hits_at(b, i);
        vndf_bsdf_normal n = normals_at(b, &h.at, i);
        reflections r = reflect(&h, &n, choice);
        lanes_store(w->cos_i + i, h.at.wi.z);
        lanes_store(w->cos_o + i, r.wo.z);
        lanes_store(w->area_i + i, h.at.area);
        lanes_store(w->area_o + i, r.area);
        lanes_store(w->facing + i, n.facing);
        lanes_store(w->quotient + i, n.quotient);
        lanes_store(w->side + i, h.side);
        lanes_store(to->density + i, lanes_keep(r.good, positive(r.density)));
        store_direction(to->wo, i, r.good, r.wo, h.side * r.wo.z, 1.0f);
        if (to->wm.x)
            store_direction(to->wm, i, r.good, n.wm, h.side * n.wm.z, 0.0f);
        store_lobes(to->lobe + i, r.good);
        set_bits(&w->good, i, lanes_mask_bits(r.good));
        set_bits(&b->left, i, lanes_mask_bits(r.left));
    }
}

/* The index ratio from the side of wi (vndf_bsdf). */
VNDF_INLINE doubles eta_at(const vndf_material *m, const work *w, uint32_t i)
{
    const doubles above = doubles_set(m->two_sided ? (double)m->is.eta : 1.0);
    if (!m->two_sided)
        return above;
    return doubles_pick(doubles_less(doubles_load(w->side + i), doubles_set(0.0)), 1.0 / above, above);
}

static void weigh_block(vndf_scatter_block *b, work *w)
{
    const vndf_material *m = b->material;
    for (uint32_t i = 0; i < b->count; i += VNDF_DOUBLES) {
        doubles cos_o = doubles_load(w->cos_o + i), facing = doubles_load(w->facing + i), eta = eta_at(m, w, i);
        doubles seen = vndf_height_correlated(doubles_load(w->cos_i + i), cos_o, doubles_load(w->area_i + i),
                                              doubles_load(w->area_o + i));
        doubles_store_f(w->weight + i, doubles_narrow(seen * cos_o * doubles_load(w->quotient + i)));
        for (int k = 0; k < m->is.wavelengths; k++)
            doubles_store_f(w->f[k] + i, doubles_narrow(vndf_reflectance_lanes(m, k, facing, eta)));
        uint32_t lost = doubles_mask_bits(vndf_loses_reflectance(facing, eta));
        set_bits(&b->left, i, lost & bits_at(&w->good, i));
    }
}

static void scatter_reflection(vndf_scatter_block *b)
{
    work w;
    clear_bits(&w.good);
    reflect_block(b, &w);
    weigh_block(b, &w);
    for (int k = 0; k < b->material->is.wavelengths; k++)
        for (uint32_t i = 0; i < b->count; i += VNDF_LANES) {
            lanes_f weight = finite(lanes_load(w.weight + i) * lanes_load(w.f[k] + i));
            lanes_store(b->to.weight[k] + i, lanes_keep(lanes_of_mask_bits(bits_at(&w.good, i)), weight));
        }
}

#  if VNDF_LANES == 16
void vndf_scatter_block_avx512(vndf_scatter_block *b)
#  else
void vndf_scatter_block_avx2(vndf_scatter_block *b)
#  endif
{
    clear_bits(&b->left);
    switch (b->material->routines->kind) {
    case VNDF_BLOCK_NONE: break;
    case VNDF_BLOCK_BARE: scatter_bare(b); break;
    case VNDF_BLOCK_REFLECTION: scatter_reflection(b); break;
    case VNDF_BLOCK_BOTH: break;
    }
}

#endif
