/* See lanes_scatter.h. Lanes past the end of a block work on numbers that are in memory, and nobody reads what they
 * make of them.
 *
 * Directions and densities of reflections are float; refractions, Fresnel terms and masking are double. So a block
 * goes through loops in turns: bare reflection through one in float; reflection through one that reflects, one in
 * double that weighs, and one that stores weights; both lobes through one for hits, one in double that chooses the
 * lobe and refracts, one that reflects, and the last two. */
#include "bsdf/batch/lanes_scatter.h"

#if VNDF_HAS_LANES && VNDF_LANES > 1

#  include "bsdf/batch/lanes_exact.h"

/* ---- results ---- */

/* 1 for each bit of eight, in bytes. */
VNDF_INLINE uint64_t bytes_of_bits(uint32_t bits)
{
    uint64_t each = (bits & 0xffu) * UINT64_C(0x0101010101010101) & UINT64_C(0x8040201008040201);
    return (each + UINT64_C(0x7f7f7f7f7f7f7f7f)) >> 7 & UINT64_C(0x0101010101010101);
}

VNDF_INLINE void store_lobes(uint8_t *to, lanes_m reflected, lanes_m transmitted)
{
    uint32_t back = lanes_mask_bits(reflected), through = lanes_mask_bits(transmitted);
    for (int n = 0; n < VNDF_LANES; n += 8) {
        uint64_t lobes = VNDF_LOBE_REFLECTION * bytes_of_bits(back >> n);
        lobes += VNDF_LOBE_TRANSMISSION * bytes_of_bits(through >> n);
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

/* Reflections of a group: their direction, its area and density; which are good, and which are `rough`, evaluated in
 * double (lanes_exact.h). */
typedef struct reflections {
    vndf_vec3_lanes wo;
    lanes_f area, density;
    lanes_m good, rough, left;
} reflections;

VNDF_INLINE reflections reflect(const vndf_hits *h, const vndf_bsdf_normal *n, vndf_choice choice)
{
    reflections r;
    lanes_m ready;
    r.wo = vndf_reflected(h->at.wi, n->wm, n->facing);
    lanes_m up = lanes_less(lanes_set(0.0f), r.wo.z), met = lanes_both(h->known, up);
    vndf_reflection_trust trust = vndf_trust_reflection(&h->at, n, choice);
    r.area = vndf_law_area_above(h->at.distribution, h->at.ax, h->at.ay, r.wo.x, r.wo.y, r.wo.z, &ready);
    r.density = vndf_reflected_density(&h->at, n, vndf_sum(h->at.wi, r.wo), trust.as_drawn);
    r.good = lanes_both(lanes_both(met, ready), trust.trusted);
    r.rough = lanes_without(lanes_both(met, ready), trust.trusted);
    r.left = lanes_either(lanes_without(h->seen, h->known), lanes_without(met, ready));
    return r;
}

/* The direction, facet and lobe of a group. */
VNDF_INLINE void store_reflections(const vndf_scattered_n *to, uint32_t i, const vndf_hits *h,
                                   const vndf_bsdf_normal *n, const reflections *r)
{
    lanes_m up = lanes_either(r->good, r->rough);
    store_direction(to->wo, i, up, r->wo, h->side * r->wo.z, 1.0f);
    if (to->wm.x)
        store_direction(to->wm, i, up, n->wm, h->side * n->wm.z, 0.0f);
    store_lobes(to->lobe + i, up, lanes_none());
}

/* ---- bare reflection ---- */

static void scatter_bare(vndf_scatter_block *b)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 1, 0};
    const vndf_scattered_n *to = &b->to;
    float area_i[VNDF_HIT_BLOCK], area_o[VNDF_HIT_BLOCK];
    vndf_sample_bits rough;
    vndf_hits shared;
    vndf_clear_bits(&rough);
    if (b->hit)
        shared = vndf_shared_hits(b->hit);
    for (uint32_t i = 0; i < b->count; i += VNDF_LANES) {
        vndf_hits h = b->hit ? shared : vndf_hits_at(b->material, b->in, i);
        vndf_bsdf_normal n = normals_at(b, &h.at, i);
        reflections r = reflect(&h, &n, choice);
        lanes_f weight = vndf_finite_lanes(r.wo.z * n.quotient / vndf_unmasked(&h.at, r.wo, r.area));
        weight = lanes_keep(r.good, weight);
        for (int k = 0; k < b->material->is.wavelengths; k++)
            lanes_store(to->weight[k] + i, weight);
        lanes_store(to->density + i, lanes_keep(r.good, vndf_positive_lanes(r.density)));
        store_reflections(to, i, &h, &n, &r);
        lanes_store(area_i + i, h.at.area);
        lanes_store(area_o + i, r.area);
        vndf_set_bits(&rough, i, lanes_mask_bits(r.rough));
        vndf_set_bits(&b->left, i, lanes_mask_bits(r.left));
    }
    vndf_scatter_exactly(b, &rough, area_i, area_o);
}

