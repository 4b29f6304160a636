/* The integral of the density over each bin. With L = |(sx m'x, sy m'y, m'z)|, m' a unit vector of the stretched
 * hemisphere, dwm = sx sy / L^3 dm', and dm' = sin(theta') dtheta' dphi'. Nothing in it is singular; but the
 * lobe may have parts of very different width, and tails that fall by a power so low that slopes of 1e20 count.
 * So the slope R = tan(theta') stands for theta', exact towards the pole and towards the horizon, and a bin is
 * integrated over panels of two octaves of R, in log R. Beyond them, R < 2^-64 and R > 2^100, the density of a
 * table is smooth, and R or 1/R will do.
 *
 * The cells of a table have their borders at constant slope. A part of a panel is halved in slope or in azimuth,
 * whichever the density changes more in. The horizon of wi, where every density ends, is neither: it is a
 * function of the azimuth, and the slopes of a panel are counted from it where it crosses the panel. */
#include "evidence/measure/bins.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* ---- panels -------------------------------------------------------------------------------------- */

/* What stands for theta' in a panel. */
typedef enum chart { CHART_SLOPE, CHART_LOG_SLOPE, CHART_RECIPROCAL } chart;

typedef struct view_of_bins {
    const bin_map *map;
    vndf_batch batch; /* of one view; it is given its count when it is asked */
    vndf_vec3 wi;
    double across; /* wi.wm ~ across cos(phi') sin(theta') + wi.z cos(theta') */
} view_of_bins;

/* Slopes times azimuths in which the horizon is a border of all slopes or of none. */
typedef struct panel {
    const view_of_bins *view;
    chart coordinate;
    double low, high; /* in it, before the horizon cuts it */
    double phi_low, phi_high;
    int is_cut;
    long budget; /* evaluations that it may still cost */
} panel;

static double place_of(chart coordinate, double slope)
{
    return coordinate == CHART_SLOPE ? slope : coordinate == CHART_RECIPROCAL ? 1 / slope : log(slope);
}

/* Of the horizon at an azimuth where there is one; positive then. */
static double horizon_slope(const view_of_bins *view, double phi)
{
    return -(double)view->wi.z / (view->across * cos(phi));
}

/* The azimuth beyond which the normals of a slope are turned away: 0 if all are, pi if none. */
static double horizon_phi(const view_of_bins *view, double slope)
{
    double cosine = 1 / sqrt(1 + slope * slope), sine = slope < 1e100 ? slope * cosine : 1;
    double across = view->across * sine, along = (double)view->wi.z * cosine;
    return fabs(along) < across ? acos(-along / across) : along > 0 ? pi : 0;
}

/* ---- the density at the nodes of a part ----------------------------------------------------------- */

/* Lobatto's 4 nodes on [-1, 1], exact to degree 5, among the 7 of Kronrod's extension, exact to degree 9 (Gander
 * and Gautschi, Adaptive Quadrature - Revisited, 2000). The end points are drawn in by 1e-7 of the interval: the
 * density there is that of this side of a border. */
enum { NODES = 7, POINTS = NODES * NODES };
static const double node[NODES] = {-0.9999999, -0.81649658092772603, -0.44721359549995794,
                                   0,          0.44721359549995794,  0.81649658092772603,
                                   0.9999999};
static const double kronrod[NODES] = {77.0 / 1470,  432.0 / 1470, 625.0 / 1470, 672.0 / 1470,
                                      625.0 / 1470, 432.0 / 1470, 77.0 / 1470};
static const double lobatto[NODES] = {1.0 / 6, 0, 5.0 / 6, 0, 5.0 / 6, 0, 1.0 / 6};

/* Part of a panel: of its slopes, in [0, 1] of what the horizon leaves, and of its azimuths. */
typedef struct part {
    double from, to, phi_low, phi_high;
    int slope_halvings, phi_halvings; /* that are left */
} part;

