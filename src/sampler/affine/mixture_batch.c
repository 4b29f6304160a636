/* Batches of mixtures: in blocks, where the processor has lanes (mixture_block.h, mixture_draw.h), else one after the
 * other. The inverse always takes one after the other. */
#include <string.h>

#include "sampler/affine/densities.h"
#include "sampler/affine/mixture_draw.h"
#include "sampler/batch/batch.h"

/* ---- one by one ---- */

static vndf_mixture mixture_at(const vndf_mixture_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_ALPHA ? 0 : i;
    vndf_mixture mixture;
    mixture.count = b->lobes;
    for (int l = 0; l < b->lobes && l < VNDF_MIXTURE_LOBES; l++) {
        const vndf_lobe_batch *from = &b->lobe[l];
        vndf_affine surface = {from->distribution,
                               vndf_batch_number(from->xx, at),
                               vndf_batch_number(from->xy, at),
                               vndf_batch_number(from->yx, at),
                               vndf_batch_number(from->yy, at),
                               vndf_batch_number(from->mean_x, at),
                               vndf_batch_number(from->mean_y, at)};
        mixture.lobe[l].surface = surface;
        mixture.lobe[l].weight = from->weight[b->shared & VNDF_SHARED_WEIGHT ? 0 : i];
    }
    return mixture;
}

static vndf_vec3 wi_at(const vndf_mixture_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_WI ? 0 : i;
    return vndf_vec3_of(b->wi_x[at], b->wi_y[at], b->wi_z[at]);
}

/* The view that all elements share, made in *view; NULL if there is none. */
static const vndf_mixture_view *shared_view(const vndf_mixture_batch *b, vndf_mixture_view *view)
{
    const unsigned all = VNDF_SHARED_ALPHA | VNDF_SHARED_WI | VNDF_SHARED_WEIGHT;
    if ((b->shared & all) != all || b->count == 0)
        return NULL;
    vndf_mixture mixture = mixture_at(b, 0);
    vndf_mixture_view_set(view, &mixture, wi_at(b, 0));
    return view;
}

/* The view of element i: `one` if all share it, or else its own, made in *view. */
static const vndf_mixture_view *view_at(const vndf_mixture_batch *b, const vndf_mixture_view *one, size_t i,
                                        vndf_mixture_view *view)
{
    if (one)
        return one;
    vndf_mixture mixture = mixture_at(b, i);
    vndf_mixture_view_set(view, &mixture, wi_at(b, i));
    return view;
}

/* A question of all elements, and the view that they share, or NULL. */
typedef struct call {
    const vndf_mixture_batch *batch;
    vndf_question question;
    vndf_normals wm;
    float *to;
    const vndf_mixture_view *one;
} call;

static float answer_of_normal(const call *c, size_t i)
{
    vndf_mixture_view own;
    const vndf_mixture_view *view = view_at(c->batch, c->one, i, &own);
    vndf_vec3 wm = vndf_batch_normal(c->wm, i);
    return c->question == VNDF_ASK_PDF ? vndf_mixture_pdf(view, wm) : vndf_mixture_visible(view, wm);
}

static float answer_of(const call *c, size_t i)
{
    if (c->question == VNDF_ASK_PDF || c->question == VNDF_ASK_VISIBLE)
        return answer_of_normal(c, i);
    vndf_mixture mixture = mixture_at(c->batch, i);
    switch (c->question) {
    case VNDF_ASK_NDF: return vndf_mixture_ndf(&mixture, vndf_batch_normal(c->wm, i));
    case VNDF_ASK_AREA: return vndf_mixture_projected_area(&mixture, wi_at(c->batch, i));
    case VNDF_ASK_LAMBDA: return vndf_mixture_lambda(&mixture, wi_at(c->batch, i));
    default: return vndf_mixture_g1(&mixture, wi_at(c->batch, i));
    }
}

/* The arrays of a sample call, and one result. */
typedef struct draw {
    const vndf_mixture_batch *batch;
    const float *u1, *u2;
    vndf_normals wm;
    float *pdf;
    int *lobe;
    const vndf_mixture_view *one;
} draw;

typedef struct sample {
    vndf_vec3 wm;
    float pdf;
    int lobe;
} sample;

static sample sample_of(const draw *c, size_t i)
{
    vndf_mixture_view own;
    sample s = {{0.0f, 0.0f, 1.0f}, 0.0f, -1};
    s.wm = vndf_mixture_sample(view_at(c->batch, c->one, i, &own), c->u1[i], c->u2[i], c->pdf ? &s.pdf : NULL,
                               &s.lobe);
    return s;
}

static void sample_one_by_one(const draw *c)
{
    for (size_t i = 0; i < c->batch->count; i++) {
        sample s = sample_of(c, i);
        c->wm.x[i] = s.wm.x;
        c->wm.y[i] = s.wm.y;
        c->wm.z[i] = s.wm.z;
        if (c->pdf)
            c->pdf[i] = s.pdf;
        if (c->lobe)
            c->lobe[i] = s.lobe;
    }
}

/* ---- in blocks ---- */

#if VNDF_HAS_LANES

static int has_lanes(const vndf_mixture_batch *b)
{
    if (b->lobes < 1 || b->lobes > VNDF_MIXTURE_LOBES || b->count < 2 ||
        vndf_instructions_used(b->limit) == VNDF_INSTRUCTIONS_PORTABLE)
        return 0;
    for (int l = 0; l < b->lobes; l++) /* lanes have no double */
        if (b->lobe[l].distribution && !(vndf_unit_scale_float(b->lobe[l].distribution) > 0.0f))
            return 0;
    return 1;
}

