/* Weights and shares of the lobes of mixtures (kernel/shares.h): number l * stride + i is that of lobe l of mixture
 * i. */
#ifndef VNDF_SAMPLER_LOBES_H
#define VNDF_SAMPLER_LOBES_H

#include <float.h>

#include "sampler/state.h"
#include "vndf.h"

KERNEL int lobe_end(int count)
{
    return count;
}

/* A copy of what was just stored would wait for the stores. */
typedef struct lobe_numbers {
    float *lobe;
} lobe_numbers;

#include "kernel/shares.h"

/* Makes the sum of weights 1; returns whether they are valid: else they become 0. */
VNDF_INLINE int vndf_weigh(float *weight, int lobes)
{
    int valid = 0;
    lobe_weights((lobe_numbers){weight}, lobes);
    for (int l = 0; l < lobes; l++)
        valid |= weight[l] > 0.0f;
    return valid;
}

VNDF_INLINE int vndf_weigh_lobes(int lobes, int stride, float *weight)
{
    float of[VNDF_MIXTURE_LOBES];
    for (int l = 0; l < lobes; l++)
        of[l] = weight[l * stride];
    const int valid = vndf_weigh(of, lobes);
    for (int l = 0; l < lobes; l++)
        weight[l * stride] = of[l];
    return valid;
}

enum { VNDF_MIXTURES = 256 }; /* side by side, at most */

/* What areas make of such weights, for `count` mixtures: share[] holds areas first. */
VNDF_INLINE void vndf_share_lobes(int lobes, int count, int stride, const float *weight, float *share)
{
    float sum[VNDF_MIXTURES], total[VNDF_MIXTURES];
    for (int i = 0; i < count; i++)
        sum[i] = total[i] = 0.0f;
    for (int l = 0; l < lobes; l++)
        for (int i = 0; i < count; i++) {
            share[l * stride + i] = lobe_part(weight[l * stride + i], share[l * stride + i]);
            sum[i] += share[l * stride + i];
            total[i] += weight[l * stride + i];
        }
    for (int l = 0; l < lobes; l++)
        for (int i = 0; i < count; i++)
            share[l * stride + i] = lobe_fraction(share[l * stride + i], weight[l * stride + i], sum[i], total[i]);
}

#endif
