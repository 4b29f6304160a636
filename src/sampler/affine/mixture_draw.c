#include "sampler/affine/mixture_draw.h"

#include <string.h>

#include "math/vector.h"
#include "sampler/affine/areas.h"

#if VNDF_HAS_LANES

/* A block while it is drawn: densities of the lobes that drew, and the sum of the others. */
typedef struct work {
    vndf_choice_block choice;
    float own[VNDF_AXES_BLOCK];
    double others[VNDF_AXES_BLOCK];
} work;

static void keep(const vndf_real_block *real, const vndf_some *some, work *w, vndf_mixture_drawn *to)
{
    for (uint32_t k = 0; k < some->count; k++) {
        uint32_t i = some->index[k];
        to->x[i] = real->x[k];
        to->y[i] = real->y[k];
        to->z[i] = real->z[k];
        w->own[i] = real->density[k];
    }
}

/* The samples that a lobe draws, side by side. */
static void draw_lobe(const vndf_mixture_block *at, int l, const float *u2, int with_density, work *w,
                      vndf_mixture_drawn *to)
{
    const vndf_some *some = &w->choice.own[l];
    vndf_gathered gathered;
    vndf_real_block real;
    vndf_left left;
    float own_u1[VNDF_AXES_BLOCK], own_u2[VNDF_AXES_BLOCK];
    left.count = 0;
    if (some->count == 0)
        return;
    const vndf_surfaces all = vndf_mixture_surfaces(at, l), own = vndf_block_gather(&all, some, &gathered);
    vndf_block_pick(w->choice.part, some, own_u1);
    vndf_block_pick(u2, some, own_u2);
    vndf_block_draw(&own, own_u1, own_u2, some->count, with_density, &real, &left);
    keep(&real, some, w, to);
    for (uint32_t k = 0; k < some->count; k++)
        to->lobe[some->index[k]] = l;
    for (uint32_t k = 0; k < left.count; k++)
        to->left[some->index[left.index[k]]] = 1;
}

/* The densities of a lobe for the samples that others drew. */
static void add_lobe(const vndf_mixture_block *at, int l, work *w, vndf_mixture_drawn *to)
{
    const float *const normal[3] = {to->x, to->y, to->z};
    const vndf_some *some = &w->choice.other[l];
    const vndf_surfaces of = vndf_mixture_surfaces(at, l);
    const double *share = at->of.lobe[l].share;
    float value[VNDF_AXES_BLOCK];
    vndf_left left;
    left.count = 0;
    vndf_block_answer_some(&of, VNDF_ASK_PDF, normal, some, value, &left);
    for (uint32_t k = 0; k < some->count; k++)
        w->others[some->index[k]] += share[some->index[k]] * value[k];
    for (uint32_t k = 0; k < left.count; k++)
        to->left[some->index[left.index[k]]] = 1;
}

/* The density of the whole: that of the lobe itself, and the sum of the others. */
static void add_densities(const vndf_mixture_block *at, work *w, vndf_mixture_drawn *to)
{
    memset(w->others, 0, sizeof w->others);
    for (int l = 0; l < at->of.lobes; l++)
        add_lobe(at, l, w, to);
    for (uint32_t i = 0; i < at->walk.count; i++) {
        double sum = w->choice.share[i] * w->own[i] + w->others[i];
        to->pdf[i] = to->lobe[i] >= 0 && sum > 0.0 ? vndf_positive(vndf_density_from(sum)) : 0.0f;
    }
}

void vndf_mixture_draw(const vndf_mixture_block *at, const float *u1, const float *u2, int with_density,
                       vndf_mixture_drawn *to)
{
    work w;
    memset(to->left, 0, sizeof to->left);
    for (uint32_t i = 0; i < at->walk.count; i++) { /* what is invalid stays so */
        to->x[i] = to->y[i] = w.own[i] = 0.0f;
        to->z[i] = 1.0f;
        to->lobe[i] = -1;
    }
    vndf_mixture_choose(at, u1, &w.choice);
    for (int l = 0; l < at->of.lobes; l++)
        draw_lobe(at, l, u2, with_density, &w, to);
    if (with_density)
        add_densities(at, &w, to);
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
static void answer_normals(const vndf_mixture_block *at, vndf_question question, const float *const normal[3],
                           float *value, unsigned char *left)
{
    double sum[VNDF_AXES_BLOCK] = {0.0};
    for (int l = 0; l < at->of.lobes; l++) {
        const vndf_surfaces of = vndf_mixture_surfaces(at, l);
        const vndf_lobe_block *lobe = &at->of.lobe[l];
        const double *part = question == VNDF_ASK_NDF ? lobe->weight : lobe->share;
        float own[VNDF_AXES_BLOCK];
        vndf_left from;
        from.count = 0;
        if (!of.distribution)
            continue;
        vndf_block_answer(&of, question, normal, at->walk.count, own, &from);
        for (uint32_t i = 0; i < at->walk.count; i++)
            sum[i] += lobe->weight[i] > 0.0 ? part[i] * own[i] : 0.0;
        vndf_left_mark(&from, left);
    }
    for (uint32_t i = 0; i < at->walk.count; i++) {
        int valid = at->of.whole.toward[i] >= 0.0;
        float density = valid ? vndf_density_from(sum[i]) : 0.0f;
        value[i] = question == VNDF_ASK_PDF && valid && sum[i] > 0.0 ? vndf_positive(density) : density;
    }
}

void vndf_mixture_answer(vndf_mixture_block *at, vndf_question question, vndf_normals wm, float *value,
                         unsigned char *left)
{
    if (vndf_question_is_of_direction(question)) {
        answer_areas(at, question, value);
        return;
    }
    const float *const normal[3] = {vndf_mixture_more(at, 0, wm.x), vndf_mixture_more(at, 1, wm.y),
                                    vndf_mixture_more(at, 2, wm.z)};
    answer_normals(at, question, normal, value, left);
}

#endif
