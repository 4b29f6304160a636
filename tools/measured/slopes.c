#include "measured/slopes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/sort.h"

enum {
    BINS_MOST = 96,
    BINS_LEAST = 4,
    TAIL_LEAST = 100,
    RINGS = 8,
    SECTORS = 12,
    SHAPE_STEPS = 60,
    FIT_STEPS = 40
};

static const double pi = 3.14159265358979323846;
static const double RATIO_MOST = 100;                    /* of the axes of the shape */
static const double SLOPE_LEAST = 1e-3, SLOPE_MOST = 10; /* medians that surfaces have */
static const double WIDER = 1.01;                        /* one edge of a bin over the edge before, at least */
static const double LEFT_MOST = 0.01;                    /* by which a bin may be missed, of the whole */
static const double BEYOND_MOST = 0.25; /* what a tail may have beyond the data, of the last bin's mass */
static const double SHORT_MOST = 0.2;   /* what may lack of that mass */

int slopes_make(slope_set *made, size_t room, data_file *file)
{
    *made = (slope_set){malloc(room * sizeof(float)), malloc(room * sizeof(float)), malloc(room), 0, room, 0};
    if (made->x && made->y && made->part)
        return 1;
    slopes_free(made);
    return refuse(file, "there is no memory for %zu slopes", room);
}

void slopes_free(slope_set *freed)
{
    free(freed->x);
    free(freed->y);
    free(freed->part);
    *freed = (slope_set){0};
}

void slopes_add(slope_set *to, double x, double y, int part)
{
    if (to->count == to->room)
        return;
    to->x[to->count] = (float)x;
    to->y[to->count] = (float)y;
    to->part[to->count++] = (unsigned char)part;
}

/* Takes the mean off. */
static int centre(slope_set *slopes, data_file *file)
{
    double x = 0, y = 0, square = 0, n = (double)slopes->count;
    size_t same = 0;
    if (slopes->count < SLOPES_LEAST)
        return refuse(file, "%zu slopes; at least %d are needed", slopes->count, SLOPES_LEAST);
    for (size_t i = 0; i < slopes->count; i++) {
        same += slopes->x[i] == slopes->x[0] && slopes->y[i] == slopes->y[0];
        x += (double)slopes->x[i] / n;
        y += (double)slopes->y[i] / n;
    }
    if (same > slopes->count / 2)
        return refuse(file,
                      "%zu of %zu slopes are the same: this is a plane with something on it, not a rough surface",
                      same, slopes->count);
    for (size_t i = 0; i < slopes->count; i++) {
        slopes->x[i] = (float)((double)slopes->x[i] - x);
        slopes->y[i] = (float)((double)slopes->y[i] - y);
        square += pow((double)slopes->x[i], 2) + pow((double)slopes->y[i], 2);
    }
    note(file, "slopes %zu\ntilt %.6g,%.6g\nrms_slope %.6g", slopes->count, x, y, sqrt(square / n / 2));
    return 1;
}

/* ---- shape --------------------------------------------------------------------------------------- */

/* A symmetric matrix; all here but sums have the determinant 1, so that (yy, -xy, xx) is the inverse. */
typedef struct shape {
    double xx, xy, yy;
} shape;

/* V^1/2 = (V + 1)/sqrt(trace V + 2), by Cayley and Hamilton. */
static shape root_of(shape v)
{
    double by = 1 / sqrt(v.xx + v.yy + 2);
    return (shape){by * (v.xx + 1), by * v.xy, by * (v.yy + 1)};
}

/* The larger axis of V^1/2 over the smaller. */
static double ratio_of(shape v)
{
    double middle = (v.xx + v.yy) / 2, away = hypot((v.xx - v.yy) / 2, v.xy);
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
            double x = (double)slopes->x[i], y = (double)slopes->y[i];
            double square = v.yy * x * x - 2 * v.xy * x * y + v.xx * y * y;
            sum.xx += square > 0 ? x * x / square : 0;
            sum.xy += square > 0 ? x * y / square : 0;
            sum.yy += square > 0 ? y * y / square : 0;
        }
        double scale = sqrt(sum.xx * sum.yy - sum.xy * sum.xy);
        if (!(scale > 0))
            return refuse(file,
                          "the slopes lie on a line: grooves that are all parallel have no D of two dimensions");
        sum = (shape){sum.xx / scale, sum.xy / scale, sum.yy / scale};
        change = fabs(sum.xx - v.xx) + fabs(sum.xy - v.xy) + fabs(sum.yy - v.yy);
        v = sum;
        if (!(ratio_of(v) < RATIO_MOST))
            return refuse(
                file,
                "the slopes lie nearly on a line, %.3g times as wide one way as the other; %.0f times is "
                "the most",
                ratio_of(v), RATIO_MOST);
    }
    *found = v;
    return 1;
}

