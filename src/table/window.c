#include "table/window.h"

#include <stdlib.h>

/* Of a law with weights (c, k): mass up to knot j. */
static double before(const vndf_knots *knots, double c, double k, uint32_t j)
{
    double w = c * knots->at[j].z + k * knots->at[j].x;
    return c * knots->pole[j].e + (w > 0.0 ? w : 0.0) * knots->pole[j].g;
}

/* Where range i of vndf_window_range begins; that of VNDF_RANGES is 1. */
static double range_begin(uint32_t i)
{
    uint32_t back = VNDF_RANGES - i, near = i < back ? i : back; /* from the nearer end */
    double u = near < VNDF_RANGES_END ? 0x1p-6 : (near - VNDF_RANGES_END + 1) / 64.0;
    for (uint32_t t = near < VNDF_RANGES_END ? VNDF_RANGES_END - near : 0; t > 1; t -= 2)
        u *= 0.5;
    if (near < VNDF_RANGES_END && (VNDF_RANGES_END - near) % 2 == 1)
        u *= 0.75; /* 2^-6 times 1, 3/4, 1/2, 3/8 ... */
    u = near == 0 ? 0.0 : u;
    return i < back ? u : 1.0 - u;
}

/* The cells of a law in which the masses end at which ranges of u begin; `side` is -1 for the lowest cell that
 * rounding and the cell of the cut allow, 1 for the highest. */
static void quantiles(const vndf_distribution *d, double c, double k, int side, uint32_t *cell)
{
    uint32_t last = d->radial_count - 1, cut = 0, j = 0;
    while (cut < last && c * d->knots.at[cut + 1].z + k * d->knots.at[cut + 1].x > 0.0)
        cut++;
    double least = before(&d->knots, c, k, cut);
    double most = before(&d->knots, c, k, cut + 1); /* beyond the cut that is c e */
    double total = (k < 0.0 && side < 0 ? least : most) * (1.0 + side * 1e-5);
    for (uint32_t i = 0; i <= VNDF_RANGES; i++) {
        double target = total * range_begin(i);
        while (j < cut && before(&d->knots, c, k, j + 1) <= target)
            j++;
        cell[i] = j;
    }
}

/* Bounds of |k|/c in a range of vndf_window_ratio, widened by what the logarithm is off. */
static double ratio_bound(uint32_t ratio, int upper)
{
    double bound = ratio % 2 == VNDF_RATIOS / 2 % 2 ? 1.0 : 0.70710678118654752;
    int octave = ((int)ratio - VNDF_RATIOS / 2 + (bound < 1.0)) / 2;
    for (; octave > 0; octave--)
        bound *= 2.0;
    for (; octave < 0; octave++)
        bound *= 0.5;
    return upper ? bound * 1.07 : bound / 1.07;
}

/* The lowest and the highest cell of each ratio and range, the second half for k < 0. */
typedef struct reach {
    uint32_t low[2 * VNDF_RATIOS][VNDF_RANGES], high[2 * VNDF_RATIOS][VNDF_RANGES];
} reach;

static void reach_of_ratio(const vndf_distribution *d, int cut, uint32_t r, uint32_t *low, uint32_t *high)
{
    uint32_t from[VNDF_RANGES + 1], to[VNDF_RANGES + 1];
    double least = r > 0 ? ratio_bound(r, 0) : 0.0, most = ratio_bound(r + 1, 1);
    int open = r + 1 == VNDF_RATIOS; /* up to c = 0 */
    quantiles(d, cut && open ? 0.0 : 1.0, cut ? -most : least, -1, from);
    quantiles(d, !cut && open ? 0.0 : 1.0, cut ? -least : open ? 1.0 : most, 1, to);
    for (uint32_t i = 0; i < VNDF_RANGES; i++) {
        low[i] = from[i];
        high[i] = to[i + 1];
    }
}

static uint32_t code_of(uint32_t low, uint32_t high)
{
    uint32_t width = 0;
    while (high - low > (uint32_t)VNDF_WINDOW << 3 * width)
        width++;
    return low | width << VNDF_WINDOW_SHIFT;
}

/* The window that ranges share with one. */
static uint32_t shared_code(const reach *all, const vndf_windows *w, uint32_t ratio, uint32_t range)
{
    uint32_t from = range >> w->range_shift << w->range_shift;
    uint32_t low = all->low[ratio][from], high = all->high[ratio][from];
    for (uint32_t i = from; i < VNDF_RANGES && i >> w->range_shift == range >> w->range_shift; i++) {
        low = all->low[ratio][i] < low ? all->low[ratio][i] : low;
        high = all->high[ratio][i] > high ? all->high[ratio][i] : high;
    }
    return code_of(low, high);
}

/* The part of samples in front of wi, then behind it, whose search sharing makes longer, ratios being alike. */
static double made_wider(const reach *all, const vndf_windows *w, uint32_t first)
{
    double wider = 0.0;
    for (uint32_t r = first; r < first + VNDF_RATIOS; r++)
        for (uint32_t i = 0; i < VNDF_RANGES; i++) {
            uint32_t own = code_of(all->low[r][i], all->high[r][i]) >> VNDF_WINDOW_SHIFT;
            if (shared_code(all, w, r, i) >> VNDF_WINDOW_SHIFT > own)
                wider += range_begin(i + 1) - range_begin(i);
        }
    return wider / VNDF_RATIOS;
}

/* The coarsest that costs next to no time. Where a window begins shows in the bits of a sample at u = 1 alone, behind
 * wi, if the cut lies so far out that the last cells inside it hold less than the rounding of the mass: their sums need
 * not ascend then, and a search ends at any of them. Eight ranges are never shared, nor ratios, since that changed
 * such samples of the 2 KiB table (239 of a million of test same_bits). */
static void choose_shift(const reach *all, vndf_windows *w)
{
    const double most = 0.005;
    for (w->range_shift = 2; w->range_shift > 0; w->range_shift--)
        if (made_wider(all, w, 0) <= most && made_wider(all, w, VNDF_RATIOS) <= most)
            return;
}

size_t vndf_windows_bytes(const vndf_windows *w)
{
    return (2 * (size_t)VNDF_RATIOS * w->ranges + 1) * sizeof *w->code;
}

int vndf_windows_make(vndf_distribution *d)
{
    vndf_windows *w = &d->windows;
    reach *all = malloc(sizeof *all);
    if (!all)
        return 0;
    for (uint32_t r = 0; r < 2 * VNDF_RATIOS; r++)
        reach_of_ratio(d, r >= VNDF_RATIOS, r % (uint32_t)VNDF_RATIOS, all->low[r], all->high[r]);
    choose_shift(all, w);
    w->ranges = ((uint32_t)(VNDF_RANGES - 1) >> w->range_shift) + 1;
    w->code = calloc(vndf_windows_bytes(w), 1);
    for (uint32_t r = 0; w->code && r < 2 * VNDF_RATIOS; r++)
        for (uint32_t i = 0; i < w->ranges; i++)
            w->code[r * w->ranges + i] = (uint16_t)shared_code(all, w, r, i << w->range_shift);
    free(all);
    return w->code != NULL;
}

void vndf_windows_free(vndf_windows *windows)
{
    free(windows->code);
}
