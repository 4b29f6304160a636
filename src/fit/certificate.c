#include "fit/certificate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
static const double LEFT_OUT = 1e-6; /* the part of what a direction sees that the largest weight leaves out */
static const double RHO_LEAST = 0x1p-20, RHO_MOST = 0x1p20;
enum { DIRECTIONS_MOST = 640, CANDIDATES = 512 };

/* What one direction shows. */
typedef struct finding {
    double tv, weight, area_error, consistency;
} finding;

typedef struct direction {
    double rho;
    finding side[2]; /* above, below */
} direction;

/* A point of which true/drawn is large. */
typedef struct candidate {
    double ratio, mass;
} candidate;

typedef struct survey {
    const vndf_laws *laws;
    const vndf_sight *sight;
    const vndf_profile *profile;
    double *kernel; /* of the points, seen from below: sqrt(y^2 - 1) - acos(1/y), 0 where y < 1 */
    direction at[DIRECTIONS_MOST];
    int count;
    candidate candidate[CANDIDATES]; /* of the direction at hand */
    int candidates;
} survey;

/* ---- one direction ---- */

static void fill_kernels(survey *s, double rho)
{
    const vndf_point *point = s->sight->points.at;
    for (size_t i = 0; i < s->sight->points.count; i++)
        s->kernel[i] = point[i].r > rho ? vndf_profile_kernel(point[i].r / rho) : 0;
}

/* What the points see: the area, but for a rho between slopes that count as one. */
static double seen_area(const survey *s, const vndf_law *law)
{
    const vndf_point *point = s->sight->points.at;
    double sum = 0, add = law->below ? 0 : PI;
    for (size_t i = s->sight->first[law->below ? law->first : 0]; i < s->sight->points.count; i++)
        sum += point[i].mass * (s->kernel[i] + add);
    return sum * law->c / PI;
}

/* Sums over the points of a direction. */
typedef struct sums {
    double miss, weight; /* weight: the largest of a point that holds more than may be left out */
} sums;

static void note(survey *s, sums *sum, double seen, double drawn)
{
    double ratio = drawn > 0 ? seen / drawn : HUGE_VAL;
    sum->miss += fabs(seen - drawn);
    if (seen > LEFT_OUT)
        sum->weight = fmax(sum->weight, ratio);
    else if (ratio > 1 && seen > 0 && s->candidates < CANDIDATES)
        s->candidate[s->candidates++] = (candidate){ratio, seen};
}

static int by_ratio(const void *a, const void *b)
{
    double x = ((const candidate *)a)->ratio, y = ((const candidate *)b)->ratio;
    return (x < y) - (x > y);
}

/* The largest ratio beyond which no more than LEFT_OUT lies. */
static double largest_weight(survey *s, const sums *sum)
{
    double mass = 0;
    int n = 0;
    for (int i = 0; i < s->candidates; i++)
        if (s->candidate[i].ratio > sum->weight)
            s->candidate[n++] = s->candidate[i];
    qsort(s->candidate, (size_t)n, sizeof *s->candidate, by_ratio);
    for (int i = 0; i < n; i++) {
        mass += s->candidate[i].mass;
        if (mass > LEFT_OUT)
            return s->candidate[i].ratio;
    }
    return sum->weight;
}

/* Adds a cell; `seen` and `drawn` turn kernels and densities into parts of what is seen and drawn. */
static void add_cell(survey *s, sums *sum, const vndf_law *law, unsigned i, double seen, double drawn)
{
    const vndf_sight *sight = s->sight;
    vndf_drawn cell = vndf_law_cell(law, i);
    int partial = law->below && i == law->first;
    double xi = partial ? law->xi : 0, per = 1 / (1 - xi), add = law->below ? 0 : PI;
    for (size_t n = sight->first[i]; n < sight->first[i + 1]; n++) {
        const vndf_point *p = &sight->points.at[n];
        double place = (p->xi - xi) * per, width = p->width * per;
        double part = place + width / 2 > 0 ? vndf_drawn_part(&cell, place, width) : 0;
        note(s, sum, p->mass * (s->kernel[n] + add) * seen, part * drawn);
    }
}

