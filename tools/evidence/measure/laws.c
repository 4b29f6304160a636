#include "evidence/measure/measure.h"

#include <math.h>
#include <string.h>

#include "cli/sort.h"

static const double PI = 3.14159265358979323846;
static const double SLOPE_LEAST = 1e-37, SLOPE_MOST = 1e26; /* over the median: no slope is drawn beyond */
static const double LEFT_OUT = 1e-6;     /* the part that the largest weight and the error of D leave out */
static const double AREA_LEAST = 1e-10;  /* over the area at grazing incidence */
static const double FIRST = 0x1p-7;      /* widths of panels in log R: at first, */
static const double UNDECIDED = 0x1p-20; /* below which floats do not tell on which side of a jump they are, */
static const double LEAST = 0x1p-44;     /* and at a jump */
static const double VARIES = 3e-3;       /* what P22 may be off a cubic in a panel */
static const double LITTLE_MASS = 1e-15, LITTLE_AREA = 1e-18; /* of a panel, of all: it is left out */
static const double ROUNDING = 0x1p-22;                       /* of cot(theta) and of slopes: two of floats */
enum { GAUSS = 4, TRIED = 2 * GAUSS + 2, QUANTILES = 1024, PANELS_MOST = 1 << 17, JUMPS_MOST = 32 };
enum { GRADES = 200, PARTS = 24, BINS = 4096, PER_OCTAVE = 64 };
static const double place[GAUSS] = {0.069431844202973712, 0.33000947820757187, 0.66999052179242813,
                                    0.93056815579702629};
static const double share[2] = {0.17392742256872693, 0.32607257743127307};

/* A point of the quadrature: a slope over the median. */
typedef struct point {
    double r, p, drawn; /* P22 of the source as it is; of the table */
    double both;        /* P22 of the source as the table says it is normalised, and of the table */
    double mass, solid; /* P22 R dR of the source; 2 pi R dR over what a solid angle takes of the slopes */
    double seen;        /* the mean of (c + s R cos a)+ from the direction at hand */
    float x, z;         /* the normal that leans towards it */
} point;

/* Panel i is from end[2 i] to end[2 i + 1] and has GAUSS points. `count` of them ascend; then there is room for GRADES
 * of the direction at hand. */
typedef struct laws {
    const vndf_source *source;
    vndf_surface surface; /* its slopes are over the median */
    double scale, unit;   /* the median, rounded; P22 of the table over that of the source, as it is said */
    size_t count;
    double end[2 * PANELS_MOST];
    point at[GAUSS * PANELS_MOST];
    float x[GAUSS * PANELS_MOST], y[GAUSS * PANELS_MOST], z[GAUSS * PANELS_MOST], pdf[GAUSS * PANELS_MOST];
    double mass[2], tail[2]; /* integrals of P22 R dR and P22 R^2 dR: all, and beyond the panels */
    double part[BINS];       /* of all, that has a value: bins are even in its logarithm */
    laws_figure *worst;
    double rho[LAWS_FIGURES]; /* where it was found; negative below the horizon */
} laws;

static void add_to(laws *l, double value, double part)
{
    l->part[BINS / 2 + (int)floor(PER_OCTAVE * log2(fmin(fmax(value, 1e-9), 1e9)))] += part;
}

/* The largest value, but for LEFT_OUT of all; empties the bins. */
static double take_most(laws *l)
{
    double sum = 0;
    int i = BINS;
    while (i > 0 && sum <= LEFT_OUT)
        sum += l->part[--i];
    memset(l->part, 0, sizeof l->part);
    return i == 0 ? 0 : exp2((i + 0.5 - BINS / 2) / PER_OCTAVE);
}

/* ---- points ---- */

/* At a slope that a float normal has, if floats tell slopes apart in the width of its panel. */
static point point_at(const laws *l, double r, double dr, double width)
{
    double z = 1 / hypot(1, r);
    point at = {.x = (float)(r * z), .z = (float)z};
    at.r = width > UNDECIDED * r ? (double)at.x / (double)at.z : r;
    at.p = vndf_source_p22(l->source, at.r * l->scale);
    at.drawn = (double)vndf_p22(&l->surface, (float)at.r, 0);
    at.both = l->unit * at.p + at.drawn;
    at.mass = at.p * at.r * dr;
    at.solid = 2 * PI * at.r * dr * z * z * z;
    return at;
}

static void put_points(const laws *l, double from, double to, point at[GAUSS])
{
    for (int k = 0; k < GAUSS; k++)
        at[k] = point_at(l, from + place[k] * (to - from), share[k % 3 != 0] * (to - from), to - from);
}

