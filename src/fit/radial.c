/* A cell counts by what it adds to the total variation: of the directions above the horizon together with all other
 * cells, for whose laws f and R f stand; below it nearly alone, since those see little beyond rho, and rho cuts the
 * cell. */
#include "fit/radial.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;
static const double BELOW = 2.5e-3;               /* weight of an error below the horizon */
static const double AREA = 0.3;                   /* of an error of the area */
static const double ENOUGH = 1e-9;                /* no cell with a smaller error is cut */
static const double SHARE0 = 0.45, SHARE1 = 0.55; /* of the law below, about */
static const double KNOT_LEAST = 1e-10, KNOT_MOST = 0x1p29;
static const double RHO_MOST = 0x1p20; /* claims end there */
static const double UNRESOLVED =
    0.02; /* part of a cell's mass that strays from what is drawn: it holds features */

/* ---- the error of a cell ---- */

/* |drawn - true| of a point; what is drawn far too rarely counts more often, since it decides the largest weight. */
static double miss_of(double seen, double drawn)
{
    const double rarely = 2, more = 6;
    return seen > rarely * drawn ? more * seen : fabs(seen - drawn);
}

/* A cell and its points. */
typedef struct view {
    vndf_knot from, to;
    vndf_span span;
    vndf_cell cell;
    const vndf_point *point;
    size_t count;
} view;

/* Half the integral of |drawn - true| for the weight W, before a part of the cell is cut off. */
static double miss_by(const view *v, const vndf_weight *w)
{
    vndf_drawn drawn = vndf_drawn_by(&v->span, &v->cell, w);
    double sum = 0;
    for (size_t i = 0; i < v->count; i++) {
        const vndf_point *p = &v->point[i];
        double weight = w->w1 * p->r + w->w0;
        sum += miss_of(p->mass * weight, vndf_drawn_part(&drawn, p->xi, p->width));
    }
    return sum / 2;
}

/* The same from below, from a rho before the cell's end; over all that is seen from there. */
static double miss_below(const vndf_radial *radial, const view *v, double rho)
{
    double mass = 0, sum = 0, seen = SHARE0 * 2 * PI * vndf_profile_s(radial->profile, rho);
    double xi0 = rho > v->span.r ? vndf_span_place(&v->span, rho) : 0, per = 1 / (1 - xi0);
    vndf_drawn drawn = vndf_drawn_below(&v->span, &v->cell, rho, SHARE0, SHARE1);
    for (size_t i = 0; i < v->count; i++) {
        double way = v->point[i].r - rho;
        mass += way > 0 ? v->point[i].mass * way * (SHARE0 + SHARE1 * way / v->point[i].r) : 0;
    }
    if (!(mass > 0))
        return 0;
    drawn = (vndf_drawn){1, xi0 > 0 ? 0 : drawn.d0 / mass, drawn.d1 / (per * mass)};
    for (size_t i = 0; i < v->count; i++) {
        const vndf_point *p = &v->point[i];
        double way = fmax(p->r - rho, 0), true_part = p->mass * way * (SHARE0 + SHARE1 * way / p->r) / mass;
        if (p->xi + p->width / 2 > xi0)
            sum += miss_of(true_part, vndf_drawn_part(&drawn, (p->xi - xi0) * per, p->width * per));
    }
    return sum / 2 * fmin(mass / seen, 1);
}

/* The worst of some rho: at the cell's left knot, inside, or the last that counts. */
static double worst_below(const vndf_radial *radial, const view *v)
{
    const vndf_span *span = &v->span;
    double middle = span->power > 0 ? 1.5 * span->r : span->r + 0.4 * span->h / (span->z * span->z);
    if (radial->last <= span->r)
        return miss_below(radial, v, radial->last);
    return fmax(span->r > 0 ? miss_below(radial, v, span->r) : 0,
                miss_below(radial, v, fmin(middle, radial->last)));
}

/* By how much the spline errs in the middle of the cell, where x = c/(c + s): of the area above the horizon, or of what
 * is left of it below, while that is not much smaller. */
static double area_miss(const vndf_profile *profile, const view *v)
{
    const double smaller = 0.02;
    int tail = v->span.power > 0;
    double x0 = v->span.x, x1 = tail ? 1 : x0 + v->span.h, x = (x0 + x1) / 2;
    double a0 = v->from.area.below + x0, a1 = v->to.area.below + x1,
           d0 = 1 - v->from.area.turned - v->from.area.along;
    double d1 = 1 - v->to.area.turned - v->to.area.along, below = vndf_profile_below(profile, 1 - x, x).below;
    double miss = fabs((a0 + a1) / 2 + (x1 - x0) * (d0 - d1) / 8 - below - x);
    return miss / fmax(below, smaller * x);
}

