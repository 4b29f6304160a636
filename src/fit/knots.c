/* A cell counts by what it adds to the total variation: of the directions above the horizon together with all other
 * cells, for whose laws f and R f stand; below it nearly alone, since those see little beyond rho, and rho cuts the
 * cell. */
#include "fit/knots.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;
static const double BELOW = 2.5e-3;               /* weight of an error below the horizon, */
static const double AREA = 0.3;                   /* of an error of the area, */
static const double DENSITY = 2e-4;               /* and of the largest error of D */
static const double FIRST = 1e-3;                 /* of the width of the first cell, where D errs by twice that */
static const double ENOUGH = 1e-9;                /* no cell with a smaller error is cut */
static const double SHARE0 = 0.45, SHARE1 = 0.55; /* of the law below, about */
static const double KNOT_LEAST = 1e-10, KNOT_MOST = 0x1p29;
static const double RHO_MOST = 0x1p20; /* claims end there */

/* A cell and its points. */
typedef struct view {
    const vndf_profile *profile;
    vndf_knot from, to;
    vndf_cell cell;
    const vndf_point *point;
    size_t count;
} view;

/* ---- the error of a cell ---- */

/* |drawn - true| of a point; what is drawn far too rarely counts more often, since it decides the largest weight. */
static double miss_of(double seen, double drawn)
{
    const double rarely = 2, more = 6;
    return seen > rarely * drawn ? more * seen : fabs(seen - drawn);
}

/* Half the integral of |drawn - true| for the weight w1 R^2 + w0 R. */
static double miss_by(const view *v, double w1, double w0)
{
    const vndf_weight w = {w1, w0, 0, 0};
    vndf_drawn drawn = vndf_drawn_by(&v->cell, &w);
    double sum = 0;
    for (size_t i = 0; i < v->count; i++) {
        const vndf_point *p = &v->point[i];
        sum += miss_of(p->mass * (w1 * p->r + w0), vndf_drawn_part(&drawn, p->xi, p->width));
    }
    return sum / 2;
}

