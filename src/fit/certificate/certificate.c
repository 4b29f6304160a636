/* The claims about a table: the worst over directions; and the worst error of D and of the area, in all cells. */
#include "fit/certificate/certificate.h"

#include <math.h>

#include "fit/certificate/validate.h"
#include "sampler/surface.h"
#include "sampler/tabulated/theory.h"

static const double PI = 3.14159265358979323846;

/* The slope at an even place inside a cell. */
enum { PLACES = 24 };
static double slope_at(const vndf_validation *v, size_t place)
{
    return vndf_validation_slope(v->table, (uint32_t)(place / (PLACES - 1)), 1 + (uint32_t)(place % (PLACES - 1)),
                                 PLACES);
}

/* The first place that has more than `end` of the mass before it, or the first beyond which there is no more. */
static size_t place_of_mass(const vndf_validation *v, double end, int beyond)
{
    size_t low = 0, high = v->table->radial_count * (size_t)(PLACES - 1);
    while (low < high) {
        size_t middle = (low + high) / 2;
        double r = slope_at(v, middle);
        int more =
            (beyond ? vndf_profile_moments(v->profile, r, HUGE_VAL) : vndf_profile_moments(v->profile, 0, r)).m0 >
            end;
        if (more == beyond)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Relative error of D at a slope, 0 where next to nothing is. */
static double ndf_miss(const vndf_validation *v, double r)
{
    const vndf_profile *p = v->profile;
    double z = 1 / (1 + r), reference = vndf_profile_p22(p, r);
    if (!(reference * r * r > 1e-6 * p->f0))
        return 0.0;
    return fabs(vndf_engine_p22_over_z4(v->table, r * z, z) * z * z * z * z / reference - 1);
}

/* The largest over the slopes that hold all but VNDF_VALIDATION_LEFT_OUT of the mass, at even places of every cell. */
static double ndf_error(const vndf_validation *v)
{
    double worst = 0.0, left_out = VNDF_VALIDATION_LEFT_OUT / 2 * v->profile->f0;
    size_t end = place_of_mass(v, left_out, 1);
    for (size_t i = place_of_mass(v, left_out, 0); i < end; i++)
        worst = fmax(worst, ndf_miss(v, slope_at(v, i)));
    return worst;
}

/* ---- directions ----
 *
 * Over the angle of incidence the total variation has as many maxima as the table has parts: between the knots of
 * azimuth rows, where a quadratic misses a cubic; as the cut passes through a radial cell; and where the last part
 * that is claimed is visible. The certificate measures there and in some fixed directions, and then again between
 * the two neighbours that promise most. The largest weight has narrower maxima, where the azimuths that see
 * anything end: at a disc, some hundredths of the distance between two knots. So it is foreseen, which costs little,
 * at many places between all knots, and measured at the largest maxima. */

/* Angles of incidence at alpha 1, degrees, and tangents of elevation at canonical scale. */
static const double ANGLES[] = {0,  10,   20, 30, 40,  50,  60,  70,  80,  85,  89, 89.9,
                                90, 90.1, 91, 95, 100, 110, 120, 130, 150, 170, 179};
static const double ELEVATIONS[] = {30, 10, 5, 3, 2, 1.5, 1.2, 1, 0.8, 0.6, 0.4, 0.3, 0.2, 0.1, 0.03};

/* Where a quadratic through both ends and the middle of a span misses a cubic most. */
static const double ROW_PEAKS[] = {0.21, 0.79};

/* The visible part there, as powers of the claimed part: compact supports end within a small part of a degree. */
static const double LEVELS[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.96, 0.99, 0.999};

enum {
    ANGLE_COUNT = sizeof ANGLES / sizeof *ANGLES,
    ELEVATION_COUNT = sizeof ELEVATIONS / sizeof *ELEVATIONS,
    PEAK_COUNT = sizeof ROW_PEAKS / sizeof *ROW_PEAKS,
    LEVEL_COUNT = sizeof LEVELS / sizeof *LEVELS,
    SPANS_MOST = 40, /* of rows on a side, and of radial cells */
    PEAKS = 4,       /* of the weight, on a side */
    BETWEEN = 44,
    DIRECTIONS_MOST = ANGLE_COUNT + 2 * ELEVATION_COUNT + 2 * PEAK_COUNT * SPANS_MOST + SPANS_MOST + LEVEL_COUNT +
                      2 * PEAKS + BETWEEN
};

typedef struct direction {
    double angle; /* of incidence at canonical scale, in [0, pi] */
    vndf_finding found;
} direction;

typedef struct circle {
    direction at[DIRECTIONS_MOST]; /* ascending */
    int count;
} circle;

/* How many directions are looked at. */
typedef struct survey {
    int first, angles; /* the first of ANGLES, and every so many */
    int elevations;    /* every so many of ELEVATIONS */
    uint32_t spans;    /* of rows on a side, and of radial cells: if there are more, every second, third ... */
    uint32_t places;   /* between two knots, where the weight is foreseen */
    int peaks;         /* of the weight, on a side */
    int thirds;        /* that are cut off a peak */
    int between;       /* directions between two others, */
    int weighed;       /* every so many by the weight */
} survey;

static const survey FULL = {0, 1, 1, SPANS_MOST, 8, PEAKS, 6, BETWEEN, 11}, QUICK = {1, 2, 3, 12, 4, 3, 4, 16, 2};

static void add_direction(circle *all, vndf_validation *v, double s, double c)
{
    double length = hypot(s, c);
    int i = all->count++;
    direction made = {atan2(s, c), vndf_validation_direction(v, s / length, c / length)};
    for (; i > 0 && all->at[i - 1].angle > made.angle; i--)
        all->at[i] = all->at[i - 1];
    all->at[i] = made;
}

static void add_grid(circle *all, vndf_validation *v, const survey *s)
{
    for (int i = s->first; i < ANGLE_COUNT; i += s->angles) {
        double theta = ANGLES[i] * PI / 180;
        add_direction(all, v, sin(theta) * v->profile->scale, ANGLES[i] == 90 ? 0 : cos(theta));
    }
    for (int i = 0; i < 2 * ELEVATION_COUNT; i += s->elevations)
        add_direction(all, v, 1, ELEVATIONS[i / 2] * (i % 2 ? -1 : 1));
}

/* The direction with the coordinate y of a side. */
static void add_side(circle *all, vndf_validation *v, const vndf_wedge *side, double y)
{
    int above = side == &v->table->above;
    add_direction(all, v, above ? 1 - y : y, above ? y : y - 1);
}

/* Between the knots of a side's azimuth rows. */
static void add_rows(circle *all, vndf_validation *v, const vndf_wedge *side, uint32_t most)
{
    uint32_t spans = side->row_count / 2, step = (spans + most - 1) / most;
    for (uint32_t i = 0; i < spans; i += step)
        for (int n = 0; n < PEAK_COUNT; n++)
            add_side(all, v, side, side->row_y[i] + ROW_PEAKS[n] * ((double)side->row_y[i + 1] - side->row_y[i]));
}

/* Cuts in the radial cells, as long as something beyond the cut is claimed. */
static void add_cuts(circle *all, vndf_validation *v, uint32_t most)
{
    const vndf_distribution *d = v->table;
    uint32_t last = 0;
    while (last + 1 < d->radial_count && vndf_profile_s(v->profile, vndf_validation_slope(d, last + 1, 0, 1)) >
                                             vndf_profile_claimed(v->profile) * v->profile->f1)
        last++;
    uint32_t step = last / most + 1;
    for (uint32_t j = 0; j <= last; j += step)
        add_direction(all, v, 1, -vndf_validation_slope(d, j, 1, 3));
}

/* The part of the area at grazing incidence that is visible; from the table it costs nothing. */
static double seen_from(const vndf_validation *v, double angle, int by_table)
{
    double s = sin(angle), c = cos(angle);
    return by_table ? vndf_unit_area(v->table, s, c) / (2 * v->profile->f1) : vndf_profile_seen(v->profile, s, c);
}

/* The area falls from 90 to 180 degrees. */
static void add_levels(circle *all, vndf_validation *v, int by_table)
{
    for (int i = 0; i < LEVEL_COUNT; i++) {
        double low = PI / 2, high = PI, level = pow(vndf_profile_claimed(v->profile), LEVELS[i]);
        for (int step = 0; step < 40 && !vndf_guard_stopped(v->profile->guard); step++) {
            double angle = (low + high) / 2;
            if (seen_from(v, angle, by_table) > level)
                low = angle;
            else
                high = angle;
        }
        add_direction(all, v, sin(low), cos(low));
    }
}

/* A maximum of the foreseen weight between two places of a side. */
typedef struct peak {
    double from, to, weight;
} peak;

static double foreseen(vndf_validation *v, const vndf_wedge *side, double y)
{
    int above = side == &v->table->above;
    return vndf_validation_foreseen(v, above ? 1 - y : y, above ? y : y - 1);
}

/* Keeps the largest, in descending order. */
static void keep_peak(peak *largest, peak found)
{
    for (int i = 0; i < PEAKS; i++)
        if (found.weight > largest[i].weight) {
            peak smaller = largest[i];
            largest[i] = found;
            found = smaller;
        }
}

/* A place of a side, and the weight foreseen there. */
typedef struct seen {
    double y, weight;
} seen;

/* The i-th of even places between all knots of a side's rows; past the last one its end. */
static seen seen_at(vndf_validation *v, const vndf_wedge *side, uint32_t i, uint32_t places)
{
    uint32_t span = i / places;
    if (span == side->row_count / 2)
        return (seen){side->row_y[span], 0.0};
    double y0 = side->row_y[span], y = y0 + (side->row_y[span + 1] - y0) * (i % places + 0.5) / places;
    return (seen){y, foreseen(v, side, y)};
}

static void find_peaks(vndf_validation *v, const vndf_wedge *side, uint32_t places, peak *largest)
{
    seen before = {side->row_y[0], 0.0}, here = before;
    for (uint32_t i = 0; i <= side->row_count / 2 * places; i++) {
        seen next = seen_at(v, side, i, places);
        peak found = {before.y, next.y, here.weight};
        if (here.weight >= before.weight && here.weight > next.weight)
            keep_peak(largest, found);
        before = here;
        here = next;
    }
}

/* Thirds of a peak that hold no maximum are cut off; below the horizon nothing is claimed where y is small. */
static double top_of(vndf_validation *v, const vndf_wedge *side, peak p, int thirds)
{
    for (int i = 0; i < thirds; i++) {
        double low = p.from + (p.to - p.from) / 3, high = p.to - (p.to - p.from) / 3;
        if (foreseen(v, side, low) > foreseen(v, side, high))
            p.to = high;
        else
            p.from = low;
    }
    return (p.from + p.to) / 2;
}

/* The maxima of the foreseen weight. */
static void add_peaks(circle *all, vndf_validation *v, const vndf_wedge *side, const survey *s)
{
    peak largest[PEAKS] = {{0, 0, 0}};
    find_peaks(v, side, s->places, largest);
    for (int i = 0; i < s->peaks && largest[i].weight > 0; i++)
        add_side(all, v, side, top_of(v, side, largest[i], s->thirds));
}

/* Adds directions between the two neighbours that promise the largest total variation, or weight. */
static void add_between(circle *all, vndf_validation *v, int by_weight)
{
    int best = 0;
    double most = -1.0;
    for (int i = 0; i + 1 < all->count; i++) {
        const vndf_finding *a = &all->at[i].found, *b = &all->at[i + 1].found;
        double size = by_weight ? fmax(a->max_weight, b->max_weight) - 1 : fmax(a->tv, b->tv);
        double promise = size * sqrt(all->at[i + 1].angle - all->at[i].angle);
        if (promise > most) {
            most = promise;
            best = i;
        }
    }
    double angle = (all->at[best].angle + all->at[best + 1].angle) / 2;
    add_direction(all, v, sin(angle), cos(angle));
}

static void take(vndf_certificate *c, vndf_finding f, double theta)
{
    if (!f.measured)
        return;
    if (f.tv > c->tv) {
        c->tv = (float)f.tv;
        c->tv_theta = (float)theta;
    }
    if (f.tv > c->tv_above && theta <= 90.0) {
        c->tv_above = (float)f.tv;
        c->tv_above_theta = (float)theta;
    }
    c->max_weight = fmaxf(c->max_weight, (float)f.max_weight);
    c->area_error = fmaxf(c->area_error, (float)f.area_error);
    c->consistency = fmaxf(c->consistency, (float)f.consistency);
}

/* Largest relative error of the area at places in every piece of the spline below the horizon, the source of all
 * areas. */
static double area_error(const vndf_validation *v)
{
    static const double places[] = {0.15, 0.35, 0.5, 0.65, 0.85};
    const vndf_wedge *below = &v->table->below;
    double worst = 0.0;
    for (uint32_t i = 0; i + 1 < below->knot_count; i++)
        for (unsigned n = 0; n < sizeof places / sizeof *places && !vndf_guard_stopped(v->profile->guard); n++) {
            double y0 = below->knot_y[i], y = y0 + places[n] * (below->knot_y[i + 1] - y0);
            double area = vndf_validation_claimed(v, y, y - 1);
            if (area > 0)
                worst = fmax(worst, fabs(vndf_unit_area(v->table, y, y - 1) / area - 1));
        }
    return worst;
}

/* The n with P22 ~ r^-n between two slopes. */
static double power_between(const vndf_profile *profile, double r0, double r1)
{
    return log(vndf_profile_p22(profile, r0) / vndf_profile_p22(profile, r1)) / log(r1 / r0);
}

/* The p with D = P22/cos^4 ~ cos^p towards the horizon. */
static double horizon_power(const vndf_profile *profile)
{
    double end = profile->panel[profile->count].r, power = power_between(profile, end / 16, end / 4) - 4;
    return power < -4e-3 ? power : 0.0;
}

/* D may be unbounded at the pole or at the horizon; a cell is bounded. */
static int is_bounded(const vndf_profile *profile)
{
    double first = profile->panel[0].r;
    return power_between(profile, 4 * first, 16 * first) < 7e-3 && !(horizon_power(profile) < 0.0);
}

/* Looks at all directions of a survey. */
static void look(circle *all, vndf_validation *v, const survey *s)
{
    const vndf_distribution *table = v->table;
    all->count = 0;
    add_grid(all, v, s);
    add_rows(all, v, &table->above, s->spans);
    add_rows(all, v, &table->below, s->spans);
    add_cuts(all, v, s->spans);
    add_levels(all, v, s == &QUICK);
    add_peaks(all, v, &table->above, s);
    add_peaks(all, v, &table->below, s);
    for (int i = 0; i < s->between; i++)
        add_between(all, v, i % s->weighed == s->weighed - 1);
}

static void take_all(vndf_certificate *c, const circle *all, const vndf_profile *profile)
{
    for (int i = 0; i < all->count; i++) /* the angle at alpha 1 */
        take(c, all->at[i].found, atan2(sin(all->at[i].angle), cos(all->at[i].angle) * profile->scale) * 180 / PI);
}

/* ---- quick ---- */

typedef enum order { BY_TV, BY_TV_ABOVE, BY_WEIGHT } order;

static double size_of(const direction *at, order by)
{
    if (!at->found.measured || (by == BY_TV_ABOVE && at->angle > PI / 2))
        return 0.0;
    return by == BY_WEIGHT ? at->found.max_weight : at->found.tv;
}

/* The index of the largest local maximum below `most`, or -1. */
static int next_maximum(const circle *all, order by, double most)
{
    int best = -1;
    for (int i = 0; i < all->count; i++) {
        double size = size_of(&all->at[i], by), before = i > 0 ? size_of(&all->at[i - 1], by) : 0.0;
        double after = i + 1 < all->count ? size_of(&all->at[i + 1], by) : 0.0;
        if (size > before && size >= after && size < most && (best < 0 || size > size_of(&all->at[best], by)))
            best = i;
    }
    return best;
}

static int has_direction(const circle *all, double angle)
{
    for (int i = 0; i < all->count; i++)
        if (fabs(all->at[i].angle - angle) < 1e-12)
            return 1;
    return 0;
}

/* Measures the largest maxima of a coarse survey closely. */
static void add_maxima(circle *all, vndf_validation *v, const circle *coarse, order by, int count)
{
    double most = HUGE_VAL;
    for (int n = 0; n < count; n++) {
        int i = next_maximum(coarse, by, most);
        if (i < 0)
            return;
        most = size_of(&coarse->at[i], by);
        if (!has_direction(all, coarse->at[i].angle))
            add_direction(all, v, sin(coarse->at[i].angle), cos(coarse->at[i].angle));
    }
}

/* What rounding of masses to float adds to the integral of a pdf in some direction of any table: a few directions need
 * not meet it. */
static const float ROUNDED_MASSES = 4e-8f;

/* Areas are as true in a coarse look as in a close one. */
static int look_quickly(circle *all, vndf_validation *v, double *area)
{
    vndf_validation coarse;
    circle found = {.count = 0};
    int good = vndf_validation_from(&coarse, v->table, v->profile, vndf_validation_coarse);
    if (good) {
        look(&found, &coarse, &QUICK);
        add_maxima(all, v, &found, BY_TV, 3);
        add_maxima(all, v, &found, BY_TV_ABOVE, 2);
        add_maxima(all, v, &found, BY_WEIGHT, 4);
        for (int i = 0; i < found.count; i++)
            *area = fmax(*area, found.at[i].found.area_error);
    }
    vndf_validation_free(&coarse);
    return good;
}

int vndf_certificate_measure(vndf_certificate *c, const vndf_distribution *table, const vndf_profile *profile,
                             int quick)
{
    vndf_validation v;
    vndf_certificate none = {.max_weight = 1};
    circle all = {.count = 0};
    double area = 0.0;
    int good = vndf_validation_from(&v, table, profile, vndf_validation_close);
    if (good && quick)
        good = look_quickly(&all, &v, &area);
    else if (good)
        look(&all, &v, &FULL);
    if (good) {
        *c = none;
        take_all(c, &all, profile);
        c->area_error = fmaxf(c->area_error, (float)fmax(area, area_error(&v)));
        c->horizon_power = (float)horizon_power(profile);
        c->weight_bounded = (float)is_bounded(profile);
        c->ndf_error = (float)ndf_error(&v);
        c->hidden = (float)profile->hidden;
        c->finest = (float)profile->finest;
        c->quick = (float)quick;
        if (quick)
            c->consistency = fmaxf(c->consistency, ROUNDED_MASSES);
    }
    vndf_validation_free(&v);
    return good;
}
