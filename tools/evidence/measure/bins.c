/* Where the bins are, which of them holds a normal, and the integral of the density over each: per log(R) and azimuth,
 * dwm = z^3 |det M| R^2 dlog(R) da.
 *
 * Nothing in it is singular; but the lobe may have parts of very different width, and tails that fall by a power so low
 * that slopes of 1e20 count. */
#include "evidence/measure/measure.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "cli/random.h"
#include "cli/sort.h"

static const double pi = 3.14159265358979323846;

/* ---- the frame ----------------------------------------------------------------------------------- */

bins_frame bins_frame_of(const vndf_surface *shape, vndf_vec3 wi)
{
    const double info = vndf_distribution_info(shape->distribution).scale, scale = info > 0 ? info : 1;
    const double length = hypot(hypot((double)wi.x, (double)wi.y), (double)wi.z);
    const double x = (double)wi.x / length, y = (double)wi.y / length;
    bins_frame f = {.mean_x = (double)shape->mean_x, .mean_y = (double)shape->mean_y, .x = 1};
    f.xx = scale * (double)shape->xx, f.xy = scale * (double)shape->xy;
    f.yx = scale * (double)shape->yx, f.yy = scale * (double)shape->yy;
    f.det = f.xx * f.yy - f.xy * f.yx;
    const double a = f.xx * x + f.yx * y, b = f.xy * x + f.yy * y;
    f.c = (double)wi.z / length - x * f.mean_x - y * f.mean_y;
    f.s = hypot(a, b);
    if (f.s > 0)
        f.x = a / f.s, f.y = b / f.s;
    return f;
}

void bins_over(const bins_frame *f, vndf_vec3 wm, double n[3])
{
    const double z = (double)wm.z, x = (double)wm.x + f->mean_x * z, y = (double)wm.y + f->mean_y * z;
    const double u = (f->yy * x - f->xy * y) / f->det, v = (f->xx * y - f->yx * x) / f->det;
    const double length = sqrt(u * u + v * v + z * z);
    n[0] = (f->x * u + f->y * v) / length, n[1] = (f->x * v - f->y * u) / length, n[2] = z / length;
}

double bins_apart(const bins_frame *f, vndf_vec3 a, vndf_vec3 b)
{
    double n[3], m[3];
    bins_over(f, a, n);
    bins_over(f, b, m);
    return hypot(hypot(n[0] - m[0], n[1] - m[1]), n[2] - m[2]);
}

/* The azimuth to which normals of slope R are seen. */
static double reach(const bins_frame *f, double slope)
{
    const double across = f->s * slope;
    if (across <= fabs(f->c))
        return f->c > 0 ? pi : 0;
    return f->c < 0 ? 2 * atan2(sqrt(across + f->c), sqrt(across - f->c)) : acos(-f->c / across);
}

/* R, infinite at the horizon, and the azimuth. */
static double polar(const bins_frame *f, vndf_vec3 wm, double *azimuth)
{
    double n[3];
    bins_over(f, wm, n);
    *azimuth = atan2(n[1], n[0]);
    return n[2] > 0 ? hypot(n[0], n[1]) / n[2] : HUGE_VAL;
}

static vndf_vec3 draw_of_view(const void *view, float u1, float u2, float *pdf)
{
    return vndf_sample(view, u1, u2, pdf);
}

static float pdf_of_view(const void *view, vndf_vec3 wm)
{
    return vndf_pdf(view, wm);
}

bins_sampler bins_of_view(const vndf_view *view, const vndf_surface *surface, vndf_vec3 wi)
{
    return (bins_sampler){bins_frame_of(surface, wi), draw_of_view, pdf_of_view, view};
}

/* ---- bins ---------------------------------------------------------------------------------------- */

/* Without branches to mispredict: samples come in any order. */
size_t bins_interval(const double *border, size_t parts, double x)
{
    size_t low = 0;
    while (parts > 1) {
        size_t half = parts / 2;
        low += x >= border[low + half] ? half : 0;
        parts -= half;
    }
    return low;
}

void bins_borders(double *border, size_t parts, double low, double high, double at[BINS_PILOTS + BINS_EVEN])
{
    for (size_t i = 0; i < BINS_EVEN; i++)
        at[BINS_PILOTS + i] = low + (high - low) * ((double)i + 0.5) / BINS_EVEN;
    sort_numbers(at, BINS_PILOTS + BINS_EVEN);
    for (size_t i = 1; i < parts; i++)
        border[i] = fmin(fmax(at[i * (BINS_PILOTS + BINS_EVEN) / parts], low), high);
    border[0] = low;
    border[parts] = high;
}

