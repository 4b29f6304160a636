/* Batches of mixtures: in blocks, where the processor has lanes (blocks.h), else one after the other. Samples are
 * sorted by lobe, each lobe draws its own, and all other lobes evaluate them. The inverse always takes one after the
 * other. */
#include <string.h>

#include "sampler/affine/areas.h"
#include "sampler/affine/blocks.h"
#include "sampler/batch/batch.h"

/* ---- one by one ---- */

static float number_at(const float *from, size_t i)
{
    return from ? from[i] : 0.0f;
}

static vndf_mixture mixture_at(const vndf_mixture_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_ALPHA ? 0 : i;
    vndf_mixture mixture;
    mixture.count = b->lobes;
    for (int l = 0; l < b->lobes && l < VNDF_MIXTURE_LOBES; l++) {
        const vndf_lobe_batch *from = &b->lobe[l];
        vndf_affine surface = {from->distribution,         number_at(from->xx, at), number_at(from->xy, at),
                               number_at(from->yx, at),    number_at(from->yy, at), number_at(from->mean_x, at),
                               number_at(from->mean_y, at)};
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

enum { B = VNDF_AXES_BLOCK, L = VNDF_MIXTURE_LOBES };

static int has_lanes(const vndf_mixture_batch *b)
{
    if (b->lobes < 1 || b->lobes > L || b->count < 2 ||
        vndf_instructions_used(b->limit) == VNDF_INSTRUCTIONS_PORTABLE)
        return 0;
    for (int l = 0; l < b->lobes; l++) /* lanes have no double */
        if (b->lobe[l].distribution && !(vndf_unit_scale_float(b->lobe[l].distribution) > 0.0f))
            return 0;
    return 1;
}

/* A lobe of a block: its axes, weights over their sum, and where in u1 it is drawn. */
typedef struct lobe_block {
    vndf_axes_block axes;
    double weight[B], begin[B], share[B];
} lobe_block;

typedef struct block {
    const vndf_mixture_batch *batch;
    int wide;
    uint32_t count;
    size_t first;
    vndf_map_inputs in; /* wi; the rest is read for the axes alone */
    vndf_map_copies copies;
    unsigned char valid[B];
    vndf_areas_block whole;
    lobe_block lobe[L];
    float more[3][B];
} block;

static void begin(block *at, const vndf_mixture_batch *b)
{
    at->batch = b;
    at->wide = vndf_instructions_used(b->limit) == VNDF_INSTRUCTIONS_AVX512;
    at->first = at->count = 0;
}

static void read_wi(block *at, int begun, int with_wi)
{
    const vndf_mixture_batch *b = at->batch;
    const float *from[] = {b->wi_x, b->wi_y, b->wi_z};
    int shared = (b->shared & VNDF_SHARED_WI) != 0;
    for (int n = 0; n < 3; n++)
        if (!(begun && shared))
            at->in.of[VNDF_MAP_WI_X + n] = vndf_block_input(with_wi ? from[n] : NULL, shared, at->first, at->count,
                                                            at->copies.of[VNDF_MAP_WI_X + n]);
}

static void find_axes(block *at, int begun)
{
    const vndf_mixture_batch *b = at->batch;
    int shared = (b->shared & VNDF_SHARED_ALPHA) != 0;
    if (begun && shared && (b->shared & VNDF_SHARED_WI))
        return;
    for (int l = 0; l < b->lobes; l++) {
        const vndf_lobe_batch *of = &b->lobe[l];
        const float *from[] = {of->xx, of->xy, of->yx, of->yy, of->mean_x, of->mean_y};
        for (int n = 0; n < VNDF_MAP_WI_X; n++)
            at->in.of[n] = vndf_block_input(from[n], shared, at->first, at->count, at->copies.of[n]);
        vndf_block_axes(at->wide, &at->in, begun ? at->count : B, &at->lobe[l].axes);
    }
}

/* Weights over their sum; not valid where they are not. */
static void weigh(block *at)
{
    const vndf_mixture_batch *b = at->batch;
    for (uint32_t i = 0; i < at->count; i++) {
        size_t from = b->shared & VNDF_SHARED_WEIGHT ? 0 : at->first + i;
        double sum = 0.0;
        int valid = 1;
        for (int l = 0; l < b->lobes; l++) {
            float weight = b->lobe[l].weight[from];
            valid &= weight >= 0.0f && weight < HUGE_VALF;
            sum += weight;
        }
        at->valid[i] = valid && sum > 0.0;
        double per = at->valid[i] ? 1.0 / sum : 0.0;
        for (int l = 0; l < b->lobes; l++)
            at->lobe[l].weight[i] = at->valid[i] ? b->lobe[l].weight[from] * per : 0.0;
    }
}

/* Adds a lobe's areas to those of the whole; its `share` is its area until all are known. */
static void add_areas(block *at, int l)
{
    lobe_block *of = &at->lobe[l];
    vndf_areas_block areas;
    if (at->batch->lobe[l].distribution)
        vndf_block_areas(at->wide, at->batch->lobe[l].distribution, &at->in, &of->axes, at->count, &areas);
    for (uint32_t i = 0; i < at->count; i++) {
        double weight = of->weight[i], toward = at->batch->lobe[l].distribution ? areas.toward[i] : -1.0;
        of->share[i] = 0.0;
        if (!(weight > 0.0))
            continue;
        of->share[i] = weight * toward;
        at->valid[i] &= toward >= 0.0;
        at->whole.toward[i] += of->share[i];
        if (toward >= 0.0) {
            at->whole.away[i] += weight * areas.away[i];
            at->whole.up[i] += weight * areas.up[i];
        }
    }
}

static void share(block *at)
{
    for (uint32_t i = 0; i < at->count; i++) {
        double from = 0.0, area = at->whole.toward[i];
        lobe_block *last = NULL;
        for (int l = 0; l < at->batch->lobes; l++) {
            lobe_block *of = &at->lobe[l];
            of->begin[i] = from;
            if (!(of->weight[i] > 0.0))
                continue;
            from += area > 0.0 ? of->share[i] / area : of->weight[i];
            of->share[i] = from - of->begin[i];
            last = of;
        }
        if (last)
            last->share[i] = 1.0 - last->begin[i];
    }
}

/* Moves on to the next block; 0 after the last. */
static int next(block *at, int with_wi)
{
    const vndf_mixture_batch *b = at->batch;
    at->first += at->count;
    if (at->first >= b->count)
        return 0;
    size_t rest = b->count - at->first;
    int begun = at->first > 0;
    at->count = rest < B ? (uint32_t)rest : B;
    read_wi(at, begun, with_wi);
    find_axes(at, begun);
    weigh(at);
    if (!with_wi)
        return 1;
    for (uint32_t i = 0; i < at->count; i++)
        at->whole.toward[i] = at->whole.away[i] = at->whole.up[i] = 0.0;
    for (int l = 0; l < b->lobes; l++)
        add_areas(at, l);
    share(at);
    return 1;
}

static const float *more(block *at, int which, const float *from)
{
    return vndf_block_input(from, 0, at->first, at->count, at->more[which]);
}

static void mark(unsigned char *left, const vndf_left *from)
{
    for (uint32_t n = 0; n < from->count; n++)
        left[from->index[n]] = 1;
}

/* ---- answers ---- */

static void answer_areas(const block *at, vndf_question question, float *value)
{
    for (uint32_t i = 0; i < at->count; i++) {
        vndf_areas areas = {at->whole.toward[i], at->whole.away[i], at->whole.up[i]};
        vndf_normal w = {at->in.of[VNDF_MAP_WI_X][i], at->in.of[VNDF_MAP_WI_Y][i], at->in.of[VNDF_MAP_WI_Z][i]};
        value[i] = !at->valid[i]                 ? 0.0f
                   : question == VNDF_ASK_AREA   ? vndf_unit_area_of(areas.toward, w, 1)
                   : question == VNDF_ASK_LAMBDA ? vndf_areas_lambda(&areas)
                                                 : vndf_areas_g1(&areas);
    }
}

/* Sums of shares, or of weights for D, times the answers of the lobes. */
static void answer_normals(block *at, const call *c, float *value, unsigned char *left)
{
    const float *const normal[3] = {more(at, 0, c->wm.x), more(at, 1, c->wm.y), more(at, 2, c->wm.z)};
    double sum[B] = {0.0};
    for (int l = 0; l < at->batch->lobes; l++) {
        const lobe_block *of = &at->lobe[l];
        const double *part = c->question == VNDF_ASK_NDF ? of->weight : of->share;
        float own[B];
        vndf_left from;
        from.count = 0;
        if (!at->batch->lobe[l].distribution)
            continue;
        vndf_block_answer(at->wide, at->batch->lobe[l].distribution, c->question, &at->in, &of->axes, normal,
                          at->count, NULL, own, &from);
        for (uint32_t i = 0; i < at->count; i++)
            sum[i] += of->weight[i] > 0.0 ? part[i] * own[i] : 0.0;
        mark(left, &from);
    }
    for (uint32_t i = 0; i < at->count; i++) {
        float density = at->valid[i] ? vndf_density_from(sum[i]) : 0.0f;
        value[i] = c->question == VNDF_ASK_PDF && at->valid[i] && sum[i] > 0.0 ? vndf_positive(density) : density;
    }
}

/* Answers may overwrite inputs, so they are stored after the whole block is read. */
static void answer_in_blocks(const call *c)
{
    int of_direction =
        c->question == VNDF_ASK_AREA || c->question == VNDF_ASK_LAMBDA || c->question == VNDF_ASK_G1;
    block at;
    float value[B];
    for (begin(&at, c->batch); next(&at, c->question != VNDF_ASK_NDF);) {
        unsigned char left[B] = {0};
        if (of_direction)
            answer_areas(&at, c->question, value);
        else
            answer_normals(&at, c, value, left);
        for (uint32_t i = 0; i < at.count; i++)
            if (left[i])
                value[i] = answer_of(c, at.first + i);
        memcpy(c->to + at.first, value, at.count * sizeof(float));
    }
}

/* ---- samples ---- */

/* Results of a block, and which lobe each sample chose; -1 of what is invalid. */
typedef struct results {
    float x[B], y[B], z[B], own[B], pdf[B];
    int lobe[B];
    float part[B];
    unsigned char left[B];
} results;

static void choose(const block *at, const float *u1, results *to)
{
    for (uint32_t i = 0; i < at->count; i++) {
        double u = vndf_clamp_unit(u1[i]);
        int chosen = -1;
        for (int l = 0; l < at->batch->lobes && at->valid[i]; l++) {
            const lobe_block *of = &at->lobe[l];
            if (of->weight[i] > 0.0 && (chosen < 0 || (of->begin[i] <= u && of->share[i] > 0.0)))
                chosen = l;
        }
        to->lobe[i] = chosen;
        to->x[i] = to->y[i] = to->pdf[i] = to->own[i] = 0.0f;
        to->z[i] = 1.0f;
        if (chosen >= 0)
            to->part[i] = (float)((u - at->lobe[chosen].begin[i]) / at->lobe[chosen].share[i]);
    }
}

/* The inputs of the samples of one lobe, side by side. */
typedef struct gathered {
    vndf_axes_block axes;
    vndf_map_inputs in;
    float wi[3][B], u1[B], u2[B];
} gathered;

static void gather(const block *at, int l, const vndf_some *some, const float *part, const float *u2, gathered *to)
{
    const vndf_axes_block *from = &at->lobe[l].axes;
    uint32_t end = (some->count + 15) / 16 * 16; /* spare lanes repeat the first sample */
    for (uint32_t k = 0; k < end; k++) {
        uint32_t i = some->index[k < some->count ? k : 0];
        to->axes.ax[k] = from->ax[i];
        to->axes.ay[k] = from->ay[i];
        to->axes.x[k] = from->x[i];
        to->axes.y[k] = from->y[i];
        to->axes.z[k] = from->z[i];
        to->axes.cosine[k] = from->cosine[i];
        to->axes.sine[k] = from->sine[i];
        to->axes.mean_x[k] = from->mean_x[i];
        to->axes.mean_y[k] = from->mean_y[i];
        to->axes.factor[k] = from->factor[i];
        for (int n = 0; n < 3; n++)
            to->wi[n][k] = at->in.of[VNDF_MAP_WI_X + n][i];
        to->u1[k] = part[i];
        to->u2[k] = u2[i];
    }
    for (int n = 0; n < 3; n++)
        to->in.of[VNDF_MAP_WI_X + n] = to->wi[n];
}

/* The samples that chose a lobe, or those that did not although it has a weight. */
static vndf_some some_of(const block *at, int l, int chosen, const int *choice)
{
    vndf_some some;
    some.count = 0;
    for (uint32_t i = 0; i < at->count; i++) {
        some.index[some.count] = i;
        some.count += chosen ? choice[i] == l : choice[i] >= 0 && choice[i] != l && at->lobe[l].weight[i] > 0.0;
    }
    return some;
}

static void draw_lobe(const block *at, int l, const float *u2, int with_density, results *to)
{
    gathered own;
    vndf_real_block real;
    vndf_left left;
    vndf_some some = some_of(at, l, 1, to->lobe);
    left.count = 0;
    if (some.count == 0)
        return;
    gather(at, l, &some, to->part, u2, &own);
    vndf_block_draw(at->wide, at->batch->lobe[l].distribution, &own.in, &own.axes, own.u1, own.u2, some.count,
                    with_density, &real, &left);
    for (uint32_t k = 0; k < some.count; k++) {
        uint32_t i = some.index[k];
        to->x[i] = real.x[k];
        to->y[i] = real.y[k];
        to->z[i] = real.z[k];
        to->own[i] = real.density[k];
    }
    for (uint32_t k = 0; k < left.count; k++)
        to->left[some.index[left.index[k]]] = 1;
}

/* The density of the whole: that of the lobe itself, and the sum of the others. */
static void add_densities(const block *at, results *to)
{
    const float *const normal[3] = {to->x, to->y, to->z};
    double others[B] = {0.0};
    for (int l = 0; l < at->batch->lobes; l++) {
        vndf_some some = some_of(at, l, 0, to->lobe);
        float value[B];
        vndf_left left;
        left.count = 0;
        if (some.count == 0)
            continue;
        vndf_block_answer(at->wide, at->batch->lobe[l].distribution, VNDF_ASK_PDF, &at->in, &at->lobe[l].axes,
                          normal, at->count, &some, value, &left);
        for (uint32_t k = 0; k < some.count; k++)
            others[some.index[k]] += at->lobe[l].share[some.index[k]] * value[some.index[k]];
        mark(to->left, &left);
    }
    for (uint32_t i = 0; i < at->count; i++) {
        if (to->lobe[i] < 0)
            continue;
        double sum = at->lobe[to->lobe[i]].share[i] * to->own[i] + others[i];
        to->pdf[i] = sum > 0.0 ? vndf_positive(vndf_density_from(sum)) : 0.0f;
    }
}

static void draw_left(const block *at, const draw *c, results *to)
{
    for (uint32_t i = 0; i < at->count; i++) {
        if (!to->left[i])
            continue;
        sample s = sample_of(c, at->first + i);
        to->x[i] = s.wm.x;
        to->y[i] = s.wm.y;
        to->z[i] = s.wm.z;
        to->pdf[i] = s.pdf;
    }
}

static void sample_in_blocks(const draw *c)
{
    block at;
    results to;
    for (begin(&at, c->batch); next(&at, 1);) {
        const float *u2 = more(&at, 1, c->u2);
        size_t bytes = at.count * sizeof(float);
        memset(to.left, 0, sizeof to.left);
        choose(&at, more(&at, 0, c->u1), &to);
        for (int l = 0; l < c->batch->lobes; l++)
            draw_lobe(&at, l, u2, c->pdf != NULL, &to);
        if (c->pdf)
            add_densities(&at, &to);
        draw_left(&at, c, &to);
        memcpy(c->wm.x + at.first, to.x, bytes);
        memcpy(c->wm.y + at.first, to.y, bytes);
        memcpy(c->wm.z + at.first, to.z, bytes);
        if (c->pdf)
            memcpy(c->pdf + at.first, to.pdf, bytes);
        if (c->lobe)
            memcpy(c->lobe + at.first, to.lobe, at.count * sizeof(int));
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
