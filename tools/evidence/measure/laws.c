#include "evidence/measure/laws.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/sort.h"

static const double PI = 3.14159265358979323846;
static const double SLOPE_LEAST = 1e-37, SLOPE_MOST = 1e37; /* of float normals, over the median slope */
static const double LEFT_OUT = 1e-6;     /* the part that the largest weight and the error of D leave out */
static const double AREA_LEAST = 1e-10;  /* over the area at grazing incidence */
static const double FIRST = 0x1p-7;      /* widths of panels in log R: at first, */
static const double UNDECIDED = 0x1p-20; /* below which floats do not tell on which side of a jump they are, */
static const double LEAST = 0x1p-44;     /* and at a jump */
static const double VARIES = 1e-2;       /* what P22 may be off a cubic in a panel */
static const double ROUNDING = 0x1p-23;  /* of cot(theta) */
static const double LITTLE[2] = {1e-15, 1e-18}, FEW[2] = {1e-13, 1e-17}; /* parts of the mass, and of the area at
                                                                          * grazing incidence: of no account; not
                                                                          * worth halving */
enum { GAUSS = 4, TRIED = 2 * GAUSS + 2, QUANTILES = 512, PANELS_MOST = 1 << 18, JUMPS = 256, JUMPS_SEEN = 32 };
enum { GRADES = 200, PARTS = 24, BLOCK = 256, BINS = 4096, PER_BIN = 64 };
static const double place[GAUSS] = {0.069431844202973712, 0.33000947820757187, 0.66999052179242813,
                                    0.93056815579702629};
static const double share[2] = {0.17392742256872693, 0.32607257743127307};

/* A point of the quadrature: a slope over the median. */
typedef struct point {
    double r, p, drawn; /* P22 of the source as it is; of the table */
    double mass, solid; /* P22 R dR of the source; 2 pi R dR over what a solid angle takes of the slopes */
    double seen, moved; /* from the direction at hand: the mean of (c + s R cos a)+, and its change by log |c| */
    vndf_vec3 wm;       /* leans towards the direction */
} point;

typedef struct panel {
    double from, to;
    point at[GAUSS];
} panel;

/* Of each value what part has it, in bins that are even between powers of 2. */
typedef struct spread {
    double part[BINS];
} spread;

typedef struct laws {
    const vndf_source *source;
    vndf_surface surface; /* its slopes are over the median */
    double scale, unit;   /* the median; P22 of the table over that of the source, as it is said */
    panel *panel;         /* in their order; behind them there is room for GRADES of one direction */
    size_t count, jumps;
    double jump[JUMPS];
    double mass[2], tail[2]; /* integrals of P22 R dR and P22 R^2 dR: all, and beyond the panels */
    spread spread;
    laws_figure *worst;
    double rho[LAWS_FIGURES]; /* where it was found */
    int below[LAWS_FIGURES];
} laws;

static void add_to(spread *s, double value, double part)
{
    int power;
    double digits = frexp(fmin(fmax(value, 1e-9), 1e9), &power);
    s->part[(power + 32) * PER_BIN + (int)((2 * digits - 1) * PER_BIN)] += part;
}

/* The largest value, but for LEFT_OUT of all; empties the bins. */
static double take_most(spread *s)
{
    double sum = 0;
    int i = BINS;
    while (i > 0 && sum <= LEFT_OUT)
        sum += s->part[--i];
    memset(s, 0, sizeof *s);
    return i == 0 ? 0 : ldexp(1 + (i % PER_BIN + 0.5) / PER_BIN, i / PER_BIN - 33);
}

/* ---- points ---- */

/* At a slope that a float normal has, if floats tell slopes apart in a width. */
static point point_at(const laws *l, double r, double dr, double width)
{
    double z = 1 / hypot(1, r), p;
    const vndf_vec3 wm = {(float)(r * z), 0, (float)z};
    r = width > UNDECIDED * r ? (double)wm.x / (double)wm.z : r;
    p = vndf_source_p22(l->source, r * l->scale);
    return (point){r, p, (double)vndf_p22(&l->surface, (float)r, 0), p * r * dr, 2 * PI * r * dr * z * z * z, 0,
                   0, wm};
}