/* ---- answers ---- */

/* Answers may overwrite inputs, so they are stored after the whole block is read. */
static void answer_in_blocks(const call *c)
{
    vndf_mixture_block at;
    float value[VNDF_AXES_BLOCK];
    for (vndf_mixture_begin(&at, c->batch); vndf_mixture_next(&at, c->question != VNDF_ASK_NDF);) {
        unsigned char left[VNDF_AXES_BLOCK] = {0};
        vndf_mixture_answer(&at, c->question, c->wm, value, left);
        for (uint32_t i = 0; i < at.walk.count; i++)
            if (left[i])
                value[i] = answer_of(c, at.walk.first + i);
        memcpy(c->to + at.walk.first, value, at.walk.count * sizeof(float));
    }
}

/* ---- samples ---- */

static void draw_left(const vndf_mixture_block *at, const draw *c, vndf_mixture_drawn *to)
{
    for (uint32_t i = 0; i < at->walk.count; i++) {
        if (!to->left[i])
            continue;
        sample s = sample_of(c, at->walk.first + i);
        to->x[i] = s.wm.x;
        to->y[i] = s.wm.y;
        to->z[i] = s.wm.z;
        to->pdf[i] = s.pdf;
    }
}

static void sample_in_blocks(const draw *c)
{
    vndf_mixture_block at;
    vndf_mixture_drawn to;
    for (vndf_mixture_begin(&at, c->batch); vndf_mixture_next(&at, 1);) {
        size_t bytes = at.walk.count * sizeof(float);
        const float *u1 = vndf_mixture_more(&at, 0, c->u1), *u2 = vndf_mixture_more(&at, 1, c->u2);
        vndf_mixture_draw(&at, u1, u2, c->pdf != NULL, &to);
        draw_left(&at, c, &to);
        memcpy(c->wm.x + at.walk.first, to.x, bytes);
        memcpy(c->wm.y + at.walk.first, to.y, bytes);
        memcpy(c->wm.z + at.walk.first, to.z, bytes);
        if (c->pdf)
            memcpy(c->pdf + at.walk.first, to.pdf, bytes);
        if (c->lobe)
            memcpy(c->lobe + at.walk.first, to.lobe, at.walk.count * sizeof(int));
    }
}

#else

static int has_lanes(const vndf_mixture_batch *b)
{
    (void)b;
    return 0;
}

static void answer_in_blocks(const call *c)
{
    (void)c;
}

static void sample_in_blocks(const draw *c)
{
    (void)c;
}

#endif

static void ask(const vndf_mixture_batch *b, vndf_question question, vndf_normals wm, float *to)
{
    vndf_mixture_view view;
    call c = {b, question, wm, to, NULL};
    if (question == VNDF_ASK_PDF || question == VNDF_ASK_VISIBLE)
        c.one = shared_view(b, &view);
    if (has_lanes(b)) {
        answer_in_blocks(&c);
        return;
    }
    for (size_t i = 0; i < b->count; i++)
        to[i] = answer_of(&c, i);
}

/* ---- the calls ---- */

void vndf_mixture_sample_n(const vndf_mixture_batch *b, const float *u1, const float *u2, vndf_normals wm,
                           float *pdf, int *lobe)
{
    vndf_mixture_view view;
    draw c = {b, u1, u2, wm, pdf, lobe, shared_view(b, &view)};
    if (has_lanes(b))
        sample_in_blocks(&c);
    else
        sample_one_by_one(&c);
}

void vndf_mixture_pdf_n(const vndf_mixture_batch *b, vndf_normals wm, float *pdf)
{
    ask(b, VNDF_ASK_PDF, wm, pdf);
}

void vndf_mixture_visible_n(const vndf_mixture_batch *b, vndf_normals wm, float *visible)
{
    ask(b, VNDF_ASK_VISIBLE, wm, visible);
}

void vndf_mixture_ndf_n(const vndf_mixture_batch *b, vndf_normals wm, float *ndf)
{
    ask(b, VNDF_ASK_NDF, wm, ndf);
}

static const vndf_normals no_normals = {NULL, NULL, NULL};

void vndf_mixture_projected_area_n(const vndf_mixture_batch *b, float *area)
{
    ask(b, VNDF_ASK_AREA, no_normals, area);
}

void vndf_mixture_lambda_n(const vndf_mixture_batch *b, float *lambda)
{
    ask(b, VNDF_ASK_LAMBDA, no_normals, lambda);
}

void vndf_mixture_g1_n(const vndf_mixture_batch *b, float *g1)
{
    ask(b, VNDF_ASK_G1, no_normals, g1);
}

void vndf_mixture_invert_n(const vndf_mixture_batch *b, vndf_normals wm, const int *asked, float *u1, float *u2,
                           int *lobe)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_mixture mixture = mixture_at(b, i);
        vndf_mixture_view view = vndf_mixture_view_from(&mixture, wi_at(b, i));
        float v1, v2;
        int found = vndf_mixture_invert(&view, vndf_batch_normal(wm, i), asked ? asked[i] : -1, &v1, &v2);
        u1[i] = v1;
        u2[i] = v2;
        if (lobe)
            lobe[i] = found;
    }
}