/* The part of the drawn mass that sums of floats miss or add. */
static double rounding_of(const vndf_law *law, double area)
{
    float sum = 0;
    for (unsigned i = law->laws->cells + 1; i-- > (law->below ? law->first : 0);)
        sum += (float)vndf_law_cell(law, i).mass;
    return fabs(sum / area - 1);
}

/* Whether rho is not among slopes that count as one: the area may be anything between those of its neighbours. */
static int resolves(const vndf_laws *laws, double rho)
{
    unsigned i = vndf_laws_cell(laws, rho);
    return i == laws->cells || laws->span[i + 1].r - laws->span[i].r > 2 * VNDF_GRAIN * rho;
}

static finding look(survey *s, double rho, int below, double area)
{
    vndf_law law = vndf_law_of(s->laws, rho, below);
    double drawn = vndf_law_area(&law);
    double miss = resolves(s->laws, rho) ? fabs(vndf_law_public_area(&law, drawn) / area - 1) : 0;
    finding found = {0, 1, miss, rounding_of(&law, drawn)};
    sums sum = {0, 1};
    double seen = seen_area(s, &law);
    s->candidates = 0;
    if (!(seen > 0))
        return found;
    for (unsigned i = below ? law.first : 0; i <= s->laws->cells; i++)
        add_cell(s, &sum, &law, i, law.c / (PI * seen), 1 / drawn);
    found.tv = fmin(sum.miss / 2, 1);
    found.weight = largest_weight(s, &sum);
    return found;
}

static int is_claimed(const survey *s, double rho, double below)
{
    double length = hypot(1 / (1 + rho), rho / (1 + rho));
    return below > vndf_profile_claimed(s->profile) * 2 * s->profile->f1 * length;
}

/* Looks from rho above and below the horizon, and keeps directions ascending. */
static void add_direction(survey *s, double rho)
{
    const finding none = {0, 1, 0, 0};
    rho = fmin(fmax(rho, RHO_LEAST), RHO_MOST);
    int i = s->count;
    for (int k = 0; k < i; k++)
        if (s->at[k].rho == rho)
            return;
    if (i == DIRECTIONS_MOST || !vndf_guard_spend(s->profile->guard, 6 * (double)s->sight->points.count))
        return;
    fill_kernels(s, rho);
    double c = rho / (1 + rho), below = vndf_profile_below(s->profile, 1 / (1 + rho), c).below;
    direction made = {rho, {look(s, rho, 0, below + c), none}};
    if (is_claimed(s, rho, below))
        made.side[1] = look(s, rho, 1, below);
    for (; i > 0 && s->at[i - 1].rho > rho; i--)
        s->at[i] = s->at[i - 1];
    s->at[i] = made;
    s->count++;
}

/* ---- all directions ---- */

/* Angles of incidence at alpha 1, degrees. */
static const double ANGLES[] = {0.001, 10, 30, 50, 60, 70, 80, 85, 89, 89.9, 89.999};

/* Every so many cells there is one direction at a knot, just before the next knot is the switch, and between. */
static void add_cells(survey *s, int most)
{
    const vndf_laws *laws = s->laws;
    unsigned step = laws->cells / (unsigned)most + 1;
    for (unsigned i = 0; i <= laws->cells; i += step) {
        const vndf_span *span = &laws->span[i];
        double end = i < laws->cells ? laws->span[i + 1].r : 4 * span->r;
        add_direction(s, fmax(span->r * (1 + 1e-6), 1e-2 * end));
        add_direction(s, (span->r + end) / 2);
    }
}

typedef enum order { BY_TV, BY_WEIGHT } order;

static double size_of(const direction *at, int side, order by)
{
    return by == BY_TV ? at->side[side].tv : at->side[side].weight - 1;
}