static panel panel_of(const laws *l, double from, double to)
{
    panel made = {.from = from, .to = to};
    for (int k = 0; k < GAUSS; k++)
        made.at[k] = point_at(l, from + place[k] * (to - from), share[k % 3 != 0] * (to - from), to - from);
    return made;
}

/* How far both P22 are off the cubics through the points of a panel, over the largest; `tried` are the points of its
 * halves and its ends. */
static double variation(const panel *p, const point tried[TRIED])
{
    double off[2] = {0, 0}, most[2] = {1e-300, 1e-300};
    for (int i = 0; i < TRIED; i++) {
        double x = i < GAUSS ? place[i] / 2 : i < 2 * GAUSS ? (1 + place[i - GAUSS]) / 2 : i - 2 * GAUSS;
        double cubic[2] = {0, 0};
        for (int k = 0; k < GAUSS; k++) {
            double part = 1;
            for (int j = 0; j < GAUSS; j++)
                part *= j == k ? 1 : (x - place[j]) / (place[k] - place[j]);
            cubic[0] += part * p->at[k].p;
            cubic[1] += part * p->at[k].drawn;
        }
        off[0] = fmax(off[0], fabs(cubic[0] - tried[i].p)), most[0] = fmax(most[0], tried[i].p);
        off[1] = fmax(off[1], fabs(cubic[1] - tried[i].drawn)), most[1] = fmax(most[1], tried[i].drawn);
    }
    return fmax(off[0] / most[0], off[1] / most[1]);
}

/* Halves a panel until P22 of source and table are smooth in it, or it holds next to nothing. */
static void refine(laws *l, const panel *p)
{
    double middle = p->from + (p->to - p->from) / 2, inside = 1e-12 * (p->to - p->from), most = 0;
    const panel half[2] = {panel_of(l, p->from, middle), panel_of(l, middle, p->to)};
    point tried[TRIED] = {[2 * GAUSS] = point_at(l, p->from + inside, 0, 0), point_at(l, p->to - inside, 0, 0)};
    memcpy(tried, half[0].at, sizeof half[0].at);
    memcpy(tried + GAUSS, half[1].at, sizeof half[1].at);
    for (int i = 0; i < TRIED; i++)
        most = fmax(most, fmax(tried[i].p, tried[i].drawn / l->unit));
    double m0 = most * p->to * (p->to - p->from) / l->mass[0], m1 = m0 * p->to * l->mass[0] / l->mass[1];
    if ((m0 < LITTLE[0] && m1 < LITTLE[1]) || l->count + GRADES == PANELS_MOST)
        return;
    int smooth = (m0 < FEW[0] && m1 < FEW[1]) || l->count > PANELS_MOST / 2 || variation(p, tried) < VARIES;
    if (!smooth && p->to - p->from > LEAST * p->to) {
        refine(l, &half[0]);
        refine(l, &half[1]);
        return;
    }
    if (!smooth && l->jumps < JUMPS && (l->jumps == 0 || l->jump[l->jumps - 1] < p->from * (1 - UNDECIDED)))
        l->jump[l->jumps++] = p->from;
    l->panel[l->count++] = *p;
}

/* Panels that are even in log R, and end at quantiles of what is drawn from above and at grazing incidence, where
 * narrow lobes are. Beyond them P22 falls as a power. */