/* u = V^-1/2 s */
static void unstretched(shape root, const slope_set *slopes, size_t i, double *u, double *v)
{
    double x = (double)slopes->x[i], y = (double)slopes->y[i];
    *u = root.yy * x - root.xy * y;
    *v = root.xx * y - root.xy * x;
}

/* Relative, of the ratio: from the spread between parts, as they were drawn again. One step from the solution moves
 * about half as far as the solution does (the derivative of Tyler's map in two dimensions), so the spread counts
 * twice. Isotropic slopes u/|u| stretch and shear alike, and each is a deviation of the ratio. */
static double shape_error(const slope_set *slopes, shape root)
{
    double stretch[SLOPE_PARTS] = {0}, shear[SLOPE_PARTS] = {0}, sum = 0;
    for (size_t i = 0; i < slopes->count; i++) {
        double u, v, square;
        unstretched(root, slopes, i, &u, &v);
        square = u * u + v * v;
        stretch[slopes->part[i]] += square > 0 ? (u * u - v * v) / (2 * square) : 0;
        shear[slopes->part[i]] += square > 0 ? u * v / square : 0;
    }
    for (int i = 0; i < SLOPE_PARTS; i++)
        sum += (stretch[i] * stretch[i] + shear[i] * shear[i]) / 2;
    return 2 * sqrt(sum) / ((double)slopes->count / 2);
}

/* Slopes become u, unless V is the identity within its error; V^1/2 is noted. */
static int unstretch(slope_set *slopes, data_file *file)
{
    shape v = {1, 0, 1};
    if (!find_shape(slopes, file, &v))
        return 0;
    shape root = root_of(v);
    double ratio = ratio_of(v), error = ratio * shape_error(slopes, root);
    note(file, "anisotropy %.4g +- %.2g", ratio, error);
    if (ratio - 1 <= fmax(4 * error, 0.02))
        return 1;
    note(file, "matrix %.6g,%.6g,%.6g,%.6g", root.xx, root.xy, root.xy, root.yy);
    for (size_t i = 0; i < slopes->count; i++) {
        double x, y;
        unstretched(root, slopes, i, &x, &y);
        slopes->x[i] = (float)x;
        slopes->y[i] = (float)y;
    }
    return 1;
}

/* ---- bins ---------------------------------------------------------------------------------------- */

/* The part of the slopes that lies between two lengths, and how sure that is. */
typedef struct slope_bins {
    size_t count, samples;
    double edge[BINS_MOST + 1]; /* edge[count] is infinite, or where slopes end abruptly */
    double mass[BINS_MOST];
    double middle[BINS_MOST]; /* a row's place */
    double error[BINS_MOST];  /* relative, of the mass: one standard deviation */
    double below[BINS_MOST];  /* the mass of shorter slopes */
    double longest;           /* of all slopes */
    double of_part[SLOPE_PARTS][BINS_MOST];
} slope_bins;

static double length_of(const slope_set *slopes, size_t i)
{
    return hypot((double)slopes->x[i], (double)slopes->y[i]);
}

static size_t bin_of(const slope_bins *b, double r)
{
    size_t low = 0, high = b->count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        *(b->edge[middle] <= r ? &low : &high) = middle;
    }
    return low;
}

/* Edges at equal parts of the sorted lengths, then halving what is left of the tail. */
static void find_edges(slope_bins *b, const double *sorted, double narrowest)
{
    double n = (double)b->samples, step = 1 / floor(fmin(fmax(cbrt(n) / 2, 12), 40)), part = 0;
    b->longest = sorted[b->samples - 1];
    while (b->count + 1 < BINS_MOST && (1 - part) * n > TAIL_LEAST) {
        part += 1 - part > 1.5 * step ? step : (1 - part) / 2;
        double edge = sorted[(size_t)(part * (n - 1))];
        if (edge > WIDER * b->edge[b->count] && edge - b->edge[b->count] >= narrowest && WIDER * edge < b->longest)
            b->edge[++b->count] = edge;
    }
    b->edge[++b->count] = INFINITY;
}

