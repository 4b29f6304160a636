/* How good a table is. Given the slope length R all azimuths are drawn as they are seen, so the total variation is
 * that of the laws of R: the drawn one, by the text of the run time in double (kernel/law.h), against
 * f(R) k(R/rho) |c|/(pi A) of the profile, strip by strip. */
#include <stdlib.h>

#include "fit/draft.h"
#include "math/ascending.h"

#define VNDF_KERNEL_DOUBLE
#include "kernel/one.h"

#include "kernel/rows.h"

#include "kernel/law.h"

static const double PI = 3.14159265358979323846;
static const double LEFT_OUT = 1e-6; /* the part of what a direction sees that the largest weight leaves out */
static const double RHO_LEAST = 0x1p-20, RHO_MOST = 0x1p20;
enum { CELLS_MOST = 64, RATIOS = 1024, PER_OCTAVE = 32 };

/* What one direction shows on one side. */
enum { TV, WEIGHT, AREA_ERROR, CONSISTENCY, FIGURES };

/* Directions are those with rho at an edge. */
typedef struct direction {
    double side[2][FIGURES]; /* above, below */
    int known;
} direction;

typedef struct survey {
    table table;
    const vndf_profile *profile;
    vndf_strips strips;
    direction *at;         /* of each edge */
    double *xi, *lean;     /* in its cell, of each edge and of the middle of its strip; of f in each strip (lean_of) */
    double *ends; /* of each strip: densities at its ends, in the unit of its points */
    double *kernel, *tilt; /* as it is seen from below: k rho f dR of each point, and lean of each strip */
    double rarely[RATIOS]; /* what the direction at hand sees, by the ratio in which it is drawn too rarely */
} survey;

/* ---- one direction ---- */

/* The largest ratio beyond which no more than LEFT_OUT lies; `least` is that of a larger part. */
static double largest_weight(const survey *s, double least)
{
    double sum = 0;
    for (int i = RATIOS - 1; i >= 0; i--)
        if ((sum += s->rarely[i]) > LEFT_OUT)
            return fmax(exp2((i + 0.5) / PER_OCTAVE), least);
    return least;
}

/* By how much the upper half of a strip, by x, holds more than half of it: by the cubic through the densities at its
 * points, where `mass` is what they stand for, and at its ends, in the same unit. */
static double lean_of(double mass0, double mass1, double end0, double end1)
{
    double lean = 0.0625 * (end1 - end0) + 0.32475952641916447 * (mass1 - mass0), most = (mass0 + mass1) / 2;
    return fmin(fmax(lean, -most), most);
}

/* What is drawn in a cell, from the direction: below the horizon from v.first on, whose coordinate is 0 at rho. */
static vndf_drawn drawn_in(table t, seen v, int i, int below)
{
    const weights near = {0, v.c, 0, 0};
    piece p = below ? law_cell_below(t, v, i) : law_cell_above(t, v, i < v.first ? near : v.w, i);
    return (vndf_drawn){p.mass, p.e0 * p.mass, p.e1 * p.mass};
}

/* Takes what is seen and drawn in a part of the slopes; returns the difference. */
static double part(survey *s, double seen, double drawn, double *weight)
{
    if (seen > LEFT_OUT && seen > *weight * drawn)
        *weight = drawn > 0 ? seen / drawn : HUGE_VAL;
    else if (seen > *weight * drawn)
        s->rarely[drawn * 0x1p31 > seen ? (int)(PER_OCTAVE * log2(seen / drawn)) : RATIOS - 1] += seen;
    return fabs(seen - drawn);
}

/* Compares what is drawn with what is seen, strip by strip. */
static void compare(survey *s, seen v, int below, size_t edge, double area_seen, double area_drawn, double *figure)
{
    const size_t *strip = s->strips.first;
    double miss = 0, weight = 1, add = below ? 0 : PI * v.rho, per = v.s / (PI * area_seen);
    memset(s->rarely, 0, sizeof s->rarely);
    for (int first = below ? v.first : 0, i = first; i <= s->table.cells; i++) {
        vndf_drawn cell = drawn_in(s->table, v, i, below);
        int partial = below && i == first;
        double xi = partial ? 1 - v.near : 0, stretch = 1 / (1 - xi), before = 0;
        for (size_t n = partial ? edge : strip[i]; n < strip[i + 1]; n++) {
            double end = n + 1 < strip[i + 1] ? (s->xi[2 * n + 2] - xi) * stretch : 1;
            double next = vndf_drawn_before(&cell, end), all = (next - before) / area_drawn, upper = all / 2,
                   seen = per * (s->kernel[2 * n] + s->kernel[2 * n + 1] + add * s->strips.at[n].f),
                   lean = per * (s->tilt[n] + add * s->lean[n]);
            if (s->xi[2 * n + 1] > 0)
                upper = (next - vndf_drawn_before(&cell, (s->xi[2 * n + 1] - xi) * stretch)) / area_drawn;
            before = next;
            miss += part(s, seen / 2 - lean, all - upper, &weight) + part(s, seen / 2 + lean, upper, &weight);
        }
    }
    figure[TV] = fmin(miss / 2, 1);
    figure[WEIGHT] = largest_weight(s, weight);
}

