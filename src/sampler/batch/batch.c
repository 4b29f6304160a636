/* Batches: which instruction set they run on, and the arrays of each call. Lanes (lanes_block.c, mixture_lanes.h) take
 * all surfaces; single elements, lobes without a distribution, and all calls where the compiler has no lanes, go one by
 * one. */
#include "sampler/batch/call.h"
#include "sampler/batch/elements.h"
#include "sampler/sampler.h"
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
static void run_lanes(const vndf_call *call, vndf_instructions limit)
{
    vndf_instructions used = vndf_instructions_used(limit);
    if (used == VNDF_INSTRUCTIONS_AVX512 && call->count <= 256 && vndf_is_table(call->distribution))
        used = VNDF_INSTRUCTIONS_AVX2;
    (used == VNDF_INSTRUCTIONS_AVX512 ? vndf_lanes_16
     : used == VNDF_INSTRUCTIONS_AVX2 ? vndf_lanes_8
                                      : vndf_lanes_4)(call);
}

static void run_mixture_lanes(const vndf_mixture_call *call, vndf_instructions limit)
{
    vndf_instructions used = vndf_instructions_used(limit);
    (used == VNDF_INSTRUCTIONS_AVX512 ? vndf_mixture_lanes_16
     : used == VNDF_INSTRUCTIONS_AVX2 ? vndf_mixture_lanes_8
                                      : vndf_mixture_lanes_4)(call);
}

#else

vndf_instructions vndf_instructions_used(vndf_instructions limit)
{
    (void)limit;
    return VNDF_INSTRUCTIONS_PORTABLE;
}

#  if defined(__GNUC__)
#    define vndf_one_lanes vndf_lanes_4
#    define vndf_one_mixture_lanes vndf_mixture_lanes_4
#  else
#    define vndf_one_lanes vndf_one_by_one
#    define vndf_one_mixture_lanes vndf_mixture_one_by_one
#  endif

static void run_lanes(const vndf_call *call, vndf_instructions limit)
{
    (void)limit;
    vndf_one_lanes(call);
}

static void run_mixture_lanes(const vndf_mixture_call *call, vndf_instructions limit)
{
    (void)limit;
    vndf_one_mixture_lanes(call);
}

#endif

/* ---- surfaces ---- */

static const unsigned SURFACE = 1u << VNDF_READ_XX | 1u << VNDF_READ_XY | 1u << VNDF_READ_YX | 1u << VNDF_READ_YY |
                                1u << VNDF_READ_MEAN_X | 1u << VNDF_READ_MEAN_Y;
static const unsigned DIRECTION = 1u << VNDF_READ_WI_X | 1u << VNDF_READ_WI_Y | 1u << VNDF_READ_WI_Z;

/* A call without what it reads and writes beside surfaces and directions. */
static vndf_call affine_call(vndf_task task, const vndf_affine_batch *b)
{
    vndf_call call = {task,     b->distribution,
                      b->count, 0,
                      0,        {b->xx, b->xy, b->yx, b->yy, b->mean_x, b->mean_y, b->wi_x, b->wi_y, b->wi_z},
                      {0}};
    call.shared = (b->shared & VNDF_SHARED_ALPHA ? SURFACE : 0) | (b->shared & VNDF_SHARED_WI ? DIRECTION : 0);
    return call;
}

/* Roughness is a diagonal matrix. */
static vndf_call plain_call(vndf_task task, const vndf_batch *b)
{
    const vndf_affine_batch affine = {b->distribution, b->count, b->shared, b->limit, b->alpha_x, NULL,   NULL,
                                      b->alpha_y,      NULL,     NULL,      b->wi_x,  b->wi_y,    b->wi_z};
    vndf_call call = affine_call(task, &affine);
    call.diagonal = 1;
    return call;
}

static void run(vndf_call *call, vndf_instructions limit, const float *const given[3],
                float *const results[VNDF_WRITES])
{
    for (int i = 0; i < 3; i++)
        call->read[VNDF_READ_A + i] = given[i];
    for (int i = 0; i < VNDF_WRITES; i++)
        call->write[i] = results[i];
    if (!call->distribution || call->count < 2)
        vndf_one_by_one(call);
    else
        run_lanes(call, limit);
}

