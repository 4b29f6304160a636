/* The library itself: view, sample and density, one by one or by batches up to a set of instructions; the other
 * calls, which are only timed; and surfaces beyond two roughnesses: affine ones and two lobes. */
#include <stdio.h>

#include "evidence/methods/vector.h"

/* ---- one by one ---------------------------------------------------------------------------------- */

static inline vndf_surface surface_of(const method *m, const method_input *in)
{
    return (vndf_surface){m->state, in->alpha, in->alpha};
}

static inline vndf_view view_of(const method *m, const method_input *in)
{
    vndf_surface surface = surface_of(m, in);
    return vndf_view_from(&surface, in->wi);
}

static inline vndf_vec3 one(const method *m, const method_input *in, float *pdf)
{
    vndf_view view = view_of(m, in);
    return vndf_sample(&view, in->u[0], in->u[1], pdf);
}

static void each(const method *m, block *b, size_t first, size_t count)
{
    method_loop(one, m, b, first, count);
}

static vndf_vec3 draw(const void *view, float u1, float u2, float *pdf)
{
    return vndf_sample(view, u1, u2, pdf);
}

static void shared(const method *m, block *b, size_t first, size_t count)
{
    vndf_view view = view_of(m, &b->in[first]);
    method_shared_loop(draw, &view, b, first, count);
}

static void each_call(const method *m, block *b, size_t first, size_t count)
{
    for (size_t i = first; i < first + count; i++) {
        const method_input *in = &b->in[i];
        const vndf_surface surface = surface_of(m, in);
        if (m->call == METHOD_NDF)
            b->pdf[i] = vndf_ndf(&surface, in->given);
        else if (m->call == METHOD_LAMBDA)
            b->pdf[i] = vndf_lambda(&surface, in->wi);
        if (m->call == METHOD_NDF || m->call == METHOD_LAMBDA)
            continue;
        vndf_view view = vndf_view_from(&surface, in->wi);
        if (m->call == METHOD_PDF)
            b->pdf[i] = vndf_pdf(&view, in->given);
        else if (m->call == METHOD_INVERT)
            vndf_invert(&view, in->given, &b->x[i], &b->y[i]);
        else {
            vndf_vec3 wm = vndf_sample_weight(&view, in->u[0], in->u[1], &b->pdf[i], &b->value[0][i]);
            method_put(b, i, wm, b->pdf[i] * b->value[0][i]);
        }
    }
}

/* ---- batches of them ----------------------------------------------------------------------------- */

static vndf_batch batch_of(const method *m, const block *b, size_t i, size_t count)
{
    return (vndf_batch){m->state,     count,        0,           m->limit, b->alpha + i, b->alpha + i,
                        b->wi[0] + i, b->wi[1] + i, b->wi[2] + i};
}

static vndf_normals drawn(block *b, size_t i)
{
    return (vndf_normals){b->x + i, b->y + i, b->z + i};
}

static void batch_each(const method *m, block *b, size_t first, size_t count)
{
    vndf_batch batch = batch_of(m, b, first, count);
    vndf_sample_n(&batch, b->u[0] + first, b->u[1] + first, drawn(b, first), b->pdf + first);
}

static void batch_call(const method *m, block *b, size_t first, size_t count)
{
    const vndf_batch batch = batch_of(m, b, first, count);
    const vndf_normals normals = {b->given[0] + first, b->given[1] + first, b->given[2] + first};
    float *pdf = b->pdf + first;
    switch (m->call) {
    case METHOD_PDF: vndf_pdf_n(&batch, normals, pdf); break;
    case METHOD_INVERT: vndf_invert_n(&batch, normals, b->x + first, b->y + first); break;
    case METHOD_NDF: vndf_ndf_n(&batch, normals, pdf); break;
    case METHOD_LAMBDA: vndf_lambda_n(&batch, pdf); break;
    default:
        vndf_sample_weight_n(&batch, b->u[0] + first, b->u[1] + first, drawn(b, first), pdf, b->value[0] + first);
        for (size_t i = first; i < first + count; i++)
            b->pdf[i] *= b->value[0][i];
    }
}

/* ---- affine surfaces ----------------------------------------------------------------------------- */

static inline vndf_affine straight(const method *m, float alpha)
{
    return (vndf_affine){m->state, alpha, 0, 0, alpha, 0, 0};
}

/* Turned, sheared, and with a mean slope. */
static inline vndf_affine oblique(const method *m, float alpha)
{
    return (vndf_affine){m->state, 0.9f * alpha, -0.5f * alpha, 0.3f * alpha, 0.8f * alpha, 0.1f, -0.05f};
}

static inline vndf_vec3 one_affine(const method *m, const method_input *in, float *pdf)
{
    vndf_affine surface = oblique(m, in->alpha);
    vndf_view view = vndf_affine_view_from(&surface, in->wi);
    return vndf_sample(&view, in->u[0], in->u[1], pdf);
}

static void each_affine(const method *m, block *b, size_t first, size_t count)
{
    method_loop(one_affine, m, b, first, count);
}

