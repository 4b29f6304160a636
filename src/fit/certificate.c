/* How good a table is. Given the slope length R all azimuths are drawn as they are seen, so the total variation is
 * that of the laws of R: the drawn one, by the text of the run time in double (kernel/law.h), against
 * f(R) k(R/rho) |c|/(pi A) of the profile, in halves of strips, which are as narrow as D varies. */
#include <stdlib.h>

#include "fit/draft.h"
#include "math/ascending.h"

#define VNDF_KERNEL_DOUBLE
#include "kernel/one.h"

#include "kernel/rows.h"

#include "kernel/law.h"

static const double PI = 3.14159265358979323846;
static const double LEFT_OUT = 1e-6; /* the part of what a direction sees that the largest weight leaves out */
static const double RHO_LEAST = 0x1p-20, RHO_MOST = 0x1p30; /* claims end there */
static const double Z_LEAST = 1e-26;                        /* law_length draws no less */
enum { CELLS_MOST = 256, RATIOS = 1024, PER_OCTAVE = 32 };

/* What one direction shows on one side; the largest weight less 1. */
enum { TV, WEIGHT, CONSISTENCY, FIGURES };

typedef struct direction {
    double side[2][FIGURES]; /* above, below */
    int known;
} direction;

/* A strip in which laws are compared, by halves. */
typedef struct halves {
    double xi, middle;   /* places in the cell: of its edge, and of its middle by x; 0 if it has no halves */
    double end[2], lean; /* f at its ends, in the unit of its points; of f (lean_of) */
    double seen, tilt;   /* from below, from the direction at hand: integral of k rho f, and its lean */
} halves;

typedef struct survey {
    table table;
    const vndf_profile *profile;
    vndf_strips strips;
    halves *in;            /* each strip, */
    direction *at;         /* and what is seen from rho at its edge */
    vndf_certificate *to;  /* what is worst so far */
    double furthest;       /* xi in the last cell beyond which all is drawn at one slope */
    double rarely[RATIOS]; /* what the direction at hand sees, by true over drawn density; or all, by error of D */
} survey;

/* ---- strips ---- */

/* By how much the upper half of a strip, by x, holds more than half of it: by the cubic through the densities at its
 * two points, which stand for half of it each, and at its ends, in the same unit. */
static double lean_of(double point0, double point1, double end0, double end1)
{
    const double of_ends = 0.0625, of_points = 0.32475952641916447; /* 3 sqrt(3)/16 */
    double lean = of_ends * (end1 - end0) + of_points * (point1 - point0), most = (point0 + point1) / 2;
    return fmin(fmax(lean, -most), most);
}

/* Places of strips in their cells, and halves of those that are not gathered. */
static void halve(survey *s, const float *knot)
{
    int cells = s->table.cells, squarings = s->table.squarings;
    for (int i = 0; i <= cells; i++) {
        vndf_cell cell =
            vndf_cell_between(knot[i], i < cells ? (double)knot[i + 1] : HUGE_VAL, (unsigned)squarings);
        for (size_t n = s->strips.first[i]; n < s->strips.first[i + 1]; n++) {
            const vndf_strip *at = &s->strips.at[n];
            double to = at[1].edge, z0 = 1 / (1 + at->edge), z1 = 1 / (1 + to), per = PI * (z0 - z1);
            halves *in = &s->in[n];
            in->xi = vndf_cell_place(&cell, at->edge);
            if (at->gathered || !(to < HUGE_VAL))
                continue;
            in->middle = vndf_cell_place(&cell, 2 / (z0 + z1) - 1);
            in->end[0] = per * at->p0 * at->edge / (z0 * z0);
            in->end[1] = per * at->p1 * to / (z1 * z1);
            in->lean = lean_of(at->mass[0], at->mass[1], in->end[0], in->end[1]);
        }
    }
    s->furthest = squarings > 0 ? 1 - pow(Z_LEAST * (1 + (double)knot[cells]), exp2(-squarings)) : 1;
}

/* ---- one direction ---- */

/* What is drawn in a cell, from the direction: below the horizon from v.first on, whose coordinate is 0 at rho. */
static vndf_drawn drawn_in(table t, radial_law v, int i, int below)
{
    const weights near = {0, v.c, 0, 0};
    cell_density p = below ? law_cell_below(t, v, i) : law_cell_above(t, v, i < v.first ? near : v.w, i);
    return (vndf_drawn){p.mass, p.e0 * p.mass, p.e1 * p.mass};
}