/* One side. */
static void look_at_side(survey *s, size_t edge, int below, double *figure)
{
    table t = s->table;
    double rho = s->strips.at[edge].edge, sine = 1 / (1 + rho), beyond = 0, all = 0;
    int cell = find_knot(t, rho * rho, 1);
    seen v = below ? law_see_below(t, sine, rho * sine, rho, cell) : law_see_above(t, sine, rho * sine, rho);
    for (size_t i = 2 * edge; i < 2 * s->strips.count; i++)
        beyond += s->kernel[i];
    if (below && !(beyond > vndf_profile_claimed(s->profile) * 2 * PI * s->profile->f1 * hypot(1, rho)))
        return;
    for (int i = t.cells; i >= (below ? cell : 0); i--)
        all += drawn_in(t, v, i, below).mass;
    double area = (beyond + (below ? 0 : PI * rho)) * sine / PI, knot = look(t, VNDF_KNOT, cell).a;
    figure[CONSISTENCY] = fabs((double)(float)v.total / all - 1);
    if (cell == t.cells || look(t, VNDF_KNOT, cell + 1).a - knot > VNDF_GRAIN * rho)
        figure[AREA_ERROR] = fabs(law_area_in(t, v, cell, below) / area - 1);
    compare(s, v, below, edge, area, all, figure);
}

/* Looks from rho at an edge, above and below the horizon. */
static void look_from(survey *s, size_t edge)
{
    const vndf_strips *strips = &s->strips;
    double rho = strips->at[edge].edge;
    direction *to = &s->at[edge];
    if (to->known || !(rho >= RHO_LEAST && rho <= RHO_MOST) ||
        !vndf_guard_spend(s->profile->guard, 6 * (double)strips->count))
        return;
    *to = (direction){{{0, 1, 0, 0}, {0, 1, 0, 0}}, 1};
    double end = 0, upper;
    for (size_t i = 0; i < strips->count; i++, end = upper) {
        const vndf_strip *at = &strips->at[i];
        for (int k = 0; k < 2; k++)
            s->kernel[2 * i + k] = at->r[k] > rho ? at->mass[k] * vndf_profile_kernel(at->r[k], rho) : 0;
        upper = at[1].edge > rho && at[1].edge < HUGE_VAL ? vndf_profile_kernel(at[1].edge, rho) : 0;
        s->tilt[i] = s->xi[2 * i + 1] > 0 ? lean_of(s->kernel[2 * i], s->kernel[2 * i + 1], end * s->ends[2 * i], upper * s->ends[2 * i + 1]) : 0;
    }
    look_at_side(s, edge, 0, to->side[0]);
    look_at_side(s, edge, 1, to->side[1]);
}

/* ---- all directions ---- */

/* Looks from the edges beside the one with the largest figure, the nearer the later. */
static void look_near_worst(survey *s, int side, int figure, size_t apart)
{
    size_t best = 0, edges = s->strips.count;
    for (; apart > 0; apart /= 2) {
        for (size_t i = 0; i < edges; i++)
            best = s->at[i].known && s->at[i].side[side][figure] > s->at[best].side[side][figure] ? i : best;
        look_from(s, best > apart ? best - apart : 0);
        look_from(s, best + apart < edges ? best + apart : edges - 1);
    }
}

/* Some angles of incidence at alpha 1; of every so many cells the left knot and two places; and the neighbourhood of
 * what is worst. */
static void look_around(survey *s)
{
    static const double degrees[] = {0.001, 10, 30, 50, 60, 70, 80, 85, 89, 89.9, 89.999};
    const vndf_strip *at = s->strips.at;
    for (size_t i = 0; i < sizeof degrees / sizeof *degrees; i++)
        look_from(s, vndf_last_before(&at->edge, sizeof *at, s->strips.count,
                                      1 / (tan(degrees[i] * PI / 180) * s->profile->scale)));
    for (int i = 0; i <= s->table.cells; i += s->table.cells / CELLS_MOST + 1) {
        size_t from = s->strips.first[i], strips = s->strips.first[i + 1] - from;
        look_from(s, from);
        look_from(s, from + strips / 3);
        if (i > 0)
            look_from(s, from + 2 * strips / 3);
    }
    if (getenv("ALL")) for (size_t i = 0; i < s->strips.count; i++) { look_from(s, i);
        if (s->at[i].known) { double angle = atan2(1, s->strips.at[i].edge * s->profile->scale) * 180 / PI; printf("D %g rho %.8g f %.3g above %.3g %.3g %.3g below %.3g %.3g %.3g\n", 180-angle, s->strips.at[i].edge, s->strips.at[i].f, s->at[i].side[0][0], s->at[i].side[0][1], s->at[i].side[0][2], s->at[i].side[1][0], s->at[i].side[1][1], s->at[i].side[1][2]); } }
    for (int figure = TV; figure <= AREA_ERROR; figure++)
        for (int side = 0; side < 2; side++)
            look_near_worst(s, side, figure, 4);
}