/* Rows stand where the mean square of the lengths in a bin is, since for a density that falls evenly in r^2 it has
 * its mean there. The last bin has no end, and a heavy tail no mean square: there it is the mean of the logarithm. */
static void find_masses(slope_bins *b, const slope_set *slopes)
{
    double number[BINS_MOST] = {0}, logarithm = 0, n = (double)b->samples;
    for (size_t i = 0; i < slopes->count; i++) {
        double r = length_of(slopes, i);
        size_t bin = bin_of(b, r);
        b->middle[bin] += r * r;
        logarithm += bin + 1 == b->count ? log(r) : 0;
        number[bin]++;
        b->of_part[slopes->part[i]][bin]++;
    }
    for (size_t i = 0; i < b->count; i++) {
        b->mass[i] = number[i] / n;
        b->below[i] = i ? b->below[i - 1] + b->mass[i - 1] : 0;
        b->middle[i] = sqrt(b->middle[i] / fmax(number[i], 1));
    }
    b->middle[b->count - 1] = exp(logarithm / fmax(number[b->count - 1], 1));
}

/* Relative, of each mass, from the spread between parts: its variance over surfaces made of parts drawn again. */
static void find_errors(slope_bins *b, data_file *file)
{
    double square[BINS_MOST] = {0};
    size_t median = 0, tail = 0, last = b->count - 1;
    for (int i = 0; i < SLOPE_PARTS; i++) {
        double whole = 0;
        for (size_t bin = 0; bin < b->count; bin++)
            whole += b->of_part[i][bin];
        for (size_t bin = 0; bin < b->count; bin++)
            square[bin] += pow(b->of_part[i][bin] - b->mass[bin] * whole, 2);
    }
    for (size_t i = 0; i < b->count; i++) {
        b->error[i] = b->mass[i] > 0 ? sqrt(square[i]) / (b->mass[i] * (double)b->samples) : 0;
        median = b->below[i] < 0.5 ? i : median;
        tail = b->below[i] < 0.99 ? i : tail;
    }
    note(file, "rows %zu\np22_error_median %.2g\np22_error_99 %.2g\np22_error_last %.2g", b->count,
         b->error[median], b->error[tail], b->error[last]);
    /* Slopes of another scale come from heights and steps in different units. */
    if (b->middle[median] < SLOPE_LEAST || b->middle[median] > SLOPE_MOST)
        note(file, "implausible median slope %.2g: are heights and steps in the same unit?", b->middle[median]);
}

/* 0 and the reason if too few lengths can be told apart. */
static int make_bins(slope_bins *b, const slope_set *slopes, data_file *file)
{
    double *sorted = malloc(slopes->count * sizeof *sorted);
    if (!sorted)
        return refuse(file, "there is no memory for %zu slopes", slopes->count);
    for (size_t i = 0; i < slopes->count; i++)
        sorted[i] = length_of(slopes, i);
    sort_numbers(sorted, slopes->count);
    b->samples = slopes->count;
    find_edges(b, sorted, 2 * slopes->quantum);
    free(sorted);
    if (b->count < BINS_LEAST)
        return refuse(file,
                      "%zu lengths of slopes can be told apart, and %d are needed: the steps of the data are too "
                      "coarse, or it is flat",
                      b->count, BINS_LEAST);
    find_masses(b, slopes);
    find_errors(b, file);
    return 1;
}