/* Adds directions on both sides of the one with the largest value, and again. */
static void add_peak(survey *s, int side, order by)
{
    enum { STEPS = 4 };
    for (int step = 0; step < STEPS; step++) {
        int best = 0;
        for (int i = 1; i < s->count; i++)
            best = size_of(&s->at[i], side, by) > size_of(&s->at[best], side, by) ? i : best;
        double rho = s->at[best].rho, before = best > 0 ? s->at[best - 1].rho : rho;
        double after = best + 1 < s->count ? s->at[best + 1].rho : rho;
        add_direction(s, sqrt(before * rho));
        add_direction(s, sqrt(rho * after));
    }
}

static void look_around(survey *s, vndf_closeness closeness)
{
    int close = closeness == VNDF_CLOSELY;
    for (size_t i = 0; i < sizeof ANGLES / sizeof *ANGLES; i++)
        add_direction(s, 1 / (tan(ANGLES[i] * PI / 180) * s->profile->scale));
    add_cells(s, close ? 250 : 24);
    for (int side = 0; side < 2; side++) {
        add_peak(s, side, BY_TV);
        if (close)
            add_peak(s, side, BY_WEIGHT);
    }
}

static void take(vndf_certificate *c, const direction *at, int side, double scale)
{
    const finding *f = &at->side[side];
    double angle = atan2(1, at->rho * scale) * 180 / PI, theta = side ? 180 - angle : angle;
    if (f->tv > c->tv) {
        c->tv = (float)f->tv;
        c->tv_theta = (float)theta;
    }
    if (!side && f->tv > c->tv_above) {
        c->tv_above = (float)f->tv;
        c->tv_above_theta = (float)theta;
    }
    c->max_weight = fmaxf(c->max_weight, (float)f->weight);
    c->area_error = fmaxf(c->area_error, (float)f->area_error);
    c->consistency = fmaxf(c->consistency, (float)f->consistency);
}

/* ---- D, and its ends ---- */

/* Largest relative error of D, which is drawn as if all normals were, in the tail as if those of grazing incidence
 * were, over the points that hold all but LEFT_OUT of the mass on either side. */
static double ndf_error(const survey *s)
{
    double before = 0, worst = 0;
    for (unsigned i = 0; i <= s->laws->cells; i++) {
        const vndf_span *span = &s->laws->span[i];
        int tail = i == s->laws->cells;
        const vndf_weight all = {tail, !tail, 0, 0};
        vndf_drawn cell = vndf_drawn_by(span, &s->laws->cell[i], &all);
        for (size_t n = s->sight->first[i]; n < s->sight->first[i + 1]; n++) {
            const vndf_point *p = &s->sight->points.at[n];
            double width = p->width / (vndf_span_density(span, p->r) * p->r); /* of log R */
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

/* The p with D = P22/cos^4 ~ cos^p towards the horizon. */
static double horizon_power(const vndf_profile *profile)
{
    double end = profile->panel[profile->count].r, power = power_between(profile, end / 16, end / 4) - 4;
    return power < -4e-3 ? power : 0.0;
}

/* D may be unbounded at the pole or at the horizon; a cell is bounded. */
static int is_bounded(const vndf_profile *profile)
{
    double first = profile->panel[0].r;
    return !(power_between(profile, 4 * first, 16 * first) >= 7e-3) && !(horizon_power(profile) < 0.0);
}

int vndf_certificate_measure(vndf_certificate *c, const vndf_laws *laws, const vndf_sight *sight,
                             const vndf_profile *profile, vndf_closeness closeness)
{
    survey *s = calloc(1, sizeof *s);
    double *kernel = s ? malloc((sight->points.count + 1) * sizeof *kernel) : NULL;
    if (kernel) {
        s->laws = laws;
        s->sight = sight;
        s->profile = profile;
        s->kernel = kernel;
        look_around(s, closeness);
        memset(c, 0, sizeof *c);
        c->max_weight = 1;
        for (int i = 0; i < s->count; i++)
            for (int side = 0; side < 2; side++)
                take(c, &s->at[i], side, profile->scale);
        c->ndf_error = (float)ndf_error(s);
        c->horizon_power = (float)horizon_power(profile);
        c->weight_bounded = (float)is_bounded(profile);
        c->hidden = (float)profile->hidden;
        c->finest = (float)profile->finest;
    }
    free(kernel);
    free(s);
    return kernel != NULL;
}
