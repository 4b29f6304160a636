/* Batches: which instruction set they run on, and the arrays of each call. Lanes (lanes_block.c, mixture_lanes.h) take
 * all surfaces; single elements, lobes without a distribution, and all calls where the compiler has no lanes, go one by
 * one. */
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
static vndf_lanes *lanes_for(const vndf_call *call, vndf_instructions limit)
{
    vndf_instructions used = vndf_instructions_used(limit);
    if (used == VNDF_INSTRUCTIONS_AVX512 && call->count <= 256 && !call->mixed &&
        vndf_is_table(call->lobe->distribution))
        used = VNDF_INSTRUCTIONS_AVX2;
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

static vndf_lanes *lanes_for(const vndf_call *call, vndf_instructions limit)
{
    (void)call;
    (void)limit;
#  if defined(__GNUC__)
    return vndf_lanes_4;
#  else
    return vndf_one_by_one;
#  endif
}

#endif

/* ---- calls ---- */

static const unsigned SURFACE = 1u << VNDF_READ_XX | 1u << VNDF_READ_XY | 1u << VNDF_READ_YX | 1u << VNDF_READ_YY |
                                1u << VNDF_READ_MEAN_X | 1u << VNDF_READ_MEAN_Y;
static const unsigned DIRECTION = 1u << VNDF_READ_WI_X | 1u << VNDF_READ_WI_Y | 1u << VNDF_READ_WI_Z;

static vndf_lobe_call lobe_of(const vndf_affine_batch *b, const vndf_call *call)
{
    const vndf_lobe_call lobe = {b->distribution,
                                 (b->shared & VNDF_SHARED_ALPHA ? SURFACE : 0) |
                                     (b->shared & VNDF_SHARED_WI ? DIRECTION : 0),
                                 {b->xx, b->xy, b->yx, b->yy, b->mean_x, b->mean_y, b->wi_x, b->wi_y, b->wi_z,
                                  call->given[0], call->given[1], call->given[2]}};
    return lobe;
}

static void run_affine(const vndf_affine_batch *b, vndf_call call)
{
    const vndf_lobe_call lobe = lobe_of(b, &call);
    call.count = b->count;
    call.lobe = &lobe;
    (b->distribution && b->count > 1 ? lanes_for(&call, b->limit) : vndf_one_by_one)(&call);
}

/* Roughness is a diagonal matrix. */
static void run_plain(const vndf_batch *b, vndf_call call)
{
    const vndf_affine_batch affine = {b->distribution, b->count, b->shared, b->limit, b->alpha_x, NULL,   NULL,
                                      b->alpha_y,      NULL,     NULL,      b->wi_x,  b->wi_y,    b->wi_z};
    call.diagonal = 1;
    run_affine(&affine, call);
}

static void run_mixture(const vndf_mixture_batch *b, vndf_call call)
{
    vndf_lobe_call lobe[VNDF_MIXTURE_LOBES] = {{NULL, 0, {NULL}}};
    int whole = b->lobes >= 1 && b->lobes <= VNDF_MIXTURE_LOBES && b->count > 1;
    for (int l = 0; l < b->lobes && l < VNDF_MIXTURE_LOBES; l++) {
        const vndf_lobe_batch *a = &b->lobe[l];
        const vndf_affine_batch of = {a->distribution, b->count,  b->shared, b->limit, a->xx,   a->xy,  a->yx,
                                      a->yy,           a->mean_x, a->mean_y, b->wi_x,  b->wi_y, b->wi_z};
        lobe[l] = lobe_of(&of, &call);
        lobe[l].shared |= b->shared & VNDF_SHARED_WEIGHT ? 1u << VNDF_READ_WEIGHT : 0;
        lobe[l].read[VNDF_READ_WEIGHT] = a->weight;
        whole = whole && a->distribution;
    }
    call.count = b->count;
    call.mixed = 1;
    call.lobes = b->lobes;
    call.lobe = lobe;
    (whole ? lanes_for(&call, b->limit) : vndf_one_by_one)(&call);
}

/* What is asked for: samples; something of given normals; something of directions. */
static vndf_call sample_call(const float *u1, const float *u2, vndf_normals wm, float *pdf, float *weight,
                             int *lobe)
{
    const vndf_call call = {
        .task = VNDF_TASK_SAMPLE, .given = {u1, u2}, .write = {wm.x, wm.y, wm.z, pdf, weight}, .drawn = lobe};
    return call;
}

static vndf_call given_call(vndf_task task, vndf_normals wm, float *first, float *second)
{
    const vndf_call call = {.task = task, .given = {wm.x, wm.y, wm.z}, .write = {first, second}};
    return call;
}

static vndf_call area_call(vndf_task task, float *to)
{
    const vndf_call call = {.task = task, .write = {to}};
    return call;
}

/* ---- surfaces ---- */

void vndf_sample_n(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf)
{
    run_plain(b, sample_call(u1, u2, wm, pdf, NULL, NULL));
}

void vndf_sample_weight_n(const vndf_batch *b, const float *u1, const float *u2, vndf_normals wm, float *pdf,
                          float *weight)
{
    run_plain(b, sample_call(u1, u2, wm, pdf, weight, NULL));
}

void vndf_pdf_n(const vndf_batch *b, vndf_normals wm, float *pdf)
{
    run_plain(b, given_call(VNDF_TASK_PDF, wm, pdf, NULL));
}

void vndf_visible_n(const vndf_batch *b, vndf_normals wm, float *visible)
{
    run_plain(b, given_call(VNDF_TASK_VISIBLE, wm, visible, NULL));
}

void vndf_invert_n(const vndf_batch *b, vndf_normals wm, float *u1, float *u2)
{
    run_plain(b, given_call(VNDF_TASK_INVERT, wm, u1, u2));
}

void vndf_ndf_n(const vndf_batch *b, vndf_normals wm, float *ndf)
{
    run_plain(b, given_call(VNDF_TASK_NDF, wm, ndf, NULL));
}

void vndf_projected_area_n(const vndf_batch *b, float *area)
{
    run_plain(b, area_call(VNDF_TASK_AREA, area));
}

void vndf_lambda_n(const vndf_batch *b, float *lambda)
{
    run_plain(b, area_call(VNDF_TASK_LAMBDA, lambda));
}

void vndf_g1_n(const vndf_batch *b, float *g1)
{
    run_plain(b, area_call(VNDF_TASK_G1, g1));
}

/* ---- affine surfaces ---- */

void vndf_affine_sample_n(const vndf_affine_batch *b, const float *u1, const float *u2, vndf_normals wm,
                          float *pdf)
{
    run_affine(b, sample_call(u1, u2, wm, pdf, NULL, NULL));
}

void vndf_affine_sample_weight_n(const vndf_affine_batch *b, const float *u1, const float *u2, vndf_normals wm,
                                 float *pdf, float *weight)
{
    run_affine(b, sample_call(u1, u2, wm, pdf, weight, NULL));
}

void vndf_affine_pdf_n(const vndf_affine_batch *b, vndf_normals wm, float *pdf)
{
    run_affine(b, given_call(VNDF_TASK_PDF, wm, pdf, NULL));
}

void vndf_affine_visible_n(const vndf_affine_batch *b, vndf_normals wm, float *visible)
{
    run_affine(b, given_call(VNDF_TASK_VISIBLE, wm, visible, NULL));
}

void vndf_affine_invert_n(const vndf_affine_batch *b, vndf_normals wm, float *u1, float *u2)
{
    run_affine(b, given_call(VNDF_TASK_INVERT, wm, u1, u2));
}

void vndf_affine_ndf_n(const vndf_affine_batch *b, vndf_normals wm, float *ndf)
{
    run_affine(b, given_call(VNDF_TASK_NDF, wm, ndf, NULL));
}

void vndf_affine_projected_area_n(const vndf_affine_batch *b, float *area)
{
    run_affine(b, area_call(VNDF_TASK_AREA, area));
}

void vndf_affine_lambda_n(const vndf_affine_batch *b, float *lambda)
{
    run_affine(b, area_call(VNDF_TASK_LAMBDA, lambda));
}

void vndf_affine_g1_n(const vndf_affine_batch *b, float *g1)
{
    run_affine(b, area_call(VNDF_TASK_G1, g1));
}

/* ---- mixtures ---- */

void vndf_mixture_sample_n(const vndf_mixture_batch *b, const float *u1, const float *u2, vndf_normals wm,
                           float *pdf, int *lobe)
{
    run_mixture(b, sample_call(u1, u2, wm, pdf, NULL, lobe));
}

void vndf_mixture_pdf_n(const vndf_mixture_batch *b, vndf_normals wm, float *pdf)
{
    run_mixture(b, given_call(VNDF_TASK_PDF, wm, pdf, NULL));
}

void vndf_mixture_visible_n(const vndf_mixture_batch *b, vndf_normals wm, float *visible)
{
    run_mixture(b, given_call(VNDF_TASK_VISIBLE, wm, visible, NULL));
}

void vndf_mixture_invert_n(const vndf_mixture_batch *b, vndf_normals wm, const int *asked, float *u1, float *u2,
                           int *lobe)
{
    vndf_call call = given_call(VNDF_TASK_INVERT, wm, u1, u2);
    call.asked = asked;
    call.drawn = lobe;
    run_mixture(b, call);
}

void vndf_mixture_ndf_n(const vndf_mixture_batch *b, vndf_normals wm, float *ndf)
{
    run_mixture(b, given_call(VNDF_TASK_NDF, wm, ndf, NULL));
}

void vndf_mixture_projected_area_n(const vndf_mixture_batch *b, float *area)
{
    run_mixture(b, area_call(VNDF_TASK_AREA, area));
}

void vndf_mixture_lambda_n(const vndf_mixture_batch *b, float *lambda)
{
    run_mixture(b, area_call(VNDF_TASK_LAMBDA, lambda));
}

void vndf_mixture_g1_n(const vndf_mixture_batch *b, float *g1)
{
    run_mixture(b, area_call(VNDF_TASK_G1, g1));
}
