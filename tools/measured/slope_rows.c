/* Bins of the lengths of slopes, and the rows whose curve has their masses. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/sort.h"
#include "measured/slopes.h"

enum { TAIL_LEAST = 100, BINS_LEAST = 4, PANELS = 6, STEPS = 40 };

static const double WIDER = 1.01;       /* one edge over the edge before, at least */
static const double LEFT_MOST = 0.01;   /* by which a bin may be missed, of the whole */
static const double BEYOND_MOST = 0.25; /* what a tail may have beyond the data, of the last bin's mass */
static const double SHORT_MOST = 0.2;   /* what may lack of that mass */

/* ---- bins ---------------------------------------------------------------------------------------- */

/* Edges at equal parts of the sorted lengths, then halving what is left of the tail. */
static void find_edges(slope_bins *b, const double *sorted, size_t count, double narrowest)
{
    double step = 1 / floor(fmin(fmax(cbrt((double)count) / 2, 12), 40)), part = 0;
    while (b->count + 1 < BINS_MOST && (1 - part) * (double)count > TAIL_LEAST) {
        part += 1 - part > 1.5 * step ? step : (1 - part) / 2;
        double edge = sorted[(size_t)(part * (double)(count - 1))];
        if (edge > WIDER * b->edge[b->count] && edge - b->edge[b->count] >= narrowest &&
            WIDER * edge < sorted[count - 1])
            b->edge[++b->count] = edge;
    }
    b->edge[++b->count] = INFINITY;
    b->longest = sorted[count - 1];
    b->samples = count;
}

size_t slope_bin_of(const slope_bins *b, double r)
{
    size_t low = 0, high = b->count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        *(b->edge[middle] <= r ? &low : &high) = middle;
    }
    return low;
}

/* Rows stand where the mean square of the lengths in a bin is, since for a density that falls evenly in r^2 it has its
 * mean there. The last bin has no end, and a heavy tail no mean square: there it is the mean of the logarithm. */
static void find_masses(slope_bins *b, const slope_set *slopes, const double *r,
                        double of_part[SLOPE_PARTS][BINS_MOST])
{
    double square[BINS_MOST] = {0}, number[BINS_MOST] = {0}, logarithm = 0;
    for (size_t i = 0; i < slopes->count; i++) {
        size_t bin = slope_bin_of(b, r[i]);
        square[bin] += r[i] * r[i];
        logarithm += bin + 1 == b->count ? log(r[i]) : 0;
        number[bin]++;
        of_part[slopes->part[i]][bin]++;
    }
    for (size_t i = 0; i < b->count; i++) {
        b->mass[i] = number[i] / (double)slopes->count;
        b->middle[i] = sqrt(square[i] / fmax(number[i], 1));
    }
    b->middle[b->count - 1] = exp(logarithm / fmax(number[b->count - 1], 1));
}

/* Relative, of each mass, from the spread between parts: its variance over surfaces made of parts drawn again. */
static void find_errors(slope_bins *b, double of_part[SLOPE_PARTS][BINS_MOST])
{
    double square[BINS_MOST] = {0};
    for (int i = 0; i < SLOPE_PARTS; i++) {
        double whole = 0;
        for (size_t bin = 0; bin < b->count; bin++)
            whole += of_part[i][bin];
        for (size_t bin = 0; bin < b->count; bin++)
            square[bin] += pow(of_part[i][bin] - b->mass[bin] * whole, 2);
    }
    for (size_t bin = 0; bin < b->count; bin++)
        b->error[bin] = b->mass[bin] > 0 ? sqrt(square[bin]) / (b->mass[bin] * (double)b->samples) : 0;
}

static void note_errors(const slope_bins *b, data_file *file)
{
    double sum = 0, median = -1, tail = -1;
    for (size_t i = 0; i < b->count; i++) {
        sum += b->mass[i];
        median = median < 0 && sum >= 0.5 ? b->error[i] : median;
        tail = tail < 0 && sum >= 0.99 ? b->error[i] : tail;
    }
    note(file, "rows %zu", b->count);
    note(file, "p22_error_median %.2g", median);
    note(file, "p22_error_99 %.2g", tail);
    note(file, "p22_error_last %.2g", b->error[b->count - 1]);
}

