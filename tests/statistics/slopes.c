#include "statistics/slopes.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/constants.h"
#include "harness/test.h"
#include "evidence/measure/pearson.h"

/* ---- the frame ---- */

slope_frame slope_frame_from(const vndf_affine *shape, vndf_vec3 wi, int all)
{
    double scale = vndf_distribution_info(shape->distribution).scale;
    scale = scale > 0 ? scale : 1;
    slope_frame f = {scale * (double)shape->xx,
                     scale * (double)shape->xy,
                     scale * (double)shape->yx,
                     scale * (double)shape->yy,
                     (double)shape->mean_x,
                     (double)shape->mean_y,
                     0,
                     0,
                     1,
                     1,
                     0};
    double length = sqrt((double)wi.x * wi.x + (double)wi.y * wi.y + (double)wi.z * wi.z);
    double x = wi.x / length, y = wi.y / length, a = f.xx * x + f.yx * y, b = f.xy * x + f.yy * y;
    f.det = fabs(f.xx * f.yy - f.xy * f.yx);
    if (all)
        return f;
    f.c = wi.z / length - x * f.mean_x - y * f.mean_y;
    f.s = hypot(a, b);
    if (f.s > 0)
        f.x = a / f.s, f.y = b / f.s;
    return f;
}

/* The azimuth to which normals of slope r are seen. */
static double reach(const slope_frame *f, double r)
{
    double across = f->s * r;
    if (across <= fabs(f->c))
        return f->c > 0 ? PI : 0;
    return f->c < 0 ? 2 * atan2(sqrt(across + f->c), sqrt(across - f->c)) : acos(-f->c / across);
}

/* q counts slopes: linear to 1, then their logarithm. */
static double slope_at(double q)
{
    return q < 1 ? q : exp(q - 1);
}

static double place_at(double r)
{
    return r < 1 ? r : 1 + log(r);
}

static const double LAST = 81; /* slopes of 1e34 */

/* Of (slopes over -1, as they stand in unit normals) and back. */
static double normal_at(const slope_frame *f, double r, double a, double wm[3])
{
    double along = r * cos(a), across = r * sin(a), u = f->x * along - f->y * across,
           v = f->y * along + f->x * across;
    double x = f->xx * u + f->xy * v - f->mean_x, y = f->yx * u + f->yy * v - f->mean_y;
    double z = 1 / sqrt(1 + x * x + y * y);
    wm[0] = x * z, wm[1] = y * z, wm[2] = z;
    return z;
}

static void place_of(const slope_frame *f, vndf_vec3 wm, double *q, double *part)
{
    double z = fmax((double)wm.z, 1e-300), x = wm.x / z + f->mean_x, y = wm.y / z + f->mean_y;
    double d = f->xx * f->yy - f->xy * f->yx, u = (f->yy * x - f->xy * y) / d, v = (f->xx * y - f->yx * x) / d;
    double r = hypot(u, v);
    *q = place_at(r);
    *part = atan2(f->x * v - f->y * u, f->x * u + f->y * v) / reach(f, r);
}

/* ---- integration ---- */

typedef struct integrand {
    const slope_frame *frame;
    slope_function *f;
    const void *of;
    double tolerance; /* absolute; 1e-4 of a panel is enough in any case */
} integrand;

static double value_at(const integrand *g, double q, double part)
{
    double r = slope_at(q), end = reach(g->frame, r), wm[3];
    if (!(end > 0))
        return 0;
    double z = normal_at(g->frame, r, part * end, wm), per_q = q < 1 ? 1 : r;
    return g->f(wm, g->of) * z * z * z * g->frame->det * r * per_q * end;
}

typedef struct panel {
    double q0, q1, b0, b1;
} panel;

static double gauss(const integrand *g, panel p)
{
    static const double node[5] = {-0.906179845938664, -0.538469310105683, 0, 0.538469310105683,
                                   0.906179845938664};
    static const double weight[5] = {0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366,
                                     0.236926885056189};
    double sum = 0, h = (p.q1 - p.q0) / 2, k = (p.b1 - p.b0) / 2;
    for (int i = 0; i < 25; i++)
        sum += weight[i / 5] * weight[i % 5] *
               value_at(g, p.q0 + h * (1 + node[i / 5]), p.b0 + k * (1 + node[i % 5]));
    return sum * h * k;
}

static double integrate(const integrand *g, panel p, double whole, int halvings)
{
    double q = (p.q0 + p.q1) / 2, b = (p.b0 + p.b1) / 2;
    const panel left = {p.q0, q, p.b0, p.b1}, right = {q, p.q1, p.b0, p.b1};
    const panel low = {p.q0, p.q1, p.b0, b}, high = {p.q0, p.q1, b, p.b1};
    double l = gauss(g, left), r = gauss(g, right), m = gauss(g, low), n = gauss(g, high);
    double by_q = fabs(l + r - whole), by_b = fabs(m + n - whole);
    if (halvings == 0 || fmax(by_q, by_b) <= fmax(1e-5 * whole, g->tolerance))
        return l + r + m + n - whole;
    return by_q > by_b ? integrate(g, left, l, halvings - 1) + integrate(g, right, r, halvings - 1)
                       : integrate(g, low, m, halvings - 1) + integrate(g, high, n, halvings - 1);
}

