#include "table/window.h"

/* Of a law with weights (c, k): mass up to knot j. */
static double before(const vndf_knots *knots, double c, double k, uint32_t j)
{
    double w = c * knots->z[j] + k * knots->x[j];
    return c * knots->e[j] + (w > 0.0 ? w : 0.0) * knots->g[j];
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

/* Cells of the masses at which ranges of u begin, of a law; `side` is -1 for the lowest that rounding and the cell
 * of the cut allow, 1 for the highest. */
static void quantiles(const vndf_distribution *d, double c, double k, int side, uint32_t *cell)
{
    uint32_t last = d->radial_count - 1, cut = 0, j = 0;
    while (cut < last && c * d->knots.z[cut + 1] + k * d->knots.x[cut + 1] > 0.0)
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

void vndf_windows_make(vndf_distribution *d)
{
    uint32_t low[VNDF_RANGES + 1], high[VNDF_RANGES + 1];
    for (int cut = 0; cut < 2; cut++)
        for (uint32_t r = 0; r < VNDF_RATIOS; r++) {
            double least = r > 0 ? ratio_bound(r, 0) : 0.0, most = ratio_bound(r + 1, 1);
            int open = r + 1 == VNDF_RATIOS; /* up to c = 0 */
            quantiles(d, cut && open ? 0.0 : 1.0, cut ? -most : least, -1, low);
            quantiles(d, !cut && open ? 0.0 : 1.0, cut ? -least : open ? 1.0 : most, 1, high);
            for (uint32_t i = 0; i < VNDF_RANGES; i++) {
                uint32_t width = 0;
                while (high[i + 1] - low[i] > (uint32_t)VNDF_WINDOW << 3 * width)
                    width++;
                d->windows[cut][r][i] = (uint16_t)(low[i] | width << VNDF_WINDOW_SHIFT);
            }
        }
}
