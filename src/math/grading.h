/* Cell boundaries on [0, 1] that are finer towards 1, where the wedge densities bend most: with w = j/n,
 * q = w (1.8 - 0.8 w); the first cell is some seven times as wide as the last. Found back by one square root. */
#ifndef VNDF_MATH_GRADING_H
#define VNDF_MATH_GRADING_H

#include <math.h>
#include <stdint.h>

static inline float vndf_graded_node(uint32_t j, uint32_t n)
{
    float w = (float)j / (float)n;
    return j < n ? w * (1.8f - 0.8f * w) : 1.0f;
}

/* j with node j <= q < node j + 1, q in [0, 1]; n - 1 for q = 1. */
static inline uint32_t vndf_graded_find(float q, uint32_t n)
{
    float w = 2.0f * q / (1.8f + sqrtf(3.24f - 3.2f * q)) * (float)n;
    uint32_t j = w < (float)(n - 1) ? (uint32_t)w : n - 1;
    if (j > 0 && q < vndf_graded_node(j, n)) /* rounding of w */
        j--;
    else if (j + 1 < n && q >= vndf_graded_node(j + 1, n))
        j++;
    return j;
}

#endif
