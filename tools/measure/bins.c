/* With L = |(sx m'x, sy m'y, m'z)|, m' a unit vector of the stretched hemisphere, dwm = sx sy / L^3 dm', and
 * dm' = sin(theta') dtheta' dphi'. Nothing in it is singular; but the lobe may have parts of very different width,
 * and tails that fall by a power so low that slopes of 1e20 count. So the slope R = tan(theta') stands for theta',
 * exact towards the pole and towards the horizon, and a bin is integrated over panels of two octaves of R, in
 * log R. Beyond them, R < 2^-64 and R > 2^100, the density of a table is smooth, and R or 1/R will do. */
#include "measure/bins.h"

#include <math.h>
#include <stdlib.h>

#include "cli/random.h"
#include "cli/sort.h"

static const double pi = 3.14159265358979323846;

/* ---- where the bins are -------------------------------------------------------------------------- */

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

/* ---- the density in these coordinates ------------------------------------------------------------ */

/* What stands for theta' in a panel: the slope itself at the pole, its reciprocal at the horizon. */
typedef enum chart { CHART_SLOPE, CHART_LOG_SLOPE, CHART_RECIPROCAL } chart;

typedef struct panel {
    const bin_map *map;
    const vndf_view *view;
    chart coordinate;
    double low, high;         /* in it */
    double phi_low, phi_high; /* of the bin */
    double sine, cosine;      /* of theta' of the row that is being integrated */
    long budget;              /* evaluations that the panel may still cost */
} panel;

/* A number and what it may be off because normals are floats. */
typedef struct estimate {
    double value, noise;
} estimate;

static void add(estimate *sum, estimate more, double weight)
{
    sum->value += weight * more.value;
    sum->noise += weight * more.noise;
}

/* What the rounding of wm may change wi.wm by, relative to it: a factor of every visible density. */
static double rounding(vndf_vec3 wi, vndf_vec3 wm)
{
    double x = (double)wi.x * (double)wm.x, y = (double)wi.y * (double)wm.y, z = (double)wi.z * (double)wm.z;
    return 0x1p-24 * (fabs(x) + fabs(y) + fabs(z)) / (fabs(x + y + z) + 0x1p-24);
}

static estimate density_at(double phi, const panel *at)
{
    const bin_map *map = at->map;
    double x = map->stretch_x * at->sine * cos(map->centre + phi);
    double y = map->stretch_y * at->sine * sin(map->centre + phi);
    double length = sqrt(x * x + y * y + at->cosine * at->cosine);
    vndf_vec3 wm = {(float)(x / length), (float)(y / length), (float)(at->cosine / length)};
    double jacobian = map->stretch_x * map->stretch_y / (length * length * length) * at->sine;
    double density = (double)vndf_pdf(at->view, wm) * jacobian;
    return (estimate){density, density * rounding(at->view->wi, wm)};
}

/* Goes to the row at a coordinate; dtheta' by that coordinate. */
static double enter_row(panel *at, double place)
{
    double slope = at->coordinate == CHART_LOG_SLOPE ? exp(place) : place;
    if (at->coordinate == CHART_RECIPROCAL) {
        at->sine = 1 / sqrt(1 + place * place);
        at->cosine = place * at->sine;
        return at->sine * at->sine;
    }
    at->cosine = 1 / sqrt(1 + slope * slope);
    at->sine = slope * at->cosine;
    return at->cosine * (at->coordinate == CHART_SLOPE ? at->cosine : at->sine);
}

/* ---- quadrature ---------------------------------------------------------------------------------- */

/* How often an interval is halved to find a jump. Azimuth: it is known to 2e-4 of the bin's width then, which no
 * test of 1e8 samples can see. Slope: to 3e-5, since all bins of a row may share a jump and its error. A panel
 * with a jump costs some 3e4 evaluations; the budget ends what is not a jump but noise. */
enum { NODES = 5, DEPTH_PHI = 12, DEPTH_SLOPE = 15, BUDGET = 1000000 };

/* Error of a panel: absolute, a tenth of what one of 1e9 samples weighs; relative, since a kink that all bins of a
 * ring share errs to one side in all of them; less for rows, which are judged by the differences between them. */
static const double ABSOLUTE = 1e-10, RELATIVE = 2e-6, ROW_RELATIVE = 1e-6;

/* Part of what the rounding of normals may amount to that is left alone: they do not all err to one side. */
static const double NOISE = 0.5;

/* A panel that holds more than this is halved at least once: all bins of a ring have the same law of slopes, and
 * where two rules agree by chance on a peak, they do so in all of them (4e-6 of the whole was seen). */
static const double SLIGHT = 1e-9;

/* Lobatto's rule of 5 points on [-1, 1], exact to degree 7. The end points are drawn in by 1e-7 of the
 * interval: the density there is that of this side of a border. */
static const double node[NODES] = {-0.9999999, -0.65465367070797714380, 0, 0.65465367070797714380, 0.9999999};
static const double weight[NODES] = {0.1, 49.0 / 90, 32.0 / 45, 49.0 / 90, 0.1};

/* What an interval may be wrong by. Halving it takes 1/sqrt(2) of the absolute error to each half, as
 * independent errors ask for, and lets the relative error of each grow likewise. (With 1/2, the roundings of
 * the float density, 1e-7 beside those of the normal, would be refined for ever.) */
typedef struct accuracy {
    double absolute, relative;
    int halvings; /* that are left */
} accuracy;

static accuracy of_half(accuracy whole)
{
    return (accuracy){whole.absolute * sqrt(0.5), whole.relative * sqrt(2), whole.halvings - 1};
}

static int agrees(estimate whole, estimate halves, accuracy wanted)
{
    double allowed = fmax(wanted.absolute, wanted.relative * fabs(halves.value));
    return wanted.halvings <= 0 || fabs(halves.value - whole.value) <= fmax(allowed, NOISE * halves.noise);
}