/* ---- what loops leave to the next ---- */

typedef struct work {
    float side[VNDF_HIT_BLOCK], cos_i[VNDF_HIT_BLOCK], area_i[VNDF_HIT_BLOCK];
    float cos_o[VNDF_HIT_BLOCK], area_o[VNDF_HIT_BLOCK]; /* of wo turned up */
    float facing[VNDF_HIT_BLOCK], quotient[VNDF_HIT_BLOCK];
    float weight[VNDF_HIT_BLOCK];                 /* without its part by wavelength, */
    float part[VNDF_WAVELENGTHS][VNDF_HIT_BLOCK]; /* which is here */
    vndf_sample_bits good, rough;
} work;

VNDF_INLINE void keep_hits(work *w, uint32_t i, const vndf_hits *h, const vndf_bsdf_normal *n)
{
    lanes_store(w->side + i, h->side);
    lanes_store(w->cos_i + i, h->at.wi.z);
    lanes_store(w->area_i + i, h->at.area);
    lanes_store(w->facing + i, n->facing);
    lanes_store(w->quotient + i, n->quotient);
}

/* Masking of reflections over both cosines. */
VNDF_INLINE doubles reflection_masking_at(const work *w, uint32_t i)
{
    return vndf_height_correlated(doubles_load(w->cos_i + i), doubles_load(w->cos_o + i),
                                  doubles_load(w->area_i + i), doubles_load(w->area_o + i));
}

VNDF_INLINE void store_weight(work *w, uint32_t i, doubles masking)
{
    doubles weight = masking * doubles_load(w->cos_o + i) * doubles_load(w->quotient + i);
    doubles_store_f(w->weight + i, doubles_narrow(weight));
}

/* `part` has one array for each wavelength, or one for all. */
static void store_weights(const vndf_scatter_block *b, const work *w, int parts)
{
    for (int k = 0; k < b->material->is.wavelengths; k++)
        for (uint32_t i = 0; i < b->count; i += VNDF_LANES) {
            lanes_f weight =
                vndf_finite_lanes(lanes_load(w->weight + i) * lanes_load(w->part[k < parts ? k : 0] + i));
            lanes_store(b->to.weight[k] + i, lanes_keep(lanes_of_mask_bits(vndf_bits_at(&w->good, i)), weight));
        }
}

/* ---- reflection ---- */

static void reflect_block(vndf_scatter_block *b, work *w)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 0, 0};
    const vndf_scattered_n *to = &b->to;
    vndf_hits shared;
    if (b->hit)
        shared = vndf_shared_hits(b->hit);
    for (uint32_t i = 0; i < b->count; i += VNDF_LANES) {
        vndf_hits h = b->hit ? shared : vndf_hits_at(b->material, b->in, i);
        vndf_bsdf_normal n = normals_at(b, &h.at, i);
        reflections r = reflect(&h, &n, choice);
        keep_hits(w, i, &h, &n);
        lanes_store(w->cos_o + i, r.wo.z);
        lanes_store(w->area_o + i, r.area);
        lanes_store(to->density + i, lanes_keep(r.good, vndf_positive_lanes(r.density)));
        store_reflections(to, i, &h, &n, &r);
        vndf_set_bits(&w->rough, i, lanes_mask_bits(r.rough));
        vndf_set_bits(&w->good, i, lanes_mask_bits(r.good));
        vndf_set_bits(&b->left, i, lanes_mask_bits(r.left));
    }
}

