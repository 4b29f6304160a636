/* Surfaces beyond two roughnesses: view, sample and density of affine surfaces and of two lobes; their
 * batches have to give the same bits. */
#include <stdio.h>

#include "bench/methods/vector.h"

static vndf_affine straight(const vndf_distribution *d, float alpha)
{
    return (vndf_affine){d, alpha, 0, 0, alpha, 0, 0};
}

/* Turned, sheared, and with a mean slope. */
static vndf_affine oblique(const vndf_distribution *d, float alpha)
{
    return (vndf_affine){d, 0.9f * alpha, -0.5f * alpha, 0.3f * alpha, 0.8f * alpha, 0.1f, -0.05f};
}

/* A core and a haze three times as rough. */
static vndf_mixture two_lobes(const vndf_distribution *d, float alpha)
{
    return (vndf_mixture){2, {{straight(d, alpha), 0.7f}, {straight(d, 3 * alpha), 0.3f}}};
}

/* ---- a direction each ---- */

static inline vndf_vec3 draw_affine(const vndf_affine *surface, const method_input *in, float *pdf)
{
    vndf_view view = vndf_affine_view_from(surface, in->wi);
    return vndf_sample(&view, in->u1, in->u2, pdf);
}

static inline vndf_vec3 one_diagonal(const method *m, const method_input *in, float *pdf)
{
    vndf_affine surface = straight(m->state, in->alpha);
    return draw_affine(&surface, in, pdf);
}

static inline vndf_vec3 one_affine(const method *m, const method_input *in, float *pdf)
{
    vndf_affine surface = oblique(m->state, in->alpha);
    return draw_affine(&surface, in, pdf);
}

static inline vndf_vec3 one_two_lobes(const method *m, const method_input *in, float *pdf)
{
    vndf_mixture mixture = two_lobes(m->state, in->alpha);
    vndf_mixture_view view = vndf_mixture_view_from(&mixture, in->wi);
    return vndf_mixture_sample(&view, in->u1, in->u2, pdf, NULL);
}

static void each_diagonal(const method *m, const method_inputs *in, const method_outputs *out)
{
    method_loop(one_diagonal, m, in, out);
}

static void each_affine(const method *m, const method_inputs *in, const method_outputs *out)
{
    method_loop(one_affine, m, in, out);
}

static void each_two_lobes(const method *m, const method_inputs *in, const method_outputs *out)
{
    method_loop(one_two_lobes, m, in, out);
}

/* ---- many samples of one direction ---- */

static vndf_vec3 draw_from_affine(const void *view, float u1, float u2, float *pdf)
{
    return vndf_sample(view, u1, u2, pdf);
}

static vndf_vec3 draw_from_mixture(const void *view, float u1, float u2, float *pdf)
{
    return vndf_mixture_sample(view, u1, u2, pdf, NULL);
}

static void shared_diagonal(const method *m, const method_inputs *in, const method_outputs *out)
{
    vndf_affine surface = straight(m->state, in->at[0].alpha);
    vndf_view view = vndf_affine_view_from(&surface, in->at[0].wi);
    method_shared_loop(draw_from_affine, &view, in, out);
}

static void shared_affine(const method *m, const method_inputs *in, const method_outputs *out)
{
    vndf_affine surface = oblique(m->state, in->at[0].alpha);
    vndf_view view = vndf_affine_view_from(&surface, in->at[0].wi);
    method_shared_loop(draw_from_affine, &view, in, out);
}

static void shared_two_lobes(const method *m, const method_inputs *in, const method_outputs *out)
{
    vndf_mixture mixture = two_lobes(m->state, in->at[0].alpha);
    vndf_mixture_view view = vndf_mixture_view_from(&mixture, in->at[0].wi);
    method_shared_loop(draw_from_mixture, &view, in, out);
}

/* ---- batches ---- */

enum { MATRICES = 1024 };

/* Matrices of a batch, formed as the calls of one form theirs. */
typedef struct matrices {
    float xx[MATRICES], xy[MATRICES], yx[MATRICES], yy[MATRICES], mean_x[MATRICES], mean_y[MATRICES];
} matrices;

