#include "measured/surface/slopes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/random.h"
#include "cli/sort.h"
#include "measured/surface/shape.h"

enum { BINS_MOST = 96, RINGS = 8, SECTORS = 12, DRAWS = 200, TAIL_LEAST = 100 };

static const double LEFT_MOST = 0.01;
static const double WIDER = 1.01; /* one edge over the edge before, at least */

static const double BEYOND_MOST = 0.25; /* what a tail may have beyond the data, of the last bin's mass */
static const double SHORT_MOST = 0.2;   /* what may lack of that mass */

int slopes_make(slope_set *made, size_t room)
{
    *made = (slope_set){malloc(room * sizeof(float)), malloc(room * sizeof(float)), malloc(room), 0, room, 0};
    if (made->x && made->y && made->part)
        return 1;
    slopes_free(made);
    return 0;
}

void slopes_free(slope_set *freed)
{
    free(freed->x);
    free(freed->y);
    free(freed->part);
    *freed = (slope_set){NULL, NULL, NULL, 0, 0, 0};
}

void slopes_add(slope_set *to, double x, double y, int part)
{
    if (to->count == to->room)
        return;
    to->x[to->count] = (float)x;
    to->y[to->count] = (float)y;
    to->part[to->count++] = (unsigned char)part;
}

/* Takes the mean off; the rms of what is left. */
static void centre(slope_set *slopes, slope_law *law)
{
    double x = 0, y = 0, square = 0, n = (double)slopes->count;
    for (size_t i = 0; i < slopes->count; i++) {
        x += (double)slopes->x[i];
        y += (double)slopes->y[i];
    }
    law->tilt_x = x / n;
    law->tilt_y = y / n;
    for (size_t i = 0; i < slopes->count; i++) {
        slopes->x[i] = (float)((double)slopes->x[i] - law->tilt_x);
        slopes->y[i] = (float)((double)slopes->y[i] - law->tilt_y);
        square += (double)slopes->x[i] * (double)slopes->x[i] + (double)slopes->y[i] * (double)slopes->y[i];
    }
    law->rms = sqrt(square / n / 2);
}

/* ---- bins ---------------------------------------------------------------------------------------- */

typedef struct bins {
    size_t count;
    double edge[BINS_MOST + 1]; /* edge[count] is infinite */
    double mass[BINS_MOST];
    double middle[BINS_MOST];               /* a row's place */
    double error[BINS_MOST];                /* relative, of the mass: one standard deviation */
    double of_part[SLOPE_PARTS][BINS_MOST]; /* how many slopes of each part */
    double longest;                         /* of all slopes */
    size_t samples;
} bins;

/* Edges at equal parts of the sorted lengths r[], then halving what is left of the tail. */
static void place_edges(bins *b, const double *r, size_t count, double narrowest)
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

static size_t bin_of(const bins *b, double r)
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

/* Where the mean square of the lengths in a bin is: for a density that falls evenly in r^2 it has its mean there. The
 * last bin has no end, and a heavy tail no mean square: there it is the mean of the logarithm. */
