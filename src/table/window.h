/* Windows of the radial search: for a law of the slope length with weights (c, k), c >= 0 (sampler/tabulated/theory.h),
 * and a part u of its mass, where the cell lies in which that part ends: eight successive cells and the one
 * after them, or, where D has many more, eight times eight or eight to the third ..., to be searched in so many
 * steps.
 *
 * The larger k/c, the larger the quantiles: (c + k R)+ for one ratio over that for a lower one grows with R. So
 * over a range of u and a range of k/c the cell lies between those of two corners, and the cells between are few
 * where the ranges are: of u 62 of 1/64, the first and last 64th in half octaves, since tails have many cells for
 * their mass; and half octaves of |k|/c from 1/16 to 16 for either sign of k, with two to
 * either side. Half octaves are read from the bits of the two floats: the bits are a logarithm that is 0 to 0.087
 * of an octave low. */
#ifndef VNDF_TABLE_WINDOW_H
#define VNDF_TABLE_WINDOW_H

#include <math.h>

#include "table/guide.h"

/* Makes d->windows from the sums of d->knots. 0 if there is no memory. */
int vndf_windows_make(vndf_distribution *d);
void vndf_windows_free(vndf_windows *windows);
size_t vndf_windows_bytes(const vndf_windows *windows);

/* 0 for |k|/c below 1/16, the last for 16 and above; c and |k| at most 4. */
VNDF_INLINE lanes_u vndf_window_ratio(lanes_f c, lanes_f k)
{
    const uint32_t half_octave = 1u << 22;
    lanes_u bits = lanes_bits(lanes_abs(k)) + VNDF_RATIOS / 2 * half_octave, least = lanes_bits(c);
    return lanes_limit_u((bits - lanes_limit_u(least, bits)) >> 22, lanes_set_u(VNDF_RATIOS - 1));
}

/* The range of u in [0, 1], ascending. */
VNDF_INLINE lanes_u vndf_window_range(lanes_f u)
{
    const float end = 0x1p-6f;
    lanes_f rest = 1.0f - u;
    lanes_f near = lanes_least(u, rest); /* to an end */
    lanes_m low = lanes_less(u, lanes_set(0.5f)), inner = lanes_at_most(lanes_set(end), near);
    lanes_u apart = lanes_bits(lanes_set(end)) - lanes_bits(lanes_least(near, lanes_set(end)));
    lanes_u half_octave = lanes_limit_u(apart >> 22, lanes_set_u(VNDF_RANGES_END - 1));
    const uint32_t first = VNDF_RANGES_END - 1, last = VNDF_RANGES - VNDF_RANGES_END;
    lanes_u outer = lanes_pick_u(low, first - half_octave, last + half_octave);
    return lanes_pick_u(inner, lanes_whole(u * 64.0f) + (VNDF_RANGES_END - 1u), outer);
}

/* The first cell of the window, and above VNDF_WINDOW_SHIFT n where it has 8^(n+1); u in [0, 1]. */
VNDF_INLINE lanes_u vndf_window_of(const vndf_distribution *d, lanes_f c, lanes_f k, lanes_f u)
{
    lanes_u cut = lanes_pick_u(lanes_less(k, lanes_set(0.0f)), lanes_set_u(VNDF_RATIOS), lanes_set_u(0));
    lanes_u row = cut + vndf_window_ratio(c, k);
    return lanes_gather_u16(d->windows.code,
                            row * d->windows.ranges + (vndf_window_range(u) >> d->windows.range_shift));
}

/* A window taken apart: its first cell, and the cells from one of its eight places to the next. */
typedef struct vndf_window {
    uint32_t first, step;
} vndf_window;

VNDF_INLINE vndf_window vndf_window_from(uint32_t code)
{
    vndf_window w = {code & ((1u << VNDF_WINDOW_SHIFT) - 1), 1u << 3 * (code >> VNDF_WINDOW_SHIFT)};
    return w;
}

#endif