/* Where the arc that is seen begins to shrink, or is first seen, a panel ends. */
static double integrate_panel(const integrand *g, panel p)
{
    double cut = g->frame->s > 0 ? place_at(fabs(g->frame->c) / g->frame->s) : HUGE_VAL;
    if (cut > p.q0 && cut < p.q1) {
        panel first = {p.q0, cut, p.b0, p.b1}, second = {cut, p.q1, p.b0, p.b1};
        return integrate(g, first, gauss(g, first), 40) + integrate(g, second, gauss(g, second), 40);
    }
    return integrate(g, p, gauss(g, p), 40);
}

double slope_integral(const slope_frame *frame, slope_function *f, const void *of)
{
    enum { PANELS = 150 };
    const integrand g = {frame, f, of, 1e-8};
    double sum = 0;
    for (int i = 0; i < PANELS; i++) /* a fifteenth of the slope each up to 1e2, then wider */
        for (int j = 0; j < 2; j++) {
            double from = i < 90 ? i / 15.0 : 6 + (LAST - 6) * (i - 90) / 60, to = i < 89 ? (i + 1) / 15.0 : 6;
            to = i < 90 ? to : 6 + (LAST - 6) * (i - 89) / 60;
            const panel p = {from, to, j - 1, j};
            sum += integrate_panel(&g, p);
        }
    return sum;
}

/* ---- chi-square ---- */

enum { RADII = 32, ARCS = 24, BINS = RADII * ARCS, PILOT = 40 * RADII };

typedef struct slope_bins {
    double q[RADII + 1], expected[BINS + 1], observed[BINS + 1]; /* the last is of what is elsewhere */
} slope_bins;

static int ascends(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static slope_bins make_bins(const slope_frame *f, slope_draw *draw, const void *of)
{
    static double pilot[PILOT];
    unsigned long long state = 11;
    slope_bins bins;
    double part;
    memset(&bins, 0, sizeof bins);
    for (int i = 0; i < PILOT; i++) {
        float u1 = test_uniform(&state), u2 = test_uniform(&state), pdf;
        place_of(f, draw(of, u1, u2, &pdf), &pilot[i], &part);
    }
    qsort(pilot, PILOT, sizeof *pilot, ascends);
    for (int i = 1; i < RADII; i++)
        bins.q[i] = fmin(pilot[i * (PILOT / RADII)], LAST);
    bins.q[RADII] = LAST;
    return bins;
}

static size_t bin_of(const slope_bins *bins, double q, double part)
{
    size_t i = 0, j = (size_t)fmin(fmax((part + 1) / 2 * ARCS, 0), ARCS - 1);
    if (!(q < LAST))
        return BINS;
    while (i + 1 < RADII && q >= bins->q[i + 1])
        i++;
    return i * ARCS + j;
}

/* In panels; those of a wide bin, an end of the slopes, are the narrower the nearer they are to the others. */
static double expect(const integrand *g, const slope_bins *bins, size_t bin)
{
    size_t row = bin / ARCS;
    double sum = 0, q0 = bins->q[row], q1 = bins->q[row + 1], b0 = 2.0 * (double)(bin % ARCS) / ARCS - 1;
    const double panels = row == 0 || row == RADII - 1 ? 24 : 4, power = panels > 4 ? 4 : 1;
    for (int i = 0; i < (int)panels && q0 < q1; i++) {
        double from = pow(i / panels, power), to = pow((i + 1) / panels, power);
        panel p = {q0 + (q1 - q0) * from, q0 + (q1 - q0) * to, b0, b0 + 2.0 / ARCS};
        if (row == 0)
            p.q0 = q1 - (q1 - q0) * to, p.q1 = q1 - (q1 - q0) * from;
        sum += integrate_panel(g, p);
    }
    return sum;
}

slope_test slope_chi_square(const slope_frame *frame, slope_draw *draw, slope_function *pdf, const void *of,
                            size_t samples, unsigned long long seed)
{
    const integrand g = {frame, pdf, of, fmax(1e-9, 2e-3 / (double)samples)};
    static slope_bins bins;
    slope_test found = {0, 0, 0, 0};
    bins = make_bins(frame, draw, of);
    for (size_t i = 0; i < BINS; i++) {
        double mass = expect(&g, &bins, i);
        found.mass += mass;
        bins.expected[i] = mass * (double)samples;
    }
    bins.expected[BINS] = fmax(0, (1 - found.mass) * (double)samples);
    for (size_t i = 0; i < samples; i++) {
        float density = -1, u1 = test_uniform(&seed), u2 = test_uniform(&seed);
        double q, part;
        vndf_vec3 wm = draw(of, u1, u2, &density);
        place_of(frame, wm, &q, &part);
        found.unseen += !(density >= FLT_MIN && density <= FLT_MAX);
        bins.observed[bin_of(&bins, q, part)] += 1;
    }
    pearson judged = pearson_of(bins.expected, bins.observed, NULL, BINS + 1, 5);
    found.classes = judged.classes;
    found.p = judged.classes > 50 ? judged.p : 0;
    return found;
}
