/* What is claimed of a table: the worst over directions, and of D and the area at all of their cells. */
#include "build/certificate.h"

#include <math.h>

#include "build/survey.h"
#include "sampler/engine.h"

static const double PI = 3.14159265358979323846;

/* Relative error of D at a slope; 0 in either end of the mass. */
static double ndf_miss(const vndf_survey *v, double r)
{
    const vndf_profile *p = v->profile;
    double z = 1 / (1 + r), truth = vndf_profile_p22(p, r), end = VNDF_SURVEY_LEFT_OUT / 2 * p->f0;
    if (!(truth * r * r > 1e-6 * p->f0 && vndf_profile_moments(p, 0, r).m0 > end &&
          vndf_profile_moments(p, r, HUGE_VAL).m0 > end))
        return 0.0;
    return fabs(vndf_engine_p22_over_z4(v->table, r * z, z) * z * z * z * z / truth - 1);
}

/* Its largest over the slopes that hold all but VNDF_SURVEY_LEFT_OUT, at even places of every cell. */
static double ndf_error(const vndf_survey *v)
{
    enum { PLACES = 24 };
    double worst = 0.0;
    for (uint32_t j = 0; j < v->table->radial_count; j++)
        for (uint32_t i = 1; i < PLACES; i++)
            worst = fmax(worst, ndf_miss(v, vndf_survey_slope(v->table, j, i, PLACES)));
    return worst;
}

/* ---- directions ---- */

/* Angles of incidence at alpha 1, degrees, and tangents of elevation at canonical scale. */
static const double ANGLES[] = {0,    10, 20, 30, 40,  50,  60,  70,  80,  85,  89, 89.9, 90,
                                90.1, 91, 95, 100, 110, 120, 130, 150, 170, 179};
static const double ELEVATIONS[] = {30, 10, 5, 3, 2, 1.5, 1.2, 1, 0.8, 0.6, 0.4, 0.3, 0.2, 0.1, 0.03};
enum { ANGLE_COUNT = sizeof ANGLES / sizeof *ANGLES, ELEVATION_COUNT = sizeof ELEVATIONS / sizeof *ELEVATIONS };

/* More directions where the total variation is large, so that its maximum is not missed between two: small tables
 * have few rows, hence broad maxima, and cost little. */
enum { MORE = 30, MORE_IF_SMALL = 60, SMALL_RADIAL_CELLS = 160 };

/* And where so much of the area at grazing incidence is left, half of it being 1: compact supports end within a
 * small part of a degree. */
static const double LEVELS[] = {1e-2, 1e-4, 1e-6};
enum { LEVEL_COUNT = sizeof LEVELS / sizeof *LEVELS };
enum { DIRECTIONS_MOST = ANGLE_COUNT + 2 * ELEVATION_COUNT + LEVEL_COUNT + MORE_IF_SMALL };

typedef struct direction {
    double angle; /* of incidence at canonical scale, in [0, pi] */
    vndf_finding found;
} direction;

typedef struct circle {
    direction at[DIRECTIONS_MOST]; /* ascending */
    int count;
} circle;

static void add_direction(circle *all, vndf_survey *v, double s, double c)
{
    int i = all->count++;
    direction made = {atan2(s, c), vndf_survey_direction(v, s, c)};
    for (; i > 0 && all->at[i - 1].angle > made.angle; i--)
        all->at[i] = all->at[i - 1];
    all->at[i] = made;
}

static void add_grid(circle *all, vndf_survey *v)
{
    for (int i = 0; i < ANGLE_COUNT; i++) {
        double theta = ANGLES[i] * PI / 180, s = sin(theta) * v->profile->scale;
        double c = ANGLES[i] == 90 ? 0 : cos(theta), length = hypot(s, c);
        add_direction(all, v, s / length, c / length);
    }
    for (int i = 0; i < 2 * ELEVATION_COUNT; i++) {
        double k = ELEVATIONS[i / 2] * (i % 2 ? -1 : 1), length = hypot(1, k);
        add_direction(all, v, 1 / length, k / length);
    }
}

