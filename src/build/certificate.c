/* The visible normals from one direction are integrated over half a turn of azimuth (both halves are
 * alike) and over slope, on Gauss points of the cells of either stage, so that every integrand is smooth
 * between the points; the cells that hold a jump of the mask, c + s cos(a) R = 0, end there. */
#include "build/certificate.h"

#include <math.h>
#include <stdlib.h>

#include "sampler/engine.h"
#include "sampler/surface.h"
#include "sampler/wedge.h"

static const double PI = 3.14159265358979323846;
static const double AREA_LEAST = 1e-10; /* of half the area at grazing incidence: below it nothing is claimed */
static const double MASS_LEFT_OUT = 1e-6;

/* f of a cell changes by more than this: it takes the finer rule. */
static const double STEEP = 1.3;

/* Cells of small tables are integrated in parts, at least so many in all: the table is measured, not the rule. */
enum { RADIAL_PARTS_LEAST = 128, AZIMUTH_PARTS_LEAST = 20, FRONT_PANELS = 20 };

static uint32_t parts_for(uint32_t cells, uint32_t least)
{
    return (least + cells - 1) / cells;
}

/* Slope at part/parts of a radial cell in xi. In double at the knots too: what is seen beyond a cut may be so narrow that
 * a rounding of its end shows. */
static double part_of(const vndf_distribution *d, uint32_t cell, uint32_t part, uint32_t parts)
{
    double xi = (double)part / parts, x0 = d->knots.x[cell], z0 = d->knots.z[cell];
    double x = part < parts ? x0 + xi * (d->knots.x[cell + 1] - x0) : d->knots.x[cell + 1];
    double z = part < parts ? z0 + xi * (d->knots.z[cell + 1] - z0) : d->knots.z[cell + 1];
    return z > 0 ? x / z : HUGE_VAL;
}

/* One Gauss point of a direction. */
typedef struct sample {
    double truth, drawn; /* density in slope area, times its share of the area: parts of the two masses */
} sample;

typedef struct survey {
    const vndf_distribution *table;
    const vndf_profile *profile;
    uint32_t radial_parts; /* of each radial cell */
    sample *samples;
    size_t count, capacity;
    double lack; /* of drawn mass, for want of azimuths */
} survey;

typedef struct finding {
    double tv, max_weight, consistency, area_error;
    int measured;
} finding;

/* The view of the unit problem: isotropic, so that it may be made from s and c alone. */
static vndf_view view_of(const vndf_distribution *table, double s, double c)
{
    vndf_vec3 wi = {(float)s, 0.0f, (float)c};
    return vndf_view_scaled(table, 1.0, 1.0, wi);
}

/* One azimuth of a direction, with the weight that it has in the sum. */
typedef struct ray {
    vndf_engine_ray drawn;
    double weight, area;
} ray;

/* pdf per unit of slope area of the unit problem at R: the engine's density is per X Z^2 dR da. */
static double drawn_density(const ray *at, double r)
{
    double unit = 1 / (1 + r);
    double x = r < HUGE_VAL ? r * unit : 1.0, z = unit;
    double w = at->drawn.k * x + at->drawn.c * z;
    return w > 0 ? vndf_engine_ray_density(&at->drawn, x, z, w) * z * z * z : 0.0;
}

/* Slopes from r0 to r1, which may be infinite: X and Z are linear between them, dR = width/Z^2 dxi. */
static void add_slopes(survey *v, const ray *at, double r0, double r1, int steep)
{
    const double *node = steep ? vndf_gauss_node : vndf_gauss_coarse_node;
    const double *weight = steep ? vndf_gauss_weight : vndf_gauss_coarse_weight;
    int points = steep ? VNDF_GAUSS : VNDF_GAUSS_COARSE;
    double x0 = r0 / (1 + r0), z0 = 1 / (1 + r0), z1 = 1 / (1 + r1), x1 = z1 > 0 ? r1 / (1 + r1) : 1.0;
    double width = z1 > 0 ? (r1 - r0) * z0 * z1 : z0;
    for (int i = 0; i < points && v->count < v->capacity; i++) {
        double xi = node[i], x = x0 + xi * (x1 - x0), z = z0 + xi * (z1 - z0), r = x / z;
        double measure = at->weight * weight[i] * width * r / (z * z), mask = at->drawn.c + at->drawn.k * r;
        double truth = mask > 0 ? vndf_profile_p22(v->profile, r) * mask / at->area : 0.0;
        sample one = {truth * measure, drawn_density(at, r) * measure};
        v->samples[v->count++] = one;
    }
}