int slope_bins_make(slope_bins *made, const slope_set *slopes, const double *r, data_file *file)
{
    double *sorted = malloc(slopes->count * sizeof *sorted);
    double(*of_part)[BINS_MOST] = calloc(SLOPE_PARTS, sizeof *of_part);
    int good = (sorted && of_part) || refuse(file, "there is no memory for %zu slopes", slopes->count);
    *made = (slope_bins){0};
    if (good) {
        memcpy(sorted, r, slopes->count * sizeof *r);
        sort_numbers(sorted, slopes->count);
        find_edges(made, sorted, slopes->count, 2 * slopes->quantum);
        good = made->count >= BINS_LEAST ||
               refuse(file,
                      "%zu lengths of slopes can be told apart, and %d are needed: the steps of the data are too "
                      "coarse, or it is flat",
                      made->count, BINS_LEAST);
    }
    if (good) {
        find_masses(made, slopes, r, of_part);
        find_errors(made, of_part);
        note_errors(made, file);
    }
    free(of_part);
    free(sorted);
    return good;
}

/* ---- masses of a curve --------------------------------------------------------------------------- */

/* By Gauss-Legendre, exact to degree 7 in each panel. Beyond a finite stretch the panels grow: P22 falls at least as
 * r^-4 there. */
double slope_mass(const vndf_source *source, double from, double to)
{
    static const double place[4] = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                    0.93056815579702629};
    static const double weight[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                     0.17392742256872693};
    double sum = 0;
    if (isinf(to)) {
        for (double left = from; left < from * 1e6; left *= 1.5)
            sum += slope_mass(source, left, 1.5 * left);
        return sum;
    }
    for (int panel = 0; panel < PANELS; panel++)
        for (int i = 0; i < 4; i++) {
            double r = from + (to - from) * (panel + place[i]) / PANELS;
            sum += weight[i] * vndf_source_p22(source, r) * r;
        }
    return 6.283185307179586477 * sum * (to - from) / PANELS;
}

/* What each bin needs to be multiplied by goes to factor[]; the largest part by which a bin is wrong, or -1. */
static double compare(const slope_bins *b, const profile *rows, double factor[BINS_MOST], data_file *file)
{
    double worst = 0;
    vndf_source *source = profile_source(rows, file);
    for (size_t i = 0; i < b->count && source; i++) {
        double found = slope_mass(source, b->edge[i], b->edge[i + 1]);
        worst = fmax(worst, fabs(found - b->mass[i]));
        factor[i] = found > 0 ? b->mass[i] / found : 1;
    }
    vndf_source_free(source);
    return source ? worst : -1;
}

/* Multiplies the rows until their curve has the mass of every bin: in full steps, and in smaller ones after a step that
 * made the worst bin no better. Rows beyond the last bin go with it. The best rows are kept: where none have the
 * masses, the last ones may be far worse. Returns by how much of the whole a bin is wrong, or -1. */
static double match(const slope_bins *b, profile *rows, data_file *file)
{
    double factor[BINS_MOST], best[BINS_MOST + 2], before = INFINITY, left = INFINITY, power = 1;
    for (int step = 0; step < STEPS && !(left <= 1e-6); step++) {
        double worst = compare(b, rows, factor, file);
        if (worst < 0)
            return -1;
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

/* ---- rows ---------------------------------------------------------------------------------------- */

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

/* Fits the rows; by how much they miss a bin, or -1. *beyond: the mass of the curve beyond the longest slope; *is_tail:
 * whether the curve has the mass of the last bin, and little of it beyond the data. Of n independent slopes in the bin,
 * a right tail has the mass of one beyond the longest, and seldom that of four; the error says how large n is. */
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

int slope_rows_make(slope_bins *b, data_file *file, profile *rows)
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
        note(file, "residual_bins %.2g", left);
        note(file, "mass_beyond %.2g", beyond);
        return 1;
    }
    profile_free(rows);
    return left < 0
               ? 0
               : refuse(file, "no smooth curve has the masses of %zu bins; %.2g of all is wrong", b->count, left);
}