/* Adds a part that has a ratio, at least 1. */
static void add_part(survey *s, double part, double ratio)
{
    s->rarely[ratio < 0x1p31 ? (int)(PER_OCTAVE * log2(ratio)) : RATIOS - 1] += part;
}

/* Notes that some of what is seen is drawn too rarely; `weight` is the largest ratio of a larger part. */
static void note_ratio(survey *s, double right, double ratio, double *weight)
{
    if (ratio > *weight && right > LEFT_OUT)
        *weight = ratio;
    else if (ratio > *weight)
        add_part(s, right, ratio);
}

/* What is seen and what is drawn of both halves of a strip, or of all of it twice: returns the difference, and notes
 * the ratios, as if they changed evenly. */
static double miss_of(survey *s, const double right[2], const double is[2], double *weight)
{
    const double even = 1.01; /* and less need no note */
    if (right[0] > even * is[0] || right[1] > even * is[1]) {
        double ratio[2] = {is[0] > 0 ? right[0] / is[0] : HUGE_VAL, is[1] > 0 ? right[1] / is[1] : HUGE_VAL},
               change = fmax(ratio[0], ratio[1]) < HUGE_VAL ? (ratio[1] - ratio[0]) / 4 : 0;
        for (int i = 0; i < 4; i++)
            note_ratio(s, right[i / 2] / 2, ratio[i / 2] + (i % 2 ? change : -change), weight);
    }
    return fabs(right[0] - is[0]) + fabs(right[1] - is[1]);
}

/* The largest ratio beyond which no more than LEFT_OUT lies, 0 if that is all. */
static double largest_ratio(const survey *s)
{
    double sum = 0;
    for (int i = RATIOS - 1; i >= 0; i--)
        if ((sum += s->rarely[i]) > LEFT_OUT)
            return exp2((i + 0.5) / PER_OCTAVE);
    return 0;
}

/* Compares what is drawn with what is seen, half a strip after the other. What is lost lies beyond all slopes. */
static void compare(survey *s, radial_law v, int below, size_t edge, double area_seen, double area_drawn,
                    double *figure)
{
    const size_t *strip = s->strips.first;
    double miss = 0, lost = 0, weight = 1, add = below ? 0 : PI * v.rho, per = v.s / (PI * area_seen);
    memset(s->rarely, 0, sizeof s->rarely);
    for (int first = below ? v.first : 0, i = first; i <= s->table.cells; i++) {
        vndf_drawn cell = drawn_in(s->table, v, i, below);
        int partial = below && i == first;
        double xi = partial ? 1 - v.near : 0, stretch = 1 / (1 - xi), before = 0;
        double furthest = i < s->table.cells ? 1 : (s->furthest - xi) * stretch;
        for (size_t n = partial ? edge : strip[i]; n < strip[i + 1]; n++) {
            const halves *in = &s->in[n];
            double end = n + 1 < strip[i + 1] ? (in[1].xi - xi) * stretch : 1;
            double next = vndf_drawn_before(&cell, fmin(end, furthest)), is = (next - before) / area_drawn;
            double right = per * (in->seen + add * s->strips.at[n].f), lean = per * (in->tilt + add * in->lean);
            if (end > furthest) {
                miss += fabs(right - is);
            } else {
                double middle =
                    in->middle > 0 ? vndf_drawn_before(&cell, (in->middle - xi) * stretch) : (before + next) / 2;
                const double seen_of[2] = {right / 2 - lean, right / 2 + lean},
                             drawn_of[2] = {(middle - before) / area_drawn, (next - middle) / area_drawn};
                miss += miss_of(s, seen_of, drawn_of, &weight);
            }
            before = next;
        }
        lost = (cell.mass - before) / area_drawn;
    }
    figure[TV] = fmin((miss + lost) / 2, 1);
    figure[WEIGHT] = fmax(largest_ratio(s), weight) - 1;
    figure[CONSISTENCY] += lost;
}

/* Takes what is worst so far. */
static void take(const survey *s, const double *f, double rho, int side)
{
    vndf_certificate *c = s->to;
    double angle = atan2(1, rho * s->profile->scale) * 180 / PI, theta = side ? 180 - angle : angle;
    if (f[TV] > c->tv) {
        c->tv = (float)f[TV];
        c->tv_theta = (float)theta;
    }
    if (!side && f[TV] > c->tv_above) {
        c->tv_above = (float)f[TV];
        c->tv_above_theta = (float)theta;
    }
    c->max_weight = fmaxf(c->max_weight, 1 + (float)f[WEIGHT]);
    c->consistency = fmaxf(c->consistency, (float)f[CONSISTENCY]);
}