/* Matrices are formed as the calls of one form theirs. */
static void batch_affine(const method *m, block *b, size_t first, size_t count)
{
    float of[6][BLOCK];
    for (size_t i = 0; i < count; i++) {
        vndf_affine a = oblique(m, b->alpha[first + i]);
        const float number[6] = {a.xx, a.xy, a.yx, a.yy, a.mean_x, a.mean_y};
        for (int k = 0; k < 6; k++)
            of[k][i] = number[k];
    }
    const float *const wi[3] = {b->wi[0] + first, b->wi[1] + first, b->wi[2] + first};
    vndf_affine_batch batch = {m->state, count, 0,     m->limit, of[0], of[1], of[2],
                               of[3],    of[4], of[5], wi[0],    wi[1], wi[2]};
    vndf_affine_sample_n(&batch, b->u[0] + first, b->u[1] + first, drawn(b, first), b->pdf + first);
}

/* A core and a haze three times as rough. */
static inline vndf_vec3 one_lobes(const method *m, const method_input *in, float *pdf)
{
    vndf_mixture mixture = {2, {{straight(m, in->alpha), 0.7f}, {straight(m, 3 * in->alpha), 0.3f}}};
    vndf_mixture_view view = vndf_mixture_view_from(&mixture, in->wi);
    return vndf_mixture_sample(&view, in->u[0], in->u[1], pdf, NULL);
}

static void each_lobes(const method *m, block *b, size_t first, size_t count)
{
    method_loop(one_lobes, m, b, first, count);
}

static void batch_lobes(const method *m, block *b, size_t first, size_t count)
{
    float rough[BLOCK], core = 0.7f, haze = 0.3f;
    const float *alpha = b->alpha + first;
    for (size_t i = 0; i < count; i++)
        rough[i] = 3 * alpha[i];
    vndf_mixture_batch batch = {.count = count,
                                .shared = VNDF_SHARED_WEIGHT,
                                .limit = m->limit,
                                .lobes = 2,
                                .wi_x = b->wi[0] + first,
                                .wi_y = b->wi[1] + first,
                                .wi_z = b->wi[2] + first};
    batch.lobe[0] = (vndf_lobe_batch){m->state, alpha, NULL, NULL, alpha, NULL, NULL, &core};
    batch.lobe[1] = (vndf_lobe_batch){m->state, rough, NULL, NULL, rough, NULL, NULL, &haze};
    vndf_mixture_sample_n(&batch, b->u[0] + first, b->u[1] + first, drawn(b, first), b->pdf + first, NULL);
}

/* ---- methods ------------------------------------------------------------------------------------- */

static const struct {
    const char *name;
    method_run *each, *shared, *batch;
} calls[METHOD_CALLS] = {
    [METHOD_SAMPLE] = {"", each, shared, batch_each},
    [METHOD_WEIGHT] = {": weight", each_call, NULL, batch_call},
    [METHOD_PDF] = {": pdf", each_call, NULL, batch_call},
    [METHOD_INVERT] = {": invert", each_call, NULL, batch_call},
    [METHOD_NDF] = {": ndf", each_call, NULL, batch_call},
    [METHOD_LAMBDA] = {": lambda", each_call, NULL, batch_call},
    [METHOD_AFFINE] = {": affine", each_affine, NULL, batch_affine},
    [METHOD_TWO_LOBES] = {": mixture", each_lobes, NULL, batch_lobes},
};

method method_ours(const vndf_distribution *d, const char *name, method_call call, vndf_instructions limit)
{
    vndf_info info = vndf_distribution_info(d);
    method m = {.instructions = method_instructions_name(limit),
                .kind = call != METHOD_SAMPLE ? ROW_CALL
                        : info.memory         ? ROW_TABLE
                                              : ROW_CLOSED,
                .memory = info.memory,
                .file_bytes = info.bytes,
                .moments = info.moments,
                .state = d,
                .call = call,
                .limit = limit};
    snprintf(m.name, sizeof m.name, "%s%s%s", name, calls[call].name, limit ? ", batch" : "");
    if (limit == VNDF_INSTRUCTIONS_BEST) {
        m.each = calls[call].each;
        m.shared = calls[call].shared;
    } else if (vndf_instructions_used(limit) == limit) {
        m.each = calls[call].batch;
        m.same_bits = calls[call].each;
    }
    return m;
}

method_reference method_reference_of(const vndf_distribution *d, const char *name)
{
    double scale = vndf_distribution_info(d).scale;
    float alpha = (float)(1 / (scale > 0 ? scale : 1));
    return (method_reference){{d, alpha, alpha}, 1 / alpha, name};
}

void method_release(method *m)
{
    if (m->release && m->state)
        m->release((void *)m->state);
    m->state = NULL;
}

const char *method_instructions_name(vndf_instructions set)
{
    return set == VNDF_INSTRUCTIONS_AVX512     ? "avx512"
           : set == VNDF_INSTRUCTIONS_AVX2     ? "avx2"
           : set == VNDF_INSTRUCTIONS_PORTABLE ? "portable"
                                               : "scalar";
}
