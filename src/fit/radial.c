/* A cell counts by what it adds to the total variation: of the directions above the horizon together with all other
 * cells, for whose laws f and R f stand; below it nearly alone, since those see little beyond rho, and rho cuts the cell. */
#include "fit/radial.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;
static const double BELOW = 2.5e-3;         /* weight of an error below the horizon */
static const double SHARE0 = 0.45, SHARE1 = 0.55; /* of the law below, about */
static const double KNOT_LEAST = 1e-10, KNOT_MOST = 1 << 21; /* rho is claimed to 2^20 */
static const double UNRESOLVED = 0.02; /* part of a cell's mass that strays from what is drawn: it holds features */
enum { FLOATS_APART = 4 };

/* ---- the error of a cell ---- */

/* A cell and its points. */
typedef struct view {
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
        sum += fabs(p->mass * weight - vndf_drawn_density(&drawn, p->xi) * p->width);
    }
    return sum / 2;
}

/* The same from below, from a rho that lies in the cell; over all that is seen from there. */
static double miss_below(const vndf_radial *radial, const view *v, double rho)
{
    double xi0 = vndf_span_place(&v->span, rho), seen = SHARE0 * 2 * PI * vndf_profile_s(radial->profile, rho);
    double mass = 0, sum = 0;
    vndf_drawn drawn = vndf_drawn_below(&v->span, &v->cell, rho, SHARE0, SHARE1);
    for (size_t i = 0; i < v->count; i++) {
        double way = v->point[i].r - rho;
        mass += way > 0 ? v->point[i].mass * way * (SHARE0 + SHARE1 * way / v->point[i].r) : 0;
    }
    if (!(mass > 0))
        return 0;
    drawn = (vndf_drawn){1, 0, drawn.d1 * (1 - xi0) / mass};
    for (size_t i = 0; i < v->count; i++) {
        const vndf_point *p = &v->point[i];
        double way = p->r - rho;
        if (way > 0)
            sum += fabs(p->mass * way * (SHARE0 + SHARE1 * way / p->r) / mass -
                        vndf_drawn_density(&drawn, (p->xi - xi0) / (1 - xi0)) * p->width / (1 - xi0));
    }
    return sum / 2 * fmin(mass / seen, 1);
}

/* Where no direction is claimed. */
static int is_hidden(const vndf_profile *profile, double rho)
{
    return rho > KNOT_MOST / 2 || !(vndf_profile_s(profile, rho) > vndf_profile_claimed(profile) * profile->f1 / 2);
}

static double error_of(const vndf_radial *radial, const view *v)
{
    const vndf_profile *profile = radial->profile;
    const vndf_weight near = {0, 1, 0, 0}, grazing = {1, 0, 0, 0};
    double middle = v->span.power > 0 ? 1.5 * v->span.r : v->span.r + 0.4 * v->span.h / (v->span.z * v->span.z);
    double error = fmax(miss_by(v, &near), miss_by(v, &grazing) / (2 * PI * profile->f1)), below = 0;
    if (!is_hidden(profile, v->span.r))
        below = fmax(v->span.r > 0 ? miss_below(radial, v, v->span.r) : 0,
                     is_hidden(profile, middle) ? 0 : miss_below(radial, v, middle));
    double mass = v->cell.m1 + v->span.r * v->cell.m0;
    if (v->span.r == 0) /* there and in the tail k~ has no pole, and strays more */
        error += mass * (v->span.h / v->span.z) / (8 * profile->f1 * PI);
    if (v->span.power > 0)
        error += mass / 8;
    return fmax(error, BELOW * below);
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
        sum += fabs(p->mass - vndf_drawn_density(&drawn, p->xi) * p->width);
        if (sum > all / 2)
            return p->r;
    }
    return 0;
}

static float apart(float r, float towards)
{
    for (int i = 0; i < FLOATS_APART; i++)
        r = nextafterf(r, towards);
    return r;
}

/* The place of a cut, some floats from both ends; 0 if there is none. */
static float cut_of(const view *v, float from, float to)
{
    double z = 1 / (1 + (double)from), middle = 2 * (double)from, own = unresolved(v);
    if (to < HUGE_VALF)
        middle = (from * z + to / (1 + (double)to)) / (z + 1 / (1 + (double)to));
    float first = apart(from, HUGE_VALF), last = to < HUGE_VALF ? apart(to, 0.0f) : HUGE_VALF;
    float at = (float)(own > 0 ? own : middle);
    at = at < first ? first : at > last ? last : at;
    return at >= first && at <= last && at >= KNOT_LEAST && at <= KNOT_MOST ? at : 0.0f;
}

