/* The library itself: view, sample and density, one by one or by batches up to a set of instructions; the other
 * calls, which are only timed; surfaces beyond two roughnesses: sheared ones and two lobes; and what `vndf export
 * --language c` writes, beside them: the build writes the kernel (tools/export/write_kernel.c). */
#include <stdio.h>
#include <stdlib.h>

#include "evidence/method.h"

#include "exported_kernel.h"

/* Weights of two lobes and of eight, which are up to three times as rough as the first. */
enum { LOBES = VNDF_MIXTURE_LOBES };
static const float weights[2][LOBES] = {{0.7f, 0.3f}, {0.3f, 0.2f, 0.15f, 0.1f, 0.1f, 0.05f, 0.05f, 0.05f}};

static inline int lobes_of(const method *m)
{
    return m->call == METHOD_TWO_LOBES ? 2 : LOBES;
}

static inline float lobe_alpha(const method *m, int lobe, float alpha)
{
    return (1 + 2 * (float)lobe / (float)(lobes_of(m) - 1)) * alpha;
}

/* Views that so many samples share; a constant where it is inlined. */
static inline void run(const method *m, block *b, size_t share)
{
    for (size_t first = 0; first < b->count; first += share) {
        const vndf_surface surface = vndf_rough(m->d, b->in[first].alpha, b->in[first].alpha);
        const vndf_view view = vndf_view_from(&surface, b->in[first].wi);
        for (size_t i = first; i < first + share; i++) {
            const vndf_vec3 wm = vndf_sample(&view, b->in[i].u[0], b->in[i].u[1], &b->pdf[i]);
            b->x[i] = wm.x, b->y[i] = wm.y, b->z[i] = wm.z;
        }
    }
}

static void each(const method *m, block *b)
{
    run(m, b, 1);
}

static void shared(const method *m, block *b)
{
    run(m, b, SHARE);
}

/* As many samples of a hit as renderers draw where they are cheap beside the hit. */
static void sixteen(const method *m, block *b)
{
    run(m, b, 16);
}

/* Turned, sheared, and with a mean slope. */
static inline vndf_surface oblique(const method *m, float alpha)
{
    return (vndf_surface){m->d, 0.9f * alpha, -0.5f * alpha, 0.3f * alpha, 0.8f * alpha, 0.1f, -0.05f};
}

