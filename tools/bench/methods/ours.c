/* The library itself: vndf_view_from and vndf_sample, or vndf_sample_n up to a set of instructions; and the other calls
 * of a distribution, which are only timed. */
#include <stdio.h>

#include "bench/methods/vector.h"

static vndf_surface surface_of(const method *m, float alpha)
{
    return (vndf_surface){m->state, alpha, alpha};
}

static vndf_batch batch_of(const method *m, const method_inputs *in, unsigned shared)
{
    return (vndf_batch){m->state, in->count, shared, m->limit, in->alpha, in->alpha, in->wi_x, in->wi_y, in->wi_z};
}

/* ---- sampling ---------------------------------------------------------------------------------- */

static inline vndf_vec3 one(const method *m, const method_input *in, float *pdf)
{
    vndf_surface surface = surface_of(m, in->alpha);
    vndf_view view = vndf_view_from(&surface, in->wi);
    return vndf_sample(&view, in->u1, in->u2, pdf);
}

static void each(const method *m, const method_inputs *in, const method_outputs *out)
{
    method_loop(one, m, in, out);
}

static void shared(const method *m, const method_inputs *in, const method_outputs *out)
{
    const method_input *first = &in->at[0];
    vndf_surface surface = surface_of(m, first->alpha);
    vndf_view view = vndf_view_from(&surface, first->wi);
    for (size_t i = 0; i < in->count; i++) {
        float pdf;
        vndf_vec3 wm = vndf_sample(&view, in->at[i].u1, in->at[i].u2, &pdf);
        method_put(out, i, wm, pdf);
    }
}

static void each_batch(const method *m, const method_inputs *in, const method_outputs *out)
{
    vndf_batch batch = batch_of(m, in, 0);
    vndf_sample_n(&batch, in->u1, in->u2, (vndf_normals){out->x, out->y, out->z}, out->pdf);
}

static void shared_batch(const method *m, const method_inputs *in, const method_outputs *out)
{
    vndf_batch batch = batch_of(m, in, VNDF_SHARED_ALPHA | VNDF_SHARED_WI);
    vndf_sample_n(&batch, in->u1, in->u2, (vndf_normals){out->x, out->y, out->z}, out->pdf);
}

static method ours(const vndf_distribution *distribution, const char *name, vndf_instructions limit)
{
    method m = {.instructions = method_instructions_name(limit), .state = distribution, .limit = limit};
    vndf_info info = vndf_distribution_info(distribution);
    m.memory = info.memory;
    m.file_bytes = info.bytes;
    m.moments = info.moments;
    snprintf(m.name, sizeof m.name, "%s%s", name, limit ? ", batch" : "");
    return m;
}

method method_ours(const vndf_distribution *distribution, const char *name, vndf_instructions limit)
{
    method m = ours(distribution, name, limit);
    m.kind = m.memory ? BENCH_TABLE : BENCH_CLOSED;
    m.certified = m.memory ? distribution : NULL;
    if (limit != VNDF_INSTRUCTIONS_BEST && vndf_instructions_used(limit) != limit)
        return m;
    m.one = limit ? NULL : one;
    m.each = limit ? each_batch : each;
    m.shared = limit ? shared_batch : shared;
    m.same_bits = limit ? each : NULL;
    return m;
}

/* ---- the other calls --------------------------------------------------------------------------- */

/* The normals of the inputs; only calls with a normal read them. */
static vndf_normals normals_of(const method_inputs *in)
{
    return (vndf_normals){(float *)in->wm_x, (float *)in->wm_y, (float *)in->wm_z};
}

static void weight_each(const method *m, const method_inputs *in, const method_outputs *out)
{
    for (size_t i = 0; i < in->count; i++) {
        const method_input *at = &in->at[i];
        vndf_surface surface = surface_of(m, at->alpha);
        vndf_view view = vndf_view_from(&surface, at->wi);
        float pdf, weight;
        vndf_vec3 wm = vndf_sample_weight(&view, at->u1, at->u2, &pdf, &weight);
        method_put(out, i, wm, pdf * weight);
    }
}

