/* Windows of the radial search: for a law of the slope length with weights (c, k), c >= 0 (sampler/engine.h), and
 * a part u of its mass, eight successive knots that tell the cell where that part ends.
 *
 * The larger k/c, the larger the quantiles: (c + k R)+ for one ratio over that for a lower one grows with R. So
 * over a range of u and a range of k/c the cell lies between those of two corners, and the cells between are few
 * where the ranges are: 64 of u, and half octaves of |k|/c from 1/16 to 16 for either sign of k, with two to
 * either side. Half octaves are read from the bits of the two floats: the bits are a logarithm that is 0 to 0.087
 * of an octave low. */
#ifndef VNDF_TABLE_WINDOW_H
#define VNDF_TABLE_WINDOW_H

#include <math.h>

#include "table/guide.h"

/* Fills d->windows from the sums of d->knots. */
void vndf_windows_make(vndf_distribution *d);

/* 0 for |k|/c below 1/16, the last for 16 and above; c and |k| at most 4. */
VNDF_INLINE uint32_t vndf_window_ratio(float c, float k)
{
    int32_t half_octave = 1 << 22, apart = (int32_t)(vndf_float_bits(fabsf(k)) - vndf_float_bits(c));
    int32_t above = apart + VNDF_RATIOS / 2 * half_octave;
    int32_t ratio = (above > 0 ? above : 0) / half_octave;
    return ratio < VNDF_RATIOS ? (uint32_t)ratio : VNDF_RATIOS - 1;
}

/* The first cell of the window, or VNDF_NO_WINDOW where eight knots are not enough; u in [0, 1]. */
VNDF_INLINE uint32_t vndf_window_of(const vndf_distribution *d, float c, float k, float u)
{
    uint32_t range = (uint32_t)(u * (VNDF_RANGES - 1e-5f)); /* below VNDF_RANGES for u = 1 */
    return d->windows[k < 0.0f][vndf_window_ratio(c, k)][range];
}

#endif