/* One azimuth: every radial cell that is seen, in parts where there are few, the one at the cut up to the cut. */
static void add_azimuth(survey *v, const ray *at)
{
    double k = at->drawn.k, c = at->drawn.c, cut = c * k < 0 ? -c / k : 0.0;
    const vndf_distribution *d = v->table;
    for (uint32_t i = 0; i < d->radial_count * v->radial_parts; i++) {
        uint32_t j = i / v->radial_parts, part = i % v->radial_parts;
        double r0 = part_of(d, j, part, v->radial_parts), r1 = part_of(d, j, part + 1, v->radial_parts);
        double f0 = d->cells[j].f0, f1 = d->cells[j].f1;
        if (c > 0 && cut > 0)
            r1 = fmin(r1, cut);
        else if (c < 0)
            r0 = fmax(r0, cut > 0 ? cut : HUGE_VAL);
        if (r1 > r0)
            add_slopes(v, at, r0, r1, v->radial_parts > 1 || f0 > STEEP * f1 || f1 > STEEP * f0);
    }
}

/* A quarter turn on the cells of a row with an aspect. */
typedef struct quarter {
    const float *node;
    uint32_t cells;
    double p, r;
    int away; /* from wi */
} quarter;

/* Gauss point g of a part of a cell. */
static ray ray_in(const vndf_view *view, const quarter *turn, uint32_t cell, uint32_t part, uint32_t parts,
                  uint32_t g)
{
    double width = ((double)turn->node[cell + 1] - turn->node[cell]) / parts;
    double q = turn->node[cell] + width * (part + vndf_gauss_coarse_node[g]), p = turn->p, r = turn->r;
    double x = p * (1 - q * q), y = r * 2 * q, n2 = x * x + y * y, n = sqrt(n2);
    double weight = 2 * vndf_gauss_coarse_weight[g] * width * 2 * p * r * (1 + q * q) / n2;
    ray at = {vndf_engine_ray_at(view, (turn->away ? -x : x) / n, y / n), weight, 0.0};
    return at;
}

/* What the few rays of add_quarter take the mass of all azimuths for too little: without the radius many more can
 * be had, and cells of a jump's azimuth are steep. */
static double azimuth_lack(const vndf_view *view, const quarter *turn, double taken)
{
    enum { PARTS = 64 };
    double mass = 0.0;
    for (uint32_t i = 0; i < turn->cells * PARTS * VNDF_GAUSS_COARSE; i++) {
        uint32_t in_cell = i % (PARTS * VNDF_GAUSS_COARSE);
        ray at = ray_in(view, turn, i / (PARTS * VNDF_GAUSS_COARSE), in_cell / VNDF_GAUSS_COARSE, PARTS,
                        i % VNDF_GAUSS_COARSE);
        mass += at.weight * at.drawn.azimuth;
    }
    return mass - taken;
}

static void add_quarter(survey *v, const vndf_view *view, const quarter *turn, double area)
{
    uint32_t parts = parts_for(turn->cells, AZIMUTH_PARTS_LEAST);
    double taken = 0.0;
    for (uint32_t i = 0; i < turn->cells * parts * VNDF_GAUSS_COARSE; i++) {
        uint32_t part = i / VNDF_GAUSS_COARSE;
        ray at = ray_in(view, turn, part / parts, part % parts, parts, i % VNDF_GAUSS_COARSE);
        at.area = area;
        taken += at.weight * at.drawn.azimuth;
        add_azimuth(v, &at);
    }
    v->lack += azimuth_lack(view, turn, taken);
}

/* The quarter turn towards wi, in panels that are closer towards 90 degrees, where cos a vanishes. */
static void add_front(survey *v, const vndf_view *view, double area)
{
    float node[FRONT_PANELS + 1];
    quarter turn = {node, FRONT_PANELS, 1, 1, 0};
    for (int i = 0; i <= FRONT_PANELS; i++) {
        double w = (double)i / FRONT_PANELS;
        node[i] = (float)tan(PI / 4 * w * (1.5 - 0.5 * w));
    }
    add_quarter(v, view, &turn, area);
}