static int place_points(laws *l)
{
    const size_t even = (size_t)(log(SLOPE_MOST / SLOPE_LEAST) / FIRST), all = even + 1 + 2 * QUANTILES;
    double *end = malloc(all * sizeof *end);
    l->panel = malloc(PANELS_MOST * sizeof *l->panel);
    for (size_t i = 0; end && i < all; i++) {
        end[i] = SLOPE_LEAST * exp((double)i * FIRST);
        if (i > even) {
            size_t side = i % 2;
            vndf_view view = vndf_view_from(&l->surface, (vndf_vec3){(float)side, 0, (float)!side});
            vndf_vec3 wm = vndf_sample(&view, 0.5f, ((float)(i - even) - 0.5f) / (2 * QUANTILES), NULL);
            end[i] = fmin(fmax((double)hypotf(wm.x, wm.y) / (double)wm.z, SLOPE_LEAST), SLOPE_MOST);
        }
    }
    if (end && l->panel) {
        sort_numbers(end, all);
        for (size_t i = 0; i + 1 < all; i++)
            if (end[i + 1] > end[i]) {
                const panel first = panel_of(l, end[i], end[i + 1]);
                refine(l, &first);
            }
    }
    free(end);
    double r = SLOPE_MOST, p = point_at(l, r, 0, 0).p,
           n = p > 0 ? log(point_at(l, r / 16, 0, 0).p / p) / log(16) : 4;
    l->mass[0] = l->tail[0] = p * r * r / (n - 2);
    l->mass[1] = l->tail[1] = p * r * r * r / (n - 3);
    for (size_t i = 0; i < GAUSS * l->count; i++) {
        const point *at = &l->panel[i / GAUSS].at[i % GAUSS];
        l->mass[0] += at->mass;
        l->mass[1] += at->mass * at->r;
    }
    return end && l->panel;
}

/* Not where floats do not tell a point from rho, or from the other side of a jump. */
static int is_decided(const panel *p, double rho)
{
    return p->to - p->from > UNDECIDED * p->to && p->from - rho > UNDECIDED * rho;
}

/* ---- one direction ---- */

/* The mean over the azimuth, with digits close beside the horizon too. */
static void see(point *at, double s, double c)
{
    double away = s * at->r - fabs(c), w = away > 0 ? sqrt(away * (s * at->r + fabs(c))) : 0, h = fabs(c),
           t = w / h;
    double arc = atan2(w, h), k = t < 0.02 ? h * t * t * t * (1.0 / 3 - t * t * (0.2 - t * t / 7)) : w - h * arc;
    at->seen = k / PI + fmax(c, 0);
    at->moved = h * (c > 0 ? PI - arc : arc) / PI;
}

/* Below the horizon panels of its own from rho on, narrower towards it, behind the others; returns the first of those
 * that stay as they are, and where all end. */
static size_t grade(laws *l, double rho, size_t *end)
{
    size_t first = 0;
    for (size_t step = PANELS_MOST; step > 0; step /= 2)
        first += first + step <= l->count && l->panel[first + step - 1].to <= rho ? step : 0;
    *end = l->count;
    for (; first < l->count && *end + PARTS < l->count + GRADES; first++) {
        const panel whole = l->panel[first];
        double parts[PARTS], from = fmax(whole.from, rho), width = whole.to - rho;
        int n = 0;
        if (width <= 1.5 * (from - rho))
            break;
        for (parts[n++] = whole.to; n < PARTS && width > 1.5 * (from - rho) && width > LEAST * rho; width *= 0.66)
            parts[n++] = rho + 0.66 * width;
        while (n-- > 0)
            if (parts[n] > from) {
                l->panel[(*end)++] = panel_of(l, from, parts[n]);
                from = parts[n];
            }
    }
    return first;
}

/* Both laws, added up; the area that is seen is A. */
typedef struct sums {
    double drawn, rarely, often;
} sums;

static void compare(laws *l, size_t from, size_t count, vndf_vec3 wi, double rho, double A, sums *sum)
{
    float x[BLOCK], y[BLOCK] = {0}, z[BLOCK], pdf[BLOCK];
    const vndf_batch batch = {.distribution = l->surface.distribution,
                              .count = GAUSS * count,
                              .shared = VNDF_SHARED_ALPHA | VNDF_SHARED_WI,
                              .alpha_x = &l->surface.alpha_x,
                              .alpha_y = &l->surface.alpha_y,
                              .wi_x = &wi.x,
                              .wi_y = &wi.y,
                              .wi_z = &wi.z};
    for (size_t i = 0; i < GAUSS * count; i++) {
        x[i] = l->panel[from + i / GAUSS].at[i % GAUSS].wm.x;
        z[i] = l->panel[from + i / GAUSS].at[i % GAUSS].wm.z;
    }
    vndf_pdf_n(&batch, (vndf_normals){x, y, z}, pdf);
    for (size_t i = 0; i < GAUSS * count; i++) {
        const panel *p = &l->panel[from + i / GAUSS];
        const point *at = &p->at[i % GAUSS];
        double facing = (double)wi.z + (double)wi.x * at->r, right = at->mass * at->seen / A;
        double is = facing > 0 ? (double)pdf[i] * at->solid * at->seen / facing : 0;
        sum->drawn += is;
        if (!is_decided(p, rho))
            continue;
        sum->rarely += fmax(right - is, 0);
        sum->often += fmax(is - right, 0);
        if (right > is)
            add_to(&l->spread, right / is - 1, right);
    }
}