static void add_panel(laws *l, size_t i, double from, double to, const point at[GAUSS])
{
    l->end[2 * i] = from;
    l->end[2 * i + 1] = to;
    memcpy(&l->at[GAUSS * i], at, GAUSS * sizeof *at);
    for (size_t k = GAUSS * i; k < GAUSS * (i + 1); k++)
        l->x[k] = l->at[k].x, l->z[k] = l->at[k].z;
}

/* How far both P22 are off the cubic through the points of a panel, at those of its halves and at its ends, over the
 * largest. */
static double variation(const point at[GAUSS], const point tried[TRIED])
{
    double off = 0, most = 1e-300;
    for (int i = 0; i < TRIED; i++) {
        double x = i < GAUSS       ? place[i] / 2
                   : i < 2 * GAUSS ? (1 + place[i - GAUSS]) / 2
                                   : i - 2 * GAUSS,
               cubic = 0;
        for (int k = 0; k < GAUSS; k++) {
            double part = at[k].both;
            for (int j = 0; j < GAUSS; j++)
                part *= j == k ? 1 : (x - place[j]) / (place[k] - place[j]);
            cubic += part;
        }
        off = fmax(off, fabs(cubic - tried[i].both));
        most = fmax(most, tried[i].both);
    }
    return off / most;
}

/* Halves a panel until both P22 are smooth in it. */
static void refine(laws *l, double from, double to, const point at[GAUSS])
{
    double middle = from + (to - from) / 2, inside = 1e-12 * (to - from), most = 0;
    point tried[TRIED];
    put_points(l, from, middle, tried);
    put_points(l, middle, to, tried + GAUSS);
    tried[2 * GAUSS] = point_at(l, from + inside, 0, 0);
    tried[2 * GAUSS + 1] = point_at(l, to - inside, 0, 0);
    for (int i = 0; i < TRIED; i++)
        most = fmax(most, tried[i].both / l->unit * to * (to - from));
    if ((most < LITTLE_MASS * l->mass[0] && most * to < LITTLE_AREA * l->mass[1]) ||
        l->count + GRADES == PANELS_MOST)
        return;
    if (variation(at, tried) < VARIES || to - from < LEAST * to || l->count > PANELS_MOST / 2) {
        add_panel(l, l->count++, from, to, at);
        return;
    }
    refine(l, from, middle, tried);
    refine(l, middle, to, tried + GAUSS);
}

/* First ends of panels: even in log R, and quantiles of what is drawn from above and at grazing incidence, where narrow
 * lobes are. */
static double first_end(const laws *l, size_t i, size_t even)
{
    if (i <= even)
        return SLOPE_LEAST * exp((double)i * FIRST);
    size_t side = i % 2;
    vndf_view view = vndf_view_from(&l->surface, (vndf_vec3){(float)side, 0, (float)!side});
    vndf_vec3 wm = vndf_sample(&view, 0.5f, ((float)(i - even) - 0.5f) / QUANTILES, NULL);
    return fmin(fmax((double)hypotf(wm.x, wm.y) / (double)wm.z, SLOPE_LEAST), SLOPE_MOST);
}

/* Beyond the panels P22 falls as a power. */
static int place_points(laws *l)
{
    const size_t even = (size_t)(log(SLOPE_MOST / SLOPE_LEAST) / FIRST), all = even + 1 + QUANTILES;
    double *first = malloc(all * sizeof *first), end = SLOPE_MOST, n = 4;
    if (!first)
        return 0;
    for (size_t i = 0; i < all; i++)
        first[i] = first_end(l, i, even);
    sort_numbers(first, all);
    for (size_t i = 0; i + 1 < all; i++)
        if (first[i + 1] > first[i]) {
            point at[GAUSS];
            put_points(l, first[i], first[i + 1], at);
            refine(l, first[i], first[i + 1], at);
        }
    const double p = point_at(l, end, 0, 0).p;
    if (p > 0)
        n = log2(point_at(l, end / 16, 0, 0).p / p) / 4;
    l->mass[0] = l->tail[0] = p * end * end / (n - 2);
    l->mass[1] = l->tail[1] = p * end * end * end / (n - 3);
    for (size_t i = 0; i < GAUSS * l->count; i++) {
        l->mass[0] += l->at[i].mass;
        l->mass[1] += l->at[i].mass * l->at[i].r;
    }
    free(first);
    return 1;
}

/* Not where floats do not tell a point from rho, or from the other side of a jump. */
static int is_decided(const laws *l, size_t i, double rho)
{
    const double *end = &l->end[2 * (i / GAUSS)];
    return end[1] - end[0] > UNDECIDED * end[1] && end[0] - rho > UNDECIDED * rho;
}

/* ---- one direction ---- */

