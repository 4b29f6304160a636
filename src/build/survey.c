/* The visible normals from one direction are integrated over half a turn of azimuth (both halves are
 * alike) and over slope, on Gauss points of the cells of either stage, so that every integrand is smooth
 * between the points; the cells that hold a jump of the mask, c + s cos(a) R = 0, end there. */
#include "build/survey.h"

#include <math.h>
#include <stdlib.h>

#include "sampler/engine.h"
#include "sampler/surface.h"
#include "sampler/wedge.h"

static const double PI = 3.14159265358979323846;

/* f of a cell changes by more than this: it takes the finer rule. */
static const double STEEP = 1.3;

/* Cells of small tables are integrated in parts, at least so many in all: the table is measured, not the rule. */
enum { RADIAL_PARTS_LEAST = 128, AZIMUTH_PARTS_LEAST = 20, FRONT_PANELS = 20 };

static uint32_t parts_for(uint32_t cells, uint32_t least)
{
    return (least + cells - 1) / cells;
}

/* In double at the knots too: what is seen beyond a cut may be so narrow that a rounding of its end shows. */
double vndf_survey_slope(const vndf_distribution *d, uint32_t cell, uint32_t part, uint32_t parts)
{
    double xi = (double)part / parts, x0 = d->knots.x[cell], z0 = d->knots.z[cell];
    double x = part < parts ? x0 + xi * (d->knots.x[cell + 1] - x0) : d->knots.x[cell + 1];
    double z = part < parts ? z0 + xi * (d->knots.z[cell + 1] - z0) : d->knots.z[cell + 1];
    return z > 0 ? x / z : HUGE_VAL;
}

/* The view of the unit problem: isotropic, so that it may be made from s and c alone. */
static vndf_view view_of(const vndf_distribution *table, double s, double c)
{
    vndf_vec3 wi = {(float)s, 0.0f, (float)c};
    return vndf_view_scaled(table, 1.0, 1.0, wi);
}