static vndf_interval interval_of(vndf_radial *radial, float from, float to)
{
    const vndf_profile *profile = radial->profile;
    int tail = !(to < HUGE_VALF);
    view v = {.span = tail ? vndf_span_of_tail(from, radial->squarings) : vndf_span_between(from, to)};
    double end = tail ? HUGE_VAL : to;
    radial->points.count = 0;
    vndf_points_add(&radial->points, profile, &v.span, end);
    v.point = radial->points.at;
    v.count = radial->points.count;
    v.cell = vndf_cell_measure(profile, &v.span, end, v.point, v.count);
    vndf_interval made = {from, to, error_of(radial, &v), cut_of(&v, from, to)};
    return made;
}

/* ---- the first knots ---- */

enum { OCTAVES = 4, JUMPS_MAX = 64 };
static const double BESIDE = 1e-9, WIDELY = 1e-4; /* of a slope: beyond the panels that a jump or a pole makes */
static const double JUMP_LEAST = 1e-4, POLE_LEAST = 1.5;
static const double JUMP_MASS = 1e-12;  /* of P r^2: what is worth a knot */
static const double NOTHING = 1e-12;    /* of the mass: octaves with less need no knot */

/* A jump or a pole; a knot there has the side with more normals in one cell. */
static int jumps_at(const vndf_profile *profile, double r, int *up)
{
    double before = vndf_profile_p22(profile, r * (1 - BESIDE)), after = vndf_profile_p22(profile, r * (1 + BESIDE));
    double around = fmax(vndf_profile_p22(profile, r * (1 - WIDELY)), vndf_profile_p22(profile, r * (1 + WIDELY)));
    double most = fmax(before, after);
    *up = before > after;
    return most * r * r > JUMP_MASS && (fabs(before - after) > JUMP_LEAST * most || most > POLE_LEAST * around);
}

static void add_start(vndf_radial *radial, float r)
{
    unsigned i = radial->start;
    for (; i > 0 && radial->knot[i - 1] > r; i--)
        radial->knot[i] = radial->knot[i - 1];
    radial->knot[i] = r;
    radial->start++;
}

/* Whether a float is as far from all knots as knots must be. */
static int is_free(const vndf_radial *radial, float r)
{
    for (unsigned i = 0; i < radial->start; i++)
        if (radial->knot[i] < apart(r, HUGE_VALF) && radial->knot[i] > apart(r, 0.0f))
            return 0;
    return r >= KNOT_LEAST && r <= KNOT_MOST;
}

static void add_jumps(vndf_radial *radial)
{
    const vndf_profile *profile = radial->profile;
    unsigned jumps = 0;
    for (size_t i = 1; i < profile->count && jumps < JUMPS_MAX; i++) {
        double r = profile->panel[i].r, z = r;
        int up, narrow = fmin(profile->panel[i + 1].r - r, r - profile->panel[i - 1].r) < WIDELY * r;
        if (!narrow || !jumps_at(profile, r, &up))
            continue;
        float knot = (float)z;
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

int vndf_radial_from(vndf_radial *radial, const vndf_profile *profile)
{
    *radial = (vndf_radial){.profile = profile, .squarings = squarings_of(profile), .knot = {0.0f}, .start = 1};
    add_jumps(radial);
    add_octaves(radial);
    radial->count = radial->start;
    for (unsigned i = 0; i < radial->start; i++)
        radial->interval[i] =
            interval_of(radial, radial->knot[i], i + 1 < radial->start ? radial->knot[i + 1] : HUGE_VALF);
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
    double most = 0;
    for (unsigned i = 0; i < n; i++)
        if (radial->interval[i].cut > 0 && radial->interval[i].error > most) {
            most = radial->interval[i].error;
            worst = i;
        }
    if (!(most > 0))
        return 0;
    vndf_interval cell = radial->interval[worst];
    radial->interval[worst] = interval_of(radial, cell.from, cell.cut);
    radial->interval[n] = interval_of(radial, cell.cut, cell.to);
    radial->knot[radial->count++] = cell.cut;
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
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

void vndf_radial_knots(const vndf_radial *radial, unsigned count, float *knot)
{
    for (unsigned i = 0; i < count; i++)
        knot[i] = radial->knot[i];
    qsort(knot, count, sizeof *knot, ascending);
}
