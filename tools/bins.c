/* Solid angle of the stretched hemisphere: with L = |(sx m'x, sy m'y, m'z)|, m' a unit vector,
 * dwm = sx sy / L^3 dm' = sx sy / L^3 sin(theta') dtheta' dphi'. Nothing in it is singular. */
#include "bins.h"

#include <math.h>
#include <stdlib.h>

#include "random.h"

static const double pi = 3.14159265358979323846;

/* ---- where the bins are -------------------------------------------------------------------------- */

enum { PILOTS = 2001 };

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void sort(double *values, size_t count)
{
    qsort(values, count, sizeof values[0], ascending);
}

/* Every other border is even between low and high, the rest are quantiles of the sorted values. */
static void place_borders(double *border, size_t parts, double low, double high, const double *values)
{
    for (size_t i = 0; i <= parts; i++)
        border[i] = i % 2 == 0 ? low + (high - low) * (double)i / (double)(parts + parts % 2)
                               : values[PILOTS * i / (parts + 1)];
    border[parts] = high;
    sort(border, parts);
}

static double slope_of(double x, double y, double z)
{
    return hypot(x, y) / (z + 1e-30);
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
    sort(slope, PILOTS);
    sort(turn, PILOTS);
    double scale = median_scale(slope);
    map.stretch_x = ax * scale;
    map.stretch_y = ay * scale;
    for (size_t i = 0; i < PILOTS; i++)
        slope[i] = atan(slope[i] / scale);
    place_borders(map.theta, BINS_THETA, 0, pi / 2, slope);
    place_borders(map.phi, BINS_PHI, -pi, pi, turn);
    return map;
}

/* The interval of ascending borders that holds x. */
static size_t interval(const double *border, size_t parts, double x)
{
    size_t low = 0, high = parts;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (x < border[middle])
            high = middle;
        else
            low = middle;
    }
    return low;
}

size_t bins_place(const bin_map *map, vndf_vec3 wm)
{
    double x = (double)wm.x / map->stretch_x, y = (double)wm.y / map->stretch_y;
    double theta = atan2(hypot(x, y), (double)wm.z), phi = remainder(atan2(y, x) - map->centre, 2 * pi);
    return interval(map->theta, BINS_THETA, theta) * BINS_PHI + interval(map->phi, BINS_PHI, phi);
}

/* ---- the density in these coordinates ------------------------------------------------------------ */

typedef struct ring {
    const bin_map *map;
    const vndf_view *view;
    double sine, cosine;      /* of theta' */
    double phi_low, phi_high; /* of the bin */
    double absolute;          /* error that a row may have */
    long budget;              /* evaluations that the bin may still cost */
    double depth;             /* angle that the bin reaches up from the horizon, if it touches it; else 0 */
} ring;

static double density_at(double phi, const ring *at)
{
    const bin_map *map = at->map;
    double x = map->stretch_x * at->sine * cos(map->centre + phi);
    double y = map->stretch_y * at->sine * sin(map->centre + phi);
    double length = sqrt(x * x + y * y + at->cosine * at->cosine);
    vndf_vec3 wm = {(float)(x / length), (float)(y / length), (float)(at->cosine / length)};
    double jacobian = map->stretch_x * map->stretch_y / (length * length * length) * at->sine;
    return (double)vndf_pdf(at->view, wm) * jacobian;
}

/* ---- quadrature ---------------------------------------------------------------------------------- */

/* How often an interval is halved to find a jump. Azimuth: it is known to 2e-4 of the bin's width then, which no
 * test of 1e8 samples can see. theta': to 3e-5, since all bins of a row may share a jump and its error. A bin
 * with a jump costs some 3e4 evaluations; the budget ends what is not a jump but noise. */
enum { NODES = 5, DEPTH_PHI = 12, DEPTH_THETA = 15, BUDGET = 100000 };

/* Lobatto's rule of 5 points on [-1, 1], exact to degree 7. The end points are drawn in by 1e-7 of the
 * interval: the density there is that of this side of a border. */
