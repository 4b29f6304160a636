/* Where the bins are, which of them holds a normal, and the integral of the density over each.
 *
 * With L = |(sx m'x, sy m'y, m'z)|, m' a unit vector of the stretched hemisphere, dwm = sx sy / L^3 dm', and dm' =
 * sin(theta') dtheta' dphi'. Nothing in it is singular; but the lobe may have parts of very different width, and tails
 * that fall by a power so low that slopes of 1e20 count.
 *
 * D is isotropic, so all that is steep in a density lies at a constant stretched slope R = tan(theta'): the
 * borders of a table's cells, jumps and rings. Along the azimuth it is smooth but for the horizon of wi, and for
 * the right angle to wi where the law of a table has an edge. So at one slope all bins of a ring are integrated
 * over their azimuths by Gauss' rule, cut at these places, which are known; and over log R all of them
 * together, adaptively: the panel whose two rules differ most is halved next. (A quadrature in two dimensions for
 * each bin chases the roundings of a narrow ring for minutes.) */
#include "evidence/measure/bins.h"

#include <math.h>
#include <stdlib.h>

#include "cli/random.h"
#include "cli/sort.h"

static const double pi = 3.14159265358979323846;

enum { PILOTS = 2001 };

void bins_borders(double *border, size_t parts, double low, double high, const double *sorted, size_t count)
{
    for (size_t i = 0; i <= parts; i++)
        border[i] =
            i % 2 ? sorted[count * i / (parts + 1)] : low + (high - low) * (double)i / (double)(parts + parts % 2);
}