typedef struct place {
    double sine, cosine, measure; /* of theta'; dtheta' by the coordinate */
} place;

static place place_at(chart coordinate, double x)
{
    double slope = coordinate == CHART_LOG_SLOPE ? exp(x) : x, length = 1 / sqrt(1 + slope * slope);
    if (coordinate == CHART_RECIPROCAL)
        return (place){length, x * length, length * length};
    place at = {slope * length, length, length * length};
    at.measure *= coordinate == CHART_SLOPE ? 1 : slope;
    return at;
}

/* The places of a part at one azimuth. */
static void find_places(const panel *of, const part *p, double phi, place at[NODES])
{
    double low = of->low, high = of->high;
    if (of->is_cut) {
        double edge = fmin(fmax(place_of(of->coordinate, horizon_slope(of->view, phi)), low), high);
        int upper_is_seen = (cos(phi) > 0) != (of->coordinate == CHART_RECIPROCAL);
        low = upper_is_seen ? edge : low;
        high = upper_is_seen ? high : edge;
    }
    double middle = (p->from + p->to) / 2, half = (p->to - p->from) / 2;
    for (int i = 0; i < NODES; i++) {
        at[i] = place_at(of->coordinate, low + (high - low) * (middle + half * node[i]));
        at[i].measure *= (high - low) * half;
    }
}

/* The normals of two parts at most, and what one unit of density there adds to the integral, before the weight
 * of its node. */
typedef struct points {
    float x[2 * POINTS], y[2 * POINTS], z[2 * POINTS], density[2 * POINTS];
    double share[2 * POINTS];
    size_t count;
} points;

static void add_point(points *to, const bin_map *map, const place *at, double cosine, double sine, double share)
{
    double x = map->stretch_x * at->sine * cosine, y = map->stretch_y * at->sine * sine;
    double per = 1 / sqrt(x * x + y * y + at->cosine * at->cosine);
    size_t n = to->count++;
    to->x[n] = (float)(x * per);
    to->y[n] = (float)(y * per);
    to->z[n] = (float)(at->cosine * per);
    to->share[n] = map->stretch_x * map->stretch_y * (per * per * per) * at->sine * at->measure * share;
}

static void add_points(points *to, const panel *of, const part *p)
{
    const bin_map *map = of->view->map;
    double middle = (p->phi_low + p->phi_high) / 2, half = (p->phi_high - p->phi_low) / 2;
    place at[NODES];
    for (int j = 0; j < NODES; j++) {
        double phi = middle + half * node[j], cosine = cos(map->centre + phi), sine = sin(map->centre + phi);
        if (j == 0 || of->is_cut)
            find_places(of, p, phi, at);
        for (int i = 0; i < NODES; i++)
            add_point(to, map, &at[i], cosine, sine, half);
    }
}

static void ask(points *at, const view_of_bins *view)
{
    vndf_batch batch = view->batch;
    batch.count = at->count;
    vndf_pdf_n(&batch, (vndf_normals){at->x, at->y, at->z}, at->density);
}

/* ---- quadrature ---------------------------------------------------------------------------------- */

/* A number, what it may be off because normals are floats, and how far it is from what Lobatto's nodes alone give,
 * in slope and in azimuth. */
typedef struct estimate {
    double value, noise, by_slope, by_phi;
} estimate;

/* What the rounding of wm may change wi.wm by, relative to it: a factor of every visible density. */
static double rounding(vndf_vec3 wi, double nx, double ny, double nz)
{
    double x = (double)wi.x * nx, y = (double)wi.y * ny, z = (double)wi.z * nz;
    return 0x1p-24 * (fabs(x) + fabs(y) + fabs(z)) / (fabs(x + y + z) + 0x1p-24);
}

