/* The law of slopes of a surface that was measured: P22 over the slope length, whether it is isotropic, and how sure
 * all that is.
 *
 * The mean slope is taken off. The shape of the rest is Tyler's: the matrix V of determinant 1 with V = (2/n) sum s
 * s^T / (s^T V^-1 s), which exists where the second moment does not (D. Tyler, "A Distribution-Free M-Estimator of
 * Multivariate Scatter", Annals of Statistics 15, 1987). If V is the identity within its error, the slopes are taken
 * as isotropic. If not, s = M u with M = V^1/2, and the rows are of u: the surface is the affine one with this
 * matrix.
 *
 * Bins of |u| hold equal parts of the slopes, and finer ones of the tail; the rows are multiplied until the curve
 * through them has the mass of every bin. After the last row a tail follows, unless slopes end abruptly: then the
 * curve ends with 0 there. Errors come from the spread between 64 parts of the surface: neighbouring slopes are not
 * independent, parts nearly are. */
#include "measured/measured.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/sort.h"

enum { BINS_MOST = 96, BINS_LEAST = 4, TAIL_LEAST = 100, RINGS = 8, SECTORS = 12 };
enum { SHAPE_STEPS = 60, FIT_STEPS = 40 };

static const double pi = 3.14159265358979323846;
static const double RATIO_MOST = 100;                    /* of the axes of the shape */
static const double SLOPE_LEAST = 1e-3, SLOPE_MOST = 10; /* medians that surfaces have */
static const double WIDER = 1.01;                        /* one edge of a bin over the edge before, at least */
static const double LEFT_MOST = 0.01;                    /* by which a bin may be missed, of the whole */
/* Slopes end abruptly where the longest is shorter than this times the one that TAIL_LEAST slopes are beyond; of the
 * light tail of Beckmann's distribution it is 1.18 for 2^24 slopes. */
static const double ABRUPT = 1.05;

int slopes_make(slope_set *made, size_t room, data_file *file)
{
    *made = (slope_set){.at = malloc(room * sizeof *made->at)};
    return made->at != NULL || refuse(file, "there is no memory for %zu slopes", room);
}

void slopes_free(slope_set *freed)
{
    free(freed->at);
    *freed = (slope_set){.at = NULL};
}

void slopes_add(slope_set *to, double x, double y, int part)
{
    to->at[to->count++] = (slope){(float)x, (float)y, part};
}

/* Takes the mean off. */
static int centre(slope_set *slopes, data_file *file)
{
    double x = 0, y = 0, square = 0, n = (double)slopes->count;
    const slope first = slopes->count ? slopes->at[0] : (slope){0.0f, 0.0f, 0};
    size_t same = 0;
    if (slopes->count < SLOPES_LEAST)
        return refuse(file, "%zu slopes; at least %d are needed", slopes->count, SLOPES_LEAST);
    for (const slope *s = slopes->at; s < slopes->at + slopes->count; s++) {
        same += s->x == first.x && s->y == first.y;
        x += (double)s->x / n;
        y += (double)s->y / n;
    }
    if (same > slopes->count / 2)
        return refuse(file,
                      "%zu of %zu slopes are the same: this is a plane with something on it, not a rough surface",
                      same, slopes->count);
    for (slope *s = slopes->at; s < slopes->at + slopes->count; s++) {
        s->x = (float)((double)s->x - x);
        s->y = (float)((double)s->y - y);
        square += (double)s->x * (double)s->x + (double)s->y * (double)s->y;
    }
    note(file, "slopes %zu\ntilt %.6g,%.6g\nrms_slope %.6g", slopes->count, x, y, sqrt(square / n / 2));
    return 1;
}

/* ---- shape --------------------------------------------------------------------------------------- */

/* A symmetric matrix; all here but sums have the determinant 1, so that (yy, -xy, xx) is the inverse. */
typedef struct shape {
    double xx, xy, yy;
} shape;

/* The larger axis of V^1/2 over the smaller. */
static double ratio_of(shape v)
{
    const double middle = (v.xx + v.yy) / 2, away = hypot((v.xx - v.yy) / 2, v.xy);
    return middle > away ? sqrt((middle + away) / (middle - away)) : INFINITY;
}