/* The same from below, from a rho before the cell's end; over all that is seen from there. */
static double miss_below(const view *v, double rho)
{
    double mass = 0, sum = 0, seen = SHARE0 * 2 * PI * vndf_profile_s(v->profile, rho);
    double xi0 = rho > v->cell.r ? vndf_cell_place(&v->cell, rho) : 0, per = 1 / (1 - xi0);
    vndf_drawn drawn = vndf_drawn_below(&v->cell, rho, SHARE0, SHARE1);
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
static double worst_below(const view *v, double last)
{
    const vndf_cell *c = &v->cell;
    double middle = c->power > 0 ? 1.5 * c->r : c->r + 0.4 * c->h / (c->z * c->z);
    if (last <= c->r)
        return miss_below(v, last);
    return fmax(c->r > 0 ? miss_below(v, c->r) : 0, miss_below(v, fmin(middle, last)));
}

/* By how much the spline errs in the middle of the cell, where x = c/(c + s): of the area above the horizon, or of what
 * is left of it below, while that is not much smaller. */
static double area_miss(const view *v)
{
    const double smaller = 0.02;
    double x0 = v->cell.x, x1 = v->cell.power > 0 ? 1 : x0 + v->cell.h, x = (x0 + x1) / 2;
    double a0 = v->from.area.below + x0, a1 = v->to.area.below + x1,
           d0 = 1 - v->from.area.turned - v->from.area.along;
    double d1 = 1 - v->to.area.turned - v->to.area.along, below = vndf_profile_below(v->profile, 1 - x, x).below;
    double miss = fabs((a0 + a1) / 2 + (x1 - x0) * (d0 - d1) / 8 - below - x);
    return miss / fmax(below, smaller * x);
}

/* The largest relative error of f, in a cell with more than a small part of the mass. */
static double density_miss(const view *v, double mass)
{
    const double small = 1e-3;
    const vndf_weight all = {0, 1, 0, 0};
    vndf_drawn drawn = vndf_drawn_by(&v->cell, &all);
    double worst = 0;
    for (size_t i = 0; i < v->count && v->cell.power == 0; i++)
        if (v->point[i].mass > 0)
            worst = fmax(worst,
                         fabs(vndf_drawn_part(&drawn, v->point[i].xi, v->point[i].width) / v->point[i].mass - 1));
    return fmin(worst, 1) * fmin(mass / small, 1);
}

static double error_of(const view *v, double last)
{
    double f1 = 2 * PI * v->profile->f1, mass = v->cell.m1 + v->cell.r * v->cell.m0;
    double error = fmax(miss_by(v, 0, 1), miss_by(v, 1, 0) / f1);
    if (v->cell.r == 0) /* there and in the tail k~ has no pole, and strays more */
        error += mass * (v->cell.h / v->cell.z) / (4 * f1) + FIRST * v->cell.h;
    if (v->cell.power > 0)
        error += mass / 8;
    error = fmax(error, DENSITY * density_miss(v, mass));
    return fmax(error, fmax(BELOW * worst_below(v, last), AREA * area_miss(v)));
}

/* ---- cuts ---- */

/* The slope before which half of |drawn - true| lies, if a part of the cell's mass strays: within a feature that the
 * cell does not resolve. */
static double unresolved(const view *v)
{
    const double part = 0.02, nothing = 1e-20;
    const vndf_weight near = {0, 1, 0, 0};
    vndf_drawn drawn = vndf_drawn_by(&v->cell, &near);
    double all = 2 * miss_by(v, 0, 1), sum = 0;
    for (size_t i = 0; i < v->count && all > fmax(2 * part * drawn.mass, nothing); i++) {
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

static vndf_interval interval_of(vndf_knots *knots, vndf_knot from, vndf_knot to)
{
    view v = {.profile = knots->profile, .from = from, .to = to};
    v.cell = vndf_cell_measure(v.profile, from.r, to.r, knots->squarings, &knots->points, 0);
    v.point = knots->points.at;
    v.count = knots->points.count;
    return (vndf_interval){from, to, error_of(&v, knots->last), cut_of(&v, from.r, to.r)};
}

/* ---- the first knots ---- */

static vndf_knot knot_at(const vndf_profile *profile, float r)
{
    double s = 1 / (1 + (double)r);
    return (vndf_knot){r, vndf_profile_below(profile, s, r * s)};
}

/* Keeps knots ascending; 0 if there is one as near as knots must not be. */
static int add_start(vndf_knots *knots, float r)
{
    unsigned i = knots->start;
    for (unsigned k = 0; k < knots->start; k++)
        if (knots->knot[k].r < apart(r, 1) && knots->knot[k].r > apart(r, 0))
            return 0;
    if (!(r == 0 || (r >= KNOT_LEAST && r <= KNOT_MOST)))
        return 0;
    for (; i > 0 && knots->knot[i - 1].r > r; i--)
        knots->knot[i] = knots->knot[i - 1];
    knots->knot[i] = knot_at(knots->profile, r);
    knots->start++;
    return 1;
}

/* A jump or a pole; a knot there has the side with more normals in one cell. */
static int jumps_at(const vndf_profile *profile, double r, int *up)
{
    const double beside = 1e-9, widely = 1e-4; /* of the slope: just beyond it, and away from it */
    const double jump_least = 1e-4, pole_least = 1.5, worth = 1e-12;
    double before = vndf_profile_p22(profile, r * (1 - beside)),
           after = vndf_profile_p22(profile, r * (1 + beside));
    double around = fmax(vndf_profile_p22(profile, r * (1 - widely)), vndf_profile_p22(profile, r * (1 + widely)));
    double most = fmax(before, after);
    *up = before > after;
    return most * r * r > worth && (fabs(before - after) > jump_least * most || most > pole_least * around);
}

/* A jump or a pole made panels narrow, or is a break of the source, where a panel begins. */
static void add_jumps(vndf_knots *knots)
{
    enum { JUMPS_MAX = 16 };
    const double narrow = 1e-10, same = 1e-12; /* of a slope */
    const vndf_profile *profile = knots->profile;
    const vndf_source *source = profile->source;
    const vndf_panel *p = profile->panel;
    unsigned jumps = 0;
    for (size_t i = 1, next = 0; i < profile->count && jumps < JUMPS_MAX; i++) {
        double r = p[i].r, own = r * profile->scale;
        int up;
        while (next < source->break_count && source->breaks[next] < own * (1 - same))
            next++;
        int is_break = next < source->break_count && source->breaks[next] < own * (1 + same);
        if ((!is_break && fmin(p[i + 1].r - r, r - p[i - 1].r) >= narrow * r) || !jumps_at(profile, r, &up))
            continue;
        float knot = (float)r;
        knot = up && knot < r ? nextafterf(knot, HUGE_VALF) : !up && knot > r ? nextafterf(knot, 0.0f) : knot;
        jumps += (unsigned)add_start(knots, knot);
    }
}

/* Octaves about the median 1, where something lies. */
static void add_octaves(vndf_knots *knots)
{
    enum { OCTAVES = 4 };
    const double nothing = 1e-12;
    const vndf_profile *profile = knots->profile;
    for (int i = -OCTAVES; i <= OCTAVES; i++) {
        float r = ldexpf(1.0f, i);
        const vndf_panel *p = &profile->panel[vndf_profile_panel(profile, r)];
        int before = p[1].f0 > nothing * profile->f0, beyond = p->t0 > nothing * profile->f0;
        if ((before && beyond) || (i == OCTAVES && knots->start == 1))
            add_start(knots, r);
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

int vndf_knots_from(vndf_knots *knots, const vndf_profile *profile)
{
    const vndf_knot outside = {HUGE_VALF, {0, 0, 0}};
    *knots = (vndf_knots){.profile = profile, .squarings = squarings_of(profile), .last = last_of(profile)};
    add_start(knots, 0.0f);
    add_jumps(knots);
    add_octaves(knots);
    knots->count = knots->start;
    for (unsigned i = 0; i < knots->start; i++)
        knots->interval[i] =
            interval_of(knots, knots->knot[i], i + 1 < knots->start ? knots->knot[i + 1] : outside);
    return !knots->points.starved;
}

/* ---- more knots ---- */

unsigned vndf_knots_refine(vndf_knots *knots, unsigned count)
{
    while (knots->count < count && !vndf_guard_stopped(knots->profile->guard)) {
        unsigned worst = 0, n = knots->count;
        double most = ENOUGH;
        for (unsigned i = 0; i < n; i++)
            if (knots->interval[i].cut > 0 && knots->interval[i].error > most) {
                most = knots->interval[i].error;
                worst = i;
            }
        if (!(most > ENOUGH))
            break;
        vndf_interval cell = knots->interval[worst];
        vndf_knot cut = knots->knot[knots->count++] = knot_at(knots->profile, cell.cut);
        knots->interval[worst] = interval_of(knots, cell.from, cut);
        knots->interval[n] = interval_of(knots, cut, cell.to);
    }
    return knots->count;
}