/* The mean over the azimuth of what is seen of a slope, with digits close beside the horizon too; returns its change by
 * log |c|. */
static double see(point *at, double s, double c)
{
    double h = fabs(c), away = s * at->r - h, w = away > 0 ? sqrt(away * (s * at->r + h)) : 0, t = w / h,
           arc = atan2(w, h);
    double k = t < 0.02 ? h * t * t * t * (1.0 / 3 - t * t * (0.2 - t * t / 7)) : w - h * arc;
    at->seen = k / PI + fmax(c, 0);
    return h * (c > 0 ? PI - arc : arc) / PI;
}

/* Below the horizon panels of its own from rho on, narrower towards it, behind the others; returns the first of those
 * that stay as they are, and where all end. */
static size_t grade(laws *l, double rho, size_t *end)
{
    size_t first = 0;
    for (size_t step = PANELS_MOST; step > 0; step /= 2)
        first += first + step <= l->count && l->end[2 * (first + step) - 1] <= rho ? step : 0;
    for (; first < l->count && *end + PARTS < l->count + GRADES; first++) {
        double to = l->end[2 * first + 1], from = fmax(l->end[2 * first], rho), next;
        const double least = fmax(1e-4 * (to - rho), LEAST * rho);
        if (to - rho <= 1.5 * (from - rho))
            break;
        for (; from < to; from = next) {
            point at[GAUSS];
            next = fmin(rho + 1.5 * fmax(from - rho, least), to);
            put_points(l, from, next, at);
            add_panel(l, (*end)++, from, next, at);
        }
    }
    return first;
}

static void take(laws *l, int figure, double measured, double rho)
{
    if (measured > l->worst[figure].measured) {
        l->worst[figure].measured = measured;
        l->worst[figure].theta = atan2(1, rho * l->scale) * 180 / PI;
        l->rho[figure] = rho;
    }
}

/* Looks from the direction whose cotangent over the median slope is rho, as floats have it. */
static void look_from(laws *l, double rho)
{
    const vndf_vec3 wi = {(float)fmin(1 / fabs(rho), 1), 0, (float)fmin(fmax(rho, -1), 1)};
    double s = (double)wi.x, c = (double)wi.z, horizon = rho < 0 ? -c / s : 0,
           area = s * l->tail[1] / PI + c / 2 * l->tail[0], beyond = area, moved = 0, steep = 0;
    size_t end = l->count, from = rho < 0 ? GAUSS * grade(l, horizon, &end) : 0;
    end *= GAUSS;
    for (size_t i = from; i < end; i++) {
        point *at = &l->at[i];
        moved += at->mass * see(at, s, c);
        steep += i > from ? at->r * at->r * fabs(at->p - at[-1].p) * at->seen : 0;
        area += at->mass * at->seen;
    }
    if (!(area > AREA_LEAST * hypot(s, c * l->scale) * l->mass[1] / PI))
        return;
    vndf_batch batch = {.surface = {.distribution = l->surface.distribution}, .count = end - from};
    batch.shared = VNDF_SHARED_SURFACE | VNDF_SHARED_WI;
    batch.surface.xx = batch.surface.yy = &l->surface.xx;
    batch.wi_x = &wi.x, batch.wi_y = &wi.y, batch.wi_z = &wi.z;
    vndf_pdf_n(&batch, (vndf_normals){l->x + from, l->y, l->z + from}, l->pdf + from);
    double drawn = 0, rarely = beyond / area, often = 0, unsure = 0;
    for (size_t i = from; i < end; i++) {
        const point *at = &l->at[i];
        double facing = c + s * at->r, right = at->mass * at->seen / area;
        double is = facing > 0 ? (double)l->pdf[i] * at->solid * at->seen / facing : 0;
        drawn += is;
        if (!is_decided(l, i, horizon)) {
            unsure += right + is;
            continue;
        }
        rarely += fmax(right - is, 0);
        often += fmax(is - right, 0);
        if (right > is)
            add_to(l, right / is - 1, right);
    }
    const double slack = ROUNDING * moved / area, both = slack + ROUNDING * steep / area,
                 tv = fmax(fmax(rarely, often) - both, 0);
    take(l, LAWS_TV, tv, rho);
    if (rho >= 0)
        take(l, LAWS_TV_ABOVE, tv, rho);
    take(l, LAWS_MAX_WEIGHT, 1 + take_most(l), rho);
    take(l, LAWS_AREA_ERROR,
         fmax(fabs((double)vndf_projected_area(&l->surface, wi) * l->mass[0] / area - 1) - slack, 0), rho);
    /* points miss some of what is drawn at knots */
    take(l, LAWS_CONSISTENCY, fmax(fabs(drawn - 1) - both - unsure - tv / 10, 0), rho);
}