static const double node[NODES] = {-0.9999999, -0.65465367070797714380, 0, 0.65465367070797714380, 0.9999999};
static const double weight[NODES] = {0.1, 49.0 / 90, 32.0 / 45, 49.0 / 90, 0.1};

/* What an interval may be wrong by. Halving it takes 1/sqrt(2) of the absolute error to each half, as
 * independent errors ask for, and lets the relative error of each grow likewise. (With 1/2, the roundings of
 * the float density, 1e-7 and much more near wi.wm = 0, would be refined for ever.) */
typedef struct accuracy {
    double absolute, relative;
    int halvings; /* that are left */
} accuracy;

static accuracy of_half(accuracy whole)
{
    return (accuracy){whole.absolute * sqrt(0.5), whole.relative * sqrt(2), whole.halvings - 1};
}

static int agrees(double whole, double halves, accuracy wanted)
{
    return wanted.halvings <= 0 || fabs(halves - whole) <= fmax(wanted.absolute, wanted.relative * fabs(halves));
}

static double row_rule(ring *at, double low, double high)
{
    double sum = 0, middle = (low + high) / 2, half = (high - low) / 2;
    for (int i = 0; i < NODES; i++)
        sum += weight[i] * density_at(middle + half * node[i], at);
    at->budget -= NODES;
    return sum * half;
}

static double row_adaptive(ring *at, double low, double high, double whole, accuracy wanted)
{
    double middle = (low + high) / 2;
    double left = row_rule(at, low, middle), right = row_rule(at, middle, high);
    if (at->budget <= 0 || agrees(whole, left + right, wanted))
        return left + right;
    wanted = of_half(wanted);
    return row_adaptive(at, low, middle, left, wanted) + row_adaptive(at, middle, high, right, wanted);
}

/* The integral over phi' at one theta'. A bin that touches the horizon, where D of a heavy tail is unbounded but
 * integrable, counts theta' from there as depth t^8. */
static double integrate_row(ring *at, double place)
{
    double theta = place, measure = 1, absolute = at->absolute;
    if (at->depth > 0) {
        double up = at->depth * pow(place, 8);
        measure = 8 * at->depth * pow(place, 7);
        absolute *= at->depth / (measure + 1e-30);
        at->sine = cos(up);
        at->cosine = sin(up);
    } else {
        at->sine = sin(theta);
        at->cosine = cos(theta);
    }
    const accuracy wanted = {absolute, 5e-6, DEPTH_PHI};
    return measure * row_adaptive(at, at->phi_low, at->phi_high, row_rule(at, at->phi_low, at->phi_high), wanted);
}

static double bin_rule(ring *at, double low, double high)
{
    double sum = 0, middle = (low + high) / 2, half = (high - low) / 2;
    for (int i = 0; i < NODES; i++)
        sum += weight[i] * integrate_row(at, middle + half * node[i]);
    return sum * half;
}

static double bin_adaptive(ring *at, double low, double high, double whole, accuracy wanted)
{
    double middle = (low + high) / 2;
    double left = bin_rule(at, low, middle), right = bin_rule(at, middle, high);
    if (at->budget <= 0 || agrees(whole, left + right, wanted))
        return left + right;
    wanted = of_half(wanted);
    return bin_adaptive(at, low, middle, left, wanted) + bin_adaptive(at, middle, high, right, wanted);
}

void bins_integrate(const bin_map *map, const vndf_view *view, double probability[BINS_COUNT])
{
    const accuracy wanted = {5e-10, 1e-5, DEPTH_THETA};
    for (size_t bin = 0; bin < BINS_COUNT; bin++) {
        const double *theta = map->theta + bin / BINS_PHI, *phi = map->phi + bin % BINS_PHI;
        double row_absolute = 0.2 * wanted.absolute / (theta[1] - theta[0] + 1e-30);
        int touches = bin / BINS_PHI == BINS_THETA - 1;
        ring at = {map, view, 0, 0, phi[0], phi[1], row_absolute, BUDGET, touches ? theta[1] - theta[0] : 0};
        double low = touches ? 0 : theta[0], high = touches ? 1 : theta[1], whole = bin_rule(&at, low, high);
        probability[bin] = bin_adaptive(&at, low, high, whole, wanted);
    }
}
