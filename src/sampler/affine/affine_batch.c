/* Batches of affine surfaces: in blocks, along the principal axes, where the processor has lanes (blocks.h), else one
 * after the other. The inverse always takes one after the other. */
#include <string.h>

#include "sampler/affine/areas.h"
#include "sampler/affine/blocks.h"
#include "sampler/batch/batch.h"

/* ---- one by one ---- */

static vndf_affine surface_at(const vndf_affine_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_ALPHA ? 0 : i;
    vndf_affine surface = {b->distribution,
                           b->xx[at],
                           vndf_batch_number(b->xy, at),
                           vndf_batch_number(b->yx, at),
                           b->yy[at],
                           vndf_batch_number(b->mean_x, at),
                           vndf_batch_number(b->mean_y, at)};
    return surface;
}

static vndf_vec3 wi_at(const vndf_affine_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_WI ? 0 : i;
    return vndf_vec3_of(b->wi_x[at], b->wi_y[at], b->wi_z[at]);
}

static vndf_affine_view view_at(const vndf_affine_batch *b, size_t i)
{
    vndf_affine surface = surface_at(b, i);
    return vndf_affine_view_from(&surface, wi_at(b, i));
}

static int is_one_view(const vndf_affine_batch *b)
{
    return (b->shared & VNDF_SHARED_ALPHA) && (b->shared & VNDF_SHARED_WI);
}

/* The view that all elements share, made in *view; NULL if there is none. */
static const vndf_affine_view *shared_view(const vndf_affine_batch *b, vndf_affine_view *view)
{
    if (!is_one_view(b) || b->count == 0)
        return NULL;
    *view = view_at(b, 0);
    return view;
}

/* A question of all elements, and the view that they share, or NULL. */
typedef struct call {
    const vndf_affine_batch *batch;
    vndf_question question;
    vndf_normals wm;
    float *to;
    const vndf_affine_view *one;
} call;

static float answer_seen(const call *c, const vndf_affine_view *view, size_t i)
{
    vndf_vec3 wm = vndf_batch_normal(c->wm, i);
    return c->question == VNDF_ASK_PDF ? vndf_affine_pdf(view, wm) : vndf_affine_visible(view, wm);
}

/* An assigned view would be copied, and waited for. */
static float answer_of_normal(const call *c, size_t i)
{
    if (c->one)
        return answer_seen(c, c->one, i);
    vndf_affine_view own = view_at(c->batch, i);
    return answer_seen(c, &own, i);
}

static float answer_of(const call *c, size_t i)
{
    if (c->question == VNDF_ASK_PDF || c->question == VNDF_ASK_VISIBLE)
        return answer_of_normal(c, i);
    vndf_affine surface = surface_at(c->batch, i);
    switch (c->question) {
    case VNDF_ASK_NDF: return vndf_affine_ndf(&surface, vndf_batch_normal(c->wm, i));
    case VNDF_ASK_AREA: return vndf_affine_projected_area(&surface, wi_at(c->batch, i));
    case VNDF_ASK_LAMBDA: return vndf_affine_lambda(&surface, wi_at(c->batch, i));
    default: return vndf_affine_g1(&surface, wi_at(c->batch, i));
    }
}

/* The arrays of a sample call, and the view that all share, or NULL. */
typedef struct draw {
    const vndf_affine_batch *batch;
    const float *u1, *u2;
    vndf_normals wm;
    float *pdf;
    const vndf_affine_view *one;
} draw;

static vndf_vec3 sample_one(const draw *c, size_t i, float *density)
{
    float *pdf = c->pdf ? density : NULL;
    if (c->one)
        return vndf_affine_sample(c->one, c->u1[i], c->u2[i], pdf);
    vndf_affine_view own = view_at(c->batch, i);
    return vndf_affine_sample(&own, c->u1[i], c->u2[i], pdf);
}