/* Tyler's V, by its own map. */
static int find_shape(const slope_set *slopes, data_file *file, shape *found)
{
    shape v = {1, 0, 1};
    double change = 1;
    for (int step = 0; step < SHAPE_STEPS && change > 1e-7; step++) {
        shape sum = {0, 0, 0};
        for (size_t i = 0; i < slopes->count; i++) {
            const double x = (double)slopes->at[i].x, y = (double)slopes->at[i].y;
            const double square = v.yy * x * x - 2 * v.xy * x * y + v.xx * y * y, by = square > 0 ? 1 / square : 0;
            sum = (shape){sum.xx + by * x * x, sum.xy + by * x * y, sum.yy + by * y * y};
        }
        const double scale = sqrt(sum.xx * sum.yy - sum.xy * sum.xy);
        sum = (shape){sum.xx / scale, sum.xy / scale, sum.yy / scale};
        if (!(scale > 0) || !(ratio_of(sum) < RATIO_MOST))
            return refuse(
                file,
                "the slopes lie on a line, %.0f times as wide one way as the other or more: grooves that are "
                "all parallel have no D of two dimensions",
                RATIO_MOST);
        change = fabs(sum.xx - v.xx) + fabs(sum.xy - v.xy) + fabs(sum.yy - v.yy);
        v = sum;
    }
    *found = v;
    return 1;
}

/* u = V^-1/2 s */
static slope unstretched(shape root, slope s)
{
    const double x = (double)s.x, y = (double)s.y;
    return (slope){(float)(root.yy * x - root.xy * y), (float)(root.xx * y - root.xy * x), s.part};
}

/* Slopes become u, unless V is the identity within its error; V^1/2 = (V + 1)/sqrt(trace V + 2), by Cayley and
 * Hamilton, is noted.
 *
 * The error is relative, of the ratio: from the spread between parts, as they were drawn again. One step from the
 * solution moves about half as far as the solution does (the derivative of Tyler's map in two dimensions), so the
 * spread counts twice. Isotropic slopes u/|u| stretch and shear alike, and each is a deviation of the ratio. */
static int unstretch(slope_set *slopes, data_file *file)
{
    double stretch[SLOPE_PARTS] = {0}, shear[SLOPE_PARTS] = {0}, sum = 0;
    shape v = {1, 0, 1};
    if (!find_shape(slopes, file, &v))
        return 0;
    const double by = 1 / sqrt(v.xx + v.yy + 2), ratio = ratio_of(v);
    const shape root = {by * (v.xx + 1), by * v.xy, by * (v.yy + 1)};
    for (size_t i = 0; i < slopes->count; i++) {
        const slope u = unstretched(root, slopes->at[i]);
        const double x = (double)u.x, y = (double)u.y, square = x * x + y * y;
        stretch[u.part] += square > 0 ? (x * x - y * y) / (2 * square) : 0;
        shear[u.part] += square > 0 ? x * y / square : 0;
    }
    for (int i = 0; i < SLOPE_PARTS; i++)
        sum += (stretch[i] * stretch[i] + shear[i] * shear[i]) / 2;
    const double error = ratio * 2 * sqrt(sum) / ((double)slopes->count / 2);
    note(file, "anisotropy %.4g +- %.2g", ratio, error);
    if (ratio - 1 <= fmax(4 * error, 0.02))
        return 1;
    note(file, "matrix %.6g,%.6g,%.6g,%.6g", root.xx, root.xy, root.xy, root.yy);
    for (size_t i = 0; i < slopes->count; i++)
        slopes->at[i] = unstretched(root, slopes->at[i]);
    return 1;
}

/* ---- bins ---------------------------------------------------------------------------------------- */

/* The part of the slopes that lies between two lengths, and how sure that is. */
typedef struct slope_bins {
    size_t count, samples;
    int has_end;
    double edge[BINS_MOST + 1]; /* edge[count] is infinite, or where slopes end abruptly */
    double mass[BINS_MOST];
    double middle[BINS_MOST]; /* a row's place */
    double error[BINS_MOST];  /* relative, of the mass: one standard deviation */
    double below[BINS_MOST];  /* the mass of shorter slopes */
    double longest;           /* of all slopes */
    double of_part[SLOPE_PARTS][BINS_MOST];
} slope_bins;

static double length_of(slope s)
{
    return hypot((double)s.x, (double)s.y);
}

static size_t bin_of(const slope_bins *b, double r)
{
    size_t low = 0, high = b->count;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        *(b->edge[middle] <= r ? &low : &high) = middle;
    }
    return low;
}

/* Edges at equal parts of the sorted lengths, then halving what is left of the tail. 0 and the reason if too few
 * lengths can be told apart. */
