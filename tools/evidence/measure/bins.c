/* Where the bins are, which of them holds a normal, and the integral of the density over each: per log(R) and azimuth,
 * dwm = z^3 |det M| R^2 dlog(R) da.
 *
 * Nothing in it is singular; but the lobe may have parts of very different width, and tails that fall by a power so low
 * that slopes of 1e20 count. */
#include "evidence/measure/bins.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "cli/random.h"
#include "cli/sort.h"
#include "evidence/measure/quadrature.h"

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

void bins_place(const bins_sampler *judged, uint64_t seed, double slope[BINS_RINGS + 1])
{
    enum { PILOTS = 2001 };
    double pilot[PILOTS], azimuth;
    random_stream stream = random_from(seed ^ 0x5851F42D4C957F2Du); /* apart from the stream that is tested */
    for (size_t i = 0; i < PILOTS; i++) {
        float pdf, u1 = random_float(&stream), u2 = random_float(&stream);
        pilot[i] = atan(polar(&judged->frame, judged->draw(judged->of, u1, u2, &pdf), &azimuth));
    }
    sort_numbers(pilot, PILOTS);
    for (size_t i = 0; i < BINS_RINGS; i++)
        slope[i] = tan(i % 2 ? pilot[PILOTS * i / (BINS_RINGS + 1)] : pi / 2 * (double)i / (BINS_RINGS + 1));
    slope[BINS_RINGS] = HUGE_VAL;
    sort_numbers(slope, BINS_RINGS + 1);
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
static int answer(void *of, quadrature_point *at, size_t count)
{
    const bins_sampler *judged = of;
    const bins_frame *f = &judged->frame;
    for (quadrature_point *p = at; p < at + count; p++) {
        const double slope = exp(p->x), wide = reach(f, slope);
        const double along = slope * cos(wide * p->y), across = slope * sin(wide * p->y);
        const double u = f->x * along - f->y * across, v = f->y * along + f->x * across;
        const double x = f->xx * u + f->xy * v - f->mean_x, y = f->yx * u + f->yy * v - f->mean_y;
        const double z = 1 / sqrt(1 + x * x + y * y);
        const vndf_vec3 wm = {(float)(x * z), (float)(y * z), (float)z};
        if (wide > 0)
            p->value = (double)judged->pdf(judged->of, wm) * z * z * z * fabs(f->det) * slope * slope * wide;
    }
    return 1;
}

/* Slopes beyond which nothing is: a cell of a table that begins at 0 or ends at infinity has some 1e-7 of its mass
 * there. */
static const double LEAST = 0x1p-80, LARGEST = 0x1p100;

/* Cells span a factor of 4 in R at most and end where the horizon enters, since the reach has a root there. */
enum { RINGS_MAX = BINS_RINGS + 92 };

static size_t divide(const bins_frame *f, const double slope[BINS_RINGS + 1], quadrature_cell *to)
{
    const double enters = log(fabs(f->c) / f->s);
    size_t count = 0;
    for (size_t ring = 0; ring < BINS_RINGS; ring++) {
        const double end = log(fmin(slope[ring + 1], LARGEST));
        for (double low = log(fmax(slope[ring], LEAST)), high; low < end; low = high) {
            high = fmin(low + log(4), end);
            high = enters > low && enters < high ? enters : high;
            for (size_t i = 0; i < BINS_SECTORS; i++) {
                const double from = 2 * (double)i / BINS_SECTORS - 1, wide = 2.0 / BINS_SECTORS;
                to[count++] = (quadrature_cell){ring * BINS_SECTORS + i, {low, high}, {from, from + wide}, 0};
            }
        }
    }
    return count;
}

/* A normal is rounded by this part of its slope, and its density is that of a normal this far away (promise 2 of the
 * library): the integral of what that adds is at most the change of the mass per log R, times this. Cells of this width
 * are not halved: normals are floats, which do not tell their slopes apart. */
static const double ONE_ROUNDING = 0x1p-23;

double bins_integrate(const bins_sampler *judged, const double slope[BINS_RINGS + 1],
                      double probability[BINS_COUNT])
{
    const quadrature q = {answer, (void *)judged, 1e-9, 0, ONE_ROUNDING, 1024, 24};
    quadrature_cell *cells = malloc(RINGS_MAX * BINS_SECTORS * sizeof *cells);
    quadrature_sum *sum = calloc(BINS_COUNT, sizeof *sum);
    double change = 0;
    const int good = cells && sum && quadrature_run(&q, cells, divide(&judged->frame, slope, cells), sum);
    for (size_t i = 0; i < BINS_COUNT; i++) {
        probability[i] = good ? sum[i].value : (double)NAN;
        change += good ? sum[i].change : 0;
    }
    free(cells);
    free(sum);
    return good ? ONE_ROUNDING * change : -1;
}

bins_result bins_chi_square(const bins_sampler *judged, size_t samples, uint64_t seed)
{
    double slope[BINS_RINGS + 1], expected[BINS_COUNT], observed[BINS_COUNT] = {0};
    bins_result result = {.mass = 0};
    random_stream stream = random_from(seed);
    bins_place(judged, seed, slope);
    for (size_t i = 0; i < samples; i++) {
        float pdf = -1, u1 = random_float(&stream), u2 = random_float(&stream);
        observed[bins_bin(&judged->frame, slope, judged->draw(judged->of, u1, u2, &pdf))] += 1;
        result.unseen += !(pdf >= FLT_MIN && pdf <= FLT_MAX);
    }
    result.rounding = bins_integrate(judged, slope, expected);
    for (size_t i = 0; i < BINS_COUNT; i++) {
        result.mass += expected[i];
        expected[i] *= (double)samples;
    }
    result.found = pearson_of(expected, observed, BINS_COUNT);
    return result;
}