static inline vndf_vec3 one_call(const method *m, const method_input *in, float *pdf)
{
    const vndf_surface surface = vndf_rough(m->d, in->alpha, in->alpha);
    vndf_vec3 wm = {0, 0, 0};
    if (m->call == METHOD_NDF || m->call == METHOD_LAMBDA) {
        *pdf = m->call == METHOD_NDF ? vndf_ndf(&surface, in->given) : vndf_lambda(&surface, in->wi);
        return wm;
    }
    if (m->call >= METHOD_TWO_LOBES) {
        vndf_mixture mixture;
        mixture.count = lobes_of(m);
        for (int k = 0; k < mixture.count; k++) {
            const float alpha = lobe_alpha(m, k, in->alpha);
            mixture.lobe[k].surface = vndf_rough(m->d, alpha, alpha);
            mixture.lobe[k].weight = weights[mixture.count > 2][k];
        }
        vndf_mixture_view lobes = vndf_mixture_view_from(&mixture, in->wi);
        return vndf_mixture_sample(&lobes, in->u[0], in->u[1], pdf, NULL);
    }
    if (m->call == METHOD_AFFINE) {
        vndf_surface sheared = oblique(m, in->alpha);
        const vndf_view leaning = vndf_view_from(&sheared, in->wi);
        return vndf_sample(&leaning, in->u[0], in->u[1], pdf);
    }
    const vndf_view view = vndf_view_from(&surface, in->wi);
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

static void each_call(const method *m, block *b)
{
    method_loop(one_call, m, b);
}

static inline vndf_vec3 one_exported(const method *m, const method_input *in, float *pdf)
{
    const float *numbers = m->state;
    exported_surface surface = exported_rough(numbers ? 0 : EXPORTED_GGX, in->alpha, in->alpha);
    exported_view view = exported_view_from(numbers, surface, (exported_vec3){in->wi.x, in->wi.y, in->wi.z});
    exported_sampled drawn = exported_sample(numbers, view, in->u[0], in->u[1]);
    *pdf = drawn.pdf;
    return (vndf_vec3){drawn.wm.x, drawn.wm.y, drawn.wm.z};
}

static void each_exported(const method *m, block *b)
{
    method_loop(one_exported, m, b);
}

static vndf_batch batch_of(const method *m, const block *b)
{
    vndf_batch of = {
        .surface = {.distribution = m->d, .xx = b->alpha, .yy = b->alpha}, .count = b->count, .limit = b->limit};
    of.wi_x = b->wi[0], of.wi_y = b->wi[1], of.wi_z = b->wi[2];
    return of;
}

static vndf_normals drawn(block *b)
{
    return (vndf_normals){b->x, b->y, b->z};
}

/* Matrices are formed as the calls of one form theirs. */
static void batch_affine(const method *m, block *b)
{
    float of[6][BLOCK];
    for (size_t i = 0; i < b->count; i++) {
        vndf_surface a = oblique(m, b->alpha[i]);
        const float number[6] = {a.xx, a.xy, a.yx, a.yy, a.mean_x, a.mean_y};
        for (int k = 0; k < 6; k++)
            of[k][i] = number[k];
    }
    vndf_batch batch = batch_of(m, b);
    batch.surface = (vndf_surface_batch){m->d, of[0], of[1], of[2], of[3], of[4], of[5]};
    vndf_sample_n(&batch, b->u[0], b->u[1], drawn(b), b->pdf);
}

static void batch_lobes(const method *m, block *b)
{
    float rough[LOBES][BLOCK];
    vndf_batch batch = batch_of(m, b);
    batch.shared = VNDF_SHARED_WEIGHT;
    batch.lobes = lobes_of(m);
    for (int k = 0; k < batch.lobes; k++) {
        const vndf_surface_batch surface = {.distribution = m->d, .xx = rough[k], .yy = rough[k]};
        batch.lobe[k] = (vndf_lobe_batch){surface, &weights[batch.lobes > 2][k]};
        for (size_t i = 0; i < b->count; i++)
            rough[k][i] = lobe_alpha(m, k, b->alpha[i]);
    }
    vndf_sample_n(&batch, b->u[0], b->u[1], drawn(b), b->pdf);
}

static void batch_call(const method *m, block *b)
{
    const vndf_batch batch = batch_of(m, b);
    const vndf_normals normals = {b->given[0], b->given[1], b->given[2]};
    switch (m->call) {
    case METHOD_SAMPLE: vndf_sample_n(&batch, b->u[0], b->u[1], drawn(b), b->pdf); break;
    case METHOD_PDF: vndf_pdf_n(&batch, normals, b->pdf); break;
    case METHOD_INVERT: vndf_invert_n(&batch, normals, b->x, b->y); break;
    case METHOD_NDF: vndf_ndf_n(&batch, normals, b->pdf); break;
    case METHOD_LAMBDA: vndf_lambda_n(&batch, b->pdf); break;
    case METHOD_AFFINE: batch_affine(m, b); break;
    case METHOD_TWO_LOBES:
    case METHOD_EIGHT_LOBES: batch_lobes(m, b); break;
    default:
        vndf_sample_weight_n(&batch, b->u[0], b->u[1], drawn(b), b->pdf, b->value[0]);
        for (size_t i = 0; i < b->count; i++)
            b->pdf[i] *= b->value[0][i];
    }
}

method method_ours(const vndf_distribution *d, const char *name, method_call call)
{
    static const char *const calls[METHOD_CALLS] = {"",          ": weight",  ": pdf",       ": invert",
                                                    ": ndf",     ": lambda",  ": 16 a view", ": affine",
                                                    ": mixture", ": 8 lobes", ", exported C"};
    const vndf_info info = vndf_distribution_info(d);
    method m = {.kind = info.memory ? ROW_TABLE : ROW_CLOSED, .memory = info.memory, .d = d, .call = call};
    snprintf(m.name, sizeof m.name, "%s%s", name, calls[call]);
    if (call == METHOD_SAMPLE) {
        m.each = each, m.shared = shared, m.batch = batch_call;
    } else if (call == METHOD_EXPORTED) {
        const size_t count = vndf_numbers(d, NULL, 0);
        float *numbers = count ? malloc(count * sizeof *numbers) : NULL;
        m.kind = ROW_EXPORTED;
        m.memory = count * sizeof *numbers;
        m.state = numbers;
        m.release = free;
        m.each = numbers || !count ? each_exported : NULL;
        vndf_numbers(d, numbers, numbers ? count : 0);
    } else {
        m.kind = ROW_CALL;
        m.each = call == METHOD_SIXTEEN ? sixteen : each_call;
        m.batch = call == METHOD_SIXTEEN ? NULL : batch_call;
    }
    m.same_bits = m.batch != NULL;
    return m;
}

method_reference method_reference_of(const vndf_distribution *d, const char *name)
{
    double scale = vndf_distribution_info(d).scale;
    float alpha = (float)(1 / (scale > 0 ? scale : 1));
    return (method_reference){vndf_rough(d, alpha, alpha), 1 / alpha, name};
}

void method_release(method *m)
{
    if (m->release && m->state)
        m->release((void *)m->state);
    m->state = NULL;
}
