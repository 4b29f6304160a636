#include "measured/slopes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RINGS = 8, SECTORS = 12, STEPS = 60 };

static const double pi = 3.14159265358979323846;
static const double RATIO_MOST = 100;
static const double SLOPE_LEAST = 1e-3, SLOPE_MOST = 10; /* medians that surfaces have */

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
static void centre(slope_set *slopes, data_file *file)
{
    double x = 0, y = 0, square = 0, n = (double)slopes->count;
    for (size_t i = 0; i < slopes->count; i++) {
        x += (double)slopes->x[i] / n;
        y += (double)slopes->y[i] / n;
    }
    for (size_t i = 0; i < slopes->count; i++) {
        slopes->x[i] = (float)((double)slopes->x[i] - x);
        slopes->y[i] = (float)((double)slopes->y[i] - y);
        square += (double)slopes->x[i] * (double)slopes->x[i] + (double)slopes->y[i] * (double)slopes->y[i];
    }
    note(file, "slopes %zu", slopes->count);
    note(file, "tilt %.6g,%.6g", x, y);
    note(file, "rms_slope %.6g", sqrt(square / n / 2));
}

/* ---- shape --------------------------------------------------------------------------------------- */

typedef struct symmetric {
    double xx, xy, yy;
} symmetric;

static double determinant(symmetric m)
{
    return m.xx * m.yy - m.xy * m.xy;
}

static symmetric scaled(symmetric m, double by)
{
    return (symmetric){by * m.xx, by * m.xy, by * m.yy};
}

static symmetric inverse(symmetric m)
{
    return scaled((symmetric){m.yy, -m.xy, m.xx}, 1 / determinant(m));
}

/* Of a matrix with determinant 1: (V + 1)/sqrt(trace V + 2), by Cayley and Hamilton. */
static symmetric root(symmetric v)
{
    double by = 1 / sqrt(v.xx + v.yy + 2);
    return (symmetric){by * (v.xx + 1), by * v.xy, by * (v.yy + 1)};
}

/* The larger axis of V^1/2 over the smaller. */
static double ratio_of(symmetric v)
{
    double middle = (v.xx + v.yy) / 2, away = hypot((v.xx - v.yy) / 2, v.xy);
    return middle > away ? sqrt((middle + away) / (middle - away)) : INFINITY;
}

static void add(symmetric *to, symmetric more)
{
    to->xx += more.xx;
    to->xy += more.xy;
    to->yy += more.yy;
}

/* The sums of s s^T / (s^T V^-1 s) over the slopes of each part. */
static void sum_parts(const slope_set *slopes, symmetric v, symmetric part[SLOPE_PARTS])
{
    symmetric w = inverse(v);
    memset(part, 0, SLOPE_PARTS * sizeof *part);
    for (size_t i = 0; i < slopes->count; i++) {
        double x = (double)slopes->x[i], y = (double)slopes->y[i];
        double square = w.xx * x * x + 2 * w.xy * x * y + w.yy * y * y;
        if (square > 0)
            add(&part[slopes->part[i]], (symmetric){x * x / square, x * y / square, y * y / square});
    }
}

/* Relative, of the ratio: from the spread between parts, as they were drawn again. One step from the solution moves
 * about half as far as the solution does (the derivative of Tyler's map in two dimensions), so the spread counts twice.
 * In the frame where V is 1 the sum of all parts is 1 but for a factor; for isotropic slopes the two components of the
 * distortion spread alike, and each is a deviation of the ratio. */
static double shape_error(const symmetric part[SLOPE_PARTS], symmetric v)
{
    symmetric s = inverse(root(v));
    double square = 0, whole = 0;
    for (int i = 0; i < SLOPE_PARTS; i++) {
        double a = s.xx * part[i].xx + s.xy * part[i].xy, b = s.xx * part[i].xy + s.xy * part[i].yy;
        double c = s.xy * part[i].xx + s.yy * part[i].xy, d = s.xy * part[i].xy + s.yy * part[i].yy;
        double stretch = (a * s.xx + b * s.xy - c * s.xy - d * s.yy) / 2, shear = a * s.xy + b * s.yy;
        square += (stretch * stretch + shear * shear) / 2;
        whole += (a * s.xx + b * s.xy + c * s.xy + d * s.yy) / 2;
    }
    return 2 * sqrt(square) / whole;
}

