/* Batches: the calls, and which instruction set they run on. Lanes (lanes_block.c, mixtures.c) take all surfaces;
 * single elements, inverses, lobes without a distribution, and all calls where the compiler has no lanes, go one by
 * one. */
#include <float.h>
#include <string.h>

#include "sampler/batch/call.h"
#include "sampler/sampler.h"
#include "table/table.h"

/* ---- one element after the other, by the calls for one ---- */

static void run_surface(const vndf_batch *b, vndf_task task, size_t at, vndf_vec3 wi, vndf_vec3 given, float *to)
{
    const vndf_surface s = vndf_surface_at(&b->surface, at);
    const vndf_view view = vndf_view_from(&s, wi);
    switch (task) {
    case VNDF_TASK_SAMPLE: {
        const vndf_vec3 wm = vndf_sample_weight(&view, given.x, given.y, &to[3], &to[4]);
        memcpy(to, &wm, sizeof wm);
        break;
    }
    case VNDF_TASK_PDF: to[0] = vndf_pdf(&view, given); break;
    case VNDF_TASK_VISIBLE: to[0] = vndf_visible(&view, given); break;
    case VNDF_TASK_INVERT: vndf_invert(&view, given, &to[0], &to[1]); break;
    case VNDF_TASK_NDF: to[0] = vndf_ndf(&s, given); break;
    case VNDF_TASK_LAMBDA: to[0] = vndf_lambda(&s, wi); break;
    case VNDF_TASK_G1: to[0] = vndf_g1(&s, wi); break;
    default: to[0] = vndf_projected_area(&s, wi);
    }
}

/* Returns the lobe that was drawn. */
static int run_mixture(const vndf_batch *b, vndf_task task, size_t i, size_t at, vndf_vec3 wi, vndf_vec3 given,
                       float *to)
{
    vndf_mixture m = {.count = b->lobes <= VNDF_MIXTURE_LOBES ? b->lobes : 0};
    int lobe = -1;
    for (int l = 0; l < m.count; l++)
        m.lobe[l] = (vndf_mixture_lobe){vndf_surface_at(&b->lobe[l].surface, at),
                                        b->lobe[l].weight[b->shared & VNDF_SHARED_WEIGHT ? 0 : i]};
    const vndf_mixture_view view = vndf_mixture_view_from(&m, wi);
    switch (task) {
    case VNDF_TASK_SAMPLE: {
        const vndf_vec3 wm = vndf_mixture_sample(&view, given.x, given.y, &to[3], &lobe);
        const float weight = to[3] > 0.0f ? vndf_mixture_visible(&view, wm) / to[3] : 0.0f;
        memcpy(to, &wm, sizeof wm);
        to[4] = weight < FLT_MAX ? weight : FLT_MAX;
        break;
    }
    case VNDF_TASK_PDF: to[0] = vndf_mixture_pdf(&view, given); break;
    case VNDF_TASK_VISIBLE: to[0] = vndf_mixture_visible(&view, given); break;
    case VNDF_TASK_INVERT: vndf_mixture_invert(&view, given, -1, &to[0], &to[1]); break;
    case VNDF_TASK_NDF: to[0] = vndf_mixture_ndf(&m, given); break;
    case VNDF_TASK_LAMBDA: to[0] = vndf_mixture_lambda(&m, wi); break;
    case VNDF_TASK_G1: to[0] = vndf_mixture_g1(&m, wi); break;
    default: to[0] = vndf_mixture_projected_area(&m, wi);
    }
    return lobe;
}

static vndf_vec3 vec3_at(const float *const array[3], size_t i)
{
    const vndf_vec3 v = {array[0] ? array[0][i] : 0.0f, array[1] ? array[1][i] : 0.0f,
                         array[2] ? array[2][i] : 0.0f};
    return v;
}

static void run_one_by_one(const vndf_batch *b, vndf_task task, const vndf_arrays *a)
{
    const float *const wi_of[3] = {b->wi_x, b->wi_y, b->wi_z};
    for (size_t i = 0; i < b->count; i++) {
        const vndf_vec3 wi = vec3_at(wi_of, b->shared & VNDF_SHARED_WI ? 0 : i), given = vec3_at(a->given, i);
        const size_t at = b->shared & VNDF_SHARED_SURFACE ? 0 : i;
        float to[VNDF_WRITES] = {0.0f};
        int lobe = 0;
        if (b->lobes)
            lobe = run_mixture(b, task, i, at, wi, given, to);
        else
            run_surface(b, task, at, wi, given, to);
        for (int w = 0; w < VNDF_WRITES; w++)
            if (a->write[w])
                a->write[w][i] = to[w];
        if (b->lobes && task == VNDF_TASK_SAMPLE && b->drawn)
            b->drawn[i] = lobe;
    }
}