/* Of the part whose points begin at `first`. */
static estimate sum_up(const points *of, size_t first, vndf_vec3 wi)
{
    double both = 0, noise = 0, few_slopes = 0, few_turns = 0;
    for (size_t j = 0; j < NODES; j++) {
        for (size_t i = 0; i < NODES; i++) {
            size_t n = first + j * NODES + i;
            double value = (double)of->density[n] * of->share[n], weighted = value * kronrod[i] * kronrod[j];
            both += weighted;
            noise += weighted * rounding(wi, (double)of->x[n], (double)of->y[n], (double)of->z[n]);
            few_slopes += value * lobatto[i] * kronrod[j];
            few_turns += value * kronrod[i] * lobatto[j];
        }
    }
    return (estimate){both, noise, fabs(few_slopes - both), fabs(few_turns - both)};
}

/* How often a part is halved to find a jump. Azimuth: it is known to 2e-4 of the bin's width then, which no test
 * of 1e8 samples can see. Slope: to 3e-5, since all bins of a ring may share a jump and its error. Where slopes
 * are counted from the horizon, a jump at one slope runs across the parts, and each halving doubles the parts
 * that it crosses: it is known to 5e-4 there. The budget ends what is not a jump but noise. */
enum { HALVINGS_PHI = 12, HALVINGS_SLOPE = 15, HALVINGS_CUT = 11, BUDGET = 1000000 };

/* How far the two rules may be apart; the better one is much closer to the integral. ABSOLUTE is a twentieth of
 * the weight of one of 1e9 samples; RELATIVE is small, since a kink errs to one side in all bins of a ring. */
static const double ABSOLUTE = 5e-11, RELATIVE = 1e-6;

/* Part of what the rounding of normals may amount to that is left alone: they do not all err to one side. */
static const double NOISE = 0.5;

/* How far apart its rules may be. Halving it takes 1/sqrt(2) of the absolute error to each half, as
 * independent errors ask for, and lets the relative error of each grow likewise. (With 1/2, the roundings of
 * the float density, 1e-7 beside those of the normal, would be refined for ever.) */
typedef struct accuracy {
    double absolute, relative;
} accuracy;

static accuracy of_half(accuracy whole)
{
    return (accuracy){whole.absolute * sqrt(0.5), whole.relative * sqrt(2)};
}

static double allowed(estimate found, accuracy wanted)
{
    return fmax(fmax(wanted.absolute, wanted.relative * fabs(found.value)), NOISE * found.noise);
}

/* What to do with a part: what has been halved to the end holds a jump, which halving the other way would not
 * mend. */
enum { GOOD, HALVE_SLOPE, HALVE_PHI };

static int next_step(const part *p, estimate found, double error)
{
    if (found.by_slope <= error && found.by_phi <= error)
        return GOOD;
    if (found.by_phi > found.by_slope)
        return p->phi_halvings > 0 ? HALVE_PHI : GOOD;
    return p->slope_halvings > 0 ? HALVE_SLOPE : GOOD;
}

static void halve(const part *p, int step, part half[2])
{
    double middle = (p->from + p->to) / 2, phi = (p->phi_low + p->phi_high) / 2;
    half[0] = half[1] = *p;
    if (step == HALVE_SLOPE) {
        half[0].to = half[1].from = middle;
        half[0].slope_halvings = half[1].slope_halvings = p->slope_halvings - 1;
    } else {
        half[0].phi_high = half[1].phi_low = phi;
        half[0].phi_halvings = half[1].phi_halvings = p->phi_halvings - 1;
    }
}

static double refine(panel *of, const part *p, int step, accuracy wanted)
{
    part half[2];
    points at;
    double sum = 0;
    at.count = 0;
    halve(p, step, half);
    add_points(&at, of, &half[0]);
    add_points(&at, of, &half[1]);
    ask(&at, of->view);
    of->budget -= 2 * POINTS;
    wanted = of_half(wanted);
    for (size_t i = 0; i < 2; i++) {
        estimate found = sum_up(&at, i * POINTS, of->view->wi);
        step = of->budget > 0 ? next_step(&half[i], found, allowed(found, wanted)) : GOOD;
        sum += step == GOOD ? found.value : refine(of, &half[i], step, wanted);
    }
    return sum;
}

