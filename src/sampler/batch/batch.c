/* Batches: the calls, and which instruction set they run on. Lanes (lanes_block.c) take all surfaces; single elements,
 * inverses, lobes without a distribution, and all calls where the compiler has no lanes, go one by one. */
#include <string.h>

#include "sampler/batch/call.h"
#include "sampler/sampler.h"
#include "table/table.h"

/* ---- one element after the other, by the calls for one ---- */

static void run_one(const vndf_call *c, size_t i)
{
    const vndf_surface s = vndf_call_surface(c, i);
    const vndf_vec3 wi = vndf_call_vec3(c, VNDF_READ_WI_X, i), given = vndf_call_vec3(c, VNDF_READ_A, i);
    const vndf_view view = vndf_view_from(&s, wi);
    vndf_vec3 wm;
    float to[VNDF_WRITES] = {0.0f};
    switch (c->task) {
    case VNDF_TASK_SAMPLE:
        wm = c->write[4] ? vndf_sample_weight(&view, given.x, given.y, &to[3], &to[4])
                         : vndf_sample(&view, given.x, given.y, &to[3]);
        to[0] = wm.x, to[1] = wm.y, to[2] = wm.z;
        break;
    case VNDF_TASK_PDF: to[0] = vndf_pdf(&view, given); break;
    case VNDF_TASK_VISIBLE: to[0] = vndf_visible(&view, given); break;
    case VNDF_TASK_INVERT: vndf_invert(&view, given, &to[0], &to[1]); break;
    case VNDF_TASK_NDF: to[0] = vndf_ndf(&s, given); break;
    case VNDF_TASK_LAMBDA: to[0] = vndf_lambda(&s, wi); break;
    case VNDF_TASK_G1: to[0] = vndf_g1(&s, wi); break;
    case VNDF_TASK_AREA: to[0] = vndf_projected_area(&s, wi); break;
    case VNDF_TASK_DRAWN_AREA: to[0] = view.distribution ? vndf_view_drawn_area(&view) : 0.0f; break;
    }
    to[1] = c->task == VNDF_TASK_AREA || c->task == VNDF_TASK_DRAWN_AREA ? view.distribution != NULL : to[1];
    for (int w = 0; w < VNDF_WRITES; w++)
        if (c->write[w])
            c->write[w][i] = to[w];
}

void vndf_one_by_one(const vndf_call *call)
{
    for (size_t i = 0; i < call->count; i++)
        run_one(call, call->at ? (size_t)call->at[i] : i);
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

vndf_lanes *vndf_lanes_for(size_t count, vndf_instructions limit)
{
    (void)limit;
#if VNDF_HAS_WIDE_LANES
    const vndf_instructions used = vndf_instructions_used(limit);
    if (count > 1 && used >= VNDF_INSTRUCTIONS_AVX2)
        return used == VNDF_INSTRUCTIONS_AVX512 ? vndf_lanes_16 : vndf_lanes_8;
#endif
#if defined(__GNUC__)
    if (count > 1)
        return vndf_lanes_4;
#endif
    return vndf_one_by_one;
}

/* ---- calls ---- */

vndf_call vndf_call_of(const vndf_batch *b, const vndf_surface_batch *s)
{
    const unsigned surface = (1u << VNDF_READ_WI_X) - 1, direction = (1u << VNDF_READ_A) - 1 - surface;
    const vndf_call call = {.distribution = s->distribution,
                            .count = b->count,
                            .shared = (b->shared & VNDF_SHARED_SURFACE ? surface : 0) |
                                      (b->shared & VNDF_SHARED_WI ? direction : 0),
                            .read = {s->xx, s->xy, s->yx, s->yy, s->mean_x, s->mean_y, b->wi_x, b->wi_y, b->wi_z},
                            .is_diagonal = !s->xy && !s->yx && !s->mean_x && !s->mean_y};
    return call;
}

static void run(const vndf_batch *b, vndf_task task, vndf_arrays a)
{
    vndf_call call = vndf_call_of(b, &b->surface);
    if (b->lobes) {
        vndf_run_mixtures(b, task, a);
        return;
    }
    const int one_by_one = !call.distribution || task == VNDF_TASK_INVERT;
    vndf_lanes *lanes = one_by_one ? vndf_one_by_one : vndf_lanes_for(call.count, b->limit);
    call.task = task;
    memcpy(call.read + VNDF_READ_A, a.given, sizeof a.given);
    memcpy(call.write, a.write, sizeof a.write);
    lanes(&call);
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