static void run_sample(vndf_call call, vndf_instructions limit, const float *u1, const float *u2, vndf_normals wm,
                       float *pdf, float *weight)
{
    const float *const given[3] = {u1, u2, NULL};
    float *const results[VNDF_WRITES] = {wm.x, wm.y, wm.z, pdf, weight};
    run(&call, limit, given, results);
}

static void run_given(vndf_call call, vndf_instructions limit, vndf_normals wm, float *first, float *second)
{
    const float *const given[3] = {wm.x, wm.y, wm.z};
    float *const results[VNDF_WRITES] = {first, second};
    run(&call, limit, given, results);
}

static void run_area(vndf_call call, vndf_instructions limit, float *result)
{
    const float *const given[3] = {NULL};
    float *const results[VNDF_WRITES] = {result};
    run(&call, limit, given, results);
}

void vndf_sample_n(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf)
{
    run_sample(plain_call(VNDF_TASK_SAMPLE, b), b->limit, u1, u2, wm, pdf, NULL);
}

void vndf_sample_weight_n(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf,
                          float *weight)
{
    run_sample(plain_call(VNDF_TASK_SAMPLE, b), b->limit, u1, u2, wm, pdf, weight);
}

void vndf_affine_sample_n(const vndf_affine_batch *b, const float *u1, const float *u2, vndf_normals wm,
                          float *pdf)
{
    run_sample(affine_call(VNDF_TASK_SAMPLE, b), b->limit, u1, u2, wm, pdf, NULL);
}

void vndf_affine_sample_weight_n(const vndf_affine_batch *b, const float *u1, const float *u2, vndf_normals wm,
                                 float *pdf, float *weight)
{
    run_sample(affine_call(VNDF_TASK_SAMPLE, b), b->limit, u1, u2, wm, pdf, weight);
}

void vndf_pdf_n(const vndf_batch *b, vndf_normals wm, float *pdf)
{
    run_given(plain_call(VNDF_TASK_PDF, b), b->limit, wm, pdf, NULL);
}

void vndf_affine_pdf_n(const vndf_affine_batch *b, vndf_normals wm, float *pdf)
{
    run_given(affine_call(VNDF_TASK_PDF, b), b->limit, wm, pdf, NULL);
}

void vndf_visible_n(const vndf_batch *b, vndf_normals wm, float *visible)
{
    run_given(plain_call(VNDF_TASK_VISIBLE, b), b->limit, wm, visible, NULL);
}

void vndf_affine_visible_n(const vndf_affine_batch *b, vndf_normals wm, float *visible)
{
    run_given(affine_call(VNDF_TASK_VISIBLE, b), b->limit, wm, visible, NULL);
}

void vndf_invert_n(const vndf_batch *b, vndf_normals wm, float *u1, float *u2)
{
    run_given(plain_call(VNDF_TASK_INVERT, b), b->limit, wm, u1, u2);
}

void vndf_affine_invert_n(const vndf_affine_batch *b, vndf_normals wm, float *u1, float *u2)
{
    run_given(affine_call(VNDF_TASK_INVERT, b), b->limit, wm, u1, u2);
}

void vndf_ndf_n(const vndf_batch *b, vndf_normals wm, float *ndf)
{
    run_given(plain_call(VNDF_TASK_NDF, b), b->limit, wm, ndf, NULL);
}

void vndf_affine_ndf_n(const vndf_affine_batch *b, vndf_normals wm, float *ndf)
{
    run_given(affine_call(VNDF_TASK_NDF, b), b->limit, wm, ndf, NULL);
}

void vndf_projected_area_n(const vndf_batch *b, float *area)
{
    run_area(plain_call(VNDF_TASK_AREA, b), b->limit, area);
}

void vndf_affine_projected_area_n(const vndf_affine_batch *b, float *area)
{
    run_area(affine_call(VNDF_TASK_AREA, b), b->limit, area);
}

void vndf_lambda_n(const vndf_batch *b, float *lambda)
{
    run_area(plain_call(VNDF_TASK_LAMBDA, b), b->limit, lambda);
}

void vndf_affine_lambda_n(const vndf_affine_batch *b, float *lambda)
{
    run_area(affine_call(VNDF_TASK_LAMBDA, b), b->limit, lambda);
}