/* Compares on one side of the horizon, and takes what is worst. */
static void look_at_side(survey *s, double rho, size_t edge, int below, double *figure)
{
    table t = s->table;
    double sine = 1 / (1 + rho), beyond = 0, all = 0;
    int cell = find_knot(t, rho * rho, 1);
    radial_law v = below ? law_see_below(t, sine, rho * sine, rho, cell) : law_see_above(t, sine, rho * sine, rho);
    for (size_t i = edge; i < s->strips.count; i++)
        beyond += s->in[i].seen;
    if (below && !(beyond > vndf_profile_claimed(s->profile) * 2 * PI * s->profile->f1 * hypot(1, rho)))
        return;
    for (int i = t.cells; i >= (below ? cell : 0); i--)
        all += drawn_in(t, v, i, below).mass;
    double area = (beyond + (below ? 0 : PI * rho)) * sine / PI;
    figure[CONSISTENCY] = fabs((double)(float)v.total / all - 1);
    compare(s, v, below, edge, area, all, figure);
    take(s, figure, rho, below);
}

static double kernel_of(double r, double rho)
{
    return r > rho ? vndf_profile_kernel(r, rho) : 0;
}

/* Looks from rho, at an edge or in its strip: above the horizon and, if `sides` is 2, below it. */
static direction look_from(survey *s, double rho, size_t edge, int sides)
{
    const vndf_strip *at = s->strips.at;
    double inner = 0, outer;
    direction found = {.known = 0};
    if (!(rho >= RHO_LEAST && rho <= RHO_MOST) ||
        !vndf_guard_spend(s->profile->guard, 6 * (double)s->strips.count))
        return found;
    found.known = 1;
    for (size_t i = 0; i < edge; i++)
        s->in[i].seen = s->in[i].tilt = 0;
    for (size_t i = edge; i < s->strips.count; i++, inner = outer) {
        halves *in = &s->in[i];
        double near = at[i].mass[0] * kernel_of(at[i].r[0], rho), far = at[i].mass[1] * kernel_of(at[i].r[1], rho);
        outer = at[i + 1].edge < HUGE_VAL ? kernel_of(at[i + 1].edge, rho) : 0;
        in->seen = near + far;
        in->tilt = in->middle > 0 ? lean_of(near, far, inner * in->end[0], outer * in->end[1]) : 0;
    }
    for (int side = 0; side < sides; side++)
        look_at_side(s, rho, edge, side, found.side[side]);
    return found;
}

static void look_from_edge(survey *s, size_t edge)
{
    if (!s->at[edge].known)
        s->at[edge] = look_from(s, s->strips.at[edge].edge, edge, 2);
}

/* ---- all directions ---- */

/* By how much a figure rises per edge up to this one, from the known edge before it, or behind it if `step` is -1. */
static double rise_to(const survey *s, size_t edge, int step, int side, int figure)
{
    size_t from = edge - (size_t)step, steps = 1;
    for (; from < s->strips.count && !s->at[from].known; from -= (size_t)step)
        steps++;
    double rise = from < s->strips.count ? s->at[edge].side[side][figure] - s->at[from].side[side][figure] : 0;
    return rise / (double)steps;
}

/* Whether a direction between two edges may be worse than the worst so far: by how much figures change from one to the
 * other, or if they go on halfway as they change beyond both. */
static int may_be_worse(const survey *s, size_t a, size_t b)
{
    const double more = 1.02, tv[2] = {s->to->tv_above, s->to->tv}, weight = (double)s->to->max_weight - 1;
    int may = 0;
    for (int side = 0; side < 2; side++)
        for (int figure = TV; figure <= WEIGHT; figure++) {
            double one = s->at[a].side[side][figure], other = s->at[b].side[side][figure],
                   half = (double)(b - a) / 2, most = fmax(one, other) + fabs(one - other);
            most = fmax(most, one + half * rise_to(s, a, 1, side, figure));
            most = fmax(most, other + half * rise_to(s, b, -1, side, figure));
            may |= most > more * (figure == TV ? tv[side] : weight);
        }
    return may;
}

