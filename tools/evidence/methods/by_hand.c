/* Bare reflection by hand, as someone would write it who wants nothing else: a visible normal, wi mirrored at
 * it, and G2/G1 of height-correlated masking,
 *
 *     weight = D(wm) (wi.wm)/pdf(wm) cos_o/(cos_o A(wi) + cos_i (A(wo) - cos_o)),
 *
 * where D (wi.wm)/pdf is A(wi) except for tables, and A of GGX is (cos + |stretched w|)/2. Once over vndf.h; and
 * once for GGX without the library, by spherical caps as published (ggx.c). vndf_bsdf.h handles special cases
 * that this file does not, above all smooth surfaces, whose roughness is below the rounding of a direction. */
#include "evidence/effects.h"
#include "evidence/methods/vector.h"

static inline float ggx_area(const vndf_surface *s, vndf_vec3 w)
{
    float x = s->alpha_x * w.x, y = s->alpha_y * w.y;
    return 0.5f * (w.z + sqrtf(x * x + y * y + w.z * w.z));
}

/* What a user knows of a distribution, asked once for a loop. */
typedef enum hand_kind { HAND_GGX, HAND_CLOSED, HAND_TABLE } hand_kind;

static hand_kind kind_of(const vndf_surface *s)
{
    return s->distribution == vndf_ggx()                       ? HAND_GGX
           : vndf_distribution_info(s->distribution).bytes > 0 ? HAND_TABLE
                                                               : HAND_CLOSED;
}

static inline float area_of(const vndf_surface *s, vndf_vec3 w, hand_kind kind)
{
    return kind == HAND_GGX ? ggx_area(s, w) : vndf_projected_area(s, w);
}

/* G2/(cos_i cos_o), of A(wi) and A(wo). */
static inline float masking(vndf_vec3 wi, float area_i, vndf_vec3 wo, float area_o)
{
    return 1.0f / (wo.z * area_i + wi.z * (area_o - wo.z));
}

static inline vndf_vec3 half_of(vndf_vec3 wi, vndf_vec3 wo)
{
    return method_unit(wi.x + wo.x, wi.y + wo.y, wi.z + wo.z);
}

static inline vndf_vec3 mirrored(vndf_vec3 wi, vndf_vec3 wm, float facing)
{
    float twice = 2.0f * facing;
    return (vndf_vec3){twice * wm.x - wi.x, twice * wm.y - wi.y, twice * wm.z - wi.z};
}

static const vndf_surface *surface_of(const method *m)
{
    const effect_case *of = m->state;
    return &of->surface;
}

/* ---- over vndf.h --------------------------------------------------------------------------------- */

/* The view is not part of a struct with wi and the area: the processor would wait for the copy. */
static inline void sample(const vndf_surface *s, const vndf_view *view, vndf_vec3 wi, float area, const float u[3],
                          vndf_scattered *out, hand_kind kind)
{
    float pdf, quotient = area;
    vndf_vec3 wm = vndf_sample(view, u[0], u[1], &pdf);
    float facing = method_dot(wi, wm);
    vndf_vec3 wo = mirrored(wi, wm, facing);
    if (!(wo.z > 0.0f)) {
        *out = (vndf_scattered){.wo = {0, 0, 1}};
        return;
    }
    if (kind == HAND_TABLE)
        quotient = vndf_ndf(s, wm) * facing / pdf;
    float weight = quotient * wo.z * masking(wi, area, wo, area_of(s, wo, kind));
    *out = (vndf_scattered){wo, {weight, weight, weight}, pdf / (4.0f * facing), VNDF_LOBE_REFLECTION, wm};
}

/* (A copy of wi would be stored by floats and loaded whole, for which the processor waits: method.h.) */
static void each(const method *m, block *b, size_t first, size_t count)
{
    const vndf_surface *s = surface_of(m);
    hand_kind kind = kind_of(s);
    for (size_t i = first; i < first + count; i++) {
        const method_input *in = &b->in[i];
        vndf_view view = vndf_view_from(s, in->wi);
        sample(s, &view, in->wi, area_of(s, in->wi, kind), in->u, &b->out[i], kind);
    }
}

static void shared(const method *m, block *b, size_t first, size_t count)
{
    const vndf_surface *s = surface_of(m);
    hand_kind kind = kind_of(s);
    vndf_vec3 wi = b->in[first].wi;
    vndf_view view = vndf_view_from(s, wi);
    float area = area_of(s, wi, kind);
    for (size_t i = first; i < first + count; i++)
        sample(s, &view, wi, area, b->in[i].u, &b->out[i], kind);
}

