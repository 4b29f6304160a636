/* The hits of a group of lanes, and the terms of their events, for lanes_scatter.c and lanes_look.c. */
#ifndef VNDF_BSDF_BATCH_LANES_HITS_H
#define VNDF_BSDF_BATCH_LANES_HITS_H

#include "bsdf/batch/block.h"
#include "bsdf/terms/beta.h"
#include "bsdf/terms/event.h"
#include "bsdf/terms/fresnel.h"
#include "bsdf/terms/masking.h"
#include "sampler/area.h"

/* ---- numbers ---- */

VNDF_INLINE lanes_f vndf_finite_lanes(lanes_f x)
{
    const lanes_f most = lanes_set(FLT_MAX);
    return lanes_pick(lanes_less(x, most), x, lanes_keep(lanes_less(lanes_set(0.0f), x), most));
}

VNDF_INLINE lanes_f vndf_positive_lanes(lanes_f x)
{
    return lanes_least(lanes_most(x, lanes_set(FLT_MIN)), lanes_set(FLT_MAX));
}

/* ---- hits ---- */

/* A group's hits: which of them see the surface, and which of these float knows. */
typedef struct vndf_hits {
    vndf_incident at;
    lanes_f side;
    lanes_m seen, known;
} vndf_hits;

VNDF_INLINE vndf_hits vndf_shared_hits(const vndf_bsdf *b)
{
    const vndf_view *v = &b->view;
    vndf_hits h = {{v->distribution,
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

/* `in` is in the order of block.h. */
VNDF_INLINE vndf_hits vndf_hits_at(const vndf_material *m, const float *const *in, uint32_t i)
{
    const vndf_distribution *d = m->is.distribution;
    float scale = vndf_unit_scale_float(d);
    lanes_f x = lanes_load(in[VNDF_HIT_WI_X] + i), y = lanes_load(in[VNDF_HIT_WI_Y] + i);
    lanes_f z = lanes_load(in[VNDF_HIT_WI_Z] + i), one = lanes_set(1.0f);
    lanes_f up = m->two_sided ? lanes_abs(z) : z, square = x * x + y * y + up * up;
    vndf_hits h = {.at = {.distribution = d, .wi = {x, y, up}, .turn = m->turn, .trusted = lanes_all()}};
    h.at.ax = lanes_load(in[VNDF_HIT_ALPHA_X] + i) * scale;
    h.at.ay = lanes_load(in[VNDF_HIT_ALPHA_Y] + i) * scale;
    h.side = m->two_sided ? lanes_pick(lanes_less(z, lanes_set(0.0f)), -one, one) : one;
    h.at.area = vndf_law_seen_area(d, h.at.ax, h.at.ay, x, y, up, &h.at.trusted);
    h.seen = lanes_both(vndf_is_near_unit_square(square), lanes_less(lanes_set(0.0f), up));
    h.known = lanes_both(h.seen, h.at.trusted);
    return h;
}

/* ---- terms in double ---- */

/* The index ratio from the side of wi (vndf_bsdf). */
VNDF_INLINE doubles vndf_eta_at(const vndf_material *m, const float *side)
{
    const doubles above = doubles_set(m->two_sided ? (double)m->is.eta : 1.0);
    if (!m->two_sided)
        return above;
    return doubles_pick(doubles_less(doubles_load(side), doubles_set(0.0)), 1.0 / above, above);
}

/* What transmission has more than for importance (vndf_bsdf). */
VNDF_INLINE doubles vndf_carried_at(const vndf_material *m, doubles eta)
{
    if (m->is.effects.transport == VNDF_TRANSPORT_RADIANCE)
        return 1.0 / (eta * eta);
    return doubles_set(1.0);
}

/* F is the same of all wavelengths; its mean is summed as vndf_mean_of sums it. */
VNDF_INLINE doubles vndf_mean_lanes(const vndf_material *m, doubles f)
{
    doubles sum = f;
    for (int k = 1; k < m->is.wavelengths; k++)
        sum += f;
    return sum * m->per_wavelength;
}

/* Of both lobes: the part *share of the samples that takes the lobe, and the weight's part F/share, or (1 - F)/share
 * with what transmission carries. */
VNDF_INLINE doubles vndf_lobe_weight(const vndf_material *m, doubles f, doubles eta, doubles_m through,
                                     doubles *share)
{
    doubles mean = vndf_mean_lanes(m, f);
    *share = doubles_pick(through, 1.0 - mean, mean);
    doubles weight = doubles_pick(through, 1.0 - f, f) / *share;
    return doubles_pick(through, vndf_carried_at(m, eta) * weight, weight);
}

VNDF_INLINE doubles vndf_at_least_one(doubles x)
{
    const doubles one = doubles_set(1.0);
    return doubles_pick(doubles_less(one, x), x, one);
}

/* Where both directions, turned up, their areas in float and the roughness are read. */
typedef struct vndf_slants_of {
    const float *wi[3], *wo[3], *area_i, *area_o, *alpha_x, *alpha_y;
} vndf_slants_of;

VNDF_INLINE doubles vndf_exact_area(const vndf_distribution *d, doubles ax, doubles ay, const float *const w[3])
{
    vndf_direction direction = {ax, ay, doubles_load(w[0]), doubles_load(w[1]), doubles_load(w[2])};
    return doubles_widen(vndf_area_of(d, &direction));
}

/* Masking of transmissions over both cosines (terms/masking.c). Clears *ready where Beta is not for lanes. */
VNDF_INLINE doubles vndf_transmission_masking(const vndf_distribution *d, const vndf_slants_of *of, doubles cos_i,
                                              doubles cos_o, doubles_m *ready)
{
    double scale = vndf_unit_scale(d);
    doubles i = doubles_load(of->area_i) / cos_i, o = doubles_load(of->area_o) / cos_o;
    doubles_m exact = doubles_both(*ready, vndf_needs_exact_areas(i, o));
    if (doubles_any(exact)) {
        doubles ax = doubles_load(of->alpha_x) * scale;
        doubles ay = doubles_load(of->alpha_y) * scale;
        i = doubles_pick(exact, vndf_exact_area(d, ax, ay, of->wi) / cos_i, i);
        o = doubles_pick(exact, vndf_exact_area(d, ax, ay, of->wo) / cos_o, o);
    }
    return vndf_beta_lanes(vndf_at_least_one(i), vndf_at_least_one(o), ready) / (cos_i * cos_o);
}

#endif