void vndf_g1_n(const vndf_batch *b, float *g1)
{
    run_area(plain_call(VNDF_TASK_G1, b), b->limit, g1);
}

void vndf_affine_g1_n(const vndf_affine_batch *b, float *g1)
{
    run_area(affine_call(VNDF_TASK_G1, b), b->limit, g1);
}

/* ---- mixtures ---- */

static void run_mixture(vndf_task task, const vndf_mixture_batch *b, const float *const given[3],
                        float *const results[4], const int *asked, int *lobe)
{
    vndf_mixture_call call = {.task = task, .count = b->count, .lobes = b->lobes, .asked = asked, .drawn = lobe};
    int whole = b->lobes >= 1 && b->lobes <= VNDF_MIXTURE_LOBES && b->count > 1;
    for (int l = 0; l < b->lobes && l < VNDF_MIXTURE_LOBES; l++) {
        const vndf_lobe_batch *a = &b->lobe[l];
        const vndf_affine_batch of = {a->distribution, b->count,  b->shared, b->limit, a->xx,   a->xy,  a->yx,
                                      a->yy,           a->mean_x, a->mean_y, b->wi_x,  b->wi_y, b->wi_z};
        call.lobe[l] = affine_call(task, &of);
        call.lobe[l].shared |= b->shared & VNDF_SHARED_WEIGHT ? 1u << VNDF_READ_WEIGHT : 0;
        call.lobe[l].read[VNDF_READ_WEIGHT] = a->weight;
        for (int i = 0; i < 3; i++)
            call.lobe[l].read[VNDF_READ_A + i] = given[i];
        whole = whole && a->distribution;
    }
    for (int i = 0; i < 4; i++)
        call.write[i] = results[i];
    if (whole)
        run_mixture_lanes(&call, b->limit);
    else
        vndf_mixture_one_by_one(&call);
}

static void run_mixture_given(vndf_task task, const vndf_mixture_batch *b, vndf_normals wm, float *result)
{
    const float *const given[3] = {wm.x, wm.y, wm.z};
    float *const results[4] = {result};
    run_mixture(task, b, given, results, NULL, NULL);
}

void vndf_mixture_sample_n(const vndf_mixture_batch *b, const float *u1, const float *u2, vndf_normals wm,
                           float *pdf, int *lobe)
{
    const float *const given[3] = {u1, u2};
    float *const results[4] = {wm.x, wm.y, wm.z, pdf};
    run_mixture(VNDF_TASK_SAMPLE, b, given, results, NULL, lobe);
}

void vndf_mixture_pdf_n(const vndf_mixture_batch *b, vndf_normals wm, float *pdf)
{
    run_mixture_given(VNDF_TASK_PDF, b, wm, pdf);
}

void vndf_mixture_visible_n(const vndf_mixture_batch *b, vndf_normals wm, float *visible)
{
    run_mixture_given(VNDF_TASK_VISIBLE, b, wm, visible);
}

void vndf_mixture_invert_n(const vndf_mixture_batch *b, vndf_normals wm, const int *asked, float *u1, float *u2,
                           int *lobe)
{
    const float *const given[3] = {wm.x, wm.y, wm.z};
    float *const results[4] = {u1, u2};
    run_mixture(VNDF_TASK_INVERT, b, given, results, asked, lobe);
}

void vndf_mixture_ndf_n(const vndf_mixture_batch *b, vndf_normals wm, float *ndf)
{
    run_mixture_given(VNDF_TASK_NDF, b, wm, ndf);
}

static const vndf_normals NO_NORMALS = {NULL, NULL, NULL};

void vndf_mixture_projected_area_n(const vndf_mixture_batch *b, float *area)
{
    run_mixture_given(VNDF_TASK_AREA, b, NO_NORMALS, area);
}

void vndf_mixture_lambda_n(const vndf_mixture_batch *b, float *lambda)
{
    run_mixture_given(VNDF_TASK_LAMBDA, b, NO_NORMALS, lambda);
}

void vndf_mixture_g1_n(const vndf_mixture_batch *b, float *g1)
{
    run_mixture_given(VNDF_TASK_G1, b, NO_NORMALS, g1);
}