/* Infinite at the horizon. */
static double slope_of(double x, double y, double z)
{
    return z > 0 ? sqrt(x * x + y * y) / z : HUGE_VAL; /* squares of floats: no overflow */
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
    /* a hostile sampler must not spoil the map: any finite positive scale makes a valid one */
    const double median = slope[PILOTS / 2], scale = median > 1e-12 ? fmin(median, 1e12) : 1e-12;
    map.stretch_x = ax * scale;
    map.stretch_y = ay * scale;
    bins_borders(map.slope, BINS_THETA, 0, pi / 2, slope, PILOTS);
    for (size_t i = 0; i <= BINS_THETA; i++) /* even ones are so in theta' */
        map.slope[i] = i % 2 ? map.slope[i] / scale : tan(map.slope[i]);
    map.slope[BINS_THETA] = HUGE_VAL;
    sort_numbers(map.slope, BINS_THETA + 1);
    bins_borders(map.phi, BINS_PHI, -pi, pi, turn, PILOTS);
    sort_numbers(map.phi, BINS_PHI + 1);
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

/* ---- one slope ----------------------------------------------------------------------------------- */

/* Lobatto's 4 nodes on [-1, 1], exact to degree 5, among the 7 of Kronrod's extension, exact to degree 9 (Gander
 * and Gautschi, Adaptive Quadrature - Revisited, 2000). The end points are drawn in by 1e-7 of the interval: the
 * density there is that of this side of a border. */
enum { NODES = 7 };
static const double node[NODES] = {-0.9999999, -0.81649658092772603, -0.44721359549995794,
                                   0,          0.44721359549995794,  0.81649658092772603,
                                   0.9999999};
static const double kronrod[NODES] = {77.0 / 1470,  432.0 / 1470, 625.0 / 1470, 672.0 / 1470,
                                      625.0 / 1470, 432.0 / 1470, 77.0 / 1470};
static const double lobatto[NODES] = {1.0 / 6, 0, 5.0 / 6, 0, 5.0 / 6, 0, 1.0 / 6};

/* Gauss' 4 nodes, exact to degree 7: a bin spans at most 6 degrees. */
enum { TURNS = 4, POINTS = (BINS_PHI + 4) * TURNS };
static const double gauss[TURNS] = {-0.86113631159405258, -0.33998104358485626, 0.33998104358485626,
                                    0.86113631159405258};
static const double gauss_weight[TURNS] = {0.34785484513745386, 0.65214515486254614, 0.65214515486254614,
                                           0.34785484513745386};

/* An azimuth of a rule. */
typedef struct turn {
    double cosine, sine, weight;
} turn;

typedef struct view_of_bins {
    const bin_map *map;
    vndf_batch batch; /* of one view; it is given its count when it is asked */
    vndf_vec3 wi;
    double across; /* wi.wm ~ across cos(phi') sin(theta') + wi.z cos(theta') */
    turn whole[BINS_PHI][TURNS];
} view_of_bins;

static void fill_turns(const bin_map *map, double low, double high, turn to[TURNS])
{
    double middle = map->centre + (low + high) / 2, half = (high - low) / 2;
    for (int i = 0; i < TURNS; i++) {
        double phi = middle + half * gauss[i];
        to[i] = (turn){cos(phi), sin(phi), half * gauss_weight[i]};
    }
}

/* The normals of a slope, and what one unit of density there adds to the bin of each. */
typedef struct points {
    float x[POINTS], y[POINTS], z[POINTS], density[POINTS];
    double share[POINTS];
    size_t bin[POINTS], count;
} points;

/* Along some azimuths; dtheta' = sine cosine dlog(R). */
static void add_points(points *to, const bin_map *map, double sine, double cosine, const turn *turns, size_t bin)
{
    for (int i = 0; i < TURNS; i++) {
        double x = map->stretch_x * sine * turns[i].cosine, y = map->stretch_y * sine * turns[i].sine;
        double per = 1 / sqrt(x * x + y * y + cosine * cosine);
        size_t n = to->count++;
        to->x[n] = (float)(x * per);
        to->y[n] = (float)(y * per);
        to->z[n] = (float)(cosine * per);
        to->share[n] =
            map->stretch_x * map->stretch_y * (per * per * per) * sine * sine * cosine * turns[i].weight;
        to->bin[n] = bin;
    }
}

/* The integrals over the azimuths of all bins of a ring at one slope. Beyond the horizon normals are turned away. */
static void integrate_turns(const view_of_bins *view, double slope, double to[BINS_PHI])
{
    const bin_map *map = view->map;
    double cosine = 1 / sqrt(1 + slope * slope), sine = slope * cosine;
    double across = view->across * sine, along = (double)view->wi.z * cosine;
    double horizon = fabs(along) < across ? acos(-along / across) : along > 0 ? pi : 0;
    double first = fmin(horizon, pi / 2), last = fmax(horizon, pi / 2);
    const double cut[] = {-last, -first, first, last, HUGE_VAL}, *next = cut;
    points of;
    of.count = 0;
    for (size_t bin = 0; bin < BINS_PHI; bin++) {
        double low = map->phi[bin], end = map->phi[bin + 1];
        to[bin] = 0;
        while (low < end) {
            while (*next <= low)
                next++;
            double high = fmin(*next, end);
            turn part[TURNS];
            int is_whole = low == map->phi[bin] && high == end, is_seen = fabs(low + high) / 2 < horizon;
            if (is_seen && !is_whole)
                fill_turns(map, low, high, part);
            if (is_seen)
                add_points(&of, map, sine, cosine, is_whole ? view->whole[bin] : part, bin);
            low = high;
        }
    }
    vndf_batch batch = view->batch;
    batch.count = of.count;
    vndf_pdf_n(&batch, (vndf_normals){of.x, of.y, of.z}, of.density);
    for (size_t n = 0; n < of.count; n++)
        to[of.bin[n]] += (double)of.density[n] * of.share[n];
}

/* ---- rings --------------------------------------------------------------------------------------- */

/* An interval of log R, the integrals of all bins over it, and the sum of how far its two rules are apart. */
typedef struct panel {
    double low, high, value[BINS_PHI], sum, error;
    double change; /* from node to node, of the mass per log R */
} panel;

/* A normal is rounded by this part of its slope, and its density is that of a normal this far away (promise 2 of the
 * library): the integral of what that adds is at most the change of the mass per log R, times this. */
static const double ONE_ROUNDING = 0x1p-23;

/* What is so narrow is left alone: normals are floats, which do not tell its slopes apart. */
static const double narrowest = 0x1p-23;

static panel measure(const view_of_bins *view, double low, double high)
{
    panel of = {.low = low, .high = high};
    double middle = (low + high) / 2, half = (high - low) / 2, at_slope[BINS_PHI], few[BINS_PHI] = {0}, before = 0;
    for (int i = 0; i < NODES; i++) {
        double sum = 0;
        integrate_turns(view, exp(middle + half * node[i]), at_slope);
        for (size_t bin = 0; bin < BINS_PHI; bin++) {
            sum += at_slope[bin];
            of.value[bin] += half * kronrod[i] * at_slope[bin];
            few[bin] += half * lobatto[i] * at_slope[bin];
        }
        of.change += i > 0 ? fabs(sum - before) : 0;
        before = sum;
    }
    for (size_t bin = 0; bin < BINS_PHI; bin++) {
        of.sum += of.value[bin];
        of.error += high - low < narrowest ? 0 : fabs(few[bin] - of.value[bin]);
    }
    return of;
}

/* A ring is good when the rules of its panels are so far apart in all, relative to its integral or absolutely (the
 * better rule is much closer to it). PANELS_MAX ends what is not a jump but noise. */
static const double RELATIVE = 1e-6, ABSOLUTE = 1e-10;
enum { PANELS_MAX = 400 };

/* Slopes beyond which nothing is: a cell of a table that begins at 0 or ends at infinity has some 1e-7 of its mass
 * there. */
static const double LEAST = 0x1p-80, LARGEST = 0x1p100;

/* Panels between the slopes of a ring span a factor of 4 at most and end where the horizon enters. Returns how much the
 * mass per log R changes on the way. */
static double integrate_ring(const view_of_bins *view, const double slope[2], double probability[BINS_PHI])
{
    panel all[PANELS_MAX];
    const double end = log(fmin(slope[1], LARGEST)), enters = log(fabs((double)view->wi.z) / view->across);
    double change = 0;
    size_t count = 0;
    for (double low = log(fmax(slope[0], LEAST)), high; low < end; low = high) {
        high = fmin(low + log(4), end);
        high = enters > low && enters < high ? enters : high;
        all[count++] = measure(view, low, high);
    }
    while (count < PANELS_MAX) {
        double sum = 0, error = 0;
        panel *worst = all;
        for (panel *of = all; of < all + count; of++) {
            sum += of->sum;
            error += of->error;
            worst = of->error > worst->error ? of : worst;
        }
        if (error <= fmax(ABSOLUTE, RELATIVE * sum))
            break;
        const double low = worst->low, high = worst->high, middle = (low + high) / 2;
        *worst = measure(view, low, middle);
        all[count++] = measure(view, middle, high);
    }
    for (size_t bin = 0; bin < BINS_PHI; bin++)
        probability[bin] = 0;
    for (size_t i = 0; i < count; i++) {
        change += all[i].change;
        for (size_t bin = 0; bin < BINS_PHI; bin++)
            probability[bin] += all[i].value[bin];
    }
    return change;
}

double bins_integrate(const bin_map *map, const vndf_surface *surface, vndf_vec3 wi,
                      double probability[BINS_COUNT])
{
    view_of_bins view = {.map = map, .wi = wi};
    view.batch = (vndf_batch){.distribution = surface->distribution,
                              .shared = VNDF_SHARED_ALPHA | VNDF_SHARED_WI,
                              .alpha_x = &surface->alpha_x,
                              .alpha_y = &surface->alpha_y,
                              .wi_x = &view.wi.x,
                              .wi_y = &view.wi.y,
                              .wi_z = &view.wi.z};
    view.across = hypot(map->stretch_x * (double)wi.x, map->stretch_y * (double)wi.y);
    for (size_t bin = 0; bin < BINS_PHI; bin++)
        fill_turns(map, map->phi[bin], map->phi[bin + 1], view.whole[bin]);
    double change = 0;
    for (size_t ring = 0; ring < BINS_THETA; ring++)
        change += integrate_ring(&view, map->slope + ring, probability + ring * BINS_PHI);
    return ONE_ROUNDING * change;
}
