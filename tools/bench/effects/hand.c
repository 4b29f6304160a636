/* Bare reflection over vndf.h, as a user would write it who wants nothing else: a visible normal, wi mirrored at
 * it, and G2/G1 of height-correlated masking,
 *
 *     weight = D(wm) (wi.wm)/pdf(wm) cos_o/(cos_o A(wi) + cos_i (A(wo) - cos_o)),
 *
 * where D (wi.wm)/pdf is A(wi) except for tables, and A of GGX is (cos + |stretched w|)/2. vndf_bsdf.h handles special
 * cases that this file does not, above all smooth surfaces, whose roughness is below the rounding of a direction. It is
 * compiled without vector loops, as method_*.c are. */
#include "bench/methods/vector.h"

#include "bench/effects/effects.h"

/* GGX with an area of its own; other closed forms; tables. */
typedef enum hand_kind { HAND_GGX, HAND_CLOSED, HAND_TABLE } hand_kind;

/* `kind` is a constant in all of these. */
static inline float area_of(const vndf_surface *s, vndf_vec3 w, hand_kind kind)
{
    if (kind != HAND_GGX)
        return vndf_projected_area(s, w);
    float x = s->alpha_x * w.x, y = s->alpha_y * w.y;
    return 0.5f * (w.z + sqrtf(x * x + y * y + w.z * w.z));
}

/* G2/(cos_i cos_o), where `area` is A(wi). */
static inline float masking(const vndf_surface *s, vndf_vec3 wi, float area, vndf_vec3 wo, hand_kind kind)
{
    return 1.0f / (wo.z * area + wi.z * (area_of(s, wo, kind) - wo.z));
}

/* The view is not part of a struct with wi and the area: the processor would wait for the copy. */
static inline void sample(const vndf_surface *s, const vndf_view *view, vndf_vec3 wi, float area, const float u[3],
                          vndf_scattered *out, hand_kind kind)
{
    float pdf, quotient = area;
    vndf_vec3 wm = vndf_sample(view, u[0], u[1], &pdf);
    float facing = method_dot(wi, wm), twice = 2.0f * facing;
    vndf_vec3 wo = {twice * wm.x - wi.x, twice * wm.y - wi.y, twice * wm.z - wi.z};
    if (!(wo.z > 0.0f)) {
        *out = (vndf_scattered){.wo = {0, 0, 1}};
        return;
    }
    if (kind == HAND_TABLE)
        quotient = vndf_ndf(s, wm) * facing / pdf;
    float weight = quotient * wo.z * masking(s, wi, area, wo, kind);
    *out = (vndf_scattered){wo, {weight, weight, weight}, pdf / (4.0f * facing), VNDF_LOBE_REFLECTION, wm};
}

static inline vndf_vec3 half_of(vndf_vec3 wi, vndf_vec3 wo)
{
    return method_unit(wi.x + wo.x, wi.y + wo.y, wi.z + wo.z);
}

/* ---- loops -------------------------------------------------------------------------------------- */

static inline void each_of(const effects_job *job, hand_kind kind)
{
    const vndf_surface *s = &job->of->surface;
    for (size_t i = 0; i < job->count; i++) {
        const effects_input *in = &job->in[i];
        vndf_view view = vndf_view_from(s, in->wi);
        sample(s, &view, in->wi, area_of(s, in->wi, kind), in->u, &job->out[i], kind);
    }
}

static inline void shared_of(const effects_job *job, hand_kind kind)
{
    const vndf_surface *s = &job->of->surface;
    vndf_vec3 wi = job->in[0].wi;
    vndf_view view = vndf_view_from(s, wi);
    float area = area_of(s, wi, kind);
    for (size_t i = 0; i < job->count; i++)
        sample(s, &view, wi, area, job->in[i].u, &job->out[i], kind);
}

static inline void eval_of(const effects_job *job, hand_kind kind)
{
    const vndf_surface *s = &job->of->surface;
    vndf_vec3 wi = job->in[0].wi;
    float area = area_of(s, wi, kind);
    for (size_t i = 0; i < job->count; i++) {
        vndf_vec3 wo = job->in[i].wo;
        float f = 0.25f * vndf_ndf(s, half_of(wi, wo)) * masking(s, wi, area, wo, kind);
        for (int k = 0; k < 3; k++)
            job->out[i].weight[k] = f;
    }
}

/* ---- by distribution, asked once for a block --------------------------------------------------- */

static hand_kind kind_of(const effects_job *job)
{
    const vndf_distribution *d = job->of->surface.distribution;
    return d == vndf_ggx() ? HAND_GGX : vndf_distribution_info(d).bytes > 0 ? HAND_TABLE : HAND_CLOSED;
}

static void each(const effects_job *job)
{
    switch (kind_of(job)) {
    case HAND_GGX: each_of(job, HAND_GGX); break;
    case HAND_CLOSED: each_of(job, HAND_CLOSED); break;
    case HAND_TABLE: each_of(job, HAND_TABLE); break;
    }
}

static void shared(const effects_job *job)
{
    switch (kind_of(job)) {
    case HAND_GGX: shared_of(job, HAND_GGX); break;
    case HAND_CLOSED: shared_of(job, HAND_CLOSED); break;
    case HAND_TABLE: shared_of(job, HAND_TABLE); break;
    }
}

static void eval_any(const effects_job *job)
{
    switch (kind_of(job)) {
    case HAND_GGX: eval_of(job, HAND_GGX); break;
    case HAND_CLOSED: eval_of(job, HAND_CLOSED); break;
    case HAND_TABLE: eval_of(job, HAND_TABLE); break;
    }
}

static void pdf(const effects_job *job)
{
    vndf_view view = vndf_view_from(&job->of->surface, job->in[0].wi);
    for (size_t i = 0; i < job->count; i++) {
        vndf_vec3 wm = half_of(job->in[0].wi, job->in[i].wo);
        job->out[i].density = vndf_pdf(&view, wm) / (4.0f * method_dot(job->in[0].wi, wm));
    }
}

const effects_loops effects_loops_by_hand = {each, shared, eval_any, pdf};
