/* Batches one element after the other, by the calls for one: what lanes do not take (batch.h). */
#include "sampler/elements.h"

static float at(const float *array, size_t i, int shared)
{
    return array ? array[shared ? 0 : i] : 0.0f;
}

static vndf_vec3 direction(const float *x, const float *y, const float *z, size_t i, int shared)
{
    vndf_vec3 w = {at(x, i, shared), at(y, i, shared), at(z, i, shared)};
    return w;
}

vndf_affine vndf_batch_surface(const vndf_affine_batch *b, size_t i)
{
    int shared = (b->shared & VNDF_SHARED_ALPHA) != 0;
    vndf_affine s = {b->distribution, at(b->xx, i, shared), at(b->xy, i, shared), at(b->yx, i, shared),
                     at(b->yy, i, shared), at(b->mean_x, i, shared), at(b->mean_y, i, shared)};
    return s;
}

vndf_vec3 vndf_batch_direction(const vndf_affine_batch *b, size_t i)
{
    return direction(b->wi_x, b->wi_y, b->wi_z, i, (b->shared & VNDF_SHARED_WI) != 0);
}

vndf_mixture vndf_batch_mixture(const vndf_mixture_batch *b, size_t i)
{
    int shared = (b->shared & VNDF_SHARED_ALPHA) != 0, one_weight = (b->shared & VNDF_SHARED_WEIGHT) != 0;
    vndf_mixture m;
    m.count = b->lobes;
    for (int l = 0; l < b->lobes && l < VNDF_MIXTURE_LOBES; l++) {
        const vndf_lobe_batch *a = &b->lobe[l];
        vndf_affine s = {a->distribution, at(a->xx, i, shared), at(a->xy, i, shared), at(a->yx, i, shared),
                         at(a->yy, i, shared), at(a->mean_x, i, shared), at(a->mean_y, i, shared)};
        m.lobe[l].surface = s;
        m.lobe[l].weight = at(a->weight, i, one_weight);
    }
    return m;
}

vndf_vec3 vndf_batch_mixture_direction(const vndf_mixture_batch *b, size_t i)
{
    return direction(b->wi_x, b->wi_y, b->wi_z, i, (b->shared & VNDF_SHARED_WI) != 0);
}
