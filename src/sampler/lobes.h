/* Weights and shares of the lobes of mixtures: number l * stride + i is that of lobe l of mixture i. */
#ifndef VNDF_SAMPLER_LOBES_H
#define VNDF_SAMPLER_LOBES_H

#include <float.h>

#include "sampler/state.h"

/* Of one mixture: divides weights by the largest and then by their sum; returns whether they are >= 0 and finite, and
 * not all 0: else they become 0. */
VNDF_INLINE int vndf_weigh_lobes(int lobes, int stride, float *weight)
{
    int valid = 1;
    float largest = 0.0f, sum = 0.0f;
    for (int l = 0; l < lobes; l++) {
        valid &= (weight[l * stride] >= 0.0f) & (weight[l * stride] <= FLT_MAX);
        largest = max(largest, weight[l * stride]);
    }
    valid &= largest > 0.0f;
    for (int l = 0; l < lobes; l++) {
        weight[l * stride] = valid ? weight[l * stride] / largest : 0.0f;
        sum += weight[l * stride];
    }
    for (int l = 0; valid && l < lobes; l++)
        weight[l * stride] = weight[l * stride] / sum;
    return valid;
}

enum { VNDF_MIXTURES = 256 }; /* side by side, at most */

/* What areas make of such weights, for `count` mixtures: share[] holds areas first. Where no lobe sees an area that a
 * float can hold, the weights alone count. */
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
            share[l * stride + i] = (sum[i] > FLT_MIN ? of : w) / (sum[i] > FLT_MIN ? sum[i] : total[i]);
        }
}

#endif
