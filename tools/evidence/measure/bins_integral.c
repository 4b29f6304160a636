/* The integral of the density over each bin. With L = |(sx m'x, sy m'y, m'z)|, m' a unit vector of the stretched
 * hemisphere, dwm = sx sy / L^3 dm', and dm' = sin(theta') dtheta' dphi'. Nothing in it is singular; but the lobe
 * may have parts of very different width, and tails that fall by a power so low that slopes of 1e20 count.
 *
 * D is isotropic, so all that is steep in a density lies at a constant stretched slope R = tan(theta'): the
 * borders of a table's cells, jumps and rings. Along the azimuth it is smooth but for the horizon of wi, and for
 * the right angle to wi where the law of a table has an edge. So at one slope all bins of a ring are integrated
 * over their azimuths by Gauss' rule, cut at these places, which are known; and over the slopes all of them
 * together, adaptively: the panel whose two rules differ most is halved next. (A quadrature in two dimensions for
 * each bin chases the roundings of a narrow ring for minutes.)
 *
 * A panel is an interval of log R that spans a factor of 4 at first. Beyond R < 2^-64 and R > 2^100 the density of
 * a table is smooth, and R or 1/R will do. */
#include "evidence/measure/bins.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

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

/* ---- one slope ----------------------------------------------------------------------------------- */

static void fill_turns(const bin_map *map, double low, double high, turn to[TURNS])
{
    double middle = map->centre + (low + high) / 2, half = (high - low) / 2;
    for (int i = 0; i < TURNS; i++) {
        double phi = middle + half * gauss[i];
        to[i] = (turn){cos(phi), sin(phi), half * gauss_weight[i]};
    }
}

/* What stands for theta' in a panel. */
typedef enum chart { CHART_SLOPE, CHART_LOG_SLOPE, CHART_RECIPROCAL } chart;

static double place_of(chart coordinate, double slope)
{
    return coordinate == CHART_SLOPE ? slope : coordinate == CHART_RECIPROCAL ? 1 / slope : log(slope);
}

typedef struct place {
    double sine, cosine, measure; /* of theta'; dtheta' by the coordinate */
} place;

static place place_at(chart coordinate, double x)
{
    double slope = coordinate == CHART_LOG_SLOPE ? exp(x) : x, length = 1 / sqrt(1 + slope * slope);
    if (coordinate == CHART_RECIPROCAL)
        return (place){length, x * length, length * length};
    return (place){slope * length, length, length * length * (coordinate == CHART_SLOPE ? 1 : slope)};
}

/* The azimuth beyond which the normals of a slope are turned away: 0 if all are, pi if none. */
static double horizon_of(const view_of_bins *view, const place *at)
{
    double across = view->across * at->sine, along = (double)view->wi.z * at->cosine;
    return fabs(along) < across ? acos(-along / across) : along > 0 ? pi : 0;
}

/* The normals of a slope, and what one unit of density there adds to the bin of each. */
typedef struct points {
    float x[POINTS], y[POINTS], z[POINTS], density[POINTS];
    double share[POINTS];
    size_t bin[POINTS], count;
} points;

static void add_points(points *to, const bin_map *map, const place *at, const turn *turns, size_t bin)
{
    for (int i = 0; i < TURNS; i++) {
        double x = map->stretch_x * at->sine * turns[i].cosine, y = map->stretch_y * at->sine * turns[i].sine;
        double per = 1 / sqrt(x * x + y * y + at->cosine * at->cosine);
        size_t n = to->count++;
        to->x[n] = (float)(x * per);
        to->y[n] = (float)(y * per);
        to->z[n] = (float)(at->cosine * per);
        to->share[n] =
            map->stretch_x * map->stretch_y * (per * per * per) * at->sine * at->measure * turns[i].weight;
        to->bin[n] = bin;
    }
}