static double error_of(const vndf_radial *radial, const view *v)
{
    const vndf_profile *profile = radial->profile;
    const vndf_weight near = {0, 1, 0, 0}, grazing = {1, 0, 0, 0};
    double error = fmax(miss_by(v, &near), miss_by(v, &grazing) / (2 * PI * profile->f1));
    double mass = v->cell.m1 + v->span.r * v->cell.m0;
    if (v->span.r == 0) /* there and in the tail k~ has no pole, and strays more */
        error += mass * (v->span.h / v->span.z) / (8 * profile->f1 * PI);
    if (v->span.power > 0)
        error += mass / 8;
    return fmax(fmax(error, BELOW * worst_below(radial, v)), AREA * area_miss(profile, v));
}

/* ---- cuts ---- */

/* The slope before which half of |drawn - true| lies: within a feature that the cell does not resolve. */
static double unresolved(const view *v)
{
    const vndf_weight near = {0, 1, 0, 0};
    vndf_drawn drawn = vndf_drawn_by(&v->span, &v->cell, &near);
    double all = 2 * miss_by(v, &near), sum = 0;
    if (!(all > 2 * UNRESOLVED * drawn.mass))
        return 0;
    for (size_t i = 0; i < v->count; i++) {
        const vndf_point *p = &v->point[i];
        sum += fabs(p->mass - vndf_drawn_part(&drawn, p->xi, p->width));
        if (sum > all / 2)
            return p->r;
    }
    return 0;
}

/* The nearest float that may be a knot beside one at r: cells that cannot be cut are narrower than VNDF_GRAIN. */
static float apart(float r, int up)
{
    const float width = 0x1p-22f;
    return up ? r * (1 + width) : r * (1 - width);
}

/* The place of a cut, some floats from both ends; 0 if there is none. */
static float cut_of(const view *v, float from, float to)
{
    double z = 1 / (1 + (double)from), middle = 2 * (double)from, own = unresolved(v);
    if (to < HUGE_VALF)
        middle = (from * z + to / (1 + (double)to)) / (z + 1 / (1 + (double)to));
    float first = apart(from, 1), last = to < HUGE_VALF ? apart(to, 0) : HUGE_VALF;
    float at = (float)(own > 0 && (to < HUGE_VALF || own < 4 * (double)from) ? own : middle);
    at = at < first ? first : at > last ? last : at;
    return at >= first && at <= last && at >= KNOT_LEAST && at <= KNOT_MOST ? at : 0.0f;
}

static vndf_interval interval_of(vndf_radial *radial, vndf_knot from, vndf_knot to)
{
    const vndf_profile *profile = radial->profile;
    int tail = !(to.r < HUGE_VALF);
    double end = tail ? HUGE_VAL : to.r;
    view v = {.from = from, .to = to};
    v.span = tail ? vndf_span_of_tail(from.r, radial->squarings) : vndf_span_between(from.r, to.r);
    radial->points.count = 0;
    vndf_points_add(&radial->points, profile, &v.span, end);
    v.point = radial->points.at;
    v.count = radial->points.count;
    v.cell = vndf_cell_measure(profile, &v.span, end, v.point, v.count);
    vndf_interval made = {from, to, error_of(radial, &v), cut_of(&v, from.r, to.r)};
    return made;
}

/* ---- the first knots ---- */

enum { OCTAVES = 4, JUMPS_MAX = 16 };
static const double BESIDE = 1e-9, WIDELY = 1e-4; /* of a slope: just beyond a jump or a pole, and away from it */
static const double NARROW = 1e-10;               /* of a slope: a panel that a jump or a pole made */
static const double SAME = 1e-12;                 /* of a slope: a panel begins at a break */
static const double JUMP_LEAST = 1e-4, POLE_LEAST = 1.5;
static const double JUMP_MASS = 1e-12; /* of P r^2: what is worth a knot */
static const double NOTHING = 1e-12;   /* of the mass: octaves with less need no knot */

/* A jump or a pole; a knot there has the side with more normals in one cell. */
static int jumps_at(const vndf_profile *profile, double r, int *up)
{
    double before = vndf_profile_p22(profile, r * (1 - BESIDE)),
           after = vndf_profile_p22(profile, r * (1 + BESIDE));
    double around = fmax(vndf_profile_p22(profile, r * (1 - WIDELY)), vndf_profile_p22(profile, r * (1 + WIDELY)));
    double most = fmax(before, after);
    *up = before > after;
    return most * r * r > JUMP_MASS && (fabs(before - after) > JUMP_LEAST * most || most > POLE_LEAST * around);
}

/* Whether a panel may begin at a jump: it is narrow, or begins at a break of the source, the next of which is given. */
static int may_jump(const vndf_profile *profile, size_t i, size_t *next)
{
    const vndf_source *source = profile->source;
    const vndf_panel *p = profile->panel;
    double r = p[i].r, own = r * profile->scale;
    while (*next < source->break_count && source->breaks[*next] < own * (1 - SAME))
        ++*next;
    return fmin(p[i + 1].r - r, r - p[i - 1].r) < NARROW * r ||
           (*next < source->break_count && source->breaks[*next] < own * (1 + SAME));
}

static vndf_knot knot_at(const vndf_profile *profile, float r)
{
    double s = 1 / (1 + (double)r);
    return (vndf_knot){r, vndf_profile_below(profile, s, r * s)};
}

