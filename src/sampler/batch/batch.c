/* Batches: which instruction set they run on, and the arrays of each call. Lanes (lanes_block.c) take tables and closed
 * forms; mixtures, and all calls where the compiler has no lanes, go one by one. */
#include "sampler/batch/call.h"
#include "sampler/batch/elements.h"
#include "sampler/sampler.h"

/* ---- instruction sets ---- */

#if VNDF_HAS_WIDE_LANES

static int has_avx2(void)
{
    return __builtin_cpu_supports("avx2");
}

static int has_avx512(void)
{
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
}

vndf_instructions vndf_instructions_used(vndf_instructions limit)
{
    if ((limit == VNDF_INSTRUCTIONS_BEST || limit >= VNDF_INSTRUCTIONS_AVX512) && has_avx512())
        return VNDF_INSTRUCTIONS_AVX512;
    if ((limit == VNDF_INSTRUCTIONS_BEST || limit >= VNDF_INSTRUCTIONS_AVX2) && has_avx2())
        return VNDF_INSTRUCTIONS_AVX2;
    return VNDF_INSTRUCTIONS_PORTABLE;
}

static vndf_lanes *lanes_of(vndf_instructions limit)
{
    vndf_instructions used = vndf_instructions_used(limit);
    return used == VNDF_INSTRUCTIONS_AVX512 ? vndf_lanes_16
           : used == VNDF_INSTRUCTIONS_AVX2 ? vndf_lanes_8
                                            : vndf_lanes_4;
}

#else

vndf_instructions vndf_instructions_used(vndf_instructions limit)
{
    (void)limit;
    return VNDF_INSTRUCTIONS_PORTABLE;
}

static vndf_lanes *lanes_of(vndf_instructions limit)
{
    (void)limit;
#  if defined(__GNUC__)
    return vndf_lanes_4;
#  else
    return vndf_one_by_one;
#  endif
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
        lanes_of(limit)(call);
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

static vndf_vec3 normal_at(vndf_normals wm, size_t i)
{
    vndf_vec3 n = {wm.x[i], wm.y[i], wm.z[i]};
    return n;
}

static vndf_mixture_view view_at(const vndf_mixture_batch *b, size_t i)
{
    vndf_mixture m = vndf_batch_mixture(b, i);
    return vndf_mixture_view_from(&m, vndf_batch_mixture_direction(b, i));
}

void vndf_mixture_sample_n(const vndf_mixture_batch *b, const float *u1, const float *u2, vndf_normals wm,
                           float *pdf, int *lobe)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_mixture_view view = view_at(b, i);
        vndf_vec3 n = vndf_mixture_sample(&view, u1[i], u2[i], pdf ? &pdf[i] : NULL, lobe ? &lobe[i] : NULL);
        wm.x[i] = n.x;
        wm.y[i] = n.y;
        wm.z[i] = n.z;
    }
}

void vndf_mixture_pdf_n(const vndf_mixture_batch *b, vndf_normals wm, float *pdf)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_mixture_view view = view_at(b, i);
        pdf[i] = vndf_mixture_pdf(&view, normal_at(wm, i));
    }
}

void vndf_mixture_visible_n(const vndf_mixture_batch *b, vndf_normals wm, float *visible)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_mixture_view view = view_at(b, i);
        visible[i] = vndf_mixture_visible(&view, normal_at(wm, i));
    }
}

void vndf_mixture_invert_n(const vndf_mixture_batch *b, vndf_normals wm, const int *asked, float *u1, float *u2,
                           int *lobe)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_mixture_view view = view_at(b, i);
        float first, second;
        int index = vndf_mixture_invert(&view, normal_at(wm, i), asked ? asked[i] : -1, &first, &second);
        u1[i] = first;
        u2[i] = second;
        if (lobe)
            lobe[i] = index;
    }
}

void vndf_mixture_ndf_n(const vndf_mixture_batch *b, vndf_normals wm, float *ndf)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_mixture m = vndf_batch_mixture(b, i);
        ndf[i] = vndf_mixture_ndf(&m, normal_at(wm, i));
    }
}

/* A function of mixtures and directions, for each element. */
static void for_each_direction(const vndf_mixture_batch *b, float (*of)(const vndf_mixture *, vndf_vec3),
                               float *to)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_mixture m = vndf_batch_mixture(b, i);
        to[i] = of(&m, vndf_batch_mixture_direction(b, i));
    }
}

void vndf_mixture_projected_area_n(const vndf_mixture_batch *b, float *area)
{
    for_each_direction(b, vndf_mixture_projected_area, area);
}

void vndf_mixture_lambda_n(const vndf_mixture_batch *b, float *lambda)
{
    for_each_direction(b, vndf_mixture_lambda, lambda);
}

void vndf_mixture_g1_n(const vndf_mixture_batch *b, float *g1)
{
    for_each_direction(b, vndf_mixture_g1, g1);
}