static int find_edges(slope_bins *b, const slope_set *slopes, data_file *file)
{
    const double n = (double)slopes->count, step = 1 / floor(fmin(fmax(cbrt(n) / 2, 12), 40));
    double part = 0, *sorted = malloc(slopes->count * sizeof *sorted);
    if (!sorted)
        return refuse(file, "there is no memory for %zu slopes", slopes->count);
    for (size_t i = 0; i < slopes->count; i++)
        sorted[i] = length_of(slopes->at[i]);
    sort_numbers(sorted, slopes->count);
    b->samples = slopes->count;
    b->longest = sorted[b->samples - 1];
    while (b->count + 1 < BINS_MOST && (1 - part) * n > TAIL_LEAST) {
        part += 1 - part > 1.5 * step ? step : (1 - part) / 2;
        const double edge = sorted[(size_t)(part * (n - 1))], before = b->edge[b->count];
        if (edge > WIDER * before && edge - before >= 2 * slopes->quantum && WIDER * edge < b->longest)
            b->edge[++b->count] = edge;
    }
    b->has_end = b->longest < ABRUPT * sorted[b->samples > TAIL_LEAST ? b->samples - TAIL_LEAST : 0];
    b->edge[++b->count] = b->has_end ? b->longest : INFINITY;
    free(sorted);
    return b->count >= BINS_LEAST ||
           refuse(
               file,
               "%zu lengths of slopes can be told apart, and %d are needed: the steps of the data are too coarse, "
               "or it is flat",
               b->count, BINS_LEAST);
}

/* Rows stand where the mean square of the lengths in a bin is, since for a density that falls evenly in r^2 it has
 * its mean there. A heavy tail has no mean square: there it is the mean of the logarithm.
 * Errors are relative, of each mass, from the spread between parts: its variance over surfaces made of parts drawn
 * again. */
static void find_masses(slope_bins *b, const slope_set *slopes, data_file *file)
{
    double number[BINS_MOST] = {0}, square[BINS_MOST] = {0}, logarithm = 0, n = (double)b->samples;
    size_t median = 0, tail = 0, last = b->count - 1;
    for (size_t i = 0; i < slopes->count; i++) {
        const double r = length_of(slopes->at[i]);
        const size_t bin = bin_of(b, r);
        b->middle[bin] += r * r;
        logarithm += bin == last ? log(r) : 0;
        number[bin]++;
        b->of_part[slopes->at[i].part][bin]++;
    }
    for (int i = 0; i < SLOPE_PARTS; i++) {
        double whole = 0;
        for (size_t bin = 0; bin < b->count; bin++)
            whole += b->of_part[i][bin];
        for (size_t bin = 0; bin < b->count; bin++)
            square[bin] += pow(b->of_part[i][bin] - number[bin] / n * whole, 2);
    }
    for (size_t i = 0; i < b->count; i++) {
        const double some = fmax(number[i], 1);
        b->mass[i] = number[i] / n;
        b->middle[i] = i == last && !b->has_end ? exp(logarithm / some) : sqrt(b->middle[i] / some);
        b->error[i] = sqrt(square[i]) / some;
        b->below[i] = i ? b->below[i - 1] + b->mass[i - 1] : 0;
        median = b->below[i] < 0.5 ? i : median;
        tail = b->below[i] < 0.99 ? i : tail;
    }
    note(file, "rows %zu\np22_error_median %.2g\np22_error_99 %.2g\np22_error_last %.2g", b->count,
         b->error[median], b->error[tail], b->error[last]);
    /* Slopes of another scale come from heights and steps in different units. */
    if (b->middle[median] < SLOPE_LEAST || b->middle[median] > SLOPE_MOST)
        note(file, "implausible median slope %.2g: are heights and steps in the same unit?", b->middle[median]);
}

/* The part of all slopes that would have to turn about z: half the sum of |sector - its mean over the ring|. */
static void note_isotropy(const slope_set *slopes, const slope_bins *b, data_file *file)
{
    double off = 0, number[RINGS][SECTORS] = {{0}}, ring[RINGS] = {0};
    for (size_t i = 0; i < slopes->count; i++) {
        const slope s = slopes->at[i];
        const double turn = atan2((double)s.y, (double)s.x) / (2 * pi) + 0.5;
        const int at = (int)fmin(b->below[bin_of(b, length_of(s))] * RINGS, RINGS - 1);
        number[at][(int)(turn * SECTORS) % SECTORS]++;
        ring[at]++;
    }
    for (int i = 0; i < RINGS * SECTORS; i++)
        off += fabs(number[i / SECTORS][i % SECTORS] - ring[i / SECTORS] / SECTORS) / 2;
    note(file, "residual_isotropy %.3g", off / (double)slopes->count);
}

/* ---- rows ---------------------------------------------------------------------------------------- */

/* By Gauss-Legendre, exact to degree 7 in each panel. Beyond a finite stretch the panels grow: P22 falls at least as
 * r^-4 there. */