/* Looks from between two edges, as long as it may be worse there. */
static void look_between(survey *s, size_t a, size_t b)
{
    size_t middle = a + (b - a) / 2;
    if (middle == a || !may_be_worse(s, a, b))
        return;
    look_from_edge(s, middle);
    look_between(s, a, middle);
    look_between(s, middle, b);
}

/* Directions an octave of rho apart; at the left knots of every so many cells; on both sides of where k~ begins at
 * another knot, which shows above the horizon; and between edges. */
static void look_around(survey *s)
{
    enum { OCTAVES = 8 };
    const double before = 1 - 0x1p-22;
    const vndf_strip *at = s->strips.at;
    for (int i = -OCTAVES; i <= OCTAVES; i++)
        look_from_edge(s, vndf_last_before(&at->edge, sizeof *at, s->strips.count, exp2(i)));
    for (int i = 0; i <= s->table.cells; i += s->table.cells / CELLS_MOST + 1)
        look_from_edge(s, s->strips.first[i]);
    for (int i = 1; i < VNDF_RHO_PARTS; i++)
        if (first_knot(s->table, i) != first_knot(s->table, i - 1)) {
            double rho = of_bits((VNDF_RHO_FIRST + i) * (1 << 20));
            size_t edge = vndf_last_before(&at->edge, sizeof *at, s->strips.count, rho * before);
            look_from(s, rho * before, edge, 1);
            look_from(s, rho, edge, 1);
        }
    for (size_t i = 1, last = 0; i < s->strips.count; i++)
        if (s->at[i].known) {
            look_between(s, last, i);
            last = i;
        }
}

/* ---- areas ---- */

/* Whether the certificate claims a direction, z = 1/(1 + rho), that sees this area from below the horizon. */
static int is_claimed(const survey *s, double z, double below)
{
    return below > vndf_profile_claimed(s->profile) * 2 * s->profile->f1 * hypot(z, 1 - z);
}

/* The larger relative error of the areas from rho, above and below the horizon, while there is enough of it. What is
 * left of c below the horizon loses digits of floats (law_area_in). */
static double area_error_at(const survey *s, int cell, double rho)
{
    const double floats = 0x1p-22, digits = 4e-4;
    table t = s->table;
    if (!(rho >= RHO_LEAST && rho <= RHO_MOST))
        return 0;
    double sine = 1 / (1 + rho), cosine = rho * sine, below = vndf_profile_below(s->profile, sine, cosine).below,
           above = below + cosine;
    double error = fabs(law_area_in(t, law_see_above(t, sine, cosine, rho), cell, 0) / above - 1);
    if (is_claimed(s, sine, below)) {
        double lost =
            below > digits * above ? floats * fmin((below / above - digits) * 625, 1) * above / below : 0;
        double left = law_area_in(t, law_see_below(t, sine, cosine, rho, cell), cell, 1);
        error = fmax(error, lost + fabs(left / below - 1));
    }
    return error;
}

/* Measures the area at z = 1/(1 + rho), and keeps the larger error and its place. Returns whether it is this one. */
static int note_area(const survey *s, int cell, double z, double *worst, double *where)
{
    double error = area_error_at(s, cell, 1 / z - 1);
    if (!(error > *worst))
        return 0;
    *worst = error;
    *where = z;
    return 1;
}

/* The smallest z that is claimed, within 1/64 of its cell. */
static double last_claimed(const survey *s)
{
    int cell = 0;
    for (int step = s->table.highest; step > 0; step /= 2) {
        double next = load_knot(s->table, min_int(cell + step, s->table.cells)).z;
        if (cell + step <= s->table.cells &&
            is_claimed(s, next, vndf_profile_below(s->profile, next, 1 - next).below))
            cell += step;
    }
    knot_row k = load_knot(s->table, cell);
    double z = k.z, width = cell < s->table.cells ? k.width : k.z;
    for (int n = 1; n <= 6; n++) {
        double next = z - ldexp(width, -n);
        z = is_claimed(s, next, vndf_profile_below(s->profile, next, 1 - next).below) ? next : z;
    }
    return z;
}

/* The largest error at places of all cells, then around it. The cell in which claims end is divided up to there, since
 * errors grow towards the end of a support. */