/* The part of all slopes that would have to turn about z: half the sum of |sector - its mean over the ring|. */
static void note_isotropy(const slope_set *slopes, const slope_bins *b, data_file *file)
{
    double off = 0, number[RINGS][SECTORS] = {{0}};
    for (size_t i = 0; i < slopes->count; i++) {
        double turn = atan2((double)slopes->y[i], (double)slopes->x[i]) / (2 * pi) + 0.5;
        double below = b->below[bin_of(b, length_of(slopes, i))];
        number[(int)fmin(below * RINGS, RINGS - 1)][(int)(turn * SECTORS) % SECTORS]++;
    }
    for (int ring = 0; ring < RINGS; ring++) {
        double sum = 0;
        for (int i = 0; i < SECTORS; i++)
            sum += number[ring][i];
        for (int i = 0; i < SECTORS; i++)
            off += fabs(number[ring][i] - sum / SECTORS) / 2;
    }
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
        double at = i % 2 ? 1 - place[i / 2 % 2] : place[i / 2 % 2], r = from + (i / 4 + at) * panel;
        sum += weight[i / 2 % 2] * vndf_source_p22(source, r) * r;
    }
    return 2 * pi * sum * panel;
}

static int make_rows(const slope_bins *b, data_file *file, profile *rows)
{
    int has_end = isfinite(b->edge[b->count]);
    size_t last = b->count - 1;
    if (!profile_make(rows, VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, b->count + (has_end ? 2 : 0), file))
        return 0;
    for (size_t i = 0; i < b->count; i++) {
        double next = isfinite(b->edge[i + 1]) ? b->edge[i + 1] : 2 * b->middle[i] - b->edge[i];
        rows->x[i] = b->middle[i];
        rows->value[i] = b->mass[i] / (next * next - b->edge[i] * b->edge[i]);
    }
    if (has_end) { /* the curve is even to the longest slope, and 0 after a step with the mass of half a slope */
        double step = (b->longest - b->edge[last]) / (b->mass[last] * (double)b->samples);
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
            double found = slope_mass(source, b->edge[i], b->edge[i + 1]);
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

/* Fits the rows; by how much they miss a bin, or -1. *beyond: the mass of the curve beyond the longest slope;
 * *is_tail: whether the curve has the mass of the last bin, and little of it beyond the data. Of n independent slopes
 * in the bin, a right tail has the mass of one beyond the longest, and seldom that of four; the error says how large
 * n is. */
static double fit_rows(const slope_bins *b, data_file *file, profile *rows, double *beyond, int *is_tail)
{
    size_t last = b->count - 1;
    double left = make_rows(b, file, rows) ? match(b, rows, file) : -1;
    vndf_source *source = left < 0 ? NULL : profile_source(rows, file);
    if (!source)
        return -1;
    double most = fmin(4 * b->error[last] * b->error[last], BEYOND_MOST);
    *beyond = slope_mass(source, b->longest, isfinite(b->edge[last + 1]) ? rows->x[rows->count - 1] : INFINITY);
    *is_tail = *beyond <= most * b->mass[last] &&
               slope_mass(source, b->edge[last], b->edge[last + 1]) >= (1 - SHORT_MOST) * b->mass[last];
    vndf_source_free(source);
    return left;
}

/* Rows whose curve has the masses of the bins; 0 and the reason if there is no such curve. */
static int find_rows(slope_bins *b, data_file *file, profile *rows)
{
    double beyond = 0, from = b->edge[b->count - 1];
    int is_tail = 0;
    double left = fit_rows(b, file, rows, &beyond, &is_tail);
    if (left >= LEFT_MOST || (left >= 0 && !is_tail)) { /* the last bin ends at the longest slope */
        profile_free(rows);
        b->edge[b->count] = b->longest;
        b->middle[b->count - 1] = sqrt((from * from + b->longest * b->longest) / 2);
        left = fit_rows(b, file, rows, &beyond, &is_tail);
    }
    if (left >= 0 && left < LEFT_MOST) {
        note(file, "residual_bins %.2g\nmass_beyond %.2g", left, beyond);
        return 1;
    }
    profile_free(rows);
    return left < 0
               ? 0
               : refuse(file, "no smooth curve has the masses of %zu bins; %.2g of all is wrong", b->count, left);
}

int slopes_law(slope_set *slopes, data_file *file, profile *rows)
{
    slope_bins *b = calloc(1, sizeof *b);
    *rows = (profile){0};
    int good = b != NULL || refuse(file, "there is no memory for the bins");
    good = good && centre(slopes, file) && unstretch(slopes, file) && make_bins(b, slopes, file) &&
           find_rows(b, file, rows);
    if (good)
        note_isotropy(slopes, b, file);
    free(b);
    return good;
}