static void sample_one_by_one(const draw *c)
{
    for (size_t i = 0; i < c->batch->count; i++) {
        float density;
        vndf_vec3 wm = sample_one(c, i, &density);
        c->wm.x[i] = wm.x;
        c->wm.y[i] = wm.y;
        c->wm.z[i] = wm.z;
        if (c->pdf)
            c->pdf[i] = density;
    }
}

/* ---- in blocks ---- */

#if VNDF_HAS_LANES

static int has_lanes(const vndf_affine_batch *b)
{
    return b->count > 1 && b->distribution && vndf_instructions_used(b->limit) != VNDF_INSTRUCTIONS_PORTABLE;
}

/* A block, its inputs and its axes. */
typedef struct block {
    const vndf_affine_batch *batch;
    vndf_walk walk;
    vndf_map_inputs in;
    vndf_map_copies copies;
    vndf_axes_block axes;
    float more[3][VNDF_AXES_BLOCK];
} block;

static void begin(block *at, const vndf_affine_batch *b)
{
    at->batch = b;
    at->walk = vndf_walk_over(b->count, b->limit);
}

/* Moves on to the next block; 0 after the last. Without wi, questions of D alone. */
static int next(block *at, int with_wi)
{
    const vndf_affine_batch *b = at->batch;
    const float *from[VNDF_MAP_INPUTS] = {b->xx,     b->xy,   b->yx,   b->yy,  b->mean_x,
                                          b->mean_y, b->wi_x, b->wi_y, b->wi_z};
    if (!vndf_walk_on(&at->walk))
        return 0;
    int begun = vndf_walk_has_begun(&at->walk), is_one = is_one_view(b);
    for (int n = 0; n < VNDF_MAP_INPUTS; n++) {
        int is_wi = n >= VNDF_MAP_WI_X, shared = (b->shared & (is_wi ? VNDF_SHARED_WI : VNDF_SHARED_ALPHA)) != 0;
        if (!(begun && shared))
            at->in.of[n] =
                vndf_walk_input(&at->walk, is_wi && !with_wi ? NULL : from[n], shared, at->copies.of[n]);
    }
    if (!(begun && is_one))
        vndf_block_axes(at->walk.wide, !(begun && (b->shared & VNDF_SHARED_ALPHA)), &at->in, at->walk.count,
                        &at->axes);
    return 1;
}

static vndf_surfaces surfaces_of(const block *at)
{
    const vndf_affine_batch *b = at->batch;
    vndf_surfaces of = {at->walk.wide, is_one_view(b), b->distribution, &at->in, &at->axes, NULL};
    return of;
}

static const float *more(block *at, int which, const float *from)
{
    return vndf_walk_input(&at->walk, from, 0, at->more[which]);
}

static void answer_areas(const block *at, float *value)
{
    const vndf_surfaces of = surfaces_of(at);
    vndf_areas_block areas;
    vndf_block_areas(&of, at->walk.count, &areas);
    for (uint32_t i = 0; i < at->walk.count; i++) {
        vndf_normal w = {at->in.of[VNDF_MAP_WI_X][i], at->in.of[VNDF_MAP_WI_Y][i], at->in.of[VNDF_MAP_WI_Z][i]};
        value[i] = vndf_unit_area_of(areas.toward[i], w, areas.toward[i] >= 0.0);
    }
}

/* Answers may overwrite inputs, so they are stored after the whole block is read. */
static void answer_in_blocks(const call *c)
{
    int of_direction = vndf_question_is_of_direction(c->question);
    block at;
    float value[VNDF_AXES_BLOCK];
    for (begin(&at, c->batch); next(&at, c->question != VNDF_ASK_NDF);) {
        const vndf_surfaces of = surfaces_of(&at);
        vndf_left left;
        left.count = 0;
        if (c->question == VNDF_ASK_AREA) {
            answer_areas(&at, value);
        } else {
            const float *normal[3] = {NULL, NULL, NULL};
            for (int n = 0; n < 3 && !of_direction; n++)
                normal[n] = more(&at, n, n == 0 ? c->wm.x : n == 1 ? c->wm.y : c->wm.z);
            vndf_block_answer(&of, c->question, of_direction ? NULL : normal, at.walk.count, value, &left);
        }
        for (uint32_t n = 0; n < left.count; n++)
            value[left.index[n]] = answer_of(c, at.walk.first + left.index[n]);
        memcpy(c->to + at.walk.first, value, at.walk.count * sizeof(float));
    }
}

