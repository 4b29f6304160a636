#include "sampler/affine/mixture_block.h"

#include <math.h>

#if VNDF_HAS_LANES

void vndf_mixture_begin(vndf_mixture_block *at, const vndf_mixture_batch *b)
{
    at->batch = b;
    at->walk = vndf_walk_over(b->count, b->limit);
}

static void read_wi(vndf_mixture_block *at, int begun, int with_wi)
{
    const vndf_mixture_batch *b = at->batch;
    const float *from[] = {b->wi_x, b->wi_y, b->wi_z};
    int shared = (b->shared & VNDF_SHARED_WI) != 0;
    for (int n = 0; n < 3; n++)
        if (!(begun && shared))
            at->in.of[VNDF_MAP_WI_X + n] =
                vndf_walk_input(&at->walk, with_wi ? from[n] : NULL, shared, at->copies.of[VNDF_MAP_WI_X + n]);
}

static void find_axes(vndf_mixture_block *at, int begun)
{
    const vndf_mixture_batch *b = at->batch;
    int shared = (b->shared & VNDF_SHARED_ALPHA) != 0;
    if (begun && shared && (b->shared & VNDF_SHARED_WI))
        return;
    for (int l = 0; l < b->lobes; l++) {
        const vndf_lobe_batch *of = &b->lobe[l];
        const float *from[] = {of->xx, of->xy, of->yx, of->yy, of->mean_x, of->mean_y};
        for (int n = 0; n < VNDF_MAP_WI_X; n++)
            at->in.of[n] = vndf_walk_input(&at->walk, from[n], shared, at->copies.of[n]);
        vndf_block_axes(at->walk.wide, &at->in, begun ? at->walk.count : VNDF_AXES_BLOCK, &at->lobe[l].axes);
    }
}

/* Weights over their sum; not valid where they are not. */
static void weigh(vndf_mixture_block *at)
{
    const vndf_mixture_batch *b = at->batch;
    for (uint32_t i = 0; i < at->walk.count; i++) {
        size_t from = b->shared & VNDF_SHARED_WEIGHT ? 0 : at->walk.first + i;
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
static void add_areas(vndf_mixture_block *at, int l)
{
    vndf_lobe_block *of = &at->lobe[l];
    vndf_areas_block areas;
    if (at->batch->lobe[l].distribution)
        vndf_block_areas(at->walk.wide, at->batch->lobe[l].distribution, &at->in, &of->axes, at->walk.count,
                         &areas);
    for (uint32_t i = 0; i < at->walk.count; i++) {
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

static void share(vndf_mixture_block *at)
{
    for (uint32_t i = 0; i < at->walk.count; i++) {
        double from = 0.0, area = at->whole.toward[i];
        vndf_lobe_block *last = NULL;
        for (int l = 0; l < at->batch->lobes; l++) {
            vndf_lobe_block *of = &at->lobe[l];
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
int vndf_mixture_next(vndf_mixture_block *at, int with_wi)
{
    if (!vndf_walk_on(&at->walk))
        return 0;
    int begun = at->walk.first > 0;
    read_wi(at, begun, with_wi);
    find_axes(at, begun);
    weigh(at);
    if (!with_wi)
        return 1;
    for (uint32_t i = 0; i < at->walk.count; i++)
        at->whole.toward[i] = at->whole.away[i] = at->whole.up[i] = 0.0;
    for (int l = 0; l < at->batch->lobes; l++)
        add_areas(at, l);
    share(at);
    return 1;
}

const float *vndf_mixture_more(vndf_mixture_block *at, int which, const float *from)
{
    return vndf_walk_input(&at->walk, from, 0, at->more[which]);
}

#endif
