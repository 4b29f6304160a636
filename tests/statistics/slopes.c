#include "statistics/slopes.h"

#include <float.h>
#include <math.h>

#include "harness/test.h"
#include "cli/sort.h"
#include "statistics/grid.h"

/* ---- the frame ---- */

slope_frame slope_frame_from(const vndf_affine *shape, vndf_vec3 wi)
{
    double scale = vndf_distribution_info(shape->distribution).scale;
    scale = scale > 0 ? scale : 1;
    slope_frame f = {.mean_x = (double)shape->mean_x, .mean_y = (double)shape->mean_y, .x = 1};
    f.xx = scale * (double)shape->xx, f.xy = scale * (double)shape->xy;
    f.yx = scale * (double)shape->yx, f.yy = scale * (double)shape->yy;
    double length = sqrt((double)wi.x * wi.x + (double)wi.y * wi.y + (double)wi.z * wi.z);
    double x = wi.x / length, y = wi.y / length, a = f.xx * x + f.yx * y, b = f.xy * x + f.yy * y;
    f.det = fabs(f.xx * f.yy - f.xy * f.yx);
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

void slope_over(const slope_frame *f, vndf_vec3 wm, double n[3])
{
    double x = wm.x + f->mean_x * wm.z, y = wm.y + f->mean_y * wm.z, d = f->xx * f->yy - f->xy * f->yx;
    double u = (f->yy * x - f->xy * y) / d, v = (f->xx * y - f->yx * x) / d,
           length = sqrt(u * u + v * v + (double)wm.z * wm.z);
    n[0] = (f->x * u + f->y * v) / length, n[1] = (f->x * v - f->y * u) / length, n[2] = wm.z / length;
}

/* q counts slopes, linear to 1, then their logarithm; the azimuth is counted in parts of its reach. */
static const double LAST = 81; /* slopes of 1e34 */

static void place_of(const slope_frame *f, vndf_vec3 wm, double *q, double *part)
{
    double n[3], r;
    slope_over(f, wm, n);
    r = hypot(n[0], n[1]) / n[2];
    *q = r < 1 ? r : 1 + log(r);
    *part = atan2(n[1], n[0]) / reach(f, r);
}

typedef struct integrand {
    const slope_frame *frame;
    slope_function *f;
    const void *of;
} integrand;

/* Per q and part. Slopes are over -1, as they stand in unit normals. */
static double value_at(double q, double part, const void *of)
{
    const integrand *g = of;
    const slope_frame *f = g->frame;
    double r = q < 1 ? q : exp(q - 1), end = reach(f, r);
    if (!(end > 0))
        return 0;
    double along = r * cos(part * end), across = r * sin(part * end), u = f->x * along - f->y * across,
           v = f->y * along + f->x * across;
    double x = f->xx * u + f->xy * v - f->mean_x, y = f->yx * u + f->yy * v - f->mean_y;
    double z = 1 / sqrt(1 + x * x + y * y), per_q = q < 1 ? 1 : r;
    const double wm[3] = {x * z, y * z, z};
    return g->f(wm, g->of) * z * z * z * f->det * r * per_q * end;
}

/* ---- chi-square ---- */

enum { RADII = 34, ARCS = 24, PILOT = 40 * RADII };

/* Radii between which as many pilots lie, from the least to the largest, and one more as far beyond that, where a jump
 * would be missed in a bin that reaches to the last slope. */
static void place_bins(grid *g, const slope_frame *f, slope_draw *draw, const void *of)
{
    static double pilot[PILOT];
    unsigned long long state = 11;
    double part;
    grid_even(g, RADII, 0, LAST, ARCS, -1, 1);
    for (int i = 0; i < PILOT; i++) {
        float u1 = test_uniform(&state), u2 = test_uniform(&state), pdf;
        place_of(f, draw(of, u1, u2, &pdf), &pilot[i], &part);
    }
    sort_numbers(pilot, PILOT);
    for (size_t i = 1; i < RADII - 1; i++)
        g->x[i] = fmin(pilot[(i - 1) * (PILOT - 1) / (RADII - 3)], LAST);
    g->x[RADII - 1] = fmin(2 * g->x[RADII - 2] - g->x[RADII - 3], LAST);
}

slope_test slope_chi_square(const slope_frame *frame, slope_draw *draw, slope_function *pdf, const void *of,
                            size_t samples, unsigned long long seed)
{
    static grid bins;
    const integrand g = {frame, pdf, of};
    slope_test found = {0, 0, 0, 0};
    place_bins(&bins, frame, draw, of);
    found.mass = grid_expect(&bins, value_at, &g, (double)samples, fmax(1e-9, 2e-3 / (double)samples));
    for (size_t i = 0; i < samples; i++) {
        float density = -1, u1 = test_uniform(&seed), u2 = test_uniform(&seed);
        double q, part;
        vndf_vec3 wm = draw(of, u1, u2, &density);
        place_of(frame, wm, &q, &part);
        found.unseen += !(density >= FLT_MIN && density <= FLT_MAX);
        bins.observed[q < LAST ? grid_bin(&bins, q, part) : bins.elsewhere] += 1;
    }
    pearson judged = grid_test(&bins);
    found.classes = judged.classes;
    found.p = judged.classes > 50 ? judged.p : 0;
    return found;
}
