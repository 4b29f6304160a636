#include "fit/certificate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
static const double LEFT_OUT = 1e-6; /* the part of what a direction sees that the largest weight leaves out */
static const double RHO_LEAST = 0x1p-20, RHO_MOST = 0x1p20;
enum { DIRECTIONS_MOST = 320, CELLS_MOST = 80, CANDIDATES = 512 };

/* What one direction shows on one side. */
enum { TV, WEIGHT, AREA_ERROR, CONSISTENCY, FIGURES };

typedef struct direction {
    double rho, side[2][FIGURES]; /* above, below */
} direction;

/* A part of what is seen, and the ratio in which it is drawn too rarely. */
typedef struct part {
    double ratio, seen;
} part;

typedef struct survey {
    const vndf_draft *draft;
    const vndf_profile *profile;
    double *kernel; /* of the points, seen from below: sqrt(y^2 - 1) - acos(1/y), 0 where y < 1 */
    direction at[DIRECTIONS_MOST];
    int count;
    part candidate
        [CANDIDATES]; /* of the direction at hand: parts that may be left out, and those drawn too rarely */
    int candidates;
} survey;

/* ---- one direction ---- */

static int by_ratio(const void *a, const void *b)
{
    double x = ((const part *)a)->ratio, y = ((const part *)b)->ratio;
    return (x < y) - (x > y);
}

/* The largest ratio beyond which no more than LEFT_OUT lies; `least` is that of a larger part. */
static double largest_weight(survey *s, double least)
{
    double sum = 0;
    int n = 0;
    for (int i = 0; i < s->candidates; i++)
        if (s->candidate[i].ratio > least)
            s->candidate[n++] = s->candidate[i];
    qsort(s->candidate, (size_t)n, sizeof *s->candidate, by_ratio);
    for (int i = 0; i < n; i++) {
        sum += s->candidate[i].seen;
        if (sum > LEFT_OUT)
            return s->candidate[i].ratio;
    }
    return least;
}

/* Compares what is drawn with what is seen, point by point. `area` is what the points see, which is the area but for a
 * rho between slopes that count as one. */
static void compare(survey *s, const vndf_law *law, double area, double drawn_area, double *figure)
{
    const vndf_draft *d = s->draft;
    double miss = 0, weight = 1, add = law->below ? 0 : PI, seen_per = law->c / (PI * area);
    s->candidates = 0;
    for (unsigned i = law->below ? law->first : 0; i <= d->table.cells; i++) {
        vndf_drawn cell = vndf_law_cell(law, i);
        double xi = law->below && i == law->first ? law->xi : 0, per = 1 / (1 - xi);
        for (size_t n = d->first[i]; n < d->first[i + 1]; n++) {
            const vndf_point *p = &d->points.at[n];
            double place = (p->xi - xi) * per, width = p->width * per;
            double drawn = place + width / 2 > 0 ? vndf_drawn_part(&cell, place, width) / drawn_area : 0;
            double seen = p->mass * (s->kernel[n] + add) * seen_per;
            miss += fabs(seen - drawn);
            if (seen > LEFT_OUT && seen > weight * drawn)
                weight = drawn > 0 ? seen / drawn : HUGE_VAL;
            else if (seen > weight * drawn && s->candidates < CANDIDATES)
                s->candidate[s->candidates++] = (part){drawn > 0 ? seen / drawn : HUGE_VAL, seen};
        }
    }
    figure[TV] = fmin(miss / 2, 1);
    figure[WEIGHT] = largest_weight(s, weight);
}

/* One side. Where rho is among slopes that count as one, the area may be anything between those of its neighbours. */
static void look(survey *s, double rho, int below, double area, double *figure)
{
    const vndf_draft *d = s->draft;
    vndf_law law = vndf_law_of(&d->laws, rho, below);
    unsigned cell = vndf_laws_cell(&d->laws, rho), first = below ? law.first : 0;
    double drawn = 0, seen = 0, add = below ? 0 : PI;
    float rounded = 0;
    for (unsigned i = d->table.cells + 1; i-- > first;) {
        double mass = vndf_law_cell(&law, i).mass;
        drawn += mass;
        rounded += (float)mass;
    }
    for (size_t i = d->first[first]; i < d->points.count; i++)
        seen += d->points.at[i].mass * (s->kernel[i] + add);
    figure[CONSISTENCY] = fabs(rounded / drawn - 1);
    if (cell == d->table.cells || d->laws.cell[cell + 1].r - d->laws.cell[cell].r > 2 * VNDF_GRAIN * rho)
        figure[AREA_ERROR] = fabs(vndf_law_public_area(&law, drawn) / area - 1);
    if (seen > 0)
        compare(s, &law, seen * law.c / PI, drawn, figure);
}

/* Looks from rho above and below the horizon, and keeps directions ascending. */
static void add_direction(survey *s, double rho)
{
    const vndf_draft *d = s->draft;
    int i = 0;
    rho = fmin(fmax(rho, RHO_LEAST), RHO_MOST);
    while (i < s->count && s->at[i].rho < rho)
        i++;
    if ((i < s->count && s->at[i].rho == rho) || s->count == DIRECTIONS_MOST ||
        !vndf_guard_spend(s->profile->guard, 6 * (double)d->points.count))
        return;
    for (size_t k = 0; k < d->points.count; k++) {
        double y = d->points.at[k].r / rho;
        s->kernel[k] = y > 1 ? vndf_profile_kernel(y) : 0;
    }
    direction made = {rho, {{0, 1, 0, 0}, {0, 1, 0, 0}}};
    double c = rho / (1 + rho), below = vndf_profile_below(s->profile, 1 / (1 + rho), c).below;
    look(s, rho, 0, below + c, made.side[0]);
    if (below > vndf_profile_claimed(s->profile) * 2 * s->profile->f1 * hypot(1 / (1 + rho), c))
        look(s, rho, 1, below, made.side[1]);
    memmove(s->at + i + 1, s->at + i, (size_t)(s->count - i) * sizeof *s->at);
    s->at[i] = made;
    s->count++;
}

