/* A cell counts by what it adds to the total variation: of the directions above the horizon together with all other
 * cells, for whose laws f and R f stand; below it nearly alone, since those see little beyond rho, and rho cuts the
 * cell. Knots are as far apart as one error allows: from 0 on each cell is as long as it may be. */
#include "fit/draft.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
/* Weights of the errors of a cell. */
static const double BELOW = 1.4e-2;     /* seen from below the horizon, ... */
static const double FLOOR_BELOW = 2e-3; /* ... beyond what k~ hides there anyway, */
static const double FLOOR_ERROR = 1e-5; /* or less of it where cells err by less than this */
static const double AREA = 0.3;         /* of the area */
static const double DRAWN = 1e-4;       /* of what is drawn of it below */
static const double DENSITY = 2e-4;     /* of the largest error of D */
static const double FIRST = 1e-3;       /* of the width of the first cell, where D errs by twice that */

/* Errors of cells that are tried. */
static const double ENOUGH = 1e-13, MOST = 0.1;

/* A cell that holds more than this of the mass is no wider than the factor, since k~ begins at a knot near rho. */
static const double HEAVY = 1e-6, RATIO_MOST = 2.5;

/* Ends of knots, and of directions; what lies beyond the last knot has to be a float. */
static const double KNOT_LEAST = 1e-10, KNOT_MOST = 0x1p43, M0_LEAST = 1e-28;
static const double RHO_MOST = 0x1p20;

/* ---- the error of a cell ---- */

/* From one edge to another; `end` is the last for the tail cell. */
typedef struct view {
    vndf_knots *knots;
    size_t from, end;
    vndf_cell cell;
} view;

/* |drawn - true|; what is drawn far too rarely counts more often, since it decides the largest weight. */
static double miss_of(double seen, double drawn)
{
    const double rarely = 2, more = 6;
    return seen > rarely * drawn ? more * seen : fabs(seen - drawn);
}

/* Half the integral of |drawn - true| for the weight w1 R^2 + w0 R; *density: the largest relative error. */
static double miss_by(const view *v, double w1, double w0, double *density)
{
    vndf_drawn drawn = vndf_drawn_by(&v->cell, w1, w0);
    double sum = 0, before = 0;
    const vndf_strip *s = v->knots->strips.at;
    for (size_t i = v->from; i < v->end; i++) {
        double next = vndf_drawn_before(&drawn, v->knots->xi[i + 1 - v->from]),
               seen = w1 * s[i].along + w0 * s[i].f;
        sum += miss_of(seen, next - before);
        *density = seen > 0 ? fmax(*density, fabs((next - before) / seen - 1)) : *density;
        before = next;
    }
    return sum / 2;
}

/* The shares that touch k where what is seen from an edge lies, about; the first is 1. */
static double second_share(const vndf_rim *rim)
{
    return 1.33 + (rim->s2 > 1e-8 * rim->s1 ? rim->s1 / rim->s2 : 1e8);
}

/* The same from below, from an edge before the cell's end, over all that is seen from there. */
static double miss_below(const view *v, size_t edge)
{
    const vndf_knots *k = v->knots;
    const vndf_rim *rim = &k->rim[edge];
    double rho = k->strips.at[edge].edge, b1 = second_share(rim), all = rim->s1 + b1 * rim->s2, mass = 0, sum = 0;
    vndf_drawn drawn = vndf_drawn_below(&v->cell, rho, 1, b1);
    size_t from = edge > v->from ? edge : v->from;
    double xi0 = k->xi[from - v->from], per = 1 / (1 - xi0), before = 0;
    for (int round = 0; round < 2; round++) {
        if (round)
            drawn = (vndf_drawn){mass, edge > v->from ? 0 : drawn.d0, drawn.d1 / per};
        for (size_t i = from; i < v->end; i++) {
            const vndf_strip *s = &k->strips.at[i];
            double e = k->strips.at[i].edge, d = e - rho;
            double part = s->m2 + (d + e) * s->m1 + d * e * s->m0 + b1 * (s->m2 + d * (2 * s->m1 + d * s->m0));
            if (!round) {
                mass += part;
                continue;
            }
            double next = vndf_drawn_before(&drawn, (k->xi[i + 1 - v->from] - xi0) * per);
            sum += miss_of(part, next - before);
            before = next;
        }
    }
    return sum / 2 / all;
}

