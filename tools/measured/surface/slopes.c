#include "measured/surface/slopes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/sort.h"
#include "measured/surface/shape.h"
#include "measured/surface/slope_rows.h"

enum { RINGS = 8, SECTORS = 12 };

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

/* ---- isotropy ------------------------------------------------------------------------------------ */

typedef struct sectors {
    double number[RINGS][SECTORS];
} sectors;

/* Half the sum of |part - its mean over the ring|, over the whole. */
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

static int ring_of(const slope_bins *b, const double *below, double r)
{
    int ring = (int)(below[slope_bin_of(b, r)] * RINGS);
    return ring < RINGS ? ring : RINGS - 1;
}

/* Of u, whose lengths the bins hold. The noise is that of SLOPE_PARTS parts, each told by the spread between them. */
static void judge_isotropy(const slope_set *slopes, const double unstretch[3], const slope_bins *b, slope_law *law)
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

/* Bins and rows of |u|, with their errors. */
static int radial_law(const slope_set *slopes, const double unstretch[3], const char *name, slope_law *law,
                      notes *to, refusal *why)
{
    double left = 0, beyond = 0;
    slope_bins *b = calloc(1, sizeof *b);
    double *r = lengths(slopes, unstretch);
    double *sorted = malloc(slopes->count * sizeof *sorted);
    int good = b && r && sorted;
    if (good) {
        memcpy(sorted, r, slopes->count * sizeof *r);
        sort_numbers(sorted, slopes->count);
        slope_bins_edges(b, sorted, slopes->count, 2 * slopes->quantum);
        slope_bins_masses(b, sorted, slopes->count);
        slope_bins_errors(b, slopes, r);
        good = b->count >= 4
                   ? slope_rows_find(b, name, &law->rows, &left, &beyond, why)
                   : refuse_data(why, name,
                                 "%zu lengths of slopes can be told apart, and 4 are needed: the steps of the "
                                 "data are too coarse, or it is flat",
                                 b->count);
        judge_isotropy(slopes, unstretch, b, law);
    } else
        refuse_data(why, name, "there is no memory for %zu slopes", slopes->count);
    if (good) {
        note(to, "rows %zu", b->count);
        slope_bins_note(b, to);
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
