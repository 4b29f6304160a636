/* Densities, D, areas, Lambda, G1 and inverses of a batch: in lanes of doubles where the processor has them
 * (lanes_eval.h, lanes_invert.h), else one after the other. */
#include <string.h>

#include "core/inline.h"
#include "sampler/batch/batch.h"
#include "sampler/batch/lanes_sample.h"
#include "sampler/batch/lanes_eval.h"
#include "sampler/batch/lanes_invert.h"
#include "sampler/surface.h"

/* The question that a call asks of all elements, its normals, and where the answers go. */
typedef struct call {
    const vndf_batch *batch;
    vndf_question question;
    vndf_normals wm;
    float *to;
} call;

/* ---- one by one ---- */

/* The answer for element i, by the scalar call. */
static float answer_of(const call *c, size_t i)
{
    vndf_surface surface = vndf_batch_surface(c->batch, i);
    switch (c->question) {
    case VNDF_ASK_NDF: return vndf_ndf(&surface, vndf_batch_normal(c->wm, i));
    case VNDF_ASK_AREA: return vndf_projected_area(&surface, vndf_batch_wi(c->batch, i));
    case VNDF_ASK_LAMBDA: return vndf_lambda(&surface, vndf_batch_wi(c->batch, i));
    case VNDF_ASK_G1: return vndf_g1(&surface, vndf_batch_wi(c->batch, i));
    default: break;
    }
    vndf_view view;
    vndf_view_bare(&view, &surface, vndf_batch_wi(c->batch, i));
    vndf_vec3 wm = vndf_batch_normal(c->wm, i);
    return c->question == VNDF_ASK_PDF ? vndf_pdf(&view, wm) : vndf_visible(&view, wm);
}

static void answer_one_by_one(const call *c)
{
    for (size_t i = 0; i < c->batch->count; i++)
        c->to[i] = answer_of(c, i);
}

/* ---- in lanes ---- */

#if VNDF_HAS_LANES

/* Copies of inputs (vndf_batch_input). */
typedef struct copies {
    float of[VNDF_EVAL_INPUTS][VNDF_EVAL_BLOCK];
} copies;

static void read_block(vndf_eval_inputs *in, uint32_t count, const call *c, size_t first, copies *own)
{
    in->normal[0] = in->facing = NULL;
    const vndf_batch *b = c->batch;
    const float *from[VNDF_EVAL_INPUTS] = {b->alpha_x, b->alpha_y, b->wi_x, b->wi_y,
                                           b->wi_z,    c->wm.x,    c->wm.y, c->wm.z};
    int last = vndf_question_is_of_direction(c->question) ? VNDF_EVAL_WI_Z : VNDF_EVAL_Z;
    for (int n = 0; n <= last; n++) {
        if (c->question == VNDF_ASK_NDF && n >= VNDF_EVAL_WI_X && n <= VNDF_EVAL_WI_Z)
            continue; /* D needs no wi; the arrays may be missing */
        unsigned bit = n <= VNDF_EVAL_ALPHA_Y ? VNDF_SHARED_ALPHA : n <= VNDF_EVAL_WI_Z ? VNDF_SHARED_WI : 0;
        in->of[n] = vndf_batch_input(from[n], (b->shared & bit) != 0, first, count, VNDF_EVAL_BLOCK, own->of[n]);
    }
}

/* Answers may overwrite inputs, so they are stored after the whole block is read. */
static void answer_in_lanes(const call *c)
{
    const vndf_batch *b = c->batch;
    int wide = vndf_instructions_used(b->limit) == VNDF_INSTRUCTIONS_AVX512;
    vndf_eval_block block;
    copies own;
    block.exact = NULL;
    for (size_t first = 0; first < b->count; first += block.count) {
        size_t rest = b->count - first;
        block.count = rest < VNDF_EVAL_BLOCK ? (uint32_t)rest : VNDF_EVAL_BLOCK;
        read_block(&block.in, block.count, c, first, &own);
        if (wide)
            vndf_eval_block_avx512(b->distribution, c->question, &block);
        else
            vndf_eval_block_avx2(b->distribution, c->question, &block);
        for (uint32_t n = 0; n < block.left_count; n++)
            block.value[block.left[n]] = answer_of(c, first + block.left[n]);
        memcpy(c->to + first, block.value, block.count * sizeof(float));
    }
}

#else

static void answer_in_lanes(const call *c)
{
    answer_one_by_one(c);
}

#endif

