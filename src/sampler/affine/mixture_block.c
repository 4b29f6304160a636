#include "sampler/affine/mixture_block.h"

#include "sampler/batch/batch.h"

#if VNDF_HAS_LANES

static int is_shared(const vndf_mixture_block *at, unsigned what)
{
    return (at->batch->shared & what) == what;
}

/* Whether the block has what `what` says from the block before. */
static int is_read(const vndf_mixture_block *at, unsigned what)
{
    return vndf_walk_has_begun(&at->walk) && is_shared(at, what);
}

static const unsigned ONE = VNDF_SHARED_ALPHA | VNDF_SHARED_WI;

void vndf_mixture_begin(vndf_mixture_block *at, const vndf_mixture_batch *b)
{
    at->batch = b;
    at->walk = vndf_walk_over(b->count, b->limit);
    at->of.lobes = b->lobes;
}

/* ---- inputs ---- */

static void read_wi(vndf_mixture_block *at, int with_wi)
{
    const vndf_mixture_batch *b = at->batch;
    const float *from[] = {b->wi_x, b->wi_y, b->wi_z};
    if (is_read(at, VNDF_SHARED_WI))
        return;
    for (int n = 0; n < 3; n++)
        at->in.of[VNDF_MAP_WI_X + n] = vndf_walk_input(
            &at->walk, with_wi ? from[n] : NULL, is_shared(at, VNDF_SHARED_WI), at->copies.of[VNDF_MAP_WI_X + n]);
}

static void read_matrix(vndf_mixture_block *at, const vndf_lobe_batch *of)
{
    const float *from[] = {of->xx, of->xy, of->yx, of->yy, of->mean_x, of->mean_y};
    for (int n = 0; n < VNDF_MAP_WI_X; n++)
        at->in.of[n] = vndf_walk_input(&at->walk, from[n], is_shared(at, VNDF_SHARED_ALPHA), at->copies.of[n]);
}

static void find_axes(vndf_mixture_block *at)
{
    int with_matrix = !is_read(at, VNDF_SHARED_ALPHA);
    if (is_read(at, ONE))
        return;
    for (int l = 0; l < at->of.lobes; l++) {
        if (with_matrix)
            read_matrix(at, &at->batch->lobe[l]);
        vndf_block_axes(at->walk.wide, with_matrix, &at->in, at->walk.count, &at->of.lobe[l].axes);
    }
}

static void weigh(vndf_mixture_block *at)
{
    const float *weight[VNDF_MIXTURE_LOBES];
    for (int l = 0; l < at->of.lobes; l++)
        weight[l] = vndf_walk_input(&at->walk, at->batch->lobe[l].weight, is_shared(at, VNDF_SHARED_WEIGHT),
                                    at->weight_copies[l]);
    if (at->walk.wide)
        vndf_mixture_weigh_avx512(weight, at->walk.count, &at->of);
    else
        vndf_mixture_weigh_avx2(weight, at->walk.count, &at->of);
}

static void find_areas(vndf_mixture_block *at)
{
    for (int l = 0; l < at->of.lobes; l++) {
        vndf_areas_block *areas = &at->of.lobe[l].areas;
        vndf_surfaces of = vndf_mixture_surfaces(at, l);
        if (of.distribution)
            vndf_block_areas(&of, at->walk.count, areas);
        for (uint32_t i = 0; i < VNDF_AXES_BLOCK && !of.distribution; i++)
            areas->toward[i] = areas->away[i] = areas->up[i] = -1.0;
    }
}

static void share(vndf_mixture_block *at)
{
    if (at->walk.wide)
        vndf_mixture_share_avx512(at->walk.count, &at->of);
    else
        vndf_mixture_share_avx2(at->walk.count, &at->of);
}

/* The views of a batch whose elements share one surface and direction. */
static void find_views(vndf_mixture_block *at)
{
    vndf_vec3 wi = {at->batch->wi_x[0], at->batch->wi_y[0], at->batch->wi_z[0]};
    for (int l = 0; l < at->of.lobes; l++) {
        const vndf_lobe_batch *of = &at->batch->lobe[l];
        vndf_affine surface = {of->distribution,
                               vndf_batch_number(of->xx, 0),
                               vndf_batch_number(of->xy, 0),
                               vndf_batch_number(of->yx, 0),
                               vndf_batch_number(of->yy, 0),
                               vndf_batch_number(of->mean_x, 0),
                               vndf_batch_number(of->mean_y, 0)};
        at->view[l] = vndf_affine_view_from(&surface, wi);
    }
}

int vndf_mixture_next(vndf_mixture_block *at, int with_wi)
{
    if (!vndf_walk_on(&at->walk))
        return 0;
    read_wi(at, with_wi);
    find_axes(at);
    if (with_wi && is_shared(at, ONE) && !is_read(at, ONE))
        find_views(at);
    if (!is_read(at, VNDF_SHARED_WEIGHT))
        weigh(at);
    if (with_wi && !is_read(at, ONE))
        find_areas(at);
    if (with_wi && !is_read(at, ONE | VNDF_SHARED_WEIGHT))
        share(at);
    return 1;
}

/* ---- what a block holds ---- */

vndf_surfaces vndf_mixture_surfaces(const vndf_mixture_block *at, int lobe)
{
    vndf_surfaces of = {at->walk.wide, is_shared(at, ONE),      at->batch->lobe[lobe].distribution,
                        &at->in,       &at->of.lobe[lobe].axes, NULL};
    if (of.is_one)
        of.view = vndf_trusted_view(&at->view[lobe]);
    return of;
}

const float *vndf_mixture_more(vndf_mixture_block *at, int which, const float *from)
{
    return vndf_walk_input(&at->walk, from, 0, at->more[which]);
}

void vndf_mixture_choose(const vndf_mixture_block *at, const float *u1, vndf_choice_block *to)
{
    if (at->walk.wide)
        vndf_mixture_choose_avx512(&at->of, u1, at->walk.count, to);
    else
        vndf_mixture_choose_avx2(&at->of, u1, at->walk.count, to);
}

#endif