static void look_both_ways(laws *l, double rho)
{
    look_from(l, rho);
    look_from(l, -rho);
}

/* ---- all directions ---- */

/* Even in log rho and in what is left of the area, where slopes are. 0: `progress` said to stop. */
static int look_around(laws *l, int per_octave, vndf_progress *progress, void *user)
{
    const double step = exp2(1.0 / per_octave), grazing = 1e-9, steep = 1e-12; /* beyond: parts of mass and area */
    double m0 = 0, m1 = l->tail[1], area = 0, rho = 1e12;
    for (size_t i = GAUSS * l->count; i-- > 0 && m0 < (1 - grazing) * l->mass[0];) {
        const double r = l->at[i].r;
        m0 += l->at[i].mass;
        m1 += l->at[i].mass * r;
        if (m1 < steep * l->mass[1] || r > rho || (m1 < step * area && r * step > rho))
            continue;
        if (progress && progress(1 - (double)i / (GAUSS * (double)l->count), "certificate", user))
            return 0;
        look_both_ways(l, rho = r);
        area = m1;
    }
    return 1;
}

/* Beside jumps; at the horizon; where the certificate found its worst; and around what is worst here. */
static void look_closer(laws *l, const vndf_certificate *c, int per_octave)
{
    static const double beside[] = {-0.3, -0.05, -1e-2, -1e-3, -3e-4, -1e-4, -1e-5, 0, 1e-4, 1e-2};
    double jump = 0;
    for (size_t i = 0, jumps = 0; i < l->count && jumps < JUMPS_MOST; i++) {
        const double r = l->end[2 * i + 1];
        if (r - l->end[2 * i] > 2 * LEAST * r || r < jump * (1 + UNDECIDED))
            continue;
        jump = r;
        jumps++;
        for (size_t k = 0; k < sizeof beside / sizeof *beside; k++)
            look_both_ways(l, jump * (1 + beside[k]));
    }
    look_from(l, 0);
    look_from(l, 1e6);
    look_both_ways(l, fabs(1 / (tan((double)c->tv_theta * PI / 180) * l->scale)));
    look_both_ways(l, fabs(1 / (tan((double)c->tv_above_theta * PI / 180) * l->scale)));
    for (int figure = LAWS_TV; figure <= LAWS_AREA_ERROR; figure++)
        for (double apart = 0.5 / per_octave; apart > 1e-5; apart /= 2) {
            const double at = l->rho[figure];
            look_from(l, at * exp2(apart));
            look_from(l, at / exp2(apart));
        }
}

static double ndf_error(laws *l)
{
    for (size_t i = 0; i < GAUSS * l->count; i++) {
        const point *at = &l->at[i];
        if (at->p > 0 && is_decided(l, i, 0))
            add_to(l, fabs(2 * PI * l->mass[0] * at->drawn / at->p - 1), at->mass / l->mass[0]);
    }
    return take_most(l);
}

int laws_measure(const vndf_distribution *table, const vndf_source *source, int per_octave,
                 vndf_progress *progress, void *user, laws_figure found[LAWS_FIGURES])
{
    static const char *const names[] = {"tv", "tv_above", "max_weight", "area_error", "consistency", "ndf_error"};
    const vndf_info info = vndf_distribution_info(table);
    const vndf_certificate *c = &info.certificate;
    const float stored[] = {c->tv, c->tv_above, c->max_weight, c->area_error, c->consistency, c->ndf_error};
    laws *l = calloc(1, sizeof *l);
    if (!l)
        return 0;
    for (int i = 0; i < LAWS_FIGURES; i++)
        found[i] = (laws_figure){names[i], (double)stored[i], -1, NAN, 0};
    l->source = source;
    const float alpha = (float)(1 / info.scale);
    l->surface = vndf_rough(table, alpha, alpha);
    l->scale = 1 / (double)alpha;
    l->worst = found;
    l->unit = info.normalization * l->scale * l->scale;
    l->mass[0] = 1 / (2 * PI * l->unit); /* first guesses */
    l->mass[1] = PI * l->mass[0] * (double)vndf_projected_area(&l->surface, (vndf_vec3){1, 0, 0});
    const int done = place_points(l) && look_around(l, per_octave, progress, user);
    if (done) {
        look_closer(l, c, per_octave);
        found[LAWS_NDF_ERROR].measured = ndf_error(l);
    }
    for (int i = 0; i < LAWS_FIGURES; i++) {
        const double claim = found[i].stored, is = found[i].measured;
        found[i].good = is >= 0 && is <= fmax(1.1 * claim, claim + 2e-5);
    }
    free(l);
    return done;
}