static double integrate_panel(panel *of)
{
    const accuracy wanted = {ABSOLUTE, RELATIVE};
    part whole = {0, 1, of->phi_low, of->phi_high, HALVINGS_SLOPE, HALVINGS_PHI};
    if (of->is_cut)
        whole.slope_halvings = whole.phi_halvings = HALVINGS_CUT;
    points at;
    at.count = 0;
    add_points(&at, of, &whole);
    ask(&at, of->view);
    of->budget -= POINTS;
    estimate found = sum_up(&at, 0, of->view->wi);
    int step = next_step(&whole, found, allowed(found, wanted));
    return step == GOOD ? found.value : refine(of, &whole, step, wanted);
}

/* ---- bins ---------------------------------------------------------------------------------------- */

/* Slopes between which panels span a factor of 4; one lies before them, one behind. */
static const double FIRST_BORDER = 0x1p-64, LAST_BORDER = 0x1p100;

/* Slopes of one bin in one panel, and the azimuths from `low` to `high`, between which the horizon does not
 * enter or leave these slopes. */
static double integrate_between(panel of, double from, double to, double low, double high)
{
    double middle = (low + high) / 2, edge = horizon_slope(of.view, middle);
    int is_seen = cos(middle) > 0 ? !(edge >= to) : of.view->wi.z > 0 && !(edge <= from);
    if (!is_seen)
        return 0;
    of.is_cut = edge > from && edge < to;
    of.phi_low = low;
    of.phi_high = high;
    return integrate_panel(&of);
}

/* The azimuths of a bin are cut where the horizon enters or leaves its slopes, and at right angles to wi, where
 * every table's density has an edge. */
static double integrate_slopes(panel of, double from, double to, const double phi[2])
{
    double a = horizon_phi(of.view, from), b = horizon_phi(of.view, to), sum = 0, low = phi[0];
    double turn[] = {fmin(a, b), fmax(a, b), pi / 2};
    double first = fmin(turn[0], turn[2]), last = fmax(turn[1], turn[2]);
    double between = fmax(turn[0], fmin(turn[1], turn[2]));
    const double cut[] = {-last, -between, -first, first, between, last, phi[1]};
    for (size_t i = 0; i < sizeof cut / sizeof *cut; i++) {
        double high = fmin(cut[i], phi[1]);
        if (high > low) {
            sum += integrate_between(of, from, to, low, high);
            low = high;
        }
    }
    return sum;
}

static panel panel_at(const view_of_bins *view, chart coordinate, double from, double to)
{
    double a = place_of(coordinate, from), b = place_of(coordinate, to);
    return (panel){
        .view = view, .coordinate = coordinate, .low = fmin(a, b), .high = fmax(a, b), .budget = BUDGET};
}

static double integrate_bin(const view_of_bins *view, size_t bin)
{
    const double *slope = view->map->slope + bin / BINS_PHI, *phi = view->map->phi + bin % BINS_PHI;
    double sum = 0, border = 0, next = FIRST_BORDER;
    while (border < slope[1]) {
        double from = fmax(border, slope[0]), to = fmin(next, slope[1]);
        chart coordinate = border == 0 ? CHART_SLOPE : next == HUGE_VAL ? CHART_RECIPROCAL : CHART_LOG_SLOPE;
        if (from < to)
            sum += integrate_slopes(panel_at(view, coordinate, from, to), from, to, phi);
        border = next;
        next = border < LAST_BORDER ? 4 * border : HUGE_VAL;
    }
    return sum;
}

void bins_integrate(const bin_map *map, const vndf_surface *surface, vndf_vec3 wi, double probability[BINS_COUNT])
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
    for (size_t bin = 0; bin < BINS_COUNT; bin++)
        probability[bin] = integrate_bin(&view, bin);
}