double slope_mass(const vndf_source *source, double from, double to)
{
    enum { PANELS = 6 };
    static const double place[2] = {0.06943184420297371, 0.33000947820757187};
    static const double weight[2] = {0.17392742256872693, 0.32607257743127307};
    double sum = 0, panel = (to - from) / PANELS;
    if (isinf(to)) {
        for (double left = from; left < from * 1e6; left *= 1.5)
            sum += slope_mass(source, left, 1.5 * left);
        return sum;
    }
    for (int i = 0; i < 4 * PANELS; i++) {
        const double at = i % 2 ? 1 - place[i / 2 % 2] : place[i / 2 % 2], r = from + (i / 4 + at) * panel;
        sum += weight[i / 2 % 2] * vndf_source_p22(source, r) * r;
    }
    return 2 * pi * sum * panel;
}

/* A row for each bin; where slopes end abruptly the curve is even to the longest one, and 0 after a step with the
 * mass of half a slope. */
static int make_rows(const slope_bins *b, data_file *file, profile *rows)
{
    const size_t last = b->count - 1, more = b->has_end ? 2 : 0;
    if (!profile_make(rows, VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, b->count + more, file))
        return 0;
    for (size_t i = 0; i < b->count; i++) {
        const double next = isfinite(b->edge[i + 1]) ? b->edge[i + 1] : 2 * b->middle[i] - b->edge[i];
        rows->x[i] = b->middle[i];
        rows->value[i] = b->mass[i] / (next * next - b->edge[i] * b->edge[i]);
    }
    if (b->has_end) {
        const double step = (b->longest - b->edge[last]) / (b->mass[last] * (double)b->samples);
        rows->x[last + 1] = b->longest;
        rows->x[last + 2] = b->longest + fmax(step, 1e-9 * b->longest);
        rows->value[last + 1] = rows->value[last];
    }
    return 1;
}

/* Multiplies the rows until their curve has the mass of every bin: in full steps, and in smaller ones after a step
 * that made the worst bin no better. Rows beyond the last bin go with it. The best rows are kept: where none have the
 * masses, the last ones may be far worse. Returns by how much of the whole a bin is wrong, or -1. */
static double match(const slope_bins *b, profile *rows, data_file *file)
{
    double best[BINS_MOST + 2], before = INFINITY, left = INFINITY, power = 1;
    for (int step = 0; step < FIT_STEPS && !(left <= 1e-6); step++) {
        double factor[BINS_MOST], worst = 0;
        vndf_source *source = profile_source(rows, file);
        if (!source)
            return -1;
        for (size_t i = 0; i < b->count; i++) {
            const double found = slope_mass(source, b->edge[i], b->edge[i + 1]);
            worst = fmax(worst, fabs(found - b->mass[i]));
            factor[i] = found > 0 ? b->mass[i] / found : 1;
        }
        vndf_source_free(source);
        if (worst < left) {
            left = worst;
            memcpy(best, rows->value, rows->count * sizeof *best);
        }
        power = worst < before ? power : fmax(power / 2, 0.125);
        before = worst;
        for (size_t i = 0; i < rows->count; i++)
            rows->value[i] *= pow(factor[i < b->count ? i : b->count - 1], power);
    }
    memcpy(rows->value, best, rows->count * sizeof *best);
    return left;
}

/* Rows whose curve has the masses of the bins; 0 and the reason if there is no such curve. */
static int find_rows(const slope_bins *b, data_file *file, profile *rows)
{
    const double left = make_rows(b, file, rows) ? match(b, rows, file) : -1;
    vndf_source *source = left >= 0 && left < LEFT_MOST ? profile_source(rows, file) : NULL;
    if (source) {
        const double end = b->has_end ? rows->x[rows->count - 1] : INFINITY;
        note(file, "residual_bins %.2g\nmass_beyond %.2g", left, slope_mass(source, b->longest, end));
        vndf_source_free(source);
        return 1;
    }
    profile_free(rows);
    return left < LEFT_MOST
               ? 0
               : refuse(file, "no smooth curve has the masses of %zu bins; %.2g of all is wrong", b->count, left);
}

int slopes_law(slope_set *slopes, data_file *file, profile *rows)
{
    slope_bins *b = calloc(1, sizeof *b);
    *rows = (profile){0};
    int good = b != NULL || refuse(file, "there is no memory for the bins");
    good = good && centre(slopes, file) && unstretch(slopes, file) && find_edges(b, slopes, file);
    if (good) {
        find_masses(b, slopes, file);
        note_isotropy(slopes, b, file);
        good = find_rows(b, file, rows);
    }
    free(b);
    return good;
}