static void weigh_reflections(vndf_scatter_block *b, work *w)
{
    const vndf_material *m = b->material;
    for (uint32_t i = 0; i < b->count; i += VNDF_DOUBLES) {
        doubles facing = doubles_load(w->facing + i), eta = vndf_eta_at(m, w->side + i);
        store_weight(w, i, reflection_masking_at(w, i));
        for (int k = 0; k < m->is.wavelengths; k++)
            doubles_store_f(w->part[k] + i, doubles_narrow(vndf_reflectance_lanes(m, k, facing, eta)));
        uint32_t lost = doubles_mask_bits(vndf_loses_reflectance(facing, eta));
        vndf_set_bits(&w->rough, i, lost & vndf_bits_at(&w->good, i));
    }
}

static void scatter_reflection(vndf_scatter_block *b)
{
    work w;
    vndf_clear_bits(&w.good);
    vndf_clear_bits(&w.rough);
    reflect_block(b, &w);
    weigh_reflections(b, &w);
    store_weights(b, &w, VNDF_WAVELENGTHS);
    vndf_scatter_exactly(b, &w.rough, w.area_i, w.area_o);
}

/* ---- both lobes ---- */

enum { GROUPS = VNDF_HIT_BLOCK / VNDF_LANES };

/* The hits and normals of a block, the lobe that each sample takes, and where refraction takes it. */
typedef struct lobes {
    work w;
    vndf_hits hits[GROUPS];
    vndf_bsdf_normal normals[GROUPS];
    float x[VNDF_HIT_BLOCK], y[VNDF_HIT_BLOCK];          /* of wi */
    float wo[3][VNDF_HIT_BLOCK];                         /* refracted, its density, */
    float density[VNDF_HIT_BLOCK], turn[VNDF_HIT_BLOCK]; /* and how far it turns */
    float share[VNDF_HIT_BLOCK];                         /* of the samples, takes the lobe */
    vndf_sample_bits through, trusted;                   /* the lobe; whether cosines and F may be rounded */
} lobes;

static void find_hits(const vndf_scatter_block *b, lobes *l)
{
    vndf_hits shared;
    if (b->hit)
        shared = vndf_shared_hits(b->hit);
    for (uint32_t i = 0, g = 0; i < b->count; i += VNDF_LANES, g++) {
        vndf_hits h = b->hit ? shared : vndf_hits_at(b->material, b->in, i);
        vndf_bsdf_normal n = normals_at(b, &h.at, i);
        keep_hits(&l->w, i, &h, &n);
        lanes_store(l->x + i, h.at.wi.x);
        lanes_store(l->y + i, h.at.wi.y);
        l->hits[g] = h;
        l->normals[g] = n;
    }
}

VNDF_INLINE vndf_meeting meeting_at(const vndf_scatter_block *b, const lobes *l, uint32_t i)
{
    const vndf_drawn_block *d = b->drawn;
    vndf_normal wi = {doubles_load(l->x + i), doubles_load(l->y + i), doubles_load(l->w.cos_i + i)};
    vndf_normal wm = {doubles_load(d->x + i), doubles_load(d->y + i), doubles_load(d->z + i)};
    return vndf_meet(wi, wm);
}