static void place_rows(bins *b, const double *r, size_t count)
{
    double square[BINS_MOST] = {0}, number[BINS_MOST] = {0}, logarithm = 0;
    for (size_t i = 0; i < count; i++) {
        size_t bin = bin_of(b, r[i]);
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

/* The standard deviation of every bin's part, over DRAWS surfaces made of parts drawn again. */
static void draw_again(bins *b)
{
    random_stream stream = random_from(1);
    double sum[BINS_MOST] = {0}, square[BINS_MOST] = {0};
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

static void note_errors(const bins *b, notes *to)
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

/* ---- isotropy ------------------------------------------------------------------------------------ */

typedef struct sectors {
    double number[RINGS][SECTORS];
} sectors;

/* Half the sum of |part - its mean over the ring|. Opposite slopes share a sector where `is_even`. */
static double unevenness(const sectors *s)
{
    double off = 0, whole = 0;
    for (int ring = 0; ring < RINGS; ring++) {
        double sum = 0;
        for (int i = 0; i < SECTORS; i++)
            sum += s->number[ring][i];
        for (int i = 0; i < SECTORS; i++)
            off += fabs(s->number[ring][i] - sum / SECTORS);
        whole += sum;
    }
    return whole > 0 ? off / 2 / whole : 0;
}

static int ring_of(const bins *b, const double *below, double r)
{
    int ring = (int)(below[bin_of(b, r)] * RINGS);
    return ring < RINGS ? ring : RINGS - 1;
}

/* Of u, whose lengths the bins hold. The noise is that of SLOPE_PARTS parts, each told by the spread between them. */
static void judge_isotropy(const slope_set *slopes, const double unstretch[3], const bins *b, slope_law *law)
{
    static const double two_pi = 6.283185307179586477;
    double below[BINS_MOST], sum = 0, variance = 0;
    sectors all = {{{0}}};
    sectors *part = calloc(SLOPE_PARTS, sizeof *part);
    for (size_t i = 0; i < b->count; i++) {
        below[i] = sum;
        sum += b->mass[i];
    }
    for (size_t i = 0; i < slopes->count; i++) {
        double x = (double)slopes->x[i], y = (double)slopes->y[i];
        double u = unstretch[0] * x + unstretch[1] * y, v = unstretch[1] * x + unstretch[2] * y;
        int sector = (int)((atan2(v, u) / two_pi + 0.5) * SECTORS), ring = ring_of(b, below, hypot(u, v));
        sector = sector < SECTORS ? sector : SECTORS - 1;
        all.number[ring][sector]++;
        if (part)
            part[slopes->part[i]].number[ring][sector]++;
    }
    law->residual = unevenness(&all);
    /* The mean of |x| is sqrt(2/pi) deviations. */
    for (int ring = 0; ring < RINGS && part; ring++)
        for (int i = 0; i < SECTORS; i++) {
            double square = 0, mean = all.number[ring][i] / SLOPE_PARTS;
            for (int p = 0; p < SLOPE_PARTS; p++)
                square += (part[p].number[ring][i] - mean) * (part[p].number[ring][i] - mean);
            variance += sqrt(square * 2 / (two_pi / 2));
        }
    law->noise = variance / 2 / (double)slopes->count;
    free(part);
}

/* ---- the whole ----------------------------------------------------------------------------------- */

static double *lengths(const slope_set *slopes, const double unstretch[3])
{
    double *r = malloc(slopes->count * sizeof *r);
    for (size_t i = 0; r && i < slopes->count; i++) {
        double x = (double)slopes->x[i], y = (double)slopes->y[i];
        r[i] = hypot(unstretch[0] * x + unstretch[1] * y, unstretch[1] * x + unstretch[2] * y);
    }
    return r;
}

/* ---- rows ---------------------------------------------------------------------------------------- */

static int make_rows(const bins *b, const char *name, profile *rows, refusal *why)
{
    int has_end = isfinite(b->edge[b->count]);
    if (profile_make(rows, VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, b->count + (has_end ? 2 : 0)))
        rows->error = calloc(rows->count, sizeof *rows->error);
    if (!rows->error)
        return refuse_data(why, name, "there is no memory for %zu rows", rows->count);
    for (size_t i = 0; i < b->count; i++) {
        double next = isfinite(b->edge[i + 1]) ? b->edge[i + 1] : 2 * b->middle[i] - b->edge[i];
        rows->x[i] = b->middle[i];
        rows->error[i] = b->error[i];
        rows->value[i] = b->mass[i] / (next * next - b->edge[i] * b->edge[i]);
    }
    return 1;
}

/* The last bin ends at the longest slope. */
static void end_bins(bins *b)
{
    double from = b->edge[b->count - 1];
    b->edge[b->count] = b->longest;
    b->middle[b->count - 1] = sqrt((from * from + b->longest * b->longest) / 2);
}

/* The curve is even to the longest slope, and 0 after a step that has the mass of half a slope. */
static void end_rows(const bins *b, profile *rows)
{
    size_t last = b->count - 1;
    double step = (b->longest - b->edge[last]) / (b->mass[last] * (double)b->samples);
    rows->x[last + 1] = b->longest;
    rows->x[last + 2] = b->longest + fmax(step, 1e-9 * b->longest);
    rows->value[last + 1] = rows->value[last];
    rows->error[last + 1] = rows->error[last];
}

/* The mass of the curve in the last bin, and beyond the longest slope. All bins together have 1. */
typedef struct tail {
    double last, beyond;
} tail;

static int find_tail(const bins *b, const profile *rows, const char *name, tail *found, refusal *why)
{
    vndf_source *source = profile_source(rows, name, why);
    if (!source)
        return 0;
    size_t last = b->count - 1;
    int has_end = isfinite(b->edge[b->count]);
    found->last = profile_mass(source, b->edge[last], b->edge[b->count]);
    found->beyond = profile_mass(source, b->longest, has_end ? rows->x[rows->count - 1] : INFINITY);
    vndf_source_free(source);
    return 1;
}

static int fit_rows(const bins *b, const char *name, profile *rows, double *left, tail *found, refusal *why)
{
    const profile_bins wanted = {b->edge, b->mass, b->count};
    if (!make_rows(b, name, rows, why))
        return 0;
    if (isfinite(b->edge[b->count]))
        end_rows(b, rows);
    return profile_match(rows, &wanted, name, left, why) && find_tail(b, rows, name, found, why);
}

/* Whether a tail has the mass of the last bin, and little of it beyond the data. Of n independent slopes in the bin, a
 * right tail has the mass of one beyond the longest, and seldom that of four; the error says how large n is. */
static int is_tail(const bins *b, const tail *found)
{
    size_t last = b->count - 1;
    double most = fmin(4 * b->error[last] * b->error[last], BEYOND_MOST);
    return found->beyond <= most * b->mass[last] && found->last >= (1 - SHORT_MOST) * b->mass[last];
}

/* Slopes that end abruptly have no tail: there the curve has an end. */
static int find_rows(bins *b, const char *name, profile *rows, double *left, double *beyond, refusal *why)
{
    tail found = {0, 0};
    int good = fit_rows(b, name, rows, left, &found, why);
    if (good && (*left >= LEFT_MOST || !is_tail(b, &found))) {
        profile_free(rows);
        end_bins(b);
        good = fit_rows(b, name, rows, left, &found, why);
    }
    *beyond = found.beyond;
    return good && (*left < LEFT_MOST || refuse_data(why, name,
                                                     "no smooth curve has the masses of %zu bins; %.2g of all is "
                                                     "wrong",
                                                     b->count, *left));
}

static void count_parts(bins *b, const slope_set *slopes, const double *r)
{
    memset(b->of_part, 0, sizeof b->of_part);
    for (size_t i = 0; i < slopes->count; i++)
        b->of_part[slopes->part[i]][bin_of(b, r[i])]++;
}

/* Bins and rows of |u|, with their errors. */
static int radial_law(const slope_set *slopes, const double unstretch[3], const char *name, slope_law *law,
                      notes *to, refusal *why)
{
    double left = 0, beyond = 0;
    bins *b = calloc(1, sizeof *b);
    double *r = lengths(slopes, unstretch);
    double *sorted = malloc(slopes->count * sizeof *sorted);
    int good = b && r && sorted;
    if (good) {
        memcpy(sorted, r, slopes->count * sizeof *r);
        sort_numbers(sorted, slopes->count);
        place_edges(b, sorted, slopes->count, 2 * slopes->quantum);
        place_rows(b, sorted, slopes->count);
        count_parts(b, slopes, r);
        draw_again(b);
        good = b->count >= 4
                   ? find_rows(b, name, &law->rows, &left, &beyond, why)
                   : refuse_data(why, name,
                                 "%zu lengths of slopes can be told apart, and 4 are needed: the steps of the "
                                 "data are too coarse, or it is flat",
                                 b->count);
        judge_isotropy(slopes, unstretch, b, law);
    } else
        refuse_data(why, name, "there is no memory for %zu slopes", slopes->count);
    if (good) {
        note(to, "rows %zu", b->count);
        note_errors(b, to);
        note(to, "residual_bins %.2g", left);
        note(to, "mass_beyond %.2g", beyond);
    }
    free(sorted);
    free(r);
    free(b);
    return good;
}

static void note_law(const slope_law *law, notes *to)
{
    note(to, "tilt %.6g,%.6g", law->tilt_x, law->tilt_y);
    note(to, "rms_slope %.6g", law->rms);
    note(to, "anisotropy %.4g +- %.2g", law->anisotropy, law->anisotropy_error);
    if (law->is_anisotropic)
        note(to, "matrix %.6g,%.6g,%.6g,%.6g", law->matrix[0], law->matrix[1], law->matrix[1], law->matrix[2]);
}

static int has_slopes(const slope_set *slopes, const char *name, refusal *why)
{
    size_t zeros = 0;
    if (slopes->count < SLOPES_LEAST)
        return refuse_data(why, name, "%zu slopes; at least %d are needed", slopes->count, SLOPES_LEAST);
    for (size_t i = 0; i < slopes->count; i++)
        zeros += slopes->x[i] == slopes->x[0] && slopes->y[i] == slopes->y[0];
    if (zeros > slopes->count / 2)
        return refuse_data(why, name,
                           "%zu of %zu slopes are the same: this is a plane with something on it, not a "
                           "rough surface",
                           zeros, slopes->count);
    return 1;
}

int slopes_law(slope_set *slopes, const char *name, slope_law *law, notes *to, refusal *why)
{
    double unstretch[3] = {1, 0, 1};
    *law = (slope_law){.matrix = {1, 0, 1}};
    if (!has_slopes(slopes, name, why))
        return 0;
    centre(slopes, law);
    slope_shape shape;
    if (!shape_of(slopes, name, &shape, why))
        return 0;
    law->anisotropy = shape.ratio;
    law->anisotropy_error = shape.error;
    law->is_anisotropic = shape.ratio - 1 > fmax(4 * shape.error, 0.02);
    if (law->is_anisotropic) {
        memcpy(law->matrix, shape.matrix, sizeof law->matrix);
        memcpy(unstretch, shape.inverse, sizeof unstretch);
    }
    note(to, "slopes %zu", slopes->count);
    note_law(law, to);
    if (!radial_law(slopes, unstretch, name, law, to, why)) {
        profile_free(&law->rows);
        return 0;
    }
    note(to, "residual_isotropy %.3g", law->residual);
    note(to, "residual_isotropy_by_chance %.3g", law->noise);
    return 1;
}