/* at: borders are some of these angles, in order. */
static void place(const bins_sampler *judged, uint64_t seed, double at[BINS_PILOTS + BINS_EVEN],
                  double slope[BINS_RINGS + 1])
{
    double azimuth;
    random_stream stream = random_from(seed ^ 0x5851F42D4C957F2Du); /* apart from the stream that is tested */
    for (size_t i = 0; i < BINS_PILOTS; i++) {
        float pdf, u1 = random_float(&stream), u2 = random_float(&stream);
        at[i] = atan(polar(&judged->frame, judged->draw(judged->of, u1, u2, &pdf), &azimuth));
    }
    bins_borders(slope, BINS_RINGS, 0, pi / 2, at);
    for (size_t i = 1; i < BINS_RINGS; i++)
        slope[i] = tan(slope[i]);
    slope[BINS_RINGS] = HUGE_VAL;
}

size_t bins_bin(const bins_frame *f, const double slope[BINS_RINGS + 1], vndf_vec3 wm)
{
    double azimuth;
    const double at = polar(f, wm, &azimuth), sector = (azimuth / reach(f, at) + 1) * BINS_SECTORS / 2;
    const size_t last = BINS_SECTORS - 1; /* beyond the horizon, too */
    return bins_interval(slope, BINS_RINGS, at) * BINS_SECTORS +
           (sector < BINS_SECTORS ? (size_t)fmax(sector, 0) : last);
}

/* ---- integrals ----------------------------------------------------------------------------------- */

/* The density of log R and of the azimuth over its reach. */
static double density(const bins_sampler *judged, double log_slope, double part)
{
    const bins_frame *f = &judged->frame;
    const double slope = exp(log_slope), wide = reach(f, slope);
    const double along = slope * cos(wide * part), across = slope * sin(wide * part);
    const double u = f->x * along - f->y * across, v = f->y * along + f->x * across;
    const double x = f->xx * u + f->xy * v - f->mean_x, y = f->yx * u + f->yy * v - f->mean_y;
    const double z = 1 / sqrt(1 + x * x + y * y);
    const vndf_vec3 wm = {(float)(x * z), (float)(y * z), (float)z};
    return wide > 0 ? (double)judged->pdf(judged->of, wm) * z * z * z * fabs(f->det) * slope * slope * wide : 0;
}

/* A normal is rounded by this part of its slope, and its density is that of a normal this far away (promise 2 of the
 * library). Cells of some such steps are not halved. */
static const double ONE_ROUNDING = 0x1p-23, FINEST = 32 * 0x1p-23;

/* It is compared with that one rounding away, where it stands for a part. */
static int answer(void *of, quadrature_point *at, size_t count)
{
    for (quadrature_point *p = at; p < at + count; p++) {
        p->value[0] = density(of, p->x, p->y);
        p->value[1] = p->part > 0 ? density(of, p->x + ONE_ROUNDING, p->y) : p->value[0];
    }
    return 1;
}

/* Slopes beyond which nothing is: a cell of a table that begins at 0 or ends at infinity has some 1e-7 of its mass
 * there. */
static const double LEAST = 0x1p-80, LARGEST = 0x1p100;

size_t bins_cells(const double *x, size_t rings, const double *y, size_t sectors, size_t first,
                  quadrature_cell *to)
{
    size_t count = 0;
    for (size_t i = 0; i < rings * sectors; i++) {
        const double *ring = &x[i / sectors], *sector = &y[i % sectors];
        if (ring[0] < ring[1] && sector[0] < sector[1])
            to[count++] = (quadrature_cell){.bin = first + i, {ring[0], ring[1]}, {sector[0], sector[1]}};
    }
    return count;
}

enum { PARTS = 4, ALL = BINS_PILOTS + BINS_EVEN, BORDERS = BINS_RINGS * PARTS + 3 };

/* Where cells begin along log R: at quarters of rings by what was drawn, since a narrow lobe may be in one ring with
 * much that is wide; and what is nearer or farther than all that was drawn is apart. */
static double first_border(const double at[ALL], size_t i)
{
    const size_t of = i > 0 ? (i - 1) * ALL / (BINS_RINGS * PARTS) : 0;
    const double to = i == 0 ? LEAST : i == BORDERS - 1 ? LARGEST : tan(at[of < ALL ? of : ALL - 1]);
    return log(fmin(fmax(to, LEAST), LARGEST));
}