static void answer(const call *c)
{
    if (vndf_question_is_of_direction(c->question) && vndf_batch_is_one_view(c->batch)) {
        float all = answer_of(c, 0);
        for (size_t i = 0; i < c->batch->count; i++)
            c->to[i] = all;
    } else if (vndf_batch_has_lanes(c->batch)) {
        answer_in_lanes(c);
    } else {
        answer_one_by_one(c);
    }
}

/* ---- the calls ---- */

void vndf_pdf_n(const vndf_batch *b, vndf_normals wm, float *pdf)
{
    call c = {b, VNDF_ASK_PDF, wm, pdf};
    answer(&c);
}

void vndf_visible_n(const vndf_batch *b, vndf_normals wm, float *visible)
{
    call c = {b, VNDF_ASK_VISIBLE, wm, visible};
    answer(&c);
}

void vndf_ndf_n(const vndf_batch *b, vndf_normals wm, float *ndf)
{
    call c = {b, VNDF_ASK_NDF, wm, ndf};
    answer(&c);
}

static const vndf_normals no_normals = {NULL, NULL, NULL};

void vndf_projected_area_n(const vndf_batch *b, float *area)
{
    call c = {b, VNDF_ASK_AREA, no_normals, area};
    answer(&c);
}

void vndf_lambda_n(const vndf_batch *b, float *lambda)
{
    call c = {b, VNDF_ASK_LAMBDA, no_normals, lambda};
    answer(&c);
}

void vndf_g1_n(const vndf_batch *b, float *g1)
{
    call c = {b, VNDF_ASK_G1, no_normals, g1};
    answer(&c);
}

/* ---- inverses ---- */

VNDF_INLINE void invert_one(const vndf_view *view, const vndf_batch_call *c, size_t i)
{
    float u1, u2;
    vndf_invert(view, vndf_batch_normal(c->wm, i), &u1, &u2);
    c->to1[i] = u1;
    c->to2[i] = u2;
}

#if VNDF_HAS_LANES

/* Inverts the normals that lanes have left, before results overwrite inputs. */
static void invert_left(const vndf_batch *b, vndf_normals wm, size_t first, vndf_invert_block *block)
{
    for (uint32_t n = 0; n < block->left_count; n++) {
        uint32_t i = block->left[n];
        vndf_view view = vndf_batch_view(b, first + i);
        vndf_invert(&view, vndf_batch_normal(wm, first + i), &block->u1[i], &block->u2[i]);
    }
}

static void invert_in_lanes(const vndf_batch *b, const vndf_batch_call *c)
{
    const call question = {b, VNDF_ASK_PDF, c->wm, NULL}; /* which asks for the same inputs */
    int wide = vndf_instructions_used(b->limit) == VNDF_INSTRUCTIONS_AVX512;
    vndf_eval_inputs in;
    vndf_invert_block block;
    copies own;
    for (size_t first = 0; first < b->count; first += block.count) {
        size_t rest = b->count - first;
        block.count = rest < VNDF_EVAL_BLOCK ? (uint32_t)rest : VNDF_EVAL_BLOCK;
        read_block(&in, block.count, &question, first, &own);
        for (int n = 0; n < VNDF_EVAL_INPUTS; n++)
            block.of[n] = in.of[n];
        if (wide)
            vndf_invert_block_avx512(b->distribution, &block);
        else
            vndf_invert_block_avx2(b->distribution, &block);
        invert_left(b, c->wm, first, &block);
        memcpy(c->to1 + first, block.u1, block.count * sizeof(float));
        memcpy(c->to2 + first, block.u2, block.count * sizeof(float));
    }
}

#else

static void invert_in_lanes(const vndf_batch *b, const vndf_batch_call *c)
{
    vndf_batch_for_each_view(b, c, invert_one);
}

#endif

/* Whether lanes would leave every normal: all share a view of a table that does not draw in float. */
static int is_left(const vndf_batch *b)
{
    if (!vndf_batch_is_one_view(b) || !vndf_is_table(b->distribution))
        return 0;
    vndf_view view = vndf_batch_view(b, 0);
    return !view.trusted;
}

void vndf_invert_n(const vndf_batch *b, vndf_normals wm, float *u1, float *u2)
{
    vndf_batch_call c = {wm, NULL, NULL, u1, u2};
    if (vndf_batch_has_lanes(b) && !is_left(b))
        invert_in_lanes(b, &c);
    else
        vndf_batch_for_each_view(b, &c, invert_one);
}