/* By how much the spline errs at an edge in the cell, where x = c/(c + s): of the area above the horizon, or of what is
 * left of it below, while that is not much smaller; and below by how much the drawn area does, between shares that make
 * it exact at the knots. */
static double area_miss_at(const view *v, size_t middle)
{
    const double smaller = 0.02;
    vndf_knots *k = v->knots;
    int tail = v->cell.power > 0;
    if (middle > k->last)
        return 0;
    vndf_area a = *vndf_knots_area(k, v->from), m = *vndf_knots_area(k, middle), b = {0, 0, 0};
    if (!tail)
        b = *vndf_knots_area(k, v->end);
    double x0 = v->cell.x, h = tail ? v->cell.z : v->cell.h, x1 = x0 + h, x = 1 - k->rim[middle].z,
           t = (x - x0) / h, u = 1 - t, d0 = h * (1 - a.turned - a.along), d1 = h * (1 - b.turned - b.along);
    double spline =
        u * u * ((1 + 2 * t) * (a.below + x0) + t * d0) + t * t * ((1 + 2 * u) * (b.below + x1) - u * d1);
    double miss = AREA * fabs(spline - m.below - x) / fmax(m.below, smaller * x);
    if (v->from > 0 && v->end <= k->deep) {
        const vndf_rim *r0 = &k->rim[v->from], *r1 = &k->rim[v->end], *r = &k->rim[middle];
        double c0 = second_share(r0), c1 = second_share(r1), xi = k->xi[middle - v->from];
        double b0 = (1 - xi) * a.below / (r0->z * (r0->s1 + c0 * r0->s2)),
               b1 = xi * b.below / (r1->z * (r1->s1 + c1 * r1->s2));
        double drawn = (b0 + b1) * r->s1 + (b0 * c0 + b1 * c1) * r->s2;
        miss = fmax(miss, DRAWN * fmin(fabs(drawn * r->z / m.below - 1), 10));
    }
    return miss;
}

/* In the middle of its edges, and of its width: before a needle edges lie close to that. */
static double area_miss(const view *v)
{
    const vndf_knots *k = v->knots;
    double z = v->cell.z - 0.5 * (v->cell.power > 0 ? v->cell.z : v->cell.h);
    size_t low = v->from, high = v->end;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        *(k->rim[middle].z > z ? &low : &high) = middle;
    }
    return fmax(area_miss_at(v, v->from + (v->end - v->from) / 2), area_miss_at(v, low > v->from ? low : high));
}

/* The error of the cell between two edges; it returns early once the error exceeds `enough`. */
static double error_of(vndf_knots *k, size_t from, size_t end, double enough)
{
    const double small = 1e-3; /* a part of the mass below which D counts less */
    int tail = end == k->strips.count;
    double f1 = 2 * PI * k->profile->f1, far = k->rim[from].s1 / f1, density = 0, unused = 0;
    if (tail && far / 8 > enough)
        return far / 8;
    vndf_guard_spend(k->profile->guard, 8 * (double)(end - from));
    view v = {k, from, end, vndf_cell_measure(k->profile, &k->strips, from, end, k->squarings)};
    double per = v.cell.z / v.cell.h, mass = v.cell.m1 + v.cell.r * v.cell.m0;
    if (from > 0 && !tail && k->strips.at[end].edge > RATIO_MOST * v.cell.r && mass > HEAVY)
        return MOST;
    for (size_t i = from; i <= end; i++)
        k->xi[i - from] = tail ? vndf_cell_place(&v.cell, k->strips.at[i].edge)
                               : (k->strips.at[i].edge - v.cell.r) * k->rim[i].z * per;
    double error = fmax(miss_by(&v, 0, 1, &density), miss_by(&v, 1, 0, &unused) / f1);
    if (from == 0) /* there and in the tail k~ has no pole, and strays more */
        error += mass * (v.cell.h / v.cell.z) / (4 * f1) + FIRST * v.cell.h;
    if (tail)
        error += mass / 8;
    else
        error = fmax(error, DENSITY * fmin(density, 1) * fmin(mass / small, 1));
    size_t middle = from + (end - from) / 2;
    double hidden = FLOOR_BELOW * fmin(enough / FLOOR_ERROR, 1);
    if (error <= enough && from > 0)
        error = fmax(error, BELOW * (miss_below(&v, from < k->deep ? from : k->deep) - hidden));
    if (error <= enough)
        error = fmax(error, BELOW * (miss_below(&v, middle < k->deep ? middle : k->deep) - hidden));
    return error <= enough ? fmax(error, area_miss(&v)) : error;
}