static void pdf_each(const method *m, const method_inputs *in, const method_outputs *out)
{
    for (size_t i = 0; i < in->count; i++) {
        const method_input *at = &in->at[i];
        vndf_surface surface = surface_of(m, at->alpha);
        vndf_view view = vndf_view_from(&surface, at->wi);
        out->pdf[i] = vndf_pdf(&view, in->wm[i]);
    }
}

static void invert_each(const method *m, const method_inputs *in, const method_outputs *out)
{
    for (size_t i = 0; i < in->count; i++) {
        const method_input *at = &in->at[i];
        vndf_surface surface = surface_of(m, at->alpha);
        vndf_view view = vndf_view_from(&surface, at->wi);
        vndf_invert(&view, in->wm[i], &out->x[i], &out->y[i]);
    }
}

static void ndf_each(const method *m, const method_inputs *in, const method_outputs *out)
{
    for (size_t i = 0; i < in->count; i++) {
        vndf_surface surface = surface_of(m, in->at[i].alpha);
        out->pdf[i] = vndf_ndf(&surface, in->wm[i]);
    }
}

static void lambda_each(const method *m, const method_inputs *in, const method_outputs *out)
{
    for (size_t i = 0; i < in->count; i++) {
        const method_input *at = &in->at[i];
        vndf_surface surface = surface_of(m, at->alpha);
        out->pdf[i] = vndf_lambda(&surface, at->wi);
    }
}

static void weight_batch(const method *m, const method_inputs *in, const method_outputs *out)
{
    enum { BLOCK = 256 };
    float weight[BLOCK];
    for (size_t first = 0; first < in->count; first += BLOCK) {
        vndf_batch batch = batch_of(m, in, 0);
        batch.count = in->count - first < BLOCK ? in->count - first : BLOCK;
        batch.alpha_x = batch.alpha_y = in->alpha + first;
        batch.wi_x += first;
        batch.wi_y += first;
        batch.wi_z += first;
        vndf_sample_weight_n(&batch, in->u1 + first, in->u2 + first,
                             (vndf_normals){out->x + first, out->y + first, out->z + first}, out->pdf + first,
                             weight);
        for (size_t i = 0; i < batch.count; i++)
            out->pdf[first + i] *= weight[i];
    }
}

static void pdf_batch(const method *m, const method_inputs *in, const method_outputs *out)
{
    vndf_batch batch = batch_of(m, in, 0);
    vndf_pdf_n(&batch, normals_of(in), out->pdf);
}

static void invert_batch(const method *m, const method_inputs *in, const method_outputs *out)
{
    vndf_batch batch = batch_of(m, in, 0);
    vndf_invert_n(&batch, normals_of(in), out->x, out->y);
}

static void ndf_batch(const method *m, const method_inputs *in, const method_outputs *out)
{
    vndf_batch batch = batch_of(m, in, 0);
    vndf_ndf_n(&batch, normals_of(in), out->pdf);
}

static void lambda_batch(const method *m, const method_inputs *in, const method_outputs *out)
{
    vndf_batch batch = batch_of(m, in, 0);
    vndf_lambda_n(&batch, out->pdf);
}

method method_ours_call(const vndf_distribution *distribution, const char *name, method_call call,
                        vndf_instructions limit)
{
    static const struct {
        const char *name;
        method_run *each, *batch;
    } calls[METHOD_CALLS] = {{"sample, weight", weight_each, weight_batch},
                             {"pdf", pdf_each, pdf_batch},
                             {"invert", invert_each, invert_batch},
                             {"ndf", ndf_each, ndf_batch},
                             {"lambda", lambda_each, lambda_batch}};
    char title[48];
    snprintf(title, sizeof title, "%s: %s", name, calls[call].name);
    method m = ours(distribution, title, limit);
    m.kind = BENCH_CALL;
    if (limit != VNDF_INSTRUCTIONS_BEST && vndf_instructions_used(limit) != limit)
        return m;
    m.each = limit ? calls[call].batch : calls[call].each;
    m.same_bits = limit ? calls[call].each : NULL;
    return m;
}