static void eval(const method *m, block *b, size_t first, size_t count)
{
    const vndf_surface *s = surface_of(m);
    hand_kind kind = kind_of(s);
    vndf_vec3 wi = b->in[first].wi;
    float area = area_of(s, wi, kind);
    for (size_t i = first; i < first + count; i++) {
        vndf_vec3 wo = b->in[i].given;
        float f = 0.25f * vndf_ndf(s, half_of(wi, wo)) * masking(wi, area, wo, area_of(s, wo, kind));
        b->out[i].weight[0] = b->out[i].weight[1] = b->out[i].weight[2] = f;
    }
}

static void density(const method *m, block *b, size_t first, size_t count)
{
    vndf_vec3 wi = b->in[first].wi;
    vndf_view view = vndf_view_from(surface_of(m), wi);
    for (size_t i = first; i < first + count; i++) {
        vndf_vec3 wm = half_of(wi, b->in[i].given);
        b->out[i].density = vndf_pdf(&view, wm) / (4.0f * method_dot(wi, wm));
    }
}

/* ---- GGX without the library --------------------------------------------------------------------- */

typedef struct caps_hit {
    vndf_vec3 wi, w;           /* w: stretched, of unit length */
    float ax, ay, area, scale; /* scale: 1/(pi ax ay) */
} caps_hit;

static inline caps_hit caps_at(const method *m, vndf_vec3 wi)
{
    const vndf_surface *s = surface_of(m);
    float ax = s->alpha_x, ay = s->alpha_y, area = ggx_area(s, wi), per = 1.0f / (2.0f * area - wi.z);
    return (caps_hit){
        wi, {ax * wi.x * per, ay * wi.y * per, wi.z * per}, ax, ay, area, 1.0f / (method_pi * ax * ay)};
}

static inline float caps_ndf(const caps_hit *hit, vndf_vec3 wm)
{
    float x = wm.x / hit->ax, y = wm.y / hit->ay, across = x * x + y * y + wm.z * wm.z;
    return hit->scale / (across * across);
}

static inline void caps_sample(const vndf_surface *s, const caps_hit *hit, const float u[3], vndf_scattered *out)
{
    float phi = 2.0f * method_pi * u[0], z = (1.0f - u[1]) * (1.0f + hit->w.z) - hit->w.z;
    float across = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    vndf_vec3 wm = method_unit(hit->ax * (across * cosf(phi) + hit->w.x),
                               hit->ay * (across * sinf(phi) + hit->w.y), z + hit->w.z);
    vndf_vec3 wo = mirrored(hit->wi, wm, method_dot(hit->wi, wm));
    if (!(wo.z > 0.0f)) {
        *out = (vndf_scattered){.wo = {0, 0, 1}};
        return;
    }
    float weight = hit->area * wo.z * masking(hit->wi, hit->area, wo, ggx_area(s, wo));
    *out = (vndf_scattered){
        wo, {weight, weight, weight}, caps_ndf(hit, wm) / (4.0f * hit->area), VNDF_LOBE_REFLECTION, wm};
}

static void caps_each(const method *m, block *b, size_t first, size_t count)
{
    for (size_t i = first; i < first + count; i++) {
        caps_hit hit = caps_at(m, b->in[i].wi);
        caps_sample(surface_of(m), &hit, b->in[i].u, &b->out[i]);
    }
}

static void caps_shared(const method *m, block *b, size_t first, size_t count)
{
    caps_hit hit = caps_at(m, b->in[first].wi);
    for (size_t i = first; i < first + count; i++)
        caps_sample(surface_of(m), &hit, b->in[i].u, &b->out[i]);
}

static void caps_eval(const method *m, block *b, size_t first, size_t count)
{
    const vndf_surface *s = surface_of(m);
    caps_hit hit = caps_at(m, b->in[first].wi);
    for (size_t i = first; i < first + count; i++) {
        vndf_vec3 wo = b->in[i].given;
        float f = 0.25f * caps_ndf(&hit, half_of(hit.wi, wo)) * masking(hit.wi, hit.area, wo, ggx_area(s, wo));
        b->out[i].weight[0] = b->out[i].weight[1] = b->out[i].weight[2] = f;
    }
}

static void caps_density(const method *m, block *b, size_t first, size_t count)
{
    caps_hit hit = caps_at(m, b->in[first].wi);
    float scale = 0.25f / hit.area;
    for (size_t i = first; i < first + count; i++)
        b->out[i].density = caps_ndf(&hit, half_of(hit.wi, b->in[i].given)) * scale;
}

void method_by_hand(method *m)
{
    const effect_case *of = m->state;
    int is_caps = of->set->kind == EFFECT_BY_CAPS;
    m->each = is_caps ? caps_each : each;
    m->shared = is_caps ? caps_shared : shared;
    m->eval = is_caps ? caps_eval : eval;
    m->density = is_caps ? caps_density : density;
}