static void integrate(const bins_sampler *judged, const double at[ALL], bins_result *to)
{
    enum { CELLS_MAX = 200000 };
    size_t count = 0;
    const quadrature q = {answer, (void *)judged, BINS_COUNT, CELLS_MAX, 1e-8, FINEST, 30, 1, NULL, 0};
    quadrature_cell *cells = malloc(CELLS_MAX * sizeof *cells);
    double sector[BINS_SECTORS + 1], variance = 0;
    for (int i = 0; i <= BINS_SECTORS; i++)
        sector[i] = 2 * (double)i / BINS_SECTORS - 1;
    for (size_t i = 0; cells && i + 1 < BORDERS; i++) {
        const double ends[2] = {first_border(at, i), first_border(at, i + 1)};
        const size_t part = i > 0 ? i - 1 : 0, ring = part / PARTS < BINS_RINGS ? part / PARTS : BINS_RINGS - 1;
        count += bins_cells(ends, 1, sector, BINS_SECTORS, ring * BINS_SECTORS, cells + count);
    }
    if (!cells || !quadrature_run(&q, cells, count, to->sum))
        to->error = -1;
    for (int i = 0; i < BINS_COUNT && to->error >= 0; i++) {
        to->mass += to->sum[i].value;
        to->error += 2 * to->sum[i].distance;
        variance += to->sum[i].variance;
    }
    to->error += 4 * sqrt(variance);
    free(cells);
}

/* Q(a, x) of the incomplete gamma function, a = dof/2, by Q(a + 1, x) = Q(a, x) + x^a e^-x/Gamma(a + 1) (DLMF 8.8.6)
 * from Q(1/2, x) = erfc(sqrt(x)) or Q(0, x) = 0. All terms are positive. */
double statistics_chi_square_p(double statistic, size_t dof)
{
    const double x = statistic / 2, first = dof % 2 ? 0.5 : 0;
    double sum = dof % 2 ? erfc(sqrt(x)) : 0;
    if (dof == 0 || statistic <= 0)
        return 1;
    if (isinf(x))
        return 0;
    for (double a = first; a < (double)dof / 2; a++)
        sum += exp(a * log(x) - x - lgamma(a + 1));
    return sum > 1 ? 1 : sum;
}

double statistics_sidak(double level, size_t n)
{
    return n == 0 ? level : -expm1(log1p(-level) / (double)n);
}

typedef struct class_sum {
    double expected, observed;
} class_sum;

static double deviation(double expected, double observed)
{
    return (observed - expected) * (observed - expected) / expected;
}

/* Bins that expect little go together with their neighbours, so that a deviation in a tail is not drowned by the
 * rest of it. The newest class is kept open, since what is left at the end joins it. */
pearson pearson_of(const double *expected, const double *observed, size_t bins)
{
    const double few = 5;
    class_sum open = {0, 0}, last = {0, 0};
    pearson found = {0, 0, 0};
    for (size_t i = 0; i < bins; i++) {
        const int is_alone = expected[i] >= few;
        const class_sum bin = {expected[i] + (is_alone ? 0 : open.expected),
                               observed[i] + (is_alone ? 0 : open.observed)};
        open = is_alone ? open : bin;
        if (!(bin.expected >= few))
            continue;
        open = is_alone ? open : (class_sum){0, 0};
        found.statistic += found.classes++ ? deviation(last.expected, last.observed) : 0;
        last = bin;
    }
    if (!found.classes)
        return found;
    found.statistic += deviation(last.expected + open.expected, last.observed + open.observed);
    found.p = statistics_chi_square_p(found.statistic, found.classes - 1);
    return found;
}

bins_result bins_chi_square(const bins_sampler *judged, size_t samples, uint64_t seed)
{
    double expected[BINS_COUNT], observed[BINS_COUNT] = {0}, at[BINS_PILOTS + BINS_EVEN];
    bins_result result = {.mass = 0};
    random_stream stream = random_from(seed);
    place(judged, seed, at, result.slope);
    for (size_t i = 0; i < samples; i++) {
        float pdf = -1, u1 = random_float(&stream), u2 = random_float(&stream);
        observed[bins_bin(&judged->frame, result.slope, judged->draw(judged->of, u1, u2, &pdf))] += 1;
        result.unseen += !(pdf >= FLT_MIN && pdf <= FLT_MAX);
    }
    integrate(judged, at, &result);
    for (size_t i = 0; i < BINS_COUNT; i++)
        expected[i] = result.sum[i].value * (double)samples;
    result.found = pearson_of(expected, observed, BINS_COUNT);
    return result;
}