/* The area falls from 90 to 180 degrees. */
static void add_levels(circle *all, vndf_survey *v)
{
    for (int i = 0; i < LEVEL_COUNT; i++) {
        double low = PI / 2, high = PI;
        for (int step = 0; step < 40 && !vndf_guard_stopped(v->profile->guard); step++) {
            double angle = (low + high) / 2, area = vndf_profile_area(v->profile, sin(angle), cos(angle));
            if (area > LEVELS[i] * v->profile->f1)
                low = angle;
            else
                high = angle;
        }
        add_direction(all, v, sin(low), cos(low));
    }
}

/* Between the two neighbours that promise most. */
static void add_between(circle *all, vndf_survey *v)
{
    int best = 0;
    double most = -1.0;
    for (int i = 0; i + 1 < all->count; i++) {
        double tv = fmax(all->at[i].found.tv, all->at[i + 1].found.tv);
        double promise = tv * sqrt(all->at[i + 1].angle - all->at[i].angle);
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
    c->max_weight = fmaxf(c->max_weight, (float)f.max_weight);
    c->area_error = fmaxf(c->area_error, (float)f.area_error);
    c->consistency = fmaxf(c->consistency, (float)f.consistency);
}

/* Largest relative error of the area at places of every piece of the spline below the horizon, from which all
 * areas come. */
static double area_error(const vndf_survey *v)
{
    static const double places[] = {0.15, 0.35, 0.5, 0.65, 0.85};
    const vndf_wedge *below = &v->table->below;
    double worst = 0.0;
    for (uint32_t i = 0; i + 1 < below->knot_count; i++)
        for (unsigned n = 0; n < sizeof places / sizeof *places && !vndf_guard_stopped(v->profile->guard); n++) {
            double y0 = below->knot_y[i], y = y0 + places[n] * (below->knot_y[i + 1] - y0);
            double area = vndf_profile_area(v->profile, y, y - 1);
            if (area > VNDF_AREA_CLAIMED * v->profile->f1)
                worst = fmax(worst, fabs(vndf_unit_area(v->table, y, y - 1) / area - 1));
        }
    return worst;
}

/* D may be unbounded at the pole or fall so slowly that it is at the horizon; a cell is bounded. */
static int is_bounded(const vndf_profile *profile)
{
    double r0 = profile->panel[0].r, r1 = profile->panel[profile->count].r;
    double pole = vndf_profile_p22(profile, 4 * r0) / vndf_profile_p22(profile, 16 * r0);
    double tail = vndf_profile_p22(profile, r1 / 16) / vndf_profile_p22(profile, r1 / 4);
    return pole < 1.01 && tail > 254;
}

int vndf_certificate_measure(vndf_certificate *c, const vndf_distribution *table, const vndf_profile *profile)
{
    vndf_survey v;
    vndf_certificate none = {0, 0, 1, 0, 0, 0, 0};
    if (!vndf_survey_from(&v, table, profile))
        return 0;
    circle all = {.count = 0};
    add_grid(&all, &v);
    add_levels(&all, &v);
    for (int i = 0; i < (table->radial_count <= SMALL_RADIAL_CELLS ? MORE_IF_SMALL : MORE); i++)
        add_between(&all, &v);
    *c = none;
    for (int i = 0; i < all.count; i++) /* the angle at alpha 1 */
        take(c, all.at[i].found, atan2(sin(all.at[i].angle), cos(all.at[i].angle) * profile->scale) * 180 / PI);
    c->area_error = fmaxf(c->area_error, (float)area_error(&v));
    c->weight_bounded = (float)is_bounded(profile);
    c->ndf_error = (float)ndf_error(&v);
    vndf_survey_free(&v);
    return 1;
}