static void take(laws *l, int figure, double measured, double rho, int below)
{
    double angle = atan2(1, rho * l->scale) * 180 / PI;
    if (measured > l->worst[figure].measured) {
        l->worst[figure].measured = measured;
        l->worst[figure].theta = below ? 180 - angle : angle;
        l->rho[figure] = rho;
        l->below[figure] = below;
    }
}

/* Looks from the direction whose cotangent over the median slope is rho, as floats have it. */
static void look_from(laws *l, double asked, int below)
{
    const vndf_vec3 wi = {asked < 1 ? 1 : (float)(1 / asked), 0,
                          (below ? -1 : 1) * (asked < 1 ? (float)asked : 1)};
    double s = (double)wi.x, c = (double)wi.z, rho = fabs(c) / s, area = 0, moved = 0;
    size_t end = l->count, from = below ? grade(l, rho, &end) : 0;
    for (size_t i = GAUSS * from; i < GAUSS * end; i++) {
        point *at = &l->panel[i / GAUSS].at[i % GAUSS];
        see(at, s, c);
        area += at->mass * at->seen;
        moved += at->mass * at->moved;
    }
    double beyond = s * l->tail[1] / PI + c / 2 * l->tail[0], A = area + beyond, slack = ROUNDING * moved / A;
    if (!(A > AREA_LEAST * hypot(s, c * l->scale) * l->mass[1] / PI))
        return;
    sums sum = {0, beyond / A, 0};
    for (size_t i = from; i < end; i += BLOCK / GAUSS)
        compare(l, i, end - i < BLOCK / GAUSS ? end - i : BLOCK / GAUSS, wi, below ? rho : 0, A, &sum);
    double tv = fmax(fmax(sum.rarely, sum.often) - slack, 0);
    double is_area = (double)vndf_projected_area(&l->surface, wi) * l->mass[0];
    take(l, LAWS_TV, tv, rho, below);
    if (!below)
        take(l, LAWS_TV_ABOVE, tv, rho, below);
    take(l, LAWS_MAX_WEIGHT, 1 + take_most(&l->spread), rho, below);
    take(l, LAWS_AREA_ERROR, fmax(fabs(is_area / A - 1) - slack, 0), rho, below);
    take(l, LAWS_CONSISTENCY, fmax(fabs(sum.drawn - 1) - slack - tv / 20, 0), rho,
         below); /* points miss some at knots */
}

static void look_both_ways(laws *l, double rho)
{
    look_from(l, rho, 0);
    if (rho > 0)
        look_from(l, rho, 1);
}

/* ---- all directions ---- */

/* Even in log rho between the slopes that are seen, and in what is left of the area. */
static void look_around(laws *l, int per_octave, vndf_progress *progress, void *user, int *go_on)
{
    double m0 = 0, m1 = l->tail[1], low = 0, high = 0, next = AREA_LEAST, step = exp2(1.0 / per_octave);
    for (size_t i = GAUSS * l->count; i-- > 0 && *go_on;) {
        const point *at = &l->panel[i / GAUSS].at[i % GAUSS];
        m1 += at->mass * at->r;
        high = m1 < 1e-12 * l->mass[1] ? at->r : high;
        if (m1 > next * l->mass[1]) {
            *go_on = !progress || progress(0.5 + log(next) / log(AREA_LEAST) / -2, "certificate", user) == 0;
            look_both_ways(l, at->r);
            while (m1 > next * l->mass[1])
                next *= step;
        }
    }
    for (size_t i = 0; i < l->count && m0 < 1e-4 * l->mass[0]; i++) {
        m0 += l->panel[i].at[0].mass + l->panel[i].at[1].mass + l->panel[i].at[2].mass + l->panel[i].at[3].mass;
        low = l->panel[i].from;
    }
    low = fmax(low / 64, 1e-6), high = high > 0 ? fmin(8 * high, 1e6) : 1e6;
    for (double rho = low; rho < high && *go_on; rho *= step) {
        *go_on = !progress || progress(0.5 + 0.5 * log(rho / low) / log(high / low), "certificate", user) == 0;
        look_both_ways(l, rho);
    }
}

