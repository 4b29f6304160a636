/* Where the bins are, which of them holds a normal, and the integral of the density over each: per log(R) and azimuth,
 * dwm = z^3 |det M| R^2 dlog(R) da.
 *
 * Nothing in it is singular; but the lobe may have parts of very different width, and tails that fall by a power so low
 * that slopes of 1e20 count. D is isotropic, so all that is steep in a density lies at a constant R: the borders of a
 * table's cells, jumps and rings. Along the azimuth it is smooth to the horizon of wi, where the sectors end, but for
 * the right angle to wi, where the law of a table has an edge. So at one slope all bins of a ring are integrated over
 * their azimuths by Gauss' rule, and over log(R) all of them together, adaptively: the panel whose two rules differ
 * most is halved next. (A quadrature in two dimensions for each bin chases the roundings of a narrow ring for
 * minutes.) */
#include "evidence/measure/bins.h"

#include <float.h>
#include <math.h>

#include "cli/random.h"
#include "cli/sort.h"

static const double pi = 3.14159265358979323846;

/* ---- the frame ----------------------------------------------------------------------------------- */

bins_frame bins_frame_from(const vndf_affine *shape, vndf_vec3 wi)
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

/* ---- bins ---------------------------------------------------------------------------------------- */

void bins_borders(double *border, size_t parts, double low, double high, const double *sorted, size_t count)
{
    for (size_t i = 0; i <= parts; i++)
        border[i] =
            i % 2 ? sorted[count * i / (parts + 1)] : low + (high - low) * (double)i / (double)(parts + parts % 2);
}

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
    bins_borders(slope, BINS_RINGS, 0, pi / 2, pilot, PILOTS);
    for (size_t i = 0; i < BINS_RINGS; i++)
        slope[i] = tan(slope[i]);
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

/* ---- one slope ----------------------------------------------------------------------------------- */

/* What the density adds to a bin, per log(R), between two azimuths: Gauss' 4 nodes, exact to degree 7. */
static double integrate_arc(const bins_sampler *judged, double slope, double low, double high)
{
    static const double gauss[4] = {-0.86113631159405258, -0.33998104358485626, 0.33998104358485626,
                                    0.86113631159405258};
    static const double weight[4] = {0.34785484513745386, 0.65214515486254614, 0.65214515486254614,
                                     0.34785484513745386};
    const bins_frame *f = &judged->frame;
    const double half = (high - low) / 2;
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        const double phi = (low + high) / 2 + half * gauss[i], along = slope * cos(phi), across = slope * sin(phi);
        const double u = f->x * along - f->y * across, v = f->y * along + f->x * across;
        const double x = f->xx * u + f->xy * v - f->mean_x, y = f->yx * u + f->yy * v - f->mean_y;
        const double z = 1 / sqrt(1 + x * x + y * y);
        const vndf_vec3 wm = {(float)(x * z), (float)(y * z), (float)z};
        sum += weight[i] * half * (double)judged->pdf(judged->of, wm) * z * z * z;
    }
    return sum * fabs(f->det) * slope * slope;
}

/* Sectors are cut at the right angles to wi. */
static void integrate_sectors(const bins_sampler *judged, double slope, double to[BINS_SECTORS])
{
    const double wide = 2 * reach(&judged->frame, slope) / BINS_SECTORS, right = pi / 2;
    for (int i = 0; i < BINS_SECTORS; i++) {
        const double end = (i + 1 - BINS_SECTORS / 2) * wide;
        to[i] = 0;
        for (double low = (i - BINS_SECTORS / 2) * wide, high; low < end; low = high) {
            high = low < -right ? fmin(end, -right) : low < right ? fmin(end, right) : end;
            to[i] += integrate_arc(judged, slope, low, high);
        }
    }
}

/* ---- rings --------------------------------------------------------------------------------------- */

/* Lobatto's 4 nodes on [-1, 1], exact to degree 5, among the 7 of Kronrod's extension, exact to degree 9 (Gander
 * and Gautschi, Adaptive Quadrature - Revisited, 2000). The end points are drawn in by 1e-7 of the interval: the
 * density there is that of this side of a border. */
enum { NODES = 7 };
static const double node[NODES] = {-0.9999999, -0.81649658092772603, -0.44721359549995794,
                                   0,          0.44721359549995794,  0.81649658092772603,
                                   0.9999999};