/* ---- placing ---- */

/* The last edge to which a cell may go from another; as far as the one before it, it is tried first. Knots are floats,
 * and no closer than the grain. */
static size_t reach_of(vndf_knots *k, size_t from, size_t stop, size_t step, double enough)
{
    size_t good = from + 1, bad = stop + 1;
    for (size_t end = from + step; good + 1 < bad; end = bad > stop ? 2 * end - from : good + (bad - good) / 2) {
        end = end > stop ? stop : end <= good ? good + 1 : end;
        if (error_of(k, from, end, enough) <= enough)
            good = end;
        else
            bad = end;
    }
    while (good < stop && k->strips.at[good].edge < k->strips.at[from].edge * (1 + 0.49 * VNDF_GRAIN))
        good++;
    return k->strips.at[good].edge * (1 + 0.49 * VNDF_GRAIN) > k->strips.at[stop].edge ? stop : good;
}

/* Knots for an error, until there are more than `most`. */
static unsigned march(vndf_knots *k, double enough, unsigned most)
{
    size_t from = 0, step = 4;
    unsigned n = 0;
    for (;;) {
        if (n < VNDF_CELLS_MAX + 1)
            k->at[n] = from;
        if (++n > most || from >= k->last || vndf_guard_stopped(k->profile->guard))
            return n;
        size_t stop = from + 1, furthest = n == 1 ? k->last - 1 : k->last;
        while (stop < furthest && !k->rim[stop].stop)
            stop++;
        if (stop == k->last && !k->rim[stop].stop && n > 2 && error_of(k, from, k->strips.count, enough) <= enough)
            return n;
        size_t end = reach_of(k, from, stop, step, enough);
        step = end - from;
        from = end < k->first ? k->first : end;
    }
}

/* The least error for which there are not too many. The number falls as its root of third order. */
void vndf_knots_place(vndf_knots *k, unsigned count)
{
    enum { STEPS = 24 };
    double low = ENOUGH / 2, high = MOST, error = 3 / pow(count, 3), best = MOST;
    unsigned n = 0;
    for (int i = 0; i < STEPS && n != count && high > fmax(1.02 * low, ENOUGH); i++) {
        error = error > low && error < high ? error : sqrt(low * high);
        n = march(k, error, count);
        if (n > count)
            low = error;
        else
            best = high = error;
        error *= n <= count ? pow((double)n / count, 3) : high < MOST ? 1.3 : 4;
    }
    k->count = n == count ? n : march(k, best, count);
    k->count = k->count > count ? count : k->count;
}

const vndf_area *vndf_knots_area(vndf_knots *k, size_t edge)
{
    vndf_rim *rim = &k->rim[edge];
    if (!rim->known)
        rim->area = vndf_profile_below(k->profile, rim->z, k->strips.at[edge].edge * rim->z);
    rim->known = 1;
    return &rim->area;
}

/* ---- jumps ---- */

/* Where there are more than STOPS_MAX, knots stand there only as far as errors ask for them. */
enum { JUMPS_MAX = 64, STOPS_MAX = 16 };

/* A knot at a jump or a pole has the side with more normals in one cell: slopes where P22 leaps from one side of a
 * panel's edge to the other, after a 0. Returns how many there are. */
