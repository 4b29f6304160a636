/* Batches of mixtures: in blocks, where the processor has lanes (mixture_block.h, mixture_draw.h), else one after the
 * other. The inverse always takes one after the other. */
#include <string.h>

#include "sampler/affine/areas.h"
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

/* A question of all elements. */
typedef struct call {
    const vndf_mixture_batch *batch;
    vndf_question question;
    vndf_normals wm;
    float *to;
} call;

static float answer_of(const call *c, size_t i)
{
    vndf_mixture mixture = mixture_at(c->batch, i);
    switch (c->question) {
    case VNDF_ASK_NDF: return vndf_mixture_ndf(&mixture, vndf_batch_normal(c->wm, i));
    case VNDF_ASK_AREA: return vndf_mixture_projected_area(&mixture, wi_at(c->batch, i));
    case VNDF_ASK_LAMBDA: return vndf_mixture_lambda(&mixture, wi_at(c->batch, i));
    case VNDF_ASK_G1: return vndf_mixture_g1(&mixture, wi_at(c->batch, i));
    default: break;
    }
    vndf_mixture_view view = vndf_mixture_view_from(&mixture, wi_at(c->batch, i));
    vndf_vec3 wm = vndf_batch_normal(c->wm, i);
    return c->question == VNDF_ASK_PDF ? vndf_mixture_pdf(&view, wm) : vndf_mixture_visible(&view, wm);
}

/* The arrays of a sample call, and one result. */
typedef struct draw {
    const vndf_mixture_batch *batch;
    const float *u1, *u2;
    vndf_normals wm;
    float *pdf;
    int *lobe;
} draw;

typedef struct sample {
    vndf_vec3 wm;
    float pdf;
    int lobe;
} sample;

static sample sample_of(const draw *c, size_t i)
{
    vndf_mixture mixture = mixture_at(c->batch, i);
    vndf_mixture_view view = vndf_mixture_view_from(&mixture, wi_at(c->batch, i));
    sample s = {{0.0f, 0.0f, 1.0f}, 0.0f, -1};
    s.wm = vndf_mixture_sample(&view, c->u1[i], c->u2[i], c->pdf ? &s.pdf : NULL, &s.lobe);
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

enum { B = VNDF_AXES_BLOCK };

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

static void answer_areas(const vndf_mixture_block *at, vndf_question question, float *value)
{
    const vndf_areas_block *whole = &at->of.whole;
    for (uint32_t i = 0; i < at->walk.count; i++) {
        vndf_areas areas = {whole->toward[i], whole->away[i], whole->up[i]};
        vndf_normal w = {at->in.of[VNDF_MAP_WI_X][i], at->in.of[VNDF_MAP_WI_Y][i], at->in.of[VNDF_MAP_WI_Z][i]};
        value[i] = areas.toward < 0.0            ? 0.0f
                   : question == VNDF_ASK_AREA   ? vndf_unit_area_of(areas.toward, w, 1)
                   : question == VNDF_ASK_LAMBDA ? vndf_areas_lambda(&areas)
                                                 : vndf_areas_g1(&areas);
    }
}

/* Sums of shares, or of weights for D, times the answers of the lobes. */
static void answer_normals(vndf_mixture_block *at, const call *c, float *value, unsigned char *left)
{
    const float *const normal[3] = {vndf_mixture_more(at, 0, c->wm.x), vndf_mixture_more(at, 1, c->wm.y),
                                    vndf_mixture_more(at, 2, c->wm.z)};
    double sum[B] = {0.0};
    for (int l = 0; l < at->of.lobes; l++) {
        const vndf_surfaces of = vndf_mixture_surfaces(at, l);
        const vndf_lobe_block *lobe = &at->of.lobe[l];
        const double *part = c->question == VNDF_ASK_NDF ? lobe->weight : lobe->share;
        float own[B];
        vndf_left from;
        from.count = 0;
        if (!of.distribution)
            continue;
        vndf_block_answer(&of, c->question, normal, at->walk.count, own, &from);
        for (uint32_t i = 0; i < at->walk.count; i++)
            sum[i] += lobe->weight[i] > 0.0 ? part[i] * own[i] : 0.0;
        vndf_left_mark(&from, left);
    }
    for (uint32_t i = 0; i < at->walk.count; i++) {
        int valid = at->of.whole.toward[i] >= 0.0;
        float density = valid ? vndf_density_from(sum[i]) : 0.0f;
        value[i] = c->question == VNDF_ASK_PDF && valid && sum[i] > 0.0 ? vndf_positive(density) : density;
    }
}

/* Answers may overwrite inputs, so they are stored after the whole block is read. */
static void answer_in_blocks(const call *c)
{
    int of_direction = vndf_question_is_of_direction(c->question);
    vndf_mixture_block at;
    float value[B];
    for (vndf_mixture_begin(&at, c->batch); vndf_mixture_next(&at, c->question != VNDF_ASK_NDF);) {
        unsigned char left[B] = {0};
        if (of_direction)
            answer_areas(&at, c->question, value);
        else
            answer_normals(&at, c, value, left);
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

static void answer(const call *c)
{
    if (has_lanes(c->batch)) {
        answer_in_blocks(c);
        return;
    }
    for (size_t i = 0; i < c->batch->count; i++)
        c->to[i] = answer_of(c, i);
}

/* ---- the calls ---- */

void vndf_mixture_sample_n(const vndf_mixture_batch *b, const float *u1, const float *u2, vndf_normals wm,
                           float *pdf, int *lobe)
{
    draw c = {b, u1, u2, wm, pdf, lobe};
    if (has_lanes(b))
        sample_in_blocks(&c);
    else
        sample_one_by_one(&c);
}

void vndf_mixture_pdf_n(const vndf_mixture_batch *b, vndf_normals wm, float *pdf)
{
    call c = {b, VNDF_ASK_PDF, wm, pdf};
    answer(&c);
}

void vndf_mixture_visible_n(const vndf_mixture_batch *b, vndf_normals wm, float *visible)
{
    call c = {b, VNDF_ASK_VISIBLE, wm, visible};
    answer(&c);
}

void vndf_mixture_ndf_n(const vndf_mixture_batch *b, vndf_normals wm, float *ndf)
{
    call c = {b, VNDF_ASK_NDF, wm, ndf};
    answer(&c);
}

static const vndf_normals no_normals = {NULL, NULL, NULL};

void vndf_mixture_projected_area_n(const vndf_mixture_batch *b, float *area)
{
    call c = {b, VNDF_ASK_AREA, no_normals, area};
    answer(&c);
}

void vndf_mixture_lambda_n(const vndf_mixture_batch *b, float *lambda)
{
    call c = {b, VNDF_ASK_LAMBDA, no_normals, lambda};
    answer(&c);
}

void vndf_mixture_g1_n(const vndf_mixture_batch *b, float *g1)
{
    call c = {b, VNDF_ASK_G1, no_normals, g1};
    answer(&c);
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