static double ratio_of(sample a)
{
    return a.drawn > 0 ? a.truth / a.drawn : a.truth > 0 ? HUGE_VAL : 0.0;
}

/* Moves samples with a ratio of `pivot` or more to the front; their count. */
static size_t split_at(sample *samples, size_t count, double pivot, double *mass)
{
    size_t n = 0;
    *mass = 0.0;
    for (size_t i = 0; i < count; i++)
        if (ratio_of(samples[i]) >= pivot) {
            sample swap = samples[n];
            *mass += samples[i].truth;
            samples[n++] = samples[i];
            samples[i] = swap;
        }
    return n;
}

static double middle_of_three(double a, double b, double c)
{
    return fmax(fmin(a, b), fmin(fmax(a, b), c));
}

/* Largest truth/drawn when the points with the largest, that together hold MASS_LEFT_OUT, are left out: what is
 * left is split until it is one value. */
static double weight_of(survey *v)
{
    double left = MASS_LEFT_OUT, mass;
    sample *from = v->samples;
    size_t count = v->count;
    while (count > 0) {
        double pivot = middle_of_three(ratio_of(from[0]), ratio_of(from[count / 2]), ratio_of(from[count - 1]));
        size_t larger = 0;
        mass = 0.0;
        if (pivot < HUGE_VAL)
            larger = split_at(from, count, nextafter(pivot, HUGE_VAL), &mass);
        if (mass > left) {
            count = larger;
            continue;
        }
        left -= mass;
        from += larger;
        count -= larger;
        size_t equal = split_at(from, count, pivot, &mass);
        if (mass > left)
            return pivot;
        left -= mass;
        from += equal;
        count -= equal;
    }
    return 1.0;
}

static finding survey_direction(survey *v, double s, double c)
{
    finding f = {0, 0, 0, 0, 0};
    s = (float)s; /* the direction that the run time is given */
    c = (float)c;
    double area = vndf_profile_area(v->profile, s, c), drawn = 0.0, miss = 0.0;
    vndf_view view = view_of(v->table, s, c);
    if (!(area > AREA_LEAST * v->profile->f1) || vndf_guard_stopped(v->profile->guard))
        return f;
    f.measured = 1;
    f.area_error = fabs(vndf_unit_area(v->table, s, c) / area - 1);
    area /= s + fabs(c); /* as the view has it: s + |c| = 1 */
    v->count = 0;
    v->lack = 0.0;
    if (view.c >= 0)
        add_front(v, &view, area);
    vndf_azimuth_row row = vndf_wedge_row(&view);
    quarter wedge = {row.q, row.cells, row.p, row.r, view.c >= 0};
    if (view.wedge > 0 && row.p > 0)
        add_quarter(v, &view, &wedge, area);
    for (size_t i = 0; i < v->count; i++) {
        drawn += v->samples[i].drawn;
        miss += fabs(v->samples[i].drawn - v->samples[i].truth);
    }
    f.tv = miss / 2;
    f.consistency = fabs(drawn + v->lack - 1);
    f.max_weight = weight_of(v);
    return f;
}

/* Relative error of D at a slope; 0 in either end of the mass. */
static double ndf_miss(const survey *v, double r)
{
    const vndf_profile *p = v->profile;
    double z = 1 / (1 + r), truth = vndf_profile_p22(p, r), end = MASS_LEFT_OUT / 2 * p->f0;
    if (!(truth * r * r > 1e-6 * p->f0 && vndf_profile_moments(p, 0, r).m0 > end &&
          vndf_profile_moments(p, r, HUGE_VAL).m0 > end))
        return 0.0;
    return fabs(vndf_engine_p22_over_z4(v->table, r * z, z) * z * z * z * z / truth - 1);
}

/* Its largest over the slopes that hold all but MASS_LEFT_OUT, at even places of every cell. */
static double ndf_error(const survey *v)
{
    enum { PLACES = 24 };
    double worst = 0.0;
    for (uint32_t j = 0; j < v->table->radial_count; j++)
        for (uint32_t i = 1; i < PLACES; i++)
            worst = fmax(worst, ndf_miss(v, part_of(v->table, j, i, PLACES)));
    return worst;
}

/* ---- directions ---- */

