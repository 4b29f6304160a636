#include "fit/cells.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

/* ---- points ---- */

static void push(vndf_points *points, vndf_point point)
{
    if (points->count == points->capacity) {
        size_t capacity = points->capacity ? 2 * points->capacity : 1024;
        vndf_point *at = realloc(points->at, capacity * sizeof *at);
        if (!at) {
            points->starved = 1;
            return;
        }
        points->at = at;
        points->capacity = capacity;
    }
    points->at[points->count++] = point;
}

void vndf_points_free(vndf_points *points)
{
    free(points->at);
    *points = (vndf_points){NULL, 0, 0, 0};
}

/* Panels that are too narrow to be told apart, or hold next to nothing, while they are gathered. */
typedef struct heap {
    double from, to, mass, first; /* first: integral of f R dR */
} heap;

static void end_heap(vndf_points *points, const vndf_span *span, heap *h)
{
    double r = h->mass > 0 ? h->first / h->mass : h->from;
    double xi0 = vndf_span_place(span, h->from), xi1 = vndf_span_place(span, h->to);
    if (h->to > h->from)
        push(points, (vndf_point){r, h->mass, (xi0 + xi1) / 2, xi1 - xi0});
    *h = (heap){0, 0, 0, 0};
}

/* Of the mass, and of that at grazing incidence: for no direction that is claimed does a part so small count. */
static const double LITTLE = 1e-10, LITTLE_GRAZING = 1e-14;

static int is_little(const vndf_profile *profile, const vndf_panel *p)
{
    return p->m0 < LITTLE * profile->f0 && p->m0 * p[1].r < LITTLE_GRAZING * profile->f1;
}

/* Adds what lies between two slopes, in one panel, whose points these are. */
static void add_part(vndf_points *points, const vndf_span *span, heap *h, double from, double to, int little,
                     const vndf_profile_point *rule)
{
    int narrow = to - from < VNDF_GRAIN * to || little;
    double log_width = log(to / from);
    if (!narrow || (!little && to - h->from >= VNDF_GRAIN * to))
        end_heap(points, span, h);
    if (narrow && h->to == 0)
        h->from = from;
    for (int i = 0; i < VNDF_GAUSS; i++) {
        double r = rule[i].r, mass = 2 * PI * rule[i].weight, dr = vndf_gauss_weight[i] * log_width * r;
        if (!narrow) {
            push(points, (vndf_point){r, mass, vndf_span_place(span, r), dr * vndf_span_density(span, r)});
            continue;
        }
        h->mass += mass;
        h->first += mass * r;
    }
    if (narrow)
        h->to = to;
}

/* The same for a panel that a knot cuts. */
static void add_cut_part(vndf_points *points, const vndf_profile *profile, const vndf_span *span, heap *h,
                         double from, double to)
{
    vndf_profile_point rule[VNDF_GAUSS];
    if (!(to > from))
        return;
    vndf_profile_rule(profile, from, to, rule);
    add_part(points, span, h, from, to, 0, rule);
}

/* What lies beyond the panels, at one place. */
static void add_rest(vndf_points *points, const vndf_profile *profile, const vndf_span *span)
{
    double end = profile->panel[profile->count].r, m0 = profile->tail_m0, m1 = profile->tail_m1 + end * m0;
    double before = vndf_span_place(span, end);
    if (m0 > 0)
        push(points, (vndf_point){m1 / m0, 2 * PI * m0, (1 + before) / 2, 1 - before});
}

void vndf_points_add(vndf_points *points, const vndf_profile *profile, const vndf_span *span, double end)
{
    const vndf_panel *p = profile->panel;
    size_t count = profile->count;
    heap h = {0, 0, 0, 0};
    for (size_t i = vndf_profile_panel(profile, span->r); i < count && p[i].r < end; i++) {
        double from = fmax(p[i].r, span->r), to = fmin(p[i + 1].r, end);
        if (from == p[i].r && to == p[i + 1].r)
            add_part(points, span, &h, from, to, is_little(profile, &p[i]), profile->point + i * VNDF_GAUSS);
        else
            add_cut_part(points, profile, span, &h, from, to);
    }
    end_heap(points, span, &h);
    if (end == HUGE_VAL)
        add_rest(points, profile, span);
}

