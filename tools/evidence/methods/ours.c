/* The library itself: view, sample and density, one by one or by batches up to a set of instructions; the other
 * calls, which are only timed; and surfaces beyond two roughnesses: affine ones and two lobes. */
#include <stdio.h>

#include "evidence/methods/vector.h"

/* ---- one by one ---------------------------------------------------------------------------------- */

static const float core = 0.7f, haze = 0.3f; /* of two lobes */

static inline vndf_view view_of(const method *m, const method_input *in)
{
    const vndf_surface surface = {m->state, in->alpha, in->alpha};
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

/* Turned, sheared, and with a mean slope. */
static inline vndf_affine oblique(const method *m, float alpha)
{
    return (vndf_affine){m->state, 0.9f * alpha, -0.5f * alpha, 0.3f * alpha, 0.8f * alpha, 0.1f, -0.05f};
}

/* The other calls, and the surfaces: a core and a haze three times as rough are the two lobes. */
static inline vndf_vec3 one_call(const method *m, const method_input *in, float *pdf)
{
    const vndf_surface surface = {m->state, in->alpha, in->alpha};
    const float a = in->alpha, b = 3 * a;
    vndf_vec3 wm = {0, 0, 0};
    vndf_view view;
    if (m->call == METHOD_NDF || m->call == METHOD_LAMBDA) {
        *pdf = m->call == METHOD_NDF ? vndf_ndf(&surface, in->given) : vndf_lambda(&surface, in->wi);
        return wm;
    }
    if (m->call == METHOD_TWO_LOBES) {
        vndf_mixture mixture = {2, {{{m->state, a, 0, 0, a, 0, 0}, core}, {{m->state, b, 0, 0, b, 0, 0}, haze}}};
        vndf_mixture_view lobes = vndf_mixture_view_from(&mixture, in->wi);
        return vndf_mixture_sample(&lobes, in->u[0], in->u[1], pdf, NULL);
    }
    if (m->call == METHOD_AFFINE) {
        vndf_affine affine = oblique(m, a);
        view = vndf_affine_view_from(&affine, in->wi);
        return vndf_sample(&view, in->u[0], in->u[1], pdf);
    }
    view = vndf_view_from(&surface, in->wi);
    *pdf = 0;
    if (m->call == METHOD_PDF)
        *pdf = vndf_pdf(&view, in->given);
    else if (m->call == METHOD_INVERT)
        vndf_invert(&view, in->given, &wm.x, &wm.y);
    else {
        float weight;
        wm = vndf_sample_weight(&view, in->u[0], in->u[1], pdf, &weight);
        *pdf *= weight;
    }
    return wm;
}

static void each_call(const method *m, block *b, size_t first, size_t count)
{
    method_loop(one_call, m, b, first, count);
}

/* ---- batches of them ----------------------------------------------------------------------------- */

static vndf_batch batch_of(const method *m, const block *b, size_t i, size_t count)
{
    return (vndf_batch){.distribution = m->state,
                        .count = count,
                        .limit = m->limit,
                        .alpha_x = b->alpha + i,
                        .alpha_y = b->alpha + i,
                        .wi_x = b->wi[0] + i,
                        .wi_y = b->wi[1] + i,
                        .wi_z = b->wi[2] + i};
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
    vndf_batch batch = batch_of(m, b, first, count);
    batch.alpha_x = of[0], batch.xy = of[1], batch.yx = of[2], batch.alpha_y = of[3];
    batch.mean_x = of[4], batch.mean_y = of[5];
    vndf_sample_n(&batch, b->u[0] + first, b->u[1] + first, drawn(b, first), b->pdf + first);
}

static void batch_lobes(const method *m, block *b, size_t first, size_t count)
{
    float rough[BLOCK];
    const float *alpha = b->alpha + first;
    for (size_t i = 0; i < count; i++)
        rough[i] = 3 * alpha[i];
    vndf_mixture_batch batch = {.count = count,
                                .shared = VNDF_SHARED_WEIGHT,
                                .limit = m->limit,
                                .lobes = 2,
                                .wi_x = b->wi[0] + first,
                                .wi_y = b->wi[1] + first,
                                .wi_z = b->wi[2] + first,
                                .lobe = {{m->state, alpha, NULL, NULL, alpha, NULL, NULL, &core},
                                         {m->state, rough, NULL, NULL, rough, NULL, NULL, &haze}}};
    vndf_mixture_sample_n(&batch, b->u[0] + first, b->u[1] + first, drawn(b, first), b->pdf + first, NULL);
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
    case METHOD_AFFINE: batch_affine(m, b, first, count); break;
    case METHOD_TWO_LOBES: batch_lobes(m, b, first, count); break;
    default:
        vndf_sample_weight_n(&batch, b->u[0] + first, b->u[1] + first, drawn(b, first), pdf, b->value[0] + first);
        for (size_t i = first; i < first + count; i++)
            b->pdf[i] *= b->value[0][i];
    }
}

/* ---- methods ------------------------------------------------------------------------------------- */

static const char *const calls[METHOD_CALLS] = {
    [METHOD_SAMPLE] = "",         [METHOD_WEIGHT] = ": weight",     [METHOD_PDF] = ": pdf",
    [METHOD_INVERT] = ": invert", [METHOD_NDF] = ": ndf",           [METHOD_LAMBDA] = ": lambda",
    [METHOD_AFFINE] = ": affine", [METHOD_TWO_LOBES] = ": mixture",
};

method method_ours(const vndf_distribution *d, const char *name, method_call call, vndf_instructions limit)
{
    vndf_info info = vndf_distribution_info(d);
    method m = {.kind = call != METHOD_SAMPLE ? ROW_CALL
                        : info.memory         ? ROW_TABLE
                                              : ROW_CLOSED,
                .memory = info.memory,
                .file_bytes = info.bytes,
                .moments = info.moments,
                .state = d,
                .call = call,
                .limit = limit};
    snprintf(m.name, sizeof m.name, "%s%s%s", name, calls[call], limit ? ", batch" : "");
    method_run *one_by_one = call == METHOD_SAMPLE ? each : each_call;
    if (limit == VNDF_INSTRUCTIONS_BEST) {
        m.each = one_by_one;
        m.shared = call == METHOD_SAMPLE ? shared : NULL;
    } else if (vndf_instructions_used(limit) == limit) {
        m.each = call == METHOD_SAMPLE ? batch_each : batch_call;
        m.same_bits = one_by_one;
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