/* ---- instruction sets ---- */

vndf_instructions vndf_instructions_used(vndf_instructions limit)
{
#if VNDF_HAS_WIDE_LANES
    const int any = limit == VNDF_INSTRUCTIONS_BEST;
    if ((any || limit >= VNDF_INSTRUCTIONS_AVX512) && __builtin_cpu_supports("avx512f") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512vl"))
        return VNDF_INSTRUCTIONS_AVX512;
    if ((any || limit >= VNDF_INSTRUCTIONS_AVX2) && __builtin_cpu_supports("avx2"))
        return VNDF_INSTRUCTIONS_AVX2;
#endif
    (void)limit;
    return VNDF_INSTRUCTIONS_PORTABLE;
}

/* How many lanes a batch runs in, 1 for one by one. */
static int lanes_of(const vndf_batch *b, vndf_task task)
{
    int knows_all = b->lobes || b->surface.distribution;
    for (int l = 0; l < b->lobes && l < VNDF_MIXTURE_LOBES; l++)
        knows_all &= b->lobe[l].surface.distribution != NULL;
    if (!knows_all || b->count < 2 || task == VNDF_TASK_INVERT || b->lobes < 0 || b->lobes > VNDF_MIXTURE_LOBES)
        return 1;
#if VNDF_HAS_WIDE_LANES
    const vndf_instructions used = vndf_instructions_used(b->limit);
    if (used >= VNDF_INSTRUCTIONS_AVX2)
        return used == VNDF_INSTRUCTIONS_AVX512 ? 16 : 8;
#endif
#if defined(__GNUC__)
    return 4;
#else
    return 1;
#endif
}

/* ---- calls ---- */

static void run(const vndf_batch *b, vndf_task task, vndf_arrays a)
{
    const vndf_call call = vndf_call_of(b, &b->surface, task, &a);
    switch (lanes_of(b, task)) {
#if VNDF_HAS_WIDE_LANES
    case 16: b->lobes ? vndf_mixtures_16(b, task, &a) : vndf_lanes_16(&call); break;
    case 8: b->lobes ? vndf_mixtures_8(b, task, &a) : vndf_lanes_8(&call); break;
#endif
#if defined(__GNUC__)
    case 4: b->lobes ? vndf_mixtures_4(b, task, &a) : vndf_lanes_4(&call); break;
#endif
    default: run_one_by_one(b, task, &a);
    }
}

void vndf_sample_n(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf)
{
    run(b, VNDF_TASK_SAMPLE, (vndf_arrays){{u1, u2}, {wm.x, wm.y, wm.z, pdf, NULL}});
}

void vndf_sample_weight_n(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf,
                          float *weight)
{
    run(b, VNDF_TASK_SAMPLE, (vndf_arrays){{u1, u2}, {wm.x, wm.y, wm.z, pdf, weight}});
}

void vndf_pdf_n(const vndf_batch *b, vndf_normals wm, float *pdf)
{
    run(b, VNDF_TASK_PDF, (vndf_arrays){{wm.x, wm.y, wm.z}, {pdf}});
}

void vndf_visible_n(const vndf_batch *b, vndf_normals wm, float *visible)
{
    run(b, VNDF_TASK_VISIBLE, (vndf_arrays){{wm.x, wm.y, wm.z}, {visible}});
}

void vndf_invert_n(const vndf_batch *b, vndf_normals wm, float *u1, float *u2)
{
    run(b, VNDF_TASK_INVERT, (vndf_arrays){{wm.x, wm.y, wm.z}, {u1, u2}});
}

void vndf_ndf_n(const vndf_batch *b, vndf_normals wm, float *ndf)
{
    run(b, VNDF_TASK_NDF, (vndf_arrays){{wm.x, wm.y, wm.z}, {ndf}});
}

void vndf_projected_area_n(const vndf_batch *b, float *area)
{
    run(b, VNDF_TASK_AREA, (vndf_arrays){.write = {area}});
}

void vndf_lambda_n(const vndf_batch *b, float *lambda)
{
    run(b, VNDF_TASK_LAMBDA, (vndf_arrays){.write = {lambda}});
}

void vndf_g1_n(const vndf_batch *b, float *g1)
{
    run(b, VNDF_TASK_G1, (vndf_arrays){.write = {g1}});
}