static size_t find_jumps(const vndf_profile *profile, float *jump)
{
    const double narrow = 1e-9;               /* of a slope: half of a panel at a pole */
    const double apart = 0x1p-21;             /* of a slope: knots */
    const double least = 1e-9, beside = 2e-7; /* of a slope: where both sides are asked, inside of their panels */
    const double widely = 1e-4;               /* of a slope: away from the edge */
    const double jump_least = 1e-4, pole_least = 1.5, needle = 1e5, worth = 1e-12;
    const vndf_panel *p = profile->panel;
    size_t n = 1;
    jump[0] = 0;
    for (size_t i = 1; i < profile->count && n <= JUMPS_MAX; i++) {
        double r = p[i].r, in = (r - p[i - 1].r) / 2, out = (p[i + 1].r - r) / 2, p22[4];
        double at[4] = {r - fmin(fmax(in, least * r), beside * r), r + fmin(fmax(out, least * r), beside * r),
                        r * (1 - widely), r * (1 + widely)};
        if (r < KNOT_LEAST || r > KNOT_MOST)
            continue;
        vndf_profile_p22_many(profile, at, 4, p22);
        double most = fmax(p22[0], p22[1]), around = fmax(p22[2], p22[3]), leap = fabs(p22[0] - p22[1]);
        int jumps = (leap > jump_least * most && leap > fabs(p22[2] - p22[3]) / 2 && most < pole_least * around) ||
                    (most > pole_least * around && fmin(in, out) < narrow * r),
            up = p22[0] > p22[1];
        float knot = (float)r;
        knot = up && knot < r ? nextafterf(knot, HUGE_VALF) : !up && knot > r ? nextafterf(knot, 0.0f) : knot;
        if (jumps && most * r * r > worth && most < needle * around && knot > jump[n - 1] * (1 + apart))
            jump[n++] = knot;
    }
    return n;
}

/* ---- the whole ---- */

int vndf_knots_from(vndf_knots *k, const vndf_profile *profile, unsigned most)
{
    const double margin = 0.5;
    float jump[JUMPS_MAX + 1];
    size_t jumps = find_jumps(profile, jump);
    memset(k, 0, sizeof *k);
    k->profile = profile;
    double power = profile->tail;
    /* the least with which R^2 P22, by xi, stays finite in the tail */
    while (k->squarings < VNDF_SQUARINGS_MAX && (power - 3) * (double)(1u << k->squarings) < 1 - 1e-3)
        k->squarings++;
    int good = vndf_strips_from(&k->strips, profile, jump, jumps, most);
    size_t n = k->strips.count, next = jumps - 1;
    k->rim = good ? calloc(n + 1, sizeof *k->rim) : NULL;
    k->xi = good ? malloc((n + 1) * sizeof *k->xi) : NULL;
    if (!k->rim || !k->xi)
        return 0;
    double m0 = 0, m1 = 0, m2 = 0, least = margin * vndf_profile_claimed(profile) * 2 * PI * profile->f1;
    for (size_t i = n; i-- > 0;) {
        const vndf_strip *s = &k->strips.at[i];
        double r = k->strips.at[i].edge, gap = i + 1 < n ? k->strips.at[i + 1].edge - r : 0;
        m2 += gap * (2 * m1 + gap * m0) + s->m2;
        m1 += gap * m0 + s->m1;
        m0 += s->m0;
        while (next > 0 && (double)jump[next] > r)
            next--;
        k->rim[i] = (vndf_rim){.z = 1 / (1 + r),
                               .s1 = m2 + r * m1,
                               .s2 = m2,
                               .stop = next > 0 && jumps <= STOPS_MAX && (double)jump[next] == r};
        if (k->last == 0 && r <= KNOT_MOST && m0 > M0_LEAST)
            k->last = k->strips.at[i + 1].edge <= KNOT_MOST ? i + 1 : i;
        k->last = k->last == 0 && k->rim[i].stop ? i : k->last;
        k->deep = k->deep == 0 && r <= RHO_MOST && k->rim[i].s1 > least ? i : k->deep;
    }
    while (k->strips.at[k->first].edge < KNOT_LEAST)
        k->first++;
    k->least = march(k, 2 * MOST, VNDF_CELLS_MAX + 1);
    k->least = k->least < 3 ? 3 : k->least;
    return 1;
}

void vndf_knots_free(vndf_knots *k)
{
    vndf_strips_free(&k->strips);
    free(k->rim);
    free(k->xi);
}
