#include "sampler/affine/mixture_draw.h"

#include <string.h>

#include "math/vector.h"

#if VNDF_HAS_LANES

enum { B = VNDF_AXES_BLOCK };

static void choose(const vndf_mixture_block *at, const float *u1, vndf_mixture_drawn *to)
{
    for (uint32_t i = 0; i < at->walk.count; i++) {
        double u = vndf_clamp_unit(u1[i]);
        int chosen = -1;
        for (int l = 0; l < at->batch->lobes && at->valid[i]; l++) {
            const vndf_lobe_block *of = &at->lobe[l];
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

static void gather(const vndf_mixture_block *at, int l, const vndf_some *some, const float *part, const float *u2,
                   gathered *to)
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
static vndf_some some_of(const vndf_mixture_block *at, int l, int chosen, const int *choice)
{
    vndf_some some;
    some.count = 0;
    for (uint32_t i = 0; i < at->walk.count; i++) {
        some.index[some.count] = i;
        some.count += chosen ? choice[i] == l : choice[i] >= 0 && choice[i] != l && at->lobe[l].weight[i] > 0.0;
    }
    return some;
}

static void draw_lobe(const vndf_mixture_block *at, int l, const float *u2, int with_density,
                      vndf_mixture_drawn *to)
{
    gathered own;
    vndf_real_block real;
    vndf_left left;
    vndf_some some = some_of(at, l, 1, to->lobe);
    left.count = 0;
    if (some.count == 0)
        return;
    gather(at, l, &some, to->part, u2, &own);
    vndf_block_draw(at->walk.wide, at->batch->lobe[l].distribution, &own.in, &own.axes, own.u1, own.u2, some.count,
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
static void add_densities(const vndf_mixture_block *at, vndf_mixture_drawn *to)
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
        vndf_block_answer(at->walk.wide, at->batch->lobe[l].distribution, VNDF_ASK_PDF, &at->in, &at->lobe[l].axes,
                          normal, at->walk.count, &some, value, &left);
        for (uint32_t k = 0; k < some.count; k++)
            others[some.index[k]] += at->lobe[l].share[some.index[k]] * value[some.index[k]];
        vndf_left_mark(&left, to->left);
    }
    for (uint32_t i = 0; i < at->walk.count; i++) {
        if (to->lobe[i] < 0)
            continue;
        double sum = at->lobe[to->lobe[i]].share[i] * to->own[i] + others[i];
        to->pdf[i] = sum > 0.0 ? vndf_positive(vndf_density_from(sum)) : 0.0f;
    }
}

void vndf_mixture_draw(const vndf_mixture_block *at, const float *u1, const float *u2, int with_density,
                       vndf_mixture_drawn *to)
{
    memset(to->left, 0, sizeof to->left);
    choose(at, u1, to);
    for (int l = 0; l < at->batch->lobes; l++)
        draw_lobe(at, l, u2, with_density, to);
    if (with_density)
        add_densities(at, to);
}

#endif
