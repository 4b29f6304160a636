/* Where the bins are, and which of them holds a normal. */
#include "evidence/measure/bins.h"

#include <math.h>
#include <stdlib.h>

#include "cli/random.h"
#include "cli/sort.h"

static const double pi = 3.14159265358979323846;

enum { PILOTS = 2001 };

/* Place i of parts, for i even: even between low and high. */
static double even_place(size_t i, size_t parts, double low, double high)
{
    return low + (high - low) * (double)i / (double)(parts + parts % 2);
}

static double quantile(size_t i, size_t parts, const double *sorted)
{
    return sorted[PILOTS * i / (parts + 1)];
}

/* Every other border is even in theta', the rest are quantiles of the sorted slopes. */
static void place_slopes(double border[BINS_THETA + 1], const double *sorted, double scale)
{
    for (size_t i = 0; i <= BINS_THETA; i++)
        border[i] =
            i % 2 == 0 ? tan(even_place(i, BINS_THETA, 0, pi / 2)) : quantile(i, BINS_THETA, sorted) / scale;
    border[BINS_THETA] = HUGE_VAL;
    sort_numbers(border, BINS_THETA + 1);
}

/* The same in azimuth. */
static void place_turns(double border[BINS_PHI + 1], const double *sorted)
{
    for (size_t i = 0; i <= BINS_PHI; i++)
        border[i] = i % 2 == 0 ? even_place(i, BINS_PHI, -pi, pi) : quantile(i, BINS_PHI, sorted);
    border[BINS_PHI] = pi;
    sort_numbers(border, BINS_PHI + 1);
}

/* Infinite at the horizon. */
static double slope_of(double x, double y, double z)
{
    return z > 0 ? sqrt(x * x + y * y) / z : HUGE_VAL; /* squares of floats: no overflow */
}

/* A hostile sampler must not spoil the map: any finite positive scale makes a valid one. */
static double median_scale(const double *sorted)
{
    double scale = sorted[PILOTS / 2];
    return scale > 1e-12 ? fmin(scale, 1e12) : 1e-12;
}

bin_map bins_for(const vndf_surface *surface, vndf_vec3 wi, uint64_t seed)
{
    double ax = (double)surface->alpha_x, ay = (double)surface->alpha_y;
    double slope[PILOTS], turn[PILOTS];
    bin_map map = {.centre = atan2(ay * (double)wi.y, ax * (double)wi.x)};
    vndf_view view = vndf_view_from(surface, wi);
    random_stream stream = random_from(seed);
    for (size_t i = 0; i < PILOTS; i++) {
        float u1 = random_float(&stream), u2 = random_float(&stream);
        vndf_vec3 wm = vndf_sample(&view, u1, u2, NULL);
        double x = (double)wm.x / ax, y = (double)wm.y / ay;
        slope[i] = slope_of(x, y, (double)wm.z);
        turn[i] = remainder(atan2(y, x) - map.centre, 2 * pi);
    }
    sort_numbers(slope, PILOTS);
    sort_numbers(turn, PILOTS);
    double scale = median_scale(slope);
    map.stretch_x = ax * scale;
    map.stretch_y = ay * scale;
    place_slopes(map.slope, slope, scale);
    place_turns(map.phi, turn);
    return map;
}

/* Without branches to mispredict: samples come in any order. */
size_t bins_interval(const double *border, size_t parts, double x)
{
    size_t low = 0;
    while (parts > 1) {
        size_t half = parts / 2;
        low += x >= border[low + half] ? half : 0;
        parts -= half;
    }
    return low;
}

size_t bins_place(const bin_map *map, vndf_vec3 wm)
{
    double x = (double)wm.x / map->stretch_x, y = (double)wm.y / map->stretch_y;
    double slope = slope_of(x, y, (double)wm.z), phi = atan2(y, x) - map->centre;
    phi += phi < -pi ? 2 * pi : phi > pi ? -2 * pi : 0;
    return bins_interval(map->slope, BINS_THETA, slope) * BINS_PHI + bins_interval(map->phi, BINS_PHI, phi);
}