/* The integrals over the azimuths of all bins of a ring at one slope. */
static void integrate_turns(const view_of_bins *view, const place *at, double to[BINS_PHI])
{
    const bin_map *map = view->map;
    double horizon = horizon_of(view, at), first = fmin(horizon, pi / 2), last = fmax(horizon, pi / 2);
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
                add_points(&of, map, at, is_whole ? view->whole[bin] : part, bin);
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

/* An interval of slopes, the integrals of all bins over it, and the sum of how far its two rules are apart. */
typedef struct panel {
    chart coordinate;
    double low, high; /* in it */
    double value[BINS_PHI], sum, error;
    double change; /* from node to node, of the mass per log R */
} panel;

/* A normal is rounded by this part of its slope, and its density is that of a normal this far away (promise 2 of the
 * library): the integral of what that adds is at most the change of the mass per log R, times this. */
static const double ONE_ROUNDING = 0x1p-23;

/* What is so narrow is left alone: normals are floats, which do not tell its slopes apart. */
static const double narrowest = 0x1p-23;

static void measure(const view_of_bins *view, panel *of)
{
    double middle = (of->low + of->high) / 2, half = (of->high - of->low) / 2;
    double at_slope[BINS_PHI], few[BINS_PHI] = {0};
    double before = 0;
    for (size_t bin = 0; bin < BINS_PHI; bin++)
        of->value[bin] = 0;
    of->change = 0;
    for (int i = 0; i < NODES; i++) {
        double x = middle + half * node[i], sum = 0;
        place at = place_at(of->coordinate, x);
        integrate_turns(view, &at, at_slope);
        for (size_t bin = 0; bin < BINS_PHI; bin++)
            sum += at_slope[bin] * (of->coordinate == CHART_LOG_SLOPE ? 1 : x);
        of->change += i > 0 ? fabs(sum - before) : 0;
        before = sum;
        for (size_t bin = 0; bin < BINS_PHI; bin++) {
            of->value[bin] += half * kronrod[i] * at_slope[bin];
            few[bin] += half * lobatto[i] * at_slope[bin];
        }
    }
    of->sum = of->error = 0;
    for (size_t bin = 0; bin < BINS_PHI; bin++) {
        of->sum += of->value[bin];
        of->error += fabs(few[bin] - of->value[bin]);
    }
    if (of->coordinate == CHART_LOG_SLOPE && of->high - of->low < narrowest)
        of->error = 0;
}

/* A ring is good when the rules of its panels are so far apart in all, relative to its integral or absolutely (the
 * better rule is much closer to it). PANELS_MAX ends what is not a jump but noise. */
static const double RELATIVE = 1e-6, ABSOLUTE = 1e-10;
enum { PANELS_MAX = 400 };

/* Slopes between which panels span a factor of 4; one lies before them, one behind. */
static const double FIRST_BORDER = 0x1p-64, LAST_BORDER = 0x1p100;

/* Panels between the slopes of a ring, cut where the horizon enters. Returns their number. */
static size_t first_panels(const view_of_bins *view, const double slope[2], panel *to)
{
    double enters = fabs((double)view->wi.z) / view->across, border = 0, next = FIRST_BORDER;
    size_t count = 0;
    while (border < slope[1]) {
        double from = fmax(border, slope[0]), end = fmin(next, slope[1]);
        chart coordinate = border == 0 ? CHART_SLOPE : next == HUGE_VAL ? CHART_RECIPROCAL : CHART_LOG_SLOPE;
        while (from < end) {
            double high = enters > from && enters < end ? enters : end;
            double a = place_of(coordinate, from), b = place_of(coordinate, high);
            to[count] = (panel){.coordinate = coordinate, .low = fmin(a, b), .high = fmax(a, b)};
            measure(view, &to[count++]);
            from = high;
        }
        border = next;
        next = border < LAST_BORDER ? 4 * border : HUGE_VAL;
    }
    return count;
}

/* Returns how much the mass per log R changes on the way. */
static double integrate_ring(const view_of_bins *view, const double slope[2], double probability[BINS_PHI])
{
    panel all[PANELS_MAX];
    size_t count = first_panels(view, slope, all);
    for (;;) {
        double sum = 0, error = 0;
        size_t worst = 0;
        for (size_t i = 0; i < count; i++) {
            sum += all[i].sum;
            error += all[i].error;
            worst = all[i].error > all[worst].error ? i : worst;
        }
        if (error <= fmax(ABSOLUTE, RELATIVE * sum) || count == PANELS_MAX)
            break;
        all[count] = all[worst];
        all[worst].high = all[count].low = (all[worst].low + all[worst].high) / 2;
        measure(view, &all[worst]);
        measure(view, &all[count++]);
    }
    double change = 0;
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
