/* The law of slopes of a surface that was measured: P22 over the slope length, whether it is isotropic, and how sure
 * all that is.
 *
 * The mean slope is taken off. The shape of the rest is Tyler's: the matrix V of determinant 1 with V = (2/n) sum s s^T
 * / (s^T V^-1 s), which exists where the second moment does not (D. Tyler, "A Distribution-Free M-Estimator of
 * Multivariate Scatter", Annals of Statistics 15, 1987). If V is the identity within its error, the slopes are taken as
 * isotropic. If not, s = M u with M = V^1/2, and the rows are of u: the surface is the affine one with this matrix.
 *
 * Bins of |u| hold equal parts of the slopes, and halves of what is left in the tail; a row stands where the mean
 * square of a bin's lengths is, since a density that falls evenly in r^2 has its mean there. Beyond the last bins the
 * curve is the power of r that has their masses; if slopes end abruptly, the power is high. Errors come from the spread
 * between 64 parts of the surface: neighbouring slopes are not independent, parts nearly are. */
#include "measured/measured.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BINS_MOST = 96, BINS_LEAST = 4, TAIL_LEAST = 100, RINGS = 8, SECTORS = 12, SHAPE_STEPS = 60 };

static const double pi = 3.14159265358979323846;
static const double RATIO_MOST = 100;                    /* of the axes of the shape */
static const double SLOPE_LEAST = 1e-3, SLOPE_MOST = 10; /* medians that surfaces have */
static const double WIDER = 1.01;                        /* one edge of a bin over the edge before, at least */

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
                "the slopes lie on a line, %.0f times as wide one way as the other or more: parallel grooves have no D",
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

/* ---- bins and rows ------------------------------------------------------------------------------- */

static double length_of(slope s)
{
    return hypot((double)s.x, (double)s.y);
}

static int by_length(const void *a, const void *b)
{
    const double of_a = length_of(*(const slope *)a), of_b = length_of(*(const slope *)b);
    return (of_a > of_b) - (of_a < of_b);
}

/* Where bins of the sorted slopes begin, and behind them the number of slopes; how many bins. */
static size_t find_bins(const slope_set *sorted, size_t begin[BINS_MOST + 1])
{
    const double n = (double)sorted->count, step = 1 / floor(fmin(fmax(cbrt(n) / 2, 12), 40));
    const double longest = length_of(sorted->at[sorted->count - 1]);
    double part = 0, before = 0;
    size_t count = 0;
    begin[0] = 0;
    while (count + 1 < BINS_MOST && (1 - part) * n > TAIL_LEAST) {
        part += 1 - part > 1.5 * step ? step : (1 - part) / 2;
        size_t at = (size_t)(part * (n - 1));
        const double edge = length_of(sorted->at[at]);
        while (at > 0 && length_of(sorted->at[at - 1]) >= edge)
            at--;
        if (edge > WIDER * before && edge - before >= 2 * sorted->quantum && WIDER * edge < longest) {
            begin[++count] = at;
            before = edge;
        }
    }
    begin[++count] = sorted->count;
    return count;
}

/* One standard deviation of the number of slopes in a bin, relative: from the spread between parts, as they were drawn
 * again. */
static double error_of(const slope_set *sorted, size_t begin, size_t end, const double of_part[SLOPE_PARTS])
{
    double here[SLOPE_PARTS] = {0}, square = 0;
    const double number = (double)(end - begin), n = (double)sorted->count;
    for (size_t i = begin; i < end; i++)
        here[sorted->at[i].part]++;
    for (int i = 0; i < SLOPE_PARTS; i++)
        square += pow(here[i] - number / n * of_part[i], 2);
    return sqrt(square) / number;
}

/* The part of all slopes that would have to turn about z: half the sum of |sector - its mean over the ring|. */
static double turning(const slope_set *sorted)
{
    double off = 0, number[RINGS][SECTORS] = {{0}}, ring[RINGS] = {0};
    for (size_t i = 0; i < sorted->count; i++) {
        const double turn = atan2((double)sorted->at[i].y, (double)sorted->at[i].x) / (2 * pi) + 0.5;
        const size_t at = i * RINGS / sorted->count;
        number[at][(int)(turn * SECTORS) % SECTORS]++;
        ring[at]++;
    }
    for (int i = 0; i < RINGS * SECTORS; i++)
        off += fabs(number[i / SECTORS][i % SECTORS] - ring[i / SECTORS] / SECTORS) / 2;
    return off / (double)sorted->count;
}

/* The last two bins make a tail: slopes beyond r are a power of r that has the masses of both. */
static void add_tail(const slope_set *sorted, const size_t begin[2], double *x, double *value)
{
    const double n = (double)sorted->count, from = length_of(sorted->at[begin[0]]);
    const double edge = length_of(sorted->at[begin[1]]), beyond = n - (double)begin[1];
    const double power = log((n - (double)begin[0]) / beyond) / log(edge / from), far = exp(fmin(1 / power, 1));
    for (int i = 0; i < 2; i++) {
        x[i] = i ? edge * far : edge;
        value[i] = beyond / n * power / (2 * pi * edge * edge) * (i ? pow(far, -power - 2) : 1);
    }
}

static int find_rows(slope_set *slopes, data_file *file, profile *rows)
{
    size_t begin[BINS_MOST + 1], median = 0, tail = 0;
    double errors[BINS_MOST], of_part[SLOPE_PARTS] = {0};
    qsort(slopes->at, slopes->count, sizeof *slopes->at, by_length);
    const size_t bins = find_bins(slopes, begin), n = slopes->count;
    if (bins < BINS_LEAST)
        return refuse(
            file,
            "%zu lengths of slopes can be told apart, and %d are needed: its steps are too coarse, or it is flat",
            bins, BINS_LEAST);
    if (!profile_make(rows, VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, bins + 1, file))
        return 0;
    for (size_t i = 0; i < n; i++)
        of_part[slopes->at[i].part]++;
    for (size_t i = 0; i < bins; i++) {
        const double from = i ? length_of(slopes->at[begin[i]]) : 0, number = (double)(begin[i + 1] - begin[i]);
        errors[i] = error_of(slopes, begin[i], begin[i + 1], of_part);
        median = begin[i] < n / 2 ? i : median;
        tail = (double)begin[i] < 0.99 * (double)n ? i : tail;
        if (i + 1 == bins)
            break;
        for (size_t k = begin[i]; k < begin[i + 1]; k++)
            rows->x[i] += pow(length_of(slopes->at[k]), 2) / number;
        rows->x[i] = sqrt(rows->x[i]);
        const double to = length_of(slopes->at[begin[i + 1]]);
        rows->value[i] = number / (double)n / (pi * (to * to - from * from));
    }
    add_tail(slopes, begin + bins - 2, rows->x + bins - 1, rows->value + bins - 1);
    note(file, "rows %zu\np22_error_median %.2g\np22_error_99 %.2g\np22_error_last %.2g\nresidual_isotropy %.3g",
         rows->count, errors[median], errors[tail], errors[bins - 1], turning(slopes));
    /* Slopes of another scale come from heights and steps in different units. */
    if (rows->x[median] < SLOPE_LEAST || rows->x[median] > SLOPE_MOST)
        note(file, "implausible median slope %.2g: are heights and steps in the same unit?", rows->x[median]);
    return 1;
}

int slopes_law(slope_set *slopes, data_file *file, profile *rows)
{
    *rows = (profile){0};
    return centre(slopes, file) && unstretch(slopes, file) && find_rows(slopes, file, rows);
}