static void form(const method *m, const float *alpha, size_t count, matrices *to)
{
    for (size_t i = 0; i < count; i++) {
        vndf_affine surface = oblique(m->state, alpha[i]);
        to->xx[i] = surface.xx;
        to->xy[i] = surface.xy;
        to->yx[i] = surface.yx;
        to->yy[i] = surface.yy;
        to->mean_x[i] = surface.mean_x;
        to->mean_y[i] = surface.mean_y;
    }
}

static void draw_affine_batch(const method *m, const method_inputs *in, const method_outputs *out, unsigned shared)
{
    matrices of;
    size_t count = in->count < MATRICES ? in->count : MATRICES;
    form(m, in->alpha, shared ? 1 : count, &of);
    vndf_affine_batch batch = {m->state, count,     shared,    m->limit, of.xx,    of.xy,   of.yx,
                               of.yy,    of.mean_x, of.mean_y, in->wi_x, in->wi_y, in->wi_z};
    vndf_affine_sample_n(&batch, in->u1, in->u2, (vndf_normals){out->x, out->y, out->z}, out->pdf);
}

static void draw_two_lobes_batch(const method *m, const method_inputs *in, const method_outputs *out,
                                 unsigned shared)
{
    float rough[MATRICES], core = 0.7f, haze = 0.3f;
    size_t count = in->count < MATRICES ? in->count : MATRICES;
    for (size_t i = 0; i < (shared ? 1 : count); i++)
        rough[i] = 3 * in->alpha[i];
    vndf_mixture_batch batch = {.count = count,
                                .shared = shared | VNDF_SHARED_WEIGHT,
                                .limit = m->limit,
                                .lobes = 2,
                                .wi_x = in->wi_x,
                                .wi_y = in->wi_y,
                                .wi_z = in->wi_z};
    batch.lobe[0] = (vndf_lobe_batch){m->state, in->alpha, NULL, NULL, in->alpha, NULL, NULL, &core};
    batch.lobe[1] = (vndf_lobe_batch){m->state, rough, NULL, NULL, rough, NULL, NULL, &haze};
    vndf_mixture_sample_n(&batch, in->u1, in->u2, (vndf_normals){out->x, out->y, out->z}, out->pdf, NULL);
}

static void each_affine_batch(const method *m, const method_inputs *in, const method_outputs *out)
{
    draw_affine_batch(m, in, out, 0);
}

static void shared_affine_batch(const method *m, const method_inputs *in, const method_outputs *out)
{
    draw_affine_batch(m, in, out, VNDF_SHARED_ALPHA | VNDF_SHARED_WI);
}

static void each_two_lobes_batch(const method *m, const method_inputs *in, const method_outputs *out)
{
    draw_two_lobes_batch(m, in, out, 0);
}

static void shared_two_lobes_batch(const method *m, const method_inputs *in, const method_outputs *out)
{
    draw_two_lobes_batch(m, in, out, VNDF_SHARED_ALPHA | VNDF_SHARED_WI);
}

/* ---- methods ---- */

static const struct {
    const char *name;
    method_one *one;
    method_run *each, *shared, *each_batch, *shared_batch;
} surfaces[METHOD_SURFACES] = {
    {"diagonal", one_diagonal, each_diagonal, shared_diagonal, NULL, NULL}, /* its batch is the plain one */
    {"affine", one_affine, each_affine, shared_affine, each_affine_batch, shared_affine_batch},
    {"two lobes", one_two_lobes, each_two_lobes, shared_two_lobes, each_two_lobes_batch, shared_two_lobes_batch}};

method method_ours_surface(const vndf_distribution *distribution, const char *name, method_surface surface,
                           vndf_instructions limit)
{
    vndf_info info = vndf_distribution_info(distribution);
    method m = {.instructions = method_instructions_name(limit), .kind = BENCH_CALL, .limit = limit};
    m.state = distribution;
    m.memory = info.memory;
    m.file_bytes = info.bytes;
    snprintf(m.name, sizeof m.name, "%s: %s%s", name, surfaces[surface].name, limit ? ", batch" : "");
    if (limit != VNDF_INSTRUCTIONS_BEST && vndf_instructions_used(limit) != limit)
        return m;
    m.one = limit ? NULL : surfaces[surface].one;
    m.each = limit ? surfaces[surface].each_batch : surfaces[surface].each;
    m.shared = limit ? surfaces[surface].shared_batch : surfaces[surface].shared;
    m.same_bits = limit ? surfaces[surface].each : NULL;
    return m;
}