/* Draws the samples that lanes have left, before results overwrite inputs. */
static void sample_left(const draw *c, size_t first, const vndf_left *left, vndf_real_block *real)
{
    for (uint32_t n = 0; n < left->count; n++) {
        uint32_t i = left->index[n];
        vndf_vec3 wm = sample_one(c, first + i, &real->density[i]);
        real->x[i] = wm.x;
        real->y[i] = wm.y;
        real->z[i] = wm.z;
    }
}

static void sample_in_blocks(const draw *c)
{
    block at;
    vndf_real_block real;
    for (begin(&at, c->batch); next(&at, 1);) {
        size_t bytes = at.walk.count * sizeof(float);
        vndf_surfaces of = surfaces_of(&at);
        vndf_left left;
        left.count = 0;
        of.view = c->one ? vndf_trusted_view(c->one) : NULL;
        vndf_block_draw(&of, more(&at, 0, c->u1), more(&at, 1, c->u2), at.walk.count, c->pdf != NULL, &real,
                        &left);
        sample_left(c, at.walk.first, &left, &real);
        memcpy(c->wm.x + at.walk.first, real.x, bytes);
        memcpy(c->wm.y + at.walk.first, real.y, bytes);
        memcpy(c->wm.z + at.walk.first, real.z, bytes);
        if (c->pdf)
            memcpy(c->pdf + at.walk.first, real.density, bytes);
    }
}

#else

static int has_lanes(const vndf_affine_batch *b)
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

static void ask(const vndf_affine_batch *b, vndf_question question, vndf_normals wm, float *to)
{
    vndf_affine_view view;
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

void vndf_affine_sample_n(const vndf_affine_batch *b, const float *u1, const float *u2, vndf_normals wm,
                          float *pdf)
{
    vndf_affine_view view;
    draw c = {b, u1, u2, wm, pdf, shared_view(b, &view)};
    if (has_lanes(b) && vndf_unit_scale_float(b->distribution) > 0.0f) /* lanes have no double */
        sample_in_blocks(&c);
    else
        sample_one_by_one(&c);
}

void vndf_affine_pdf_n(const vndf_affine_batch *b, vndf_normals wm, float *pdf)
{
    ask(b, VNDF_ASK_PDF, wm, pdf);
}

void vndf_affine_visible_n(const vndf_affine_batch *b, vndf_normals wm, float *visible)
{
    ask(b, VNDF_ASK_VISIBLE, wm, visible);
}

void vndf_affine_ndf_n(const vndf_affine_batch *b, vndf_normals wm, float *ndf)
{
    ask(b, VNDF_ASK_NDF, wm, ndf);
}

static const vndf_normals no_normals = {NULL, NULL, NULL};

void vndf_affine_projected_area_n(const vndf_affine_batch *b, float *area)
{
    ask(b, VNDF_ASK_AREA, no_normals, area);
}

void vndf_affine_lambda_n(const vndf_affine_batch *b, float *lambda)
{
    ask(b, VNDF_ASK_LAMBDA, no_normals, lambda);
}

void vndf_affine_g1_n(const vndf_affine_batch *b, float *g1)
{
    ask(b, VNDF_ASK_G1, no_normals, g1);
}

void vndf_affine_invert_n(const vndf_affine_batch *b, vndf_normals wm, float *u1, float *u2)
{
    for (size_t i = 0; i < b->count; i++) {
        vndf_affine_view view = view_at(b, i);
        float v1, v2;
        vndf_affine_invert(&view, vndf_batch_normal(wm, i), &v1, &v2);
        u1[i] = v1;
        u2[i] = v2;
    }
}