/* V^-1/2, and the identity where that is within its error; V^1/2 is noted. */
static int find_shape(const slope_set *slopes, data_file *file, symmetric *unstretch)
{
    symmetric v = {1, 0, 1}, part[SLOPE_PARTS];
    double change = 1;
    for (int step = 0; step < STEPS && change > 1e-7; step++) {
        symmetric sum = {0, 0, 0};
        sum_parts(slopes, v, part);
        for (int i = 0; i < SLOPE_PARTS; i++)
            add(&sum, part[i]);
        if (!(determinant(sum) > 0))
            return refuse(file,
                          "the slopes lie on a line: grooves that are all parallel have no D of two dimensions");
        sum = scaled(sum, 1 / sqrt(determinant(sum)));
        change = fabs(sum.xx - v.xx) + fabs(sum.xy - v.xy) + fabs(sum.yy - v.yy);
        v = sum;
        if (!(ratio_of(v) < RATIO_MOST))
            return refuse(
                file,
                "the slopes lie nearly on a line, %.3g times as wide one way as the other; %.0f times is "
                "the most",
                ratio_of(v), RATIO_MOST);
    }
    double ratio = ratio_of(v), error = ratio * shape_error(part, v);
    symmetric m = root(v);
    *unstretch = (symmetric){1, 0, 1};
    note(file, "anisotropy %.4g +- %.2g", ratio, error);
    if (ratio - 1 > fmax(4 * error, 0.02)) {
        *unstretch = inverse(m);
        note(file, "matrix %.6g,%.6g,%.6g,%.6g", m.xx, m.xy, m.xy, m.yy);
    }
    return 1;
}

/* ---- isotropy ------------------------------------------------------------------------------------ */

/* The part of all slopes u = (x, y), whose lengths the bins hold, that would have to turn about z: half the sum of
 * |sector - its mean over the ring|. */
static void note_isotropy(const slope_set *slopes, symmetric unstretch, const slope_bins *b, data_file *file)
{
    double below[BINS_MOST], before = 0, off = 0, number[RINGS][SECTORS] = {{0}};
    for (size_t i = 0; i < b->count; before += b->mass[i++])
        below[i] = before;
    for (size_t i = 0; i < slopes->count; i++) {
        double x = (double)slopes->x[i], y = (double)slopes->y[i];
        double u = unstretch.xx * x + unstretch.xy * y, v = unstretch.xy * x + unstretch.yy * y;
        int sector = (int)((atan2(v, u) / (2 * pi) + 0.5) * SECTORS) % SECTORS;
        number[(int)fmin(below[slope_bin_of(b, hypot(u, v))] * RINGS, RINGS - 1)][sector]++;
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

/* ---- the whole ----------------------------------------------------------------------------------- */

static int has_slopes(const slope_set *slopes, data_file *file)
{
    size_t same = 0;
    if (slopes->count < SLOPES_LEAST)
        return refuse(file, "%zu slopes; at least %d are needed", slopes->count, SLOPES_LEAST);
    for (size_t i = 0; i < slopes->count; i++)
        same += slopes->x[i] == slopes->x[0] && slopes->y[i] == slopes->y[0];
    return same <= slopes->count / 2 ||
           refuse(file,
                  "%zu of %zu slopes are the same: this is a plane with something on it, not a rough surface",
                  same, slopes->count);
}

/* Slopes of another scale come from heights and steps in different units. */
static void note_median(const slope_bins *b, data_file *file)
{
    double below = 0;
    size_t i = 0;
    while (i + 1 < b->count && below + b->mass[i] < 0.5)
        below += b->mass[i++];
    if (b->middle[i] < SLOPE_LEAST || b->middle[i] > SLOPE_MOST)
        note(file, "implausible median slope %.2g: are heights and steps in the same unit?", b->middle[i]);
}

int slopes_law(slope_set *slopes, data_file *file, profile *rows)
{
    symmetric unstretch;
    *rows = (profile){0};
    if (!has_slopes(slopes, file))
        return 0;
    centre(slopes, file);
    if (!find_shape(slopes, file, &unstretch))
        return 0;
    slope_bins *b = calloc(1, sizeof *b);
    double *r = malloc(slopes->count * sizeof *r);
    for (size_t i = 0; r && i < slopes->count; i++) {
        double x = (double)slopes->x[i], y = (double)slopes->y[i];
        r[i] = hypot(unstretch.xx * x + unstretch.xy * y, unstretch.xy * x + unstretch.yy * y);
    }
    int good = (b && r) || refuse(file, "there is no memory for %zu slopes", slopes->count);
    good = good && slope_bins_make(b, slopes, r, file) && slope_rows_make(b, file, rows);
    if (good) {
        note_isotropy(slopes, unstretch, b, file);
        note_median(b, file);
    }
    free(r);
    free(b);
    return good;
}