/* ---- numbers ---- */

static const double INSIDE = 1.5e-7; /* of the slope: a float into the cell, where P22 may jump beside the knot */
static const double END_LEAST = 0.02, END_MOST = 300; /* of the mean: for poles, zeros and light tails */
static const double MASS_LEAST = 1e-30, LEAST = 1e-36, MOST = 1e30;
static const double NEAR_END = 4e-2; /* 1 - xi where the limit of a tail is read */

static vndf_cell moments_of(const vndf_span *span, const vndf_point *point, size_t count)
{
    vndf_cell sum = {0, 0, 0, 0, 0, 0};
    for (size_t i = 0; i < count; i++) {
        double r = point[i].r, t = r - span->r, m = point[i].mass / r;
        sum.m0 += m;
        sum.m1 += m * t;
        sum.m2 += m * t * t;
        sum.m4 += m / (r * r * r);
    }
    return sum;
}

/* 2 pi P22 h/z^4 at a slope, where d xi/dR = z^2/h. */
static double end_at(const vndf_profile *profile, const vndf_span *span, double r)
{
    double z = 1 / (1 + r);
    return 2 * PI * vndf_profile_p22(profile, r) / (z * z * vndf_span_density(span, r));
}

static double clipped(double value, double mean)
{
    return fmin(fmax(value, END_LEAST * mean), END_MOST * mean);
}

/* Where D is known beside a knot: inside the cell, since P22 may jump there. */
static double beside(const vndf_span *span, double end, int outer)
{
    double width = end - span->r, step = fmin(INSIDE * (outer ? end : span->r), width / 32);
    if (outer)
        return end - step;
    return span->r > 0 ? span->r + step : 1e-6 * width;
}

static void put_ends(const vndf_profile *profile, const vndf_span *span, double end, vndf_cell *cell)
{
    int tail = end == HUGE_VAL;
    double r = span->r, z0 = span->z, z1 = tail ? 0 : z0 - span->h;
    double far = tail ? 1 / (z0 * pow(NEAR_END, span->power)) - 1 : beside(span, end, 1);
    double mass1 = tail ? cell->m2 + (2 * cell->m1 + cell->m0 * r) * r : cell->m0 / (z1 * z1);
    cell->g0 =
        clipped(end_at(profile, span, tail ? r * (1 + INSIDE) : beside(span, end, 0)), cell->m0 / (z0 * z0));
    cell->g1 = clipped(end_at(profile, span, far), mass1);
}

/* Raises the moments to those of an even density that floats can hold. */
static void keep_positive(const vndf_span *span, double end, vndf_cell *cell)
{
    double width = end < HUGE_VAL ? end - span->r : span->r;
    double third = span->r > 0 ? span->r * span->r * span->r : HUGE_VAL;
    if (cell->m0 < MASS_LEAST) {
        double m = MASS_LEAST;
        *cell = (vndf_cell){0, 0, m, m * width / 2, m * width * width / 3, m / third};
    }
    cell->m1 = fmax(cell->m1, LEAST);
    cell->m2 = fmax(cell->m2, LEAST);
    cell->m4 = cell->m4 > LEAST ? fmin(cell->m4, MOST) : 0;
}

vndf_cell vndf_cell_measure(const vndf_profile *profile, const vndf_span *span, double end,
                            const vndf_point *point, size_t count)
{
    vndf_cell cell = moments_of(span, point, count);
    keep_positive(span, end, &cell);
    if (span->r == 0) { /* no law reads these two; the first may be infinite */
        cell.m0 = 2 * cell.m1 / end;
        cell.m4 = 0;
    }
    put_ends(profile, span, end, &cell);
    return cell;
}