VNDF_INLINE void refract(const vndf_scatter_block *b, lobes *l, uint32_t i, const vndf_meeting *at, doubles beyond,
                         doubles eta)
{
    doubles along = vndf_bend_along(at, beyond, eta);
    vndf_normal wo = vndf_bent(at, along, eta);
    doubles density = vndf_bent_density(at, doubles_load(b->drawn->density + i), beyond, eta);
    doubles_store_f(l->wo[0] + i, doubles_narrow(wo.x));
    doubles_store_f(l->wo[1] + i, doubles_narrow(wo.y));
    doubles_store_f(l->wo[2] + i, doubles_narrow(wo.z));
    doubles_store_f(l->turn + i, doubles_narrow(doubles_abs(along / eta)));
    doubles_store_f(l->density + i, vndf_density_of(density));
}

/* Chooses lobes as the call of one does (lobes/dielectric.c), and refracts. */
static void choose_lobes(const vndf_scatter_block *b, lobes *l)
{
    const vndf_material *m = b->material;
    const doubles one = doubles_set(1.0), nothing = doubles_set(0.0);
    for (uint32_t i = 0; i < b->count; i += VNDF_DOUBLES) {
        vndf_meeting at = meeting_at(b, l, i);
        doubles eta = vndf_eta_at(m, l->w.side + i), f = vndf_reflectance_lanes(m, 0, at.facing, eta),
                part = vndf_mean_lanes(m, f);
        doubles square = vndf_refracted_square(at.facing, eta), beyond = doubles_root(square);
        doubles_m passes = doubles_both(doubles_less(part, one), doubles_less(nothing, square));
        doubles_m back = doubles_both(doubles_less(nothing, part),
                                      doubles_less(doubles_load(b->in[VNDF_SCATTER_U3] + i), part));
        doubles_m through = doubles_without(passes, back), loses = vndf_loses_reflectance(at.facing, eta);
        doubles share, weight = vndf_lobe_weight(m, f, eta, through, &share);
        uint32_t bits = doubles_mask_bits(through), bent = doubles_mask_bits(vndf_trusts_refraction(&at, beyond));
        doubles_store_f(l->share + i, doubles_narrow(share));
        doubles_store_f(l->w.part[0] + i, doubles_narrow(weight));
        vndf_set_bits(&l->through, i, bits);
        vndf_set_bits(&l->trusted, i,
                      (bits & bent) | (~(bits | doubles_mask_bits(loses)) & ((1u << VNDF_DOUBLES) - 1)));
        refract(b, l, i, &at, beyond, eta);
    }
}

/* The lobe of each sample of a group, its direction and its density, stored where it is good. */
static void follow_lobes(vndf_scatter_block *b, lobes *l)
{
    const vndf_choice choice = {VNDF_NORMALS_VISIBLE, 0, 0};
    const vndf_scattered_n *to = &b->to;
    const lanes_f nothing = lanes_set(0.0f);
    for (uint32_t i = 0, g = 0; i < b->count; i += VNDF_LANES, g++) {
        const vndf_hits *h = &l->hits[g];
        const vndf_bsdf_normal *n = &l->normals[g];
        lanes_m through = lanes_of_mask_bits(vndf_bits_at(&l->through, i)), ready;
        lanes_m trusted = lanes_of_mask_bits(vndf_bits_at(&l->trusted, i));
        vndf_vec3_lanes back = vndf_reflected(h->at.wi, n->wm, n->facing);
        vndf_vec3_lanes up = {lanes_pick(through, lanes_load(l->wo[0] + i), back.x),
                              lanes_pick(through, lanes_load(l->wo[1] + i), back.y),
                              lanes_pick(through, nothing - lanes_load(l->wo[2] + i), back.z)};
        vndf_reflection_trust trust = vndf_trust_reflection(&h->at, n, choice);
        lanes_m settled = vndf_is_settled(&h->at, n, vndf_refraction_gain(lanes_load(l->turn + i), n->wm.z));
        lanes_f area = vndf_law_area_above(h->at.distribution, h->at.ax, h->at.ay, up.x, up.y, up.z, &ready);
        lanes_f density = lanes_pick(through, lanes_load(l->density + i),
                                     vndf_reflected_density(&h->at, n, vndf_sum(h->at.wi, back), trust.as_drawn));
        lanes_m met = lanes_both(h->known, lanes_less(nothing, up.z));
        met = lanes_without(met, lanes_without(through, lanes_less(nothing, n->facing)));
        lanes_m sure = lanes_either(lanes_both(through, settled), lanes_without(trust.trusted, through));
        lanes_m asked = lanes_both(met, ready), good = lanes_both(asked, lanes_both(trusted, sure));
        lanes_f side = lanes_pick(through, nothing - h->side, h->side);
        lanes_store(l->w.cos_o + i, up.z);
        lanes_store(l->w.area_o + i, area);
        lanes_store(to->density + i, lanes_keep(good, vndf_positive_lanes(density * lanes_load(l->share + i))));
        store_direction(to->wo, i, asked, up, side * up.z, 1.0f);
        if (to->wm.x)
            store_direction(to->wm, i, asked, n->wm, h->side * n->wm.z, 0.0f);
        store_lobes(to->lobe + i, lanes_without(asked, through), lanes_both(asked, through));
        lanes_m left = lanes_either(lanes_without(h->seen, h->known), lanes_without(met, ready));
        vndf_set_bits(&l->w.good, i, lanes_mask_bits(good));
        vndf_set_bits(&l->w.rough, i, lanes_mask_bits(lanes_without(asked, good)));
        vndf_set_bits(&b->left, i, lanes_mask_bits(left));
    }
}