static estimate row_rule(panel *at, double low, double high)
{
    estimate sum = {0, 0};
    double middle = (low + high) / 2, half = (high - low) / 2;
    for (int i = 0; i < NODES; i++)
        add(&sum, density_at(middle + half * node[i], at), weight[i] * half);
    at->budget -= NODES;
    return sum;
}

static estimate row_adaptive(panel *at, double low, double high, estimate whole, accuracy wanted)
{
    double middle = (low + high) / 2;
    estimate left = row_rule(at, low, middle), right = row_rule(at, middle, high), halves = left;
    add(&halves, right, 1);
    if (at->budget <= 0 || agrees(whole, halves, wanted))
        return halves;
    wanted = of_half(wanted);
    halves = row_adaptive(at, low, middle, left, wanted);
    add(&halves, row_adaptive(at, middle, high, right, wanted), 1);
    return halves;
}

/* The azimuth beyond which the normals of the row are turned away: wi.wm ~ across cos(phi') + along.
 * 0 if all are, pi if none. */
static double horizon(const panel *at)
{
    vndf_vec3 wi = at->view->wi;
    double across = hypot(at->map->stretch_x * (double)wi.x, at->map->stretch_y * (double)wi.y) * at->sine;
    double along = (double)wi.z * at->cosine;
    return fabs(along) < across ? acos(-along / across) : along > 0 ? pi : 0;
}

/* The integral over phi' of one row; *measure: what it counts by, per unit of the panel's coordinate. It is cut
 * where every density has an edge, at the horizon of wi, and where a table's has one, at right angles to wi. */
static estimate integrate_row(panel *at, double place, double *measure)
{
    *measure = enter_row(at, place);
    const accuracy wanted = {0.2 * ABSOLUTE / (at->high - at->low) / *measure, ROW_RELATIVE, DEPTH_PHI};
    double edge = horizon(at), inner = fmin(edge, pi / 2), outer = fmax(edge, pi / 2), low = at->phi_low;
    const double cut[] = {-outer, -inner, inner, outer, at->phi_high};
    estimate sum = {0, 0};
    for (int i = 0; i < 5; i++) {
        double high = fmin(cut[i], at->phi_high);
        if (!(high > low))
            continue;
        if (fabs(low + high) / 2 < edge)
            add(&sum, row_adaptive(at, low, high, row_rule(at, low, high), wanted), 1);
        low = high;
    }
    return sum;
}

static estimate panel_rule(panel *at, double low, double high)
{
    estimate sum = {0, 0};
    double measure, middle = (low + high) / 2, half = (high - low) / 2;
    for (int i = 0; i < NODES; i++) {
        estimate row = integrate_row(at, middle + half * node[i], &measure);
        add(&sum, row, weight[i] * half * measure);
    }
    return sum;
}

static estimate panel_adaptive(panel *at, double low, double high, estimate whole, accuracy wanted)
{
    double middle = (low + high) / 2;
    estimate left = panel_rule(at, low, middle), right = panel_rule(at, middle, high), halves = left;
    add(&halves, right, 1);
    int doubtful = wanted.halvings == DEPTH_SLOPE && fabs(halves.value) > SLIGHT;
    if (at->budget <= 0 || (!doubtful && agrees(whole, halves, wanted)))
        return halves;
    wanted = of_half(wanted);
    halves = panel_adaptive(at, low, middle, left, wanted);
    add(&halves, panel_adaptive(at, middle, high, right, wanted), 1);
    return halves;
}

/* ---- panels -------------------------------------------------------------------------------------- */

/* Panel i lies between slopes 4^(i - 1) and 4^i; the first begins at 0, the last ends at infinity. */
enum { PANEL_FIRST = -32, PANEL_LAST = 51 };

/* The part of panel i between two slopes; none of it: low >= high. */
static panel panel_between(const bin_map *map, const vndf_view *view, int i, double low, double high)
{
    panel made = {.map = map, .view = view, .coordinate = CHART_LOG_SLOPE, .budget = BUDGET};
    double from = i == PANEL_FIRST ? 0 : ldexp(1, 2 * (i - 1)), to = i == PANEL_LAST ? HUGE_VAL : ldexp(1, 2 * i);
    from = fmax(from, low);
    to = fmin(to, high);
    if (i == PANEL_FIRST)
        made.coordinate = CHART_SLOPE;
    if (i == PANEL_LAST)
        made.coordinate = CHART_RECIPROCAL;
    made.low = i == PANEL_FIRST ? from : i == PANEL_LAST ? 1 / to : log(from);
    made.high = i == PANEL_FIRST ? to : i == PANEL_LAST ? 1 / from : log(to);
    return made;
}

static double integrate_bin(const bin_map *map, const vndf_view *view, size_t bin)
{
    const double *slope = map->slope + bin / BINS_PHI, *phi = map->phi + bin % BINS_PHI;
    const accuracy wanted = {ABSOLUTE, RELATIVE, DEPTH_SLOPE};
    double sum = 0;
    for (int i = PANEL_FIRST; i <= PANEL_LAST; i++) {
        panel at = panel_between(map, view, i, slope[0], slope[1]);
        at.phi_low = phi[0];
        at.phi_high = phi[1];
        if (at.low < at.high)
            sum += panel_adaptive(&at, at.low, at.high, panel_rule(&at, at.low, at.high), wanted).value;
    }
    return sum;
}

void bins_integrate(const bin_map *map, const vndf_view *view, double probability[BINS_COUNT])
{
    for (size_t bin = 0; bin < BINS_COUNT; bin++)
        probability[bin] = integrate_bin(map, view, bin);
}
