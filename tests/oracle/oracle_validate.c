#include "harness/constants.h"
#include "oracle/oracle_validate.h"

#include <math.h>

/* Gauss-Legendre with three points on [0, 1]. */
static const double NODE[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
static const double WEIGHT[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

enum { RADII_MAX = 8000 };

/* The direction in the stretched frame, in double from the float wi, and the grid of slopes. */
typedef struct grid {
    const oracle *o;
    const vndf_surface *surface;
    double s, c, cos_phi, sin_phi, length, area;
    double edge[RADII_MAX];
    int edges;
    oracle_visitor *visit;
    void *user;
    int sides; /* 2: both halves of the turn; 1: now one, now the other, for what is alike on both */
    unsigned long count;
} grid;

static void stretch(grid *g, vndf_vec3 wi)
{
    double l = sqrt((double)wi.x * wi.x + (double)wi.y * wi.y + (double)wi.z * wi.z);
    double x = (double)g->surface->alpha_x * wi.x / l, y = (double)g->surface->alpha_y * wi.y / l;
    g->s = hypot(x, y);
    g->c = wi.z / l;
    g->cos_phi = g->s > 0 ? x / g->s : 1;
    g->sin_phi = g->s > 0 ? y / g->s : 0;
    g->area = oracle_area(g->o, g->s, g->c);
}

/* ---- edges of the panels ---- */

static void put(grid *g, double r)
{
    if (g->edges < RADII_MAX && (g->edges == 0 || r > g->edge[g->edges - 1] * (1 + 1e-13)))
        g->edge[g->edges++] = r;
}

/* Steps in log r of at most an eighth, shorter where P22 is steep; about a break they shrink towards it by
 * threes, since a table may put the jump a rounding error beside. */
static double step_from(const oracle *o, double r)
{
    double here = o->shape(r), there = o->shape(r * 1.001), step = 0.125, gap = fabs(r - o->breaks[0]);
    if (here > 0 && there > 0)
        step = 0.125 / (1 + 0.5 * fabs(log(there / here)) / 0.001);
    if (o->breaks[0] > 0 && gap < 0.3 * o->breaks[0])
        step = fmin(step, fmax(gap / o->breaks[0] * (r < o->breaks[0] ? 0.67 : 2), 1e-8));
    return step > 1e-4 || o->breaks[0] > 0 ? step : 1e-4;
}

static void make_edges(grid *g)
{
    double r = g->o->peak, most = fmin(1e3 * g->o->reach, 1e14), b = g->o->breaks[0];
    put(g, 0);
    while (r < most) {
        put(g, r);
        double next = r * (1 + step_from(g->o, r));
        r = r < b && next > b * (1 - 1e-8) ? b : next;
    }
    put(g, most);
}

/* ---- the grid ---- */

static void visit_slope(grid *g, double r, double cos_a, double sin_a, double p22, double weight)
{
    double ax = g->surface->alpha_x, ay = g->surface->alpha_y;
    double x = ax * r * (g->cos_phi * cos_a - g->sin_phi * sin_a),
           y = ay * r * (g->sin_phi * cos_a + g->cos_phi * sin_a);
    double z = 1 / sqrt(1 + x * x + y * y), mask = g->c + g->s * r * cos_a;
    oracle_point point = {{(float)(x * z), (float)(y * z), (float)z}, 0, 0};
    point.reference = mask > 0 ? p22 * mask / g->area / (ax * ay * z * z * z) : 0;
    point.weight = weight * r * ax * ay * z * z * z;
    g->visit(&point, g->user);
}

/* One azimuth: the panels as far as they face wi. */
static void visit_side(grid *g, double cos_a, double sin_a, double weight)
{
    double k = g->s * cos_a, cut = g->c * k < 0 ? -g->c / k : 0;
    for (int i = 0; i + 1 < g->edges; i++) {
        double r0 = g->edge[i], r1 = g->edge[i + 1];
        if (g->c > 0 && k < 0)
            r1 = fmin(r1, cut);
        else if (g->c <= 0)
            r0 = k > 0 ? fmax(r0, cut) : HUGE_VAL;
        for (int j = 0; j < 3 && r0 < r1; j++) {
            double r = r0 + (r1 - r0) * NODE[j];
            visit_slope(g, r, cos_a, sin_a, oracle_p22(g->o, r), weight * WEIGHT[j] * (r1 - r0));
        }
    }
}

static void visit_azimuth(grid *g, double a, double weight)
{
    int left = g->count++ % 2 == 0;
    if (g->sides == 2 || left)
        visit_side(g, cos(a), -sin(a), weight / g->sides);
    if (g->sides == 2 || !left)
        visit_side(g, cos(a), sin(a), weight / g->sides);
}

/* Panels from the middle of a range of azimuth to one end: of three degrees at most, and of a third of what is
 * left, so that they are fine where the range is cut. */
static void visit_towards(grid *g, double middle, double end)
{
    double whole = end - middle, done = 0;
    while (done < 1) {
        double left = 1 - done, part = fmin(0.33 * left, 0.052 / fabs(whole));
        part = left * fabs(whole) < 1e-5 ? left : part;
        for (int j = 0; j < 3; j++)
            visit_azimuth(g, middle + whole * (done + part * NODE[j]), 2 * WEIGHT[j] * part * fabs(whole));
        done = part < left ? done + part : 1;
    }
}

static void visit_range(grid *g, double from, double to)
{
    visit_towards(g, (from + to) / 2, from);
    visit_towards(g, (from + to) / 2, to);
}

static void visit_all(const oracle *o, const vndf_surface *surface, vndf_vec3 wi, oracle_visitor *visit,
                      void *user, int sides)
{
    grid g = {o, surface, 0, 0, 0, 0, 0, 0, {0}, 0, visit, user, sides, 0};
    stretch(&g, wi);
    make_edges(&g);
    double end = g.c > 0 ? PI : PI / 2, from = 0, turn = -g.c / (g.s * o->breaks[0]);
    /* there the cut meets the break */
    double edge[3] = {PI / 2, fabs(turn) < 1 ? acos(turn) : end, end};
    if (edge[1] < edge[0]) {
        edge[0] = edge[1];
        edge[1] = PI / 2;
    }
    for (int i = 0; i < 3; i++) {
        if (edge[i] > from + 1e-12)
            visit_range(&g, from, edge[i]);
        from = edge[i];
    }
}

void oracle_visit(const oracle *o, const vndf_surface *surface, vndf_vec3 wi, oracle_visitor *visit, void *user)
{
    visit_all(o, surface, wi, visit, user, 2);
}

double oracle_surface_area(const oracle *o, const vndf_surface *surface, vndf_vec3 wi)
{
    grid g = {o, surface, 0, 0, 0, 0, 0, 0, {0}, 0, NULL, NULL, 1, 0};
    stretch(&g, wi);
    return g.area;
}

double oracle_visible(const oracle *o, const vndf_surface *surface, vndf_vec3 wi, vndf_vec3 wm, double area)
{
    double ax = surface->alpha_x, ay = surface->alpha_y, z = wm.z;
    double l = sqrt((double)wi.x * wi.x + (double)wi.y * wi.y + (double)wi.z * wi.z);
    double mask = ((double)wi.x * wm.x + (double)wi.y * wm.y + (double)wi.z * wm.z) / l;
    return mask > 0 ? oracle_p22(o, hypot(wm.x / ax, wm.y / ay) / z) * mask / (area * ax * ay * z * z * z * z) : 0;
}

/* ---- findings ---- */

typedef struct validation {
    vndf_view view;
    double heavy;
    oracle_finding finding;
} validation;

static void measure(const oracle_point *point, void *user)
{
    validation *v = user;
    double pdf = vndf_pdf(&v->view, point->wm);
    v->finding.mass += pdf * point->weight;
    v->finding.reference += point->reference * point->weight;
    v->finding.tv += fabs(pdf - point->reference) * point->weight / 2;
    v->finding.heavier += point->reference > v->heavy * pdf ? point->reference * point->weight : 0;
}

oracle_finding oracle_validate(const oracle *o, const vndf_surface *surface, vndf_vec3 wi, double heavy)
{
    validation v = {vndf_view_from(surface, wi), heavy, {0, 0, 0, 0, 0}};
    double area = oracle_surface_area(o, surface, wi);
    v.finding.area_error = fabs((double)vndf_projected_area(surface, wi) / area - 1);
    visit_all(o, surface, wi, measure, &v, 1); /* pdf and reference are even in the azimuth */
    return v.finding;
}

vndf_vec3 oracle_direction(double theta, double phi)
{
    double t = theta * PI / 180, p = phi * PI / 180, s = sin(t);
    vndf_vec3 w = {(float)(s * cos(p)), (float)(s * sin(p)), theta == 90 ? 0.0f : (float)cos(t)};
    return w;
}
