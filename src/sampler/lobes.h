/* Weights and shares of the lobes of mixtures, of `count` mixtures side by side: number l * stride + i is that of lobe
 * l of mixture i. For one mixture, and for blocks of them (batch/mixtures.c). */
#ifndef VNDF_SAMPLER_LOBES_H
#define VNDF_SAMPLER_LOBES_H

#include <float.h>

#include "sampler/state.h"

enum { VNDF_MIXTURES = 512 }; /* `count`, at most */

/* Divides weights by the largest of each mixture and then by their sum; valid[i] says whether they are >= 0 and finite,
 * and not all 0: else they become 0. */
VNDF_INLINE void vndf_weigh_lobes(int lobes, int count, int stride, float *weight, int *valid)
{
    float largest[VNDF_MIXTURES], sum[VNDF_MIXTURES];
    for (int i = 0; i < count; i++) {
        valid[i] = 1;
        largest[i] = sum[i] = 0.0f;
    }
    for (int l = 0; l < lobes; l++)
        for (int i = 0; i < count; i++) {
            const float w = weight[l * stride + i];
            valid[i] &= (w >= 0.0f) & (w <= FLT_MAX);
            largest[i] = most(largest[i], w);
        }
    for (int i = 0; i < count; i++)
        valid[i] &= largest[i] > 0.0f;
    for (int l = 0; l < lobes; l++)
        for (int i = 0; i < count; i++) {
            const float w = weight[l * stride + i] / largest[i];
            weight[l * stride + i] = valid[i] ? w : 0.0f;
            sum[i] += weight[l * stride + i];
        }
    for (int l = 0; l < lobes; l++)
        for (int i = 0; i < count; i++) {
            const float w = weight[l * stride + i] / sum[i];
            weight[l * stride + i] = valid[i] ? w : 0.0f;
        }
}

/* What areas make of these weights: share[] holds areas first. Where no lobe sees an area that a float can hold, the
 * weights alone count. */
VNDF_INLINE void vndf_share_lobes(int lobes, int count, int stride, const float *weight, float *share)
{
    float sum[VNDF_MIXTURES], total[VNDF_MIXTURES];
    for (int i = 0; i < count; i++)
        sum[i] = total[i] = 0.0f;
    for (int l = 0; l < lobes; l++)
        for (int i = 0; i < count; i++) {
            const float w = weight[l * stride + i], part = w * share[l * stride + i];
            share[l * stride + i] = w > 0.0f ? part : 0.0f;
            sum[i] += share[l * stride + i];
            total[i] += w;
        }
    for (int l = 0; l < lobes; l++)
        for (int i = 0; i < count; i++) {
            const float of = share[l * stride + i], w = weight[l * stride + i];
            const float part = sum[i] > FLT_MIN ? of : w, all = sum[i] > FLT_MIN ? sum[i] : total[i];
            share[l * stride + i] = part / all;
        }
}

#endif