static void add_start(vndf_radial *radial, float r)
{
    unsigned i = radial->start;
    for (; i > 0 && radial->knot[i - 1].r > r; i--)
        radial->knot[i] = radial->knot[i - 1];
    radial->knot[i] = knot_at(radial->profile, r);
    radial->start++;
}

/* Whether a float is as far from all knots as knots must be. */
static int is_free(const vndf_radial *radial, float r)
{
    for (unsigned i = 0; i < radial->start; i++)
        if (radial->knot[i].r < apart(r, 1) && radial->knot[i].r > apart(r, 0))
            return 0;
    return r >= KNOT_LEAST && r <= KNOT_MOST;
}

static void add_jumps(vndf_radial *radial)
{
    const vndf_profile *profile = radial->profile;
    unsigned jumps = 0;
    size_t next = 0;
    for (size_t i = 1; i < profile->count && jumps < JUMPS_MAX; i++) {
        double r = profile->panel[i].r;
        int up;
        if (!may_jump(profile, i, &next) || !jumps_at(profile, r, &up))
            continue;
        float knot = (float)r;
        knot = up && knot < r ? nextafterf(knot, HUGE_VALF) : !up && knot > r ? nextafterf(knot, 0.0f) : knot;
        if (is_free(radial, knot)) {
            add_start(radial, knot);
            jumps++;
        }
    }
}

/* Octaves where something lies, about the median 1. */
static void add_octaves(vndf_radial *radial)
{
    const vndf_profile *profile = radial->profile;
    for (int i = -OCTAVES; i <= OCTAVES; i++) {
        float r = ldexpf(1.0f, i);
        const vndf_panel *p = &profile->panel[vndf_profile_panel(profile, r)];
        int before = p[1].f0 > NOTHING * profile->f0, beyond = p->t0 > NOTHING * profile->f0;
        if ((before && beyond && is_free(radial, r)) || (i == OCTAVES && radial->start == 1))
            add_start(radial, r);
    }
}

/* The least with which R^2 P22, by xi, stays finite in the tail. */
static unsigned squarings_of(const vndf_profile *profile)
{
    double end = profile->panel[profile->count].r, p0 = vndf_profile_p22(profile, end / 64);
    double power = log(p0 / vndf_profile_p22(profile, end / 4)) / log(16.0);
    unsigned n = 0;
    while (n < VNDF_SQUARINGS_MAX && power > 3 && (power - 3) * (double)(1u << n) < 1 - 1e-3)
        n++;
    return n;
}

static const vndf_knot OUTSIDE = {HUGE_VALF, {0, 0, 0}};

/* Where next to nothing is seen from below. */
static double last_of(const vndf_profile *profile)
{
    const double margin = 0.5;
    double low = 0x1p-20, high = RHO_MOST, least = margin * vndf_profile_claimed(profile) * profile->f1;
    for (int step = 0; step < 40; step++) {
        double middle = sqrt(low * high);
        if (vndf_profile_s(profile, middle) > least)
            low = middle;
        else
            high = middle;
    }
    return low;
}

int vndf_radial_from(vndf_radial *radial, const vndf_profile *profile)
{
    *radial = (vndf_radial){.profile = profile, .squarings = squarings_of(profile), .last = last_of(profile)};
    add_start(radial, 0.0f);
    add_jumps(radial);
    add_octaves(radial);
    radial->count = radial->start;
    for (unsigned i = 0; i < radial->start; i++)
        radial->interval[i] =
            interval_of(radial, radial->knot[i], i + 1 < radial->start ? radial->knot[i + 1] : OUTSIDE);
    return !radial->points.starved;
}

void vndf_radial_free(vndf_radial *radial)
{
    vndf_points_free(&radial->points);
}

/* ---- more knots ---- */

static int cut_worst(vndf_radial *radial)
{
    unsigned worst = 0, n = radial->count;
    double most = ENOUGH;
    for (unsigned i = 0; i < n; i++)
        if (radial->interval[i].cut > 0 && radial->interval[i].error > most) {
            most = radial->interval[i].error;
            worst = i;
        }
    if (!(most > ENOUGH))
        return 0;
    vndf_interval cell = radial->interval[worst];
    vndf_knot cut = radial->knot[radial->count++] = knot_at(radial->profile, cell.cut);
    radial->interval[worst] = interval_of(radial, cell.from, cut);
    radial->interval[n] = interval_of(radial, cut, cell.to);
    return 1;
}

unsigned vndf_radial_refine(vndf_radial *radial, unsigned count)
{
    while (radial->count < count && !vndf_guard_stopped(radial->profile->guard) && cut_worst(radial)) {
    }
    return radial->count;
}

static int ascending(const void *a, const void *b)
{
    float x = ((const vndf_knot *)a)->r, y = ((const vndf_knot *)b)->r;
    return (x > y) - (x < y);
}

void vndf_radial_knots(const vndf_radial *radial, unsigned count, vndf_knot *knot)
{
    for (unsigned i = 0; i < count; i++)
        knot[i] = radial->knot[i];
    qsort(knot, count, sizeof *knot, ascending);
}