/* Takes what is worst so far. */
static void take(vndf_certificate *c, const double *f, double rho, int side, double scale)
{
    double angle = atan2(1, rho * scale) * 180 / PI, theta = side ? 180 - angle : angle;
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
 * were, over the strips that hold all but LEFT_OUT of the mass on either side. */
static double ndf_error(const survey *s)
{
    const size_t *first = s->strips.first;
    double sum = 0, worst = 0;
    for (int i = 0; i <= s->table.cells; i++) {
        int tail = i == s->table.cells;
        piece all = law_cell_all(s->table, i);
        vndf_drawn cell = {all.mass, all.e0 * all.mass, all.e1 * all.mass};
        double before = 0;
        for (size_t n = first[i]; n < first[i + 1]; n++) {
            const vndf_strip *strip = &s->strips.at[n];
            double next = vndf_drawn_before(&cell, n + 1 < first[i + 1] ? s->xi[2 * n + 2] : 1), is = next - before;
            double right = tail ? strip->along : strip->f, upper = 0, lean = s->lean[n] * right / strip->f;
            if (s->xi[2 * n + 1] > 0)
                upper = is - vndf_drawn_before(&cell, s->xi[2 * n + 1]) + before;
            double error = upper > 0 ? fmax(fabs(upper / (right / 2 + lean) - 1), fabs((is - upper) / (right / 2 - lean) - 1)) : fabs(is / right - 1);
            before = next;
            sum += strip->f;
            if (sum > LEFT_OUT / 2 && sum < 1 - LEFT_OUT / 2 &&
                strip->f > LEFT_OUT * log(strip[1].edge / strip->edge))
                worst = fmax(worst, error);
        }
    }
    return worst;
}

int vndf_certificate_measure(vndf_certificate *c, const vndf_distribution *d, const vndf_profile *profile)
{
    const unsigned cells = (unsigned)d->cells;
    survey s = {.table = table_of(d), .profile = profile};
    float *knot = malloc((cells + 1) * sizeof *knot);
    for (unsigned i = 0; knot && i <= cells; i++)
        knot[i] = (float)look(s.table, VNDF_KNOT, (int)i).a;
    int good = knot && vndf_strips_from(&s.strips, profile, knot, cells + 1, cells);
    size_t n = good ? s.strips.count : 0;
    s.at = calloc(n + 1, sizeof *s.at);
    s.xi = calloc(2 * n + 2, sizeof *s.xi);
    s.lean = calloc(n + 1, sizeof *s.lean);
    s.ends = calloc(2 * n + 2, sizeof *s.ends);
    s.tilt = malloc((n + 1) * sizeof *s.tilt);
    s.kernel = malloc((2 * n + 1) * sizeof *s.kernel);
    good = good && s.at && s.xi && s.kernel && s.lean && s.ends && s.tilt;
    if (good) {
        for (unsigned i = 0; i <= cells; i++) {
            vndf_cell cell =
                vndf_cell_between(knot[i], i < cells ? (double)knot[i + 1] : HUGE_VAL, (unsigned)d->squarings);
            for (size_t k = s.strips.first[i]; k < s.strips.first[i + 1]; k++) {
                const vndf_strip *at = &s.strips.at[k];
                s.xi[2 * k] = vndf_cell_place(&cell, at->edge);
                if (at->gathered || !(at[1].edge < HUGE_VAL))
                    continue;
                double x0 = at->edge / (1 + at->edge), x1 = at[1].edge / (1 + at[1].edge), width = x1 - x0;
                s.xi[2 * k + 1] = vndf_cell_place(&cell, (x0 + x1) / (2 - x0 - x1));
                s.ends[2 * k] = PI * at->p0 * at->edge * width * (1 + at->edge) * (1 + at->edge);
                s.ends[2 * k + 1] = PI * at->p1 * at[1].edge * width * (1 + at[1].edge) * (1 + at[1].edge);
                s.lean[k] = lean_of(at->mass[0], at->mass[1], s.ends[2 * k], s.ends[2 * k + 1]);
            }
        }
        look_around(&s);
        *c = (vndf_certificate){.max_weight = 1};
        for (size_t i = 0; i < 2 * n; i++)
            if (s.at[i / 2].known)
                take(c, s.at[i / 2].side[i % 2], s.strips.at[i / 2].edge, i % 2, profile->scale);
        c->ndf_error = (float)ndf_error(&s);
        /* D = P22/cos^4 ~ cos^p towards the horizon; it may be unbounded there or at the pole, and no cell is */
        double first = profile->panel[0].r, end = profile->panel[profile->count].r;
        double power = vndf_profile_exponent(profile, end / 16, end / 4) - 4,
               pole = vndf_profile_exponent(profile, 4 * first, 16 * first);
        c->horizon_power = power < -4e-3 ? (float)power : 0.0f;
        c->weight_bounded = !(power < -4e-3) && (pole < 7e-3 || pole == HUGE_VAL);
        c->hidden = (float)profile->hidden;
        c->finest = (float)profile->finest;
    }
    vndf_strips_free(&s.strips);
    free(knot);
    free(s.at);
    free(s.xi);
    free(s.kernel);
    free(s.lean);
    free(s.ends);
    free(s.tilt);
    return good;
}
