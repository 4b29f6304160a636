/* Weights and shares of the lobes of a mixture (kernel/shares.h). */
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

#endif