VNDF_INLINE doubles transmission_masking_at(const vndf_scatter_block *b, const lobes *l, uint32_t i,
                                            doubles_m *ready)
{
    const vndf_slants_of of = {{l->x + i, l->y + i, l->w.cos_i + i},
                               {l->wo[0] + i, l->wo[1] + i, l->w.cos_o + i},
                               l->w.area_i + i,
                               l->w.area_o + i,
                               b->in[VNDF_HIT_ALPHA_X] + i,
                               b->in[VNDF_HIT_ALPHA_Y] + i};
    doubles cos_i = doubles_load(l->w.cos_i + i), cos_o = doubles_load(l->w.cos_o + i);
    return vndf_transmission_masking(b->material->is.distribution, &of, cos_i, cos_o, ready);
}

static void weigh_lobes(vndf_scatter_block *b, lobes *l)
{
    for (uint32_t i = 0; i < b->count; i += VNDF_DOUBLES) {
        uint32_t bits = vndf_bits_at(&l->through, i) & vndf_bits_at(&l->w.good, i) & ((1u << VNDF_DOUBLES) - 1);
        doubles masking = reflection_masking_at(&l->w, i);
        if (bits) {
            doubles_m through = doubles_of_mask_bits(bits), ready = through;
            masking = doubles_pick(through, transmission_masking_at(b, l, i, &ready), masking);
            vndf_set_bits(&b->left, i, bits & ~doubles_mask_bits(ready));
        }
        store_weight(&l->w, i, masking);
    }
}

static void scatter_both(vndf_scatter_block *b)
{
    lobes l;
    vndf_clear_bits(&l.w.good);
    vndf_clear_bits(&l.w.rough);
    vndf_clear_bits(&l.through);
    vndf_clear_bits(&l.trusted);
    find_hits(b, &l);
    choose_lobes(b, &l);
    follow_lobes(b, &l);
    weigh_lobes(b, &l);
    store_weights(b, &l.w, 1);
    vndf_scatter_exactly(b, &l.w.rough, l.w.area_i, l.w.area_o);
}

#  if VNDF_LANES == 16
void vndf_scatter_block_avx512(vndf_scatter_block *b)
#  else
void vndf_scatter_block_avx2(vndf_scatter_block *b)
#  endif
{
    vndf_clear_bits(&b->left);
    switch (b->material->routines->kind) {
    case VNDF_BLOCK_NONE: break;
    case VNDF_BLOCK_BARE: scatter_bare(b); break;
    case VNDF_BLOCK_REFLECTION: scatter_reflection(b); break;
    case VNDF_BLOCK_BOTH: scatter_both(b); break;
    }
}

#endif
