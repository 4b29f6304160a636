/* Batches: which instruction set they run on, and the arrays of each call. Lanes (lanes_block.c) take all surfaces;
 * single elements, inverses, what has no distribution, and all calls where the compiler has no lanes, go one by one. */
#include <string.h>

#include "sampler/batch/call.h"
#include "table/table.h"

/* ---- instruction sets ---- */

#if VNDF_HAS_WIDE_LANES

static int has_avx512(void)
{
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
}

vndf_instructions vndf_instructions_used(vndf_instructions limit)
{
    if ((limit == VNDF_INSTRUCTIONS_BEST || limit >= VNDF_INSTRUCTIONS_AVX512) && has_avx512())
        return VNDF_INSTRUCTIONS_AVX512;
    if ((limit == VNDF_INSTRUCTIONS_BEST || limit >= VNDF_INSTRUCTIONS_AVX2) && __builtin_cpu_supports("avx2"))
        return VNDF_INSTRUCTIONS_AVX2;
    return VNDF_INSTRUCTIONS_PORTABLE;
}

/* Sixteen lanes first put a table into columns, which takes as long as they gain on 256 samples. */
const vndf_lanes *vndf_lanes_for(size_t count, int table, vndf_instructions limit)
{
    const vndf_instructions used = vndf_instructions_used(limit);
    if (count <= 1)
        return &vndf_one_by_one;
    if (used == VNDF_INSTRUCTIONS_AVX512 && !(table && count <= 256))
        return &vndf_lanes_16;
    return used >= VNDF_INSTRUCTIONS_AVX2 ? &vndf_lanes_8 : &vndf_lanes_4;
}

#else

vndf_instructions vndf_instructions_used(vndf_instructions limit)
{
    (void)limit;
    return VNDF_INSTRUCTIONS_PORTABLE;
}

const vndf_lanes *vndf_lanes_for(size_t count, int table, vndf_instructions limit)
{
    (void)table;
    (void)limit;
#  if defined(__GNUC__)
    if (count > 1)
        return &vndf_lanes_4;
#  endif
    (void)count;
    return &vndf_one_by_one;
}

#endif

/* ---- calls ---- */

vndf_call vndf_call_of(const vndf_batch *b)
{
    const unsigned surface = (1u << VNDF_READ_WI_X) - 1, direction = (1u << VNDF_READ_A) - 1 - surface;
    const vndf_call call = {
        .distribution = b->distribution,
        .count = b->count,
        .shared = (b->shared & VNDF_SHARED_ALPHA ? surface : 0) | (b->shared & VNDF_SHARED_WI ? direction : 0),
        .read = {b->alpha_x, b->xy, b->yx, b->alpha_y, b->mean_x, b->mean_y, b->wi_x, b->wi_y, b->wi_z},
        .diagonal = !b->xy && !b->yx && !b->mean_x && !b->mean_y};
    return call;
}

static void run(const vndf_batch *b, vndf_task task, vndf_arrays a)
{
    vndf_prepared prepared;
    vndf_call call = vndf_call_of(b);
    if (b->lobes) {
        vndf_run_mixtures(b, task, a);
        return;
    }
    const int one_by_one = !call.distribution || task == VNDF_TASK_INVERT;
    const vndf_lanes *lanes =
        one_by_one ? &vndf_one_by_one : vndf_lanes_for(call.count, vndf_is_table(call.distribution), b->limit);
    call.task = task;
    call.prepared = &prepared;
    memcpy(call.read + VNDF_READ_A, a.given, sizeof a.given);
    memcpy(call.write, a.write, sizeof a.write);
    lanes->prepare(call.distribution, &prepared);
    lanes->run(&call);
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
