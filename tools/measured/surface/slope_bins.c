#include "measured/surface/slope_bins.h"

#include <math.h>
#include <string.h>

#include "cli/random.h"

enum { DRAWS = 200, TAIL_LEAST = 100 };

static const double WIDER = 1.01; /* one edge over the edge before, at least */

void slope_bins_edges(slope_bins *b, const double *r, size_t count, double narrowest)
{
    double even = floor(fmin(fmax(cbrt((double)count) / 2, 12), 40)), part = 0;
    double step = 1 / even;
    b->edge[0] = 0;
    b->count = 0;
    while (b->count + 1 < BINS_MOST && (1 - part) * (double)count > TAIL_LEAST) {
        part += 1 - part > 1.5 * step ? step : (1 - part) / 2;
        double edge = r[(size_t)(part * (double)(count - 1))];
        if (edge > WIDER * b->edge[b->count] && edge - b->edge[b->count] >= narrowest &&
            WIDER * edge < r[count - 1])
            b->edge[++b->count] = edge;
    }
    b->edge[++b->count] = INFINITY;
    b->longest = r[count - 1];
    b->samples = count;
}

size_t slope_bin_of(const slope_bins *b, double r)
{
    size_t low = 0, high = b->count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (b->edge[middle] <= r)
            low = middle;
        else
            high = middle;
    }
    return low;
}

void slope_bins_masses(slope_bins *b, const double *r, size_t count)
{
    double square[BINS_MOST] = {0}, number[BINS_MOST] = {0}, logarithm = 0;
    for (size_t i = 0; i < count; i++) {
        size_t bin = slope_bin_of(b, r[i]);
        square[bin] += r[i] * r[i];
        logarithm += bin + 1 == b->count ? log(r[i]) : 0;
        number[bin]++;
    }
    for (size_t i = 0; i < b->count; i++) {
        b->mass[i] = number[i] / (double)count;
        b->middle[i] = sqrt(square[i] / fmax(number[i], 1));
    }
    b->middle[b->count - 1] = exp(logarithm / fmax(number[b->count - 1], 1));
}

/* ---- errors -------------------------------------------------------------------------------------- */

static void count_parts(slope_bins *b, const slope_set *slopes, const double *r)
{
    memset(b->of_part, 0, sizeof b->of_part);
    for (size_t i = 0; i < slopes->count; i++)
        b->of_part[slopes->part[i]][slope_bin_of(b, r[i])]++;
}

void slope_bins_errors(slope_bins *b, const slope_set *slopes, const double *r)
{
    random_stream stream = random_from(1);
    double sum[BINS_MOST] = {0}, square[BINS_MOST] = {0};
    count_parts(b, slopes, r);
    for (int draw = 0; draw < DRAWS; draw++) {
        double found[BINS_MOST] = {0}, whole = 0;
        for (int i = 0; i < SLOPE_PARTS; i++) {
            const double *part = b->of_part[random_bits(&stream) % SLOPE_PARTS];
            for (size_t bin = 0; bin < b->count; bin++)
                found[bin] += part[bin];
        }
        for (size_t bin = 0; bin < b->count; bin++)
            whole += found[bin];
        for (size_t bin = 0; bin < b->count && whole > 0; bin++) {
            sum[bin] += found[bin] / whole / DRAWS;
            square[bin] += found[bin] / whole * found[bin] / whole / DRAWS;
        }
    }
    for (size_t bin = 0; bin < b->count; bin++)
        b->error[bin] = sum[bin] > 0 ? sqrt(fmax(square[bin] - sum[bin] * sum[bin], 0)) / sum[bin] : 0;
}

void slope_bins_note(const slope_bins *b, notes *to)
{
    double sum = 0, median = -1, tail = -1;
    for (size_t i = 0; i < b->count; i++) {
        sum += b->mass[i];
        if (median < 0 && sum >= 0.5)
            median = b->error[i];
        if (tail < 0 && sum >= 0.99)
            tail = b->error[i];
    }
    note(to, "p22_error_median %.2g", median);
    note(to, "p22_error_99 %.2g", tail);
    note(to, "p22_error_last %.2g", b->error[b->count - 1]);
}