/* Angles of incidence at alpha 1, degrees, and tangents of elevation at canonical scale. */
static const double ANGLES[] = {0,    10, 20, 30, 40,  50,  60,  70,  80,  85,  89, 89.9, 90,
                                90.1, 91, 95, 100, 110, 120, 130, 150, 170, 179};
static const double ELEVATIONS[] = {30, 10, 5, 3, 2, 1.5, 1.2, 1, 0.8, 0.6, 0.4, 0.3, 0.2, 0.1, 0.03};
enum { ANGLE_COUNT = sizeof ANGLES / sizeof *ANGLES, ELEVATION_COUNT = sizeof ELEVATIONS / sizeof *ELEVATIONS };

/* More directions where the total variation is large, so that its maximum is not missed between two: small tables have
 * few rows, hence broad maxima, and cost little. */
enum { MORE = 12, MORE_IF_SMALL = 60, SMALL_RADIAL_CELLS = 64 };
enum { DIRECTIONS_MOST = ANGLE_COUNT + 2 * ELEVATION_COUNT + MORE_IF_SMALL };

typedef struct direction {
    double angle; /* of incidence at canonical scale, in [0, pi] */
    finding found;
} direction;

typedef struct circle {
    direction at[DIRECTIONS_MOST]; /* ascending */
    int count;
} circle;

static void add_direction(circle *all, survey *v, double s, double c)
{
    int i = all->count++;
    direction made = {atan2(s, c), survey_direction(v, s, c)};
    for (; i > 0 && all->at[i - 1].angle > made.angle; i--)
        all->at[i] = all->at[i - 1];
    all->at[i] = made;
}

static void add_grid(circle *all, survey *v)
{
    for (int i = 0; i < ANGLE_COUNT; i++) {
        double theta = ANGLES[i] * PI / 180, s = sin(theta) * v->profile->scale, c = ANGLES[i] == 90 ? 0 : cos(theta);
        double length = hypot(s, c);
        add_direction(all, v, s / length, c / length);
    }
    for (int i = 0; i < 2 * ELEVATION_COUNT; i++) {
        double k = ELEVATIONS[i / 2] * (i % 2 ? -1 : 1), length = hypot(1, k);
        add_direction(all, v, 1 / length, k / length);
    }
}

/* Between the two neighbours that promise most. */
static void add_between(circle *all, survey *v)
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

static void take(vndf_certificate *c, finding f, double theta)
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

/* Largest relative error of the area at places of every piece of the spline below the horizon, from which all areas
 * come. */
static double area_error(const survey *v)
{
    static const double places[] = {0.15, 0.35, 0.5, 0.65, 0.85};
    const vndf_wedge *below = &v->table->below;
    double worst = 0.0;
    for (uint32_t i = 0; i + 1 < below->knot_count; i++)
        for (unsigned n = 0; n < sizeof places / sizeof *places && !vndf_guard_stopped(v->profile->guard); n++) {
            double y0 = below->knot_y[i], y = y0 + places[n] * (below->knot_y[i + 1] - y0);
            double area = vndf_profile_area(v->profile, y, y - 1);
            if (area > AREA_LEAST * v->profile->f1)
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
    survey v = {table, profile, parts_for(table->radial_count, RADIAL_PARTS_LEAST), NULL, 0, 0, 0};
    vndf_certificate none = {0, 0, 1, 0, 0, 0, 0};
    uint32_t cells = table->above.cell_count + table->below.cell_count + FRONT_PANELS + 3 * AZIMUTH_PARTS_LEAST;
    v.capacity = (size_t)cells * VNDF_GAUSS_COARSE * table->radial_count * v.radial_parts * VNDF_GAUSS;
    v.samples = malloc(v.capacity * sizeof *v.samples);
    if (!v.samples)
        return 0;
    circle all = {.count = 0};
    add_grid(&all, &v);
    for (int i = 0; i < (table->radial_count <= SMALL_RADIAL_CELLS ? MORE_IF_SMALL : MORE); i++)
        add_between(&all, &v);
    *c = none;
    for (int i = 0; i < all.count; i++) /* the angle at alpha 1 */
        take(c, all.at[i].found, atan2(sin(all.at[i].angle), cos(all.at[i].angle) * profile->scale) * 180 / PI);
    c->area_error = fmaxf(c->area_error, (float)area_error(&v));
    c->weight_bounded = (float)is_bounded(profile);
    c->ndf_error = (float)ndf_error(&v);
    free(v.samples);
    return 1;
}