/* ---- all directions ---- */

/* Adds directions on both sides of the one with the largest figure, and again. */
static void add_peak(survey *s, int side, int figure)
{
    enum { STEPS = 4 };
    for (int step = 0; step < STEPS; step++) {
        int best = 0;
        for (int i = 1; i < s->count; i++)
            best = s->at[i].side[side][figure] > s->at[best].side[side][figure] ? i : best;
        double rho = s->at[best].rho, before = best > 0 ? s->at[best - 1].rho : rho;
        double after = best + 1 < s->count ? s->at[best + 1].rho : rho;
        add_direction(s, sqrt(before * rho));
        add_direction(s, sqrt(rho * after));
    }
}

/* Some angles of incidence at alpha 1; of every so many cells the left knot and the middle; and the neighbourhood of
 * what is worst. */
static void look_around(survey *s)
{
    static const double degrees[] = {0.001, 10, 30, 50, 60, 70, 80, 85, 89, 89.9, 89.999};
    const vndf_laws *laws = &s->draft->laws;
    for (size_t i = 0; i < sizeof degrees / sizeof *degrees; i++)
        add_direction(s, 1 / (tan(degrees[i] * PI / 180) * s->profile->scale));
    for (unsigned i = 0; i <= laws->cells; i += laws->cells / CELLS_MOST + 1) {
        double r = laws->cell[i].r, end = i < laws->cells ? laws->cell[i + 1].r : 4 * r;
        add_direction(s, fmax(r * (1 + 1e-6), 1e-2 * end));
        add_direction(s, (r + end) / 2);
    }
    for (int figure = TV; figure <= AREA_ERROR; figure++) {
        add_peak(s, 0, figure);
        add_peak(s, 1, figure);
    }
}

static void take(vndf_certificate *c, const direction *at, int side, double scale)
{
    const double *f = at->side[side];
    double angle = atan2(1, at->rho * scale) * 180 / PI, theta = side ? 180 - angle : angle;
    if (f[TV] > c->tv) {
        c->tv = (float)f[TV];
        c->tv_theta = (float)theta;
    }
    if (!side && f[TV] > c->tv_above) {
        c->tv_above = (float)f[TV];
        c->tv_above_theta = (float)theta;
    }
    c->max_weight = fmaxf(c->max_weight, (float)f[WEIGHT]);
    c->area_error = fmaxf(c->area_error, (float)f[AREA_ERROR]);
    c->consistency = fmaxf(c->consistency, (float)f[CONSISTENCY]);
}

/* ---- D, and its ends ---- */

/* Largest relative error of D, which is drawn as if all normals were, in the tail as if those of grazing incidence
 * were, over the points that hold all but LEFT_OUT of the mass on either side. */
static double ndf_error(const vndf_draft *d)
{
    double before = 0, worst = 0;
    for (unsigned i = 0; i <= d->table.cells; i++) {
        const vndf_cell *c = &d->laws.cell[i];
        int tail = i == d->table.cells;
        const vndf_weight all = {tail, !tail, 0, 0};
        vndf_drawn cell = vndf_drawn_by(c, &all);
        for (size_t n = d->first[i]; n < d->first[i + 1]; n++) {
            const vndf_point *p = &d->points.at[n];
            double width = p->width / (vndf_cell_density(c, p->r) * p->r); /* of log R */
            double drawn = vndf_drawn_part(&cell, p->xi, p->width) / (tail ? p->r : 1);
            before += p->mass;
            if (before > LEFT_OUT / 2 && before < 1 - LEFT_OUT / 2 && p->mass > LEFT_OUT * width)
                worst = fmax(worst, fabs(drawn / p->mass - 1));
        }
    }
    return worst;
}

/* The n with P22 ~ r^-n between two slopes. */
static double power_between(const vndf_profile *profile, double r0, double r1)
{
    return log(vndf_profile_p22(profile, r0) / vndf_profile_p22(profile, r1)) / log(r1 / r0);
}

int vndf_certificate_measure(vndf_certificate *c, const vndf_draft *draft, const vndf_profile *profile)
{
    survey *s = calloc(1, sizeof *s);
    double *kernel = malloc((draft->points.count + 1) * sizeof *kernel);
    if (s && kernel) {
        double first = profile->panel[0].r, end = profile->panel[profile->count].r;
        s->draft = draft;
        s->profile = profile;
        s->kernel = kernel;
        look_around(s);
        memset(c, 0, sizeof *c);
        c->max_weight = 1;
        for (int i = 0; i < 2 * s->count; i++)
            take(c, &s->at[i / 2], i % 2, profile->scale);
        c->ndf_error = (float)ndf_error(draft);
        /* D = P22/cos^4 ~ cos^p towards the horizon; it may be unbounded there or at the pole, and no cell is */
        double power = power_between(profile, end / 16, end / 4) - 4;
        c->horizon_power = power < -4e-3 ? (float)power : 0.0f;
        c->weight_bounded = !(power < -4e-3) && !(power_between(profile, 4 * first, 16 * first) >= 7e-3);
        c->hidden = (float)profile->hidden;
        c->finest = (float)profile->finest;
    }
    int good = s && kernel;
    free(kernel);
    free(s);
    return good;
}