static const double kronrod[NODES] = {77.0 / 1470,  432.0 / 1470, 625.0 / 1470, 672.0 / 1470,
                                      625.0 / 1470, 432.0 / 1470, 77.0 / 1470};
static const double lobatto[NODES] = {1.0 / 6, 0, 5.0 / 6, 0, 5.0 / 6, 0, 1.0 / 6};

/* An interval of log R, the integrals of all bins over it, and the sum of how far its two rules are apart. */
typedef struct panel {
    double low, high, value[BINS_SECTORS], sum, error;
    double change; /* from node to node, of the mass per log R */
} panel;

/* A normal is rounded by this part of its slope, and its density is that of a normal this far away (promise 2 of the
 * library): the integral of what that adds is at most the change of the mass per log R, times this. */
static const double ONE_ROUNDING = 0x1p-23;

/* What is so narrow is left alone: normals are floats, which do not tell its slopes apart. */
static const double narrowest = 0x1p-23;

static panel measure(const bins_sampler *judged, double low, double high)
{
    panel of = {.low = low, .high = high};
    double middle = (low + high) / 2, half = (high - low) / 2, at_slope[BINS_SECTORS], few[BINS_SECTORS] = {0},
           before = 0;
    for (int i = 0; i < NODES; i++) {
        double sum = 0;
        integrate_sectors(judged, exp(middle + half * node[i]), at_slope);
        for (size_t bin = 0; bin < BINS_SECTORS; bin++) {
            sum += at_slope[bin];
            of.value[bin] += half * kronrod[i] * at_slope[bin];
            few[bin] += half * lobatto[i] * at_slope[bin];
        }
        of.change += i > 0 ? fabs(sum - before) : 0;
        before = sum;
    }
    for (size_t bin = 0; bin < BINS_SECTORS; bin++) {
        of.sum += of.value[bin];
        of.error += high - low < narrowest ? 0 : fabs(few[bin] - of.value[bin]);
    }
    return of;
}

/* A ring is good when the rules of its panels are so far apart in all, relative to its integral or absolutely (the
 * better rule is much closer to it). PANELS_MAX ends what is not a jump but noise. */
static const double RELATIVE = 1e-6, ABSOLUTE = 1e-10;
enum { PANELS_MAX = 400 };

/* Slopes beyond which nothing is: a cell of a table that begins at 0 or ends at infinity has some 1e-7 of its mass
 * there. */
static const double LEAST = 0x1p-80, LARGEST = 0x1p100;

/* Panels between the slopes of a ring span a factor of 4 at most and end where the horizon enters. Returns how much the
 * mass per log R changes on the way. */
static double integrate_ring(const bins_sampler *judged, const double slope[2], double probability[BINS_SECTORS])
{
    panel all[PANELS_MAX];
    const double end = log(fmin(slope[1], LARGEST)), enters = log(fabs(judged->frame.c) / judged->frame.s);
    double change = 0;
    size_t count = 0;
    for (double low = log(fmax(slope[0], LEAST)), high; low < end; low = high) {
        high = fmin(low + log(4), end);
        high = enters > low && enters < high ? enters : high;
        all[count++] = measure(judged, low, high);
    }
    while (count < PANELS_MAX) {
        double sum = 0, error = 0;
        panel *worst = all;
        for (panel *of = all; of < all + count; of++) {
            sum += of->sum;
            error += of->error;
            worst = of->error > worst->error ? of : worst;
        }
        if (error <= fmax(ABSOLUTE, RELATIVE * sum))
            break;
        const double low = worst->low, high = worst->high, middle = (low + high) / 2;
        *worst = measure(judged, low, middle);
        all[count++] = measure(judged, middle, high);
    }
    for (size_t bin = 0; bin < BINS_SECTORS; bin++)
        probability[bin] = 0;
    for (size_t i = 0; i < count; i++) {
        change += all[i].change;
        for (size_t bin = 0; bin < BINS_SECTORS; bin++)
            probability[bin] += all[i].value[bin];
    }
    return change;
}

double bins_integrate(const bins_sampler *judged, const double slope[BINS_RINGS + 1],
                      double probability[BINS_COUNT])
{
    double change = 0;
    for (size_t ring = 0; ring < BINS_RINGS; ring++)
        change += integrate_ring(judged, slope + ring, probability + ring * BINS_SECTORS);
    return ONE_ROUNDING * change;
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
    result.found = pearson_of(expected, observed, NULL, BINS_COUNT, 5);
    return result;
}
