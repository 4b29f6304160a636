/* Solid angle of the stretched hemisphere: with L = |(sx m'x, sy m'y, m'z)|,
 * dwm = sx sy / L^3 dm', and dm' = sin(theta') dtheta' dphi', dphi'/dpsi = kappa / (cos^2 + kappa^2 sin^2)
 * of psi/2. Nothing in it is singular. */
#include "bins.h"

#include <math.h>
#include <stdlib.h>

#include "random.h"

static const double pi = 3.14159265358979323846;

/* ---- where the bins are -------------------------------------------------------------------------- */

enum { PILOTS = 801 };

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double values[PILOTS])
{
    qsort(values, PILOTS, sizeof values[0], ascending);
    return values[PILOTS / 2];
}

/* Keeps what a hostile sampler may return away from the map: any finite positive scale is a valid one. */
static double clamp_scale(double scale, double low, double high)
{
    if (!(scale > low))
        return low;
    return scale < high ? scale : high;
}

bin_map bins_for(const vndf_surface *surface, vndf_vec3 wi, uint64_t seed)
{
    double ax = (double)surface->alpha_x, ay = (double)surface->alpha_y;
    double slope[PILOTS], turn[PILOTS];
    bin_map map = {ax, ay, atan2(ay * (double)wi.y, ax * (double)wi.x), 1};
    vndf_view view = vndf_view_from(surface, wi);
    random_stream stream = random_from(seed);
    for (size_t i = 0; i < PILOTS; i++) {
        float u1 = random_float(&stream), u2 = random_float(&stream);
        vndf_vec3 wm = vndf_sample(&view, u1, u2, NULL);
        double x = (double)wm.x / ax, y = (double)wm.y / ay;
        slope[i] = hypot(x, y) / ((double)wm.z + 1e-30);
        turn[i] = fabs(remainder(atan2(y, x) - map.centre, 2 * pi));
    }
    double scale = clamp_scale(median(slope), 1e-12, 1e12);
    map.stretch_x = ax * scale;
    map.stretch_y = ay * scale;
    map.kappa = clamp_scale(tan(median(turn) / 2), 1e-6, 1);
    return map;
}

static size_t part(double fraction, size_t parts)
{
    double place = fraction * (double)parts;
    if (!(place > 0))
        return 0;
    return place < (double)parts ? (size_t)place : parts - 1;
}

size_t bins_place(const bin_map *map, vndf_vec3 wm)
{
    double x = (double)wm.x / map->stretch_x, y = (double)wm.y / map->stretch_y;
    double theta = atan2(hypot(x, y), (double)wm.z);
    double half = remainder(atan2(y, x) - map->centre, 2 * pi) / 2;
    double psi = 2 * atan2(sin(half), map->kappa * cos(half));
    return part(theta / (pi / 2), BINS_THETA) * BINS_PHI + part((psi + pi) / (2 * pi), BINS_PHI);
}

/* ---- the density in these coordinates ------------------------------------------------------------ */

typedef struct ring {
    const bin_map *map;
    const vndf_view *view;
    double sine, cosine;       /* of theta' */
    double psi_low, psi_high;  /* of the bin */
    double tolerance;
} ring;

static double density_at_psi(double psi, const ring *at)
{
    const bin_map *map = at->map;
    double c = cos(psi / 2), s = map->kappa * sin(psi / 2);
    double norm = c * c + s * s, phi = map->centre + 2 * atan2(s, c);
    double x = map->stretch_x * at->sine * cos(phi), y = map->stretch_y * at->sine * sin(phi);
    double length = sqrt(x * x + y * y + at->cosine * at->cosine);
    vndf_vec3 wm = {(float)(x / length), (float)(y / length), (float)(at->cosine / length)};
    double jacobian = map->stretch_x * map->stretch_y / (length * length * length) * at->sine * map->kappa / norm;
    return (double)vndf_pdf(at->view, wm) * jacobian;
}

/* ---- quadrature ---------------------------------------------------------------------------------- */

enum { NODES = 5, DEPTH_MAX = 22 };

/* Lobatto's rule of 5 points on [-1, 1], exact to degree 7. The end points are drawn in by 1e-7 of the
 * interval: the density there is that of this side of a border. */
static const double node[NODES] = {-0.9999999, -0.65465367070797714380, 0, 0.65465367070797714380, 0.9999999};
static const double weight[NODES] = {0.1, 49.0 / 90, 32.0 / 45, 49.0 / 90, 0.1};

static double row_rule(const ring *at, double low, double high)
{
    double sum = 0, middle = (low + high) / 2, half = (high - low) / 2;
    for (int i = 0; i < NODES; i++)
        sum += weight[i] * density_at_psi(middle + half * node[i], at);
    return sum * half;
}

/* Halving the tolerance at each level is what independent errors ask for on smooth sides; along a jump
 * only one of the two halves goes on. */
static double row_adaptive(const ring *at, double low, double high, double coarse, double tolerance, int depth)
{
    double middle = (low + high) / 2;
    double left = row_rule(at, low, middle), right = row_rule(at, middle, high);
    if (depth >= DEPTH_MAX || fabs(left + right - coarse) <= tolerance)
        return left + right;
    return row_adaptive(at, low, middle, left, tolerance / 2, depth + 1) +
           row_adaptive(at, middle, high, right, tolerance / 2, depth + 1);
}

/* The integral over psi at one theta'. */
static double integrate_row(ring *at, double theta)
{
    at->sine = sin(theta);
    at->cosine = cos(theta);
    double coarse = row_rule(at, at->psi_low, at->psi_high);
    double tolerance = fmax(at->tolerance, 2e-6 * fabs(coarse));
    return row_adaptive(at, at->psi_low, at->psi_high, coarse, tolerance, 0);
}

static double bin_rule(ring *at, double low, double high)
{
    double sum = 0, middle = (low + high) / 2, half = (high - low) / 2;
    for (int i = 0; i < NODES; i++)
        sum += weight[i] * integrate_row(at, middle + half * node[i]);
    return sum * half;
}

static double bin_adaptive(ring *at, double low, double high, double coarse, double tolerance, int depth)
{
    double middle = (low + high) / 2;
    double left = bin_rule(at, low, middle), right = bin_rule(at, middle, high);
    if (depth >= DEPTH_MAX || fabs(left + right - coarse) <= tolerance)
        return left + right;
    return bin_adaptive(at, low, middle, left, tolerance / 2, depth + 1) +
           bin_adaptive(at, middle, high, right, tolerance / 2, depth + 1);
}

void bins_integrate(const bin_map *map, const vndf_view *view, double probability[BINS_COUNT])
{
    const double absolute = 5e-10, high = pi / 2 / BINS_THETA, wide = 2 * pi / BINS_PHI;
    for (size_t bin = 0; bin < BINS_COUNT; bin++) {
        double theta = (double)(bin / BINS_PHI) * high;
        double psi = (double)(bin % BINS_PHI) * wide - pi;
        ring at = {map, view, 0, 0, psi, psi + wide, 0.2 * absolute / high};
        double coarse = bin_rule(&at, theta, theta + high);
        double tolerance = fmax(absolute, 1e-5 * fabs(coarse));
        probability[bin] = bin_adaptive(&at, theta, theta + high, coarse, tolerance, 0);
    }
}