static double area_error(const survey *s)
{
    enum { PLACES = 3, HALVINGS = 3 };
    double worst = 0, where = 1, step = 0, last = last_claimed(s);
    for (int i = 0; i <= s->table.cells; i++) {
        knot_row k = load_knot(s->table, i);
        double end = k.z - (i < s->table.cells ? k.width : k.z), width = (k.z - end) / (PLACES + 1);
        if (last > end && last < k.z)
            width = (k.z - last) / PLACES;
        for (int n = 1; n <= PLACES && width > VNDF_GRAIN * k.z * (1 - k.z); n++)
            if (note_area(s, i, k.z - n * width, &worst, &where))
                step = width;
    }
    for (int n = 0; n < 2 * HALVINGS; n++) {
        step = n % 2 ? -step : -step / 2;
        double rho = 1 / (where + step) - 1;
        note_area(s, find_knot(s->table, rho * rho, 1), where + step, &worst, &where);
    }
    return worst;
}

/* ---- D, and its ends ---- */

/* Error of D in a strip, of which `drawn` is drawn in the cell: of all of it; at its ends and points; and in its
 * middle, by the cubic through those. In the last cell, which draws R f, it is that of all alone. */
static double strip_error(const vndf_drawn *cell, const vndf_strip *strip, const halves *in, double end,
                          int is_tail, double drawn)
{
    static const double places[4] = {0, 0.21132486540518712, 0.78867513459481288, 1};
    const double right[4] = {in->end[0], strip->mass[0], strip->mass[1], in->end[1]}, wide = end - in->xi;
    double worst = fabs(drawn / (is_tail ? strip->along : strip->f) - 1), off[4];
    if (!(in->middle > 0) || is_tail)
        return worst;
    for (int k = 0; k < 4; k++) {
        off[k] = wide / 2 * vndf_drawn_density(cell, in->xi + wide * places[k]) / right[k] - 1;
        worst = fmax(worst, fabs(off[k]));
    }
    return fmax(worst, fabs(3 * (off[1] + off[2]) - off[0] - off[3]) / 4);
}

/* Largest relative error of D, but for LEFT_OUT of all normals. */
static double ndf_error(survey *s)
{
    const double least = 0x1p-24; /* of errors that are told apart */
    const size_t *first = s->strips.first;
    memset(s->rarely, 0, sizeof s->rarely);
    for (int i = 0; i <= s->table.cells; i++) {
        cell_density all = law_cell_all(s->table, i);
        vndf_drawn cell = {all.mass, all.e0 * all.mass, all.e1 * all.mass};
        double before = 0, next;
        for (size_t n = first[i]; n < first[i + 1]; n++, before = next) {
            double end = n + 1 < first[i + 1] ? s->in[n + 1].xi : 1;
            next = vndf_drawn_before(&cell, end);
            double error =
                strip_error(&cell, &s->strips.at[n], &s->in[n], end, i == s->table.cells, next - before) / least;
            if (error >= 1)
                add_part(s, s->strips.at[n].f, error);
        }
    }
    return largest_ratio(s) * least;
}

/* D = P22/cos^4 ~ cos^p towards the horizon; it may be unbounded there or at the pole, and no cell is. */
static void put_ends(vndf_certificate *c, const vndf_profile *profile)
{
    double power = profile->tail - 4, pole = profile->pole;
    c->horizon_power = power < -4e-3 ? (float)power : 0.0f;
    c->weight_bounded = !(power < -4e-3) && (pole < 7e-3 || pole == HUGE_VAL);
    c->hidden = (float)profile->hidden;
    c->finest = (float)profile->finest;
}

int vndf_certificate_measure(vndf_certificate *c, const vndf_distribution *d, const vndf_profile *profile)
{
    const unsigned cells = (unsigned)d->cells;
    survey s = {.table = table_of(d), .profile = profile, .to = c};
    float *knot = malloc((cells + 1) * sizeof *knot);
    for (unsigned i = 0; knot && i <= cells; i++)
        knot[i] = (float)load_knot(s.table, (int)i).r;
    int good = knot && vndf_strips_from(&s.strips, profile, knot, cells + 1, cells);
    size_t n = good ? s.strips.count : 0;
    s.at = calloc(n + 1, sizeof *s.at);
    s.in = calloc(n + 1, sizeof *s.in);
    good = good && s.at && s.in;
    if (good) {
        halve(&s, knot);
        *c = (vndf_certificate){.max_weight = 1};
        look_around(&s);
        c->area_error = (float)area_error(&s);
        c->ndf_error = (float)ndf_error(&s);
        put_ends(c, profile);
    }
    vndf_strips_free(&s.strips);
    free(knot);
    free(s.at);
    free(s.in);
    return good;
}