/* Beside jumps; at the horizon; where the certificate found its worst; and around what is worst here. */
static void look_closer(laws *l, const vndf_certificate *c, int per_octave)
{
    static const double beside[] = {-0.3, -0.05, -1e-2, -1e-3, -3e-4, -1e-4, -1e-5, 0, 1e-4, 1e-2};
    for (size_t i = 0; i < l->jumps; i += l->jumps / JUMPS_SEEN + 1)
        for (size_t k = 0; k < sizeof beside / sizeof *beside; k++)
            look_both_ways(l, l->jump[i] * (1 + beside[k]));
    look_both_ways(l, 0);
    look_both_ways(l, fabs(1 / (tan((double)c->tv_theta * PI / 180) * l->scale)));
    look_both_ways(l, fabs(1 / (tan((double)c->tv_above_theta * PI / 180) * l->scale)));
    for (int figure = LAWS_TV; figure <= LAWS_AREA_ERROR; figure++)
        for (double step = 0.5 / per_octave; step > 1e-5; step /= 2) {
            const double at = l->rho[figure];
            look_from(l, at * exp2(step), l->below[figure]);
            look_from(l, at * exp2(-step), l->below[figure]);
        }
}

static double ndf_error(laws *l)
{
    for (size_t i = 0; i < GAUSS * l->count; i++) {
        const point *at = &l->panel[i / GAUSS].at[i % GAUSS];
        if (at->p > 0 && is_decided(&l->panel[i / GAUSS], 0))
            add_to(&l->spread, fabs(2 * PI * l->mass[0] * at->drawn / at->p - 1), at->mass / l->mass[0]);
    }
    return take_most(&l->spread);
}

int laws_measure(const vndf_distribution *table, const vndf_source *source, int per_octave,
                 vndf_progress *progress, void *user, laws_figure found[LAWS_FIGURES])
{
    static const char *const names[] = {"tv", "tv_above", "max_weight", "area_error", "consistency", "ndf_error"};
    const vndf_info info = vndf_distribution_info(table);
    const vndf_certificate *c = &info.certificate;
    const float stored[] = {c->tv, c->tv_above, c->max_weight, c->area_error, c->consistency, c->ndf_error};
    laws *l = calloc(1, sizeof *l);
    int done = l != NULL;
    for (int i = 0; i < LAWS_FIGURES; i++)
        found[i] = (laws_figure){names[i], (double)stored[i], -1, NAN, 0};
    if (done) {
        float alpha = (float)(1 / info.scale);
        for (int i = -2; i <= 2; i++) /* the one that makes a median of 1, if a float does */
            if ((alpha + (float)i * 0x1p-24f * alpha) * (float)info.scale == 1)
                alpha += (float)i * 0x1p-24f * alpha;
        *l = (laws){.source = source, .surface = {table, alpha, alpha}, .scale = info.scale, .worst = found};
        l->unit = info.normalization * info.scale * info.scale;
        l->mass[0] = 1 / (2 * PI * l->unit); /* first guesses */
        l->mass[1] = PI * l->mass[0] * (double)vndf_projected_area(&l->surface, (vndf_vec3){1, 0, 0});
        done = place_points(l);
    }
    if (done)
        look_around(l, per_octave, progress, user, &done);
    if (done) {
        look_closer(l, c, per_octave);
        found[LAWS_NDF_ERROR].measured = ndf_error(l);
    }
    for (int i = 0; done && i < LAWS_FIGURES; i++) {
        double best = i == LAWS_MAX_WEIGHT, claim = found[i].stored - best;
        found[i].good = found[i].measured >= 0 && found[i].measured - best <= fmax(1.1 * claim, claim + 2e-5);
    }
    if (l)
        free(l->panel);
    free(l);
    return done;
}
