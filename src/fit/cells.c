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
        points->starved |= !at;
        if (!at)
            return;
        points->at = at;
        points->capacity = capacity;
    }
    points->at[points->count++] = point;
}

/* Panels that become one point, while they are gathered. */
typedef struct heap {
    double from, to, mass, first; /* first: integral of f R dR */
} heap;

static void end_heap(vndf_points *points, const vndf_cell *cell, heap *h)
{
    double xi0 = vndf_cell_place(cell, h->from), xi1 = vndf_cell_place(cell, h->to);
    if (h->to > h->from)
        push(points,
             (vndf_point){h->mass > 0 ? h->first / h->mass : h->from, h->mass, (xi0 + xi1) / 2, xi1 - xi0});
    *h = (heap){0, 0, 0, 0};
}

/* Adds what lies between two slopes, in one panel, whose points these are. */
static void add_part(vndf_points *points, const vndf_profile *profile, const vndf_cell *cell, heap *h, double from,
                     double to, const vndf_profile_point *rule)
{
    /* of the mass, and of that at grazing incidence: for no direction that is claimed does a part so small count */
    const double few = 1e-10, few_grazing = 1e-14;
    double mass = 0, log_width = log(to / from);
    for (int i = 0; i < VNDF_GAUSS; i++)
        mass += rule[i].weight;
    int little = mass < few * profile->f0 && mass * to < few_grazing * profile->f1;
    int gathered = little || to - from < VNDF_GRAIN * to;
    if (!gathered || (!little && to - h->from >= VNDF_GRAIN * to))
        end_heap(points, cell, h);
    if (gathered) {
        h->from = h->to == 0 ? from : h->from;
        h->to = to;
    }
    for (int i = 0; i < VNDF_GAUSS; i++) {
        double r = rule[i].r, m = 2 * PI * rule[i].weight, dr = vndf_gauss_weight[i] * log_width * r;
        if (!gathered)
            push(points, (vndf_point){r, m, vndf_cell_place(cell, r), dr * vndf_cell_density(cell, r)});
        h->mass += gathered ? m : 0;
        h->first += gathered ? m * r : 0;
    }
}

static void add_points(vndf_points *points, const vndf_profile *profile, const vndf_cell *cell, double end)
{
    const vndf_panel *p = profile->panel;
    double last = p[profile->count].r, m0 = profile->tail_m0, before = vndf_cell_place(cell, last);
    heap h = {0, 0, 0, 0};
    for (size_t i = vndf_profile_panel(profile, cell->r); i < profile->count && p[i].r < end; i++) {
        double from = fmax(p[i].r, cell->r), to = fmin(p[i + 1].r, end);
        vndf_profile_point cut[VNDF_GAUSS], *rule = profile->point + i * VNDF_GAUSS;
        if (from > p[i].r || to < p[i + 1].r)
            vndf_profile_rule(profile, from, to, rule = cut);
        if (to > from)
            add_part(points, profile, cell, &h, from, to, rule);
    }
    end_heap(points, cell, &h);
    if (end == HUGE_VAL && m0 > 0) /* what lies beyond the panels, at one place */
        push(points, (vndf_point){profile->tail_m1 / m0 + last, 2 * PI * m0, (1 + before) / 2, 1 - before});
}

/* ---- numbers ---- */

static const double INSIDE = 1.5e-7; /* of the slope: a float into the cell, where P22 may jump beside the knot */
static const double END_LEAST = 0.02, END_MOST = 300; /* of the mean: for poles, zeros and light tails */
static const double MASS_LEAST = 1e-30, LEAST = 1e-36, MOST = 1e30;
static const double NEAR_END = 4e-2; /* 1 - xi where the limit of a tail is read */

/* 2 pi P22 h/z^4 at a slope, where d xi/dR = z^2/h, within bounds about the mean. */
static double end_at(const vndf_profile *profile, const vndf_cell *cell, double r, double mean)
{
    double z = 1 / (1 + r), value = 2 * PI * vndf_profile_p22(profile, r) / (z * z * vndf_cell_density(cell, r));
    return fmin(fmax(value, END_LEAST * mean), END_MOST * mean);
}

static void put_ends(const vndf_profile *profile, double end, vndf_cell *c)
{
    double r = c->r, mean0 = c->m0 / (c->z * c->z), width = end - r;
    if (end == HUGE_VAL) {
        double far = 1 / (c->z * pow(NEAR_END, c->power)) - 1;
        c->g0 = end_at(profile, c, r * (1 + INSIDE), mean0);
        c->g1 = end_at(profile, c, far, c->m2 + (2 * c->m1 + c->m0 * r) * r);
        return;
    }
    double z1 = c->z - c->h, first = r > 0 ? fmin(INSIDE * r, width / 32) : 1e-6 * width;
    c->g0 = end_at(profile, c, r + first, mean0);
    c->g1 = end_at(profile, c, end - fmin(INSIDE * end, width / 32), c->m0 / (z1 * z1));
}

vndf_cell vndf_cell_measure(const vndf_profile *profile, double from, double end, unsigned squarings,
                            vndf_points *points, size_t first)
{
    vndf_cell c = vndf_cell_between(from, end, squarings);
    points->count = first;
    add_points(points, profile, &c, end);
    for (size_t i = first; i < points->count; i++) {
        double r = points->at[i].r, t = r - from, m = points->at[i].mass / r;
        c.m0 += m;
        c.m1 += m * t;
        c.m2 += m * t * t;
        c.cube += m / (r * r * r);
    }
    c.cube = c.m0 > 0 ? c.cube / c.m0 : 0;
    if (c.m0 < MASS_LEAST) { /* an even density that floats can hold */
        double width = end < HUGE_VAL ? end - from : from;
        c.m0 = MASS_LEAST;
        c.m1 = c.m0 * width / 2;
        c.m2 = c.m0 * width * width / 3;
        c.cube = 1 / (from * from * from);
    }
    c.m1 = fmax(c.m1, LEAST);
    c.m2 = fmax(c.m2, LEAST);
    c.cube = c.cube > LEAST ? fmin(fmin(c.cube, 1 / (from * from * from)), MOST) : 0;
    if (from == 0) { /* no law reads these two; the first may be infinite */
        c.m0 = 2 * c.m1 / end;
        c.cube = 0;
    }
    put_ends(profile, end, &c);
    return c;
}