/* One azimuth of a direction, with the weight that it has in the sum. */
typedef struct ray {
    vndf_engine_ray drawn;
    double weight;
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
static void add_slopes(vndf_survey *v, const ray *at, double r0, double r1, int steep)
{
    const double *node = steep ? vndf_gauss_node : vndf_gauss_coarse_node;
    const double *weight = steep ? vndf_gauss_weight : vndf_gauss_coarse_weight;
    int points = steep ? VNDF_GAUSS : VNDF_GAUSS_COARSE;
    double x0 = r0 / (1 + r0), z0 = 1 / (1 + r0), z1 = 1 / (1 + r1), x1 = z1 > 0 ? r1 / (1 + r1) : 1.0;
    double width = z1 > 0 ? (r1 - r0) * z0 * z1 : z0;
    for (int i = 0; i < points && v->count < v->capacity; i++) {
        double xi = node[i], x = x0 + xi * (x1 - x0), z = z0 + xi * (z1 - z0), r = x / z;
        double measure = at->weight * weight[i] * width * r / (z * z), mask = at->drawn.c + at->drawn.k * r;
        double truth = mask > 0 ? vndf_profile_p22(v->profile, r) * mask / v->area : 0.0;
        vndf_survey_point one = {truth * measure, drawn_density(at, r) * measure};
        v->samples[v->count++] = one;
    }
}

/* One azimuth: every radial cell that is seen, in parts where there are few, the one at the cut up to the cut. */
static void add_azimuth(vndf_survey *v, const ray *at)
{
    double k = at->drawn.k, c = at->drawn.c, cut = c * k < 0 ? -c / k : 0.0;
    const vndf_distribution *d = v->table;
    for (uint32_t i = 0; i < d->radial_count * v->radial_parts; i++) {
        uint32_t j = i / v->radial_parts, part = i % v->radial_parts;
        double r0 = vndf_survey_slope(d, j, part, v->radial_parts);
        double r1 = vndf_survey_slope(d, j, part + 1, v->radial_parts);
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
    ray at = {vndf_engine_ray_at(view, (turn->away ? -x : x) / n, y / n), weight};
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

static void add_quarter(vndf_survey *v, const vndf_view *view, const quarter *turn)
{
    uint32_t parts = parts_for(turn->cells, AZIMUTH_PARTS_LEAST);
    double taken = 0.0;
    for (uint32_t i = 0; i < turn->cells * parts * VNDF_GAUSS_COARSE; i++) {
        uint32_t part = i / VNDF_GAUSS_COARSE;
        ray at = ray_in(view, turn, part / parts, part % parts, parts, i % VNDF_GAUSS_COARSE);
        taken += at.weight * at.drawn.azimuth;
        add_azimuth(v, &at);
    }
    v->lack += azimuth_lack(view, turn, taken);
}

/* The quarter turn towards wi, in panels that are closer towards 90 degrees, where cos a vanishes. */
static void add_front(vndf_survey *v, const vndf_view *view)
{
    float node[FRONT_PANELS + 1];
    quarter turn = {node, FRONT_PANELS, 1, 1, 0};
    for (int i = 0; i <= FRONT_PANELS; i++) {
        double w = (double)i / FRONT_PANELS;
        node[i] = (float)tan(PI / 4 * w * (1.5 - 0.5 * w));
    }
    add_quarter(v, view, &turn);
}

static double ratio_of(vndf_survey_point a)
{
    return a.drawn > 0 ? a.truth / a.drawn : a.truth > 0 ? HUGE_VAL : 0.0;
}

/* Moves samples with a ratio of `pivot` or more to the front; their count. */
static size_t split_at(vndf_survey_point *samples, size_t count, double pivot, double *mass)
{
    size_t n = 0;
    *mass = 0.0;
    for (size_t i = 0; i < count; i++)
        if (ratio_of(samples[i]) >= pivot) {
            vndf_survey_point swap = samples[n];
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

/* Largest truth/drawn when the points with the largest, that together hold VNDF_SURVEY_LEFT_OUT, are left out:
 * what is left is split until it is one value. */
static double weight_of(vndf_survey *v)
{
    double left = VNDF_SURVEY_LEFT_OUT, mass;
    vndf_survey_point *from = v->samples;
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

vndf_finding vndf_survey_direction(vndf_survey *v, double s, double c)
{
    vndf_finding f = {0, 0, 0, 0, 0};
    s = (float)s; /* the direction that the run time is given */
    c = (float)c;
    double area = vndf_profile_area(v->profile, s, c), drawn = 0.0, miss = 0.0;
    vndf_view view = view_of(v->table, s, c);
    if (!(area > VNDF_AREA_CLAIMED * v->profile->f1) || vndf_guard_stopped(v->profile->guard))
        return f;
    f.measured = 1;
    f.area_error = fabs(vndf_unit_area(v->table, s, c) / area - 1);
    v->area = area / (s + fabs(c)); /* as the view has it: s + |c| = 1 */
    v->count = 0;
    v->lack = 0.0;
    if (c >= 0)
        add_front(v, &view);
    const vndf_wedge *side = vndf_wedge_of(v->table, c);
    vndf_azimuth_row row = vndf_wedge_row(side, (float)vndf_wedge_y(view.s, view.c));
    quarter wedge = {side->q, side->cell_count, row.p, row.r, c >= 0};
    if (view.wedge > 0 && row.p > 0)
        add_quarter(v, &view, &wedge);
    for (size_t i = 0; i < v->count; i++) {
        drawn += v->samples[i].drawn;
        miss += fabs(v->samples[i].drawn - v->samples[i].truth);
    }
    f.tv = miss / 2;
    f.consistency = fabs(drawn + v->lack - 1);
    f.max_weight = weight_of(v);
    return f;
}

int vndf_survey_from(vndf_survey *v, const vndf_distribution *table, const vndf_profile *profile)
{
    uint32_t cells = table->above.cell_count + table->below.cell_count + FRONT_PANELS + 3 * AZIMUTH_PARTS_LEAST;
    vndf_survey made = {table, profile, parts_for(table->radial_count, RADIAL_PARTS_LEAST), NULL, 0, 0, 0.0, 0.0};
    *v = made;
    v->capacity = (size_t)cells * VNDF_GAUSS_COARSE * table->radial_count * v->radial_parts * VNDF_GAUSS;
    v->samples = malloc(v->capacity * sizeof *v->samples);
    return v->samples != NULL;
}

void vndf_survey_free(vndf_survey *v)
{
    free(v->samples);
}
