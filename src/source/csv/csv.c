/* Distributions given by a measured curve: joins the rows of csv_read.c as csv.h says. */
#include "source/csv/csv.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "core/error.h"
#include "source/csv/curve.h"
#include "source/rows.h"
#include "source/source.h"
#include "source/words.h"

enum { BREAKS = 4096, OPERATIONS = 8 };

static const double ROUNDING_MOST = 1e-6; /* of P22: rows of six digits */

typedef struct csv_source {
    vndf_source base; /* first: a vndf_source* is cast back to this */
    vndf_csv_first first;
    vndf_csv_second second;
    vndf_curve curve; /* over asinh(x/scale) */
    double scale;
    int logarithmic;   /* the curve is the logarithm of the second column */
    double last_slope; /* where the tail begins; infinite if the rows reach 90 degrees */
    double last_p22;
    double tail;         /* beyond it P22 falls as r^-tail */
    int falls_to_0;      /* the last row is 0 at 90 degrees, the row before is not 0 ... */
    double last_but_one; /* ... and stands at this slope */
    double *breaks;      /* owned */
    vndf_rows rows;      /* P22 r^2 over log r, where there are more than BREAKS; else empty */
} csv_source;

/* cos(theta)^4 at the slope r: P22 = D c^4. */
static double cosine4(double r)
{
    double c = 1 / hypot(1, r), c2 = c * c;
    return c2 * c2;
}

/* Between the abscissas of the angle of the slope r and of 90 degrees: asinh a - asinh b for a^2 - b^2 that is known
 * with all its digits. */
static double distance_to_grazing(double scale, double r)
{
    double a = 1.5707963267948966 / scale, rest = atan(1 / r) / scale, b = a - rest;
    return asinh(rest * (a + b) / (a * hypot(1, b) + b * hypot(1, a)));
}

static double p22(const vndf_source *self, double r)
{
    const csv_source *source = (const csv_source *)self;
    if (r > source->last_slope)
        return source->last_p22 == 0 ? 0 : source->last_p22 * pow(r / source->last_slope, -source->tail);
    double x = source->first == VNDF_CSV_SLOPE ? r : atan(r);
    double y = source->falls_to_0 && r > source->last_but_one
                   ? vndf_curve_before_end(&source->curve, distance_to_grazing(source->scale, r))
                   : vndf_curve_value(&source->curve, asinh(x / source->scale));
    double value = source->logarithmic ? exp(y) : y;
    return source->second == VNDF_CSV_NDF ? value * cosine4(r) : value;
}

/* Between rows that are breaks the curve is one cubic, or the exponential of one: a few points determine it. */
static vndf_reach reach(const vndf_source *self, double low, double high)
{
    const csv_source *source = (const csv_source *)self;
    vndf_reach at = {p22(self, low), p22(self, high), 0};
    if (source->rows.count)
        at.stray = vndf_rows_stray(&source->rows, log(low), at.low * low * low, log(high), at.high * high * high);
    return at;
}

static void destroy(vndf_source *self)
{
    csv_source *source = (csv_source *)self;
    vndf_curve_free(&source->curve);
    vndf_rows_free(&source->rows);
    free(source->breaks);
    free(source->base.description);
    free(source);
}

static double slope_of_row(const vndf_csv_rows *rows, size_t i)
{
    static const double grazing = 1.5707963267948966;
    if (rows->first == VNDF_CSV_SLOPE)
        return rows->x[i];
    return rows->x[i] >= grazing ? INFINITY : tan(rows->x[i]);
}

static double p22_of_row(const vndf_csv_rows *rows, size_t i)
{
    return rows->second == VNDF_CSV_P22 ? rows->value[i] : rows->value[i] * cosine4(slope_of_row(rows, i));
}

static void fit_curve(csv_source *source, const vndf_csv_rows *rows)
{
    size_t last = rows->count - 1;
    double x = rows->x[last], first_step = rows->x[1] - rows->x[0], last_step = x - rows->x[last - 1];
    source->scale = fmax(x * fmin(fmax(first_step / last_step, 1e-12), 1e3), DBL_MIN);
    source->logarithmic = 1;
    for (size_t i = 0; i <= last; i++)
        source->logarithmic &= rows->value[i] > 0;
    for (size_t i = 0; i <= last; i++) {
        source->curve.x[i] = asinh(rows->x[i] / source->scale);
        source->curve.y[i] = source->logarithmic ? log(rows->value[i]) : rows->value[i];
    }
    vndf_curve_fit(&source->curve);
}

static void fit_tail(csv_source *source, const vndf_csv_rows *rows)
{
    size_t last = rows->count - 1;
    double before = slope_of_row(rows, last - 1), p22_before = p22_of_row(rows, last - 1);
    source->last_slope = slope_of_row(rows, last);
    source->last_p22 = p22_of_row(rows, last);
    source->tail = 4;
    source->last_but_one = before;
    source->falls_to_0 = isinf(source->last_slope) && rows->value[last] == 0 && rows->value[last - 1] > 0;
    if (before > 0 && p22_before > 0 && source->last_p22 > 0 && isfinite(source->last_slope))
        source->tail = fmax(4, log(p22_before / source->last_p22) / log(source->last_slope / before));
}

/* The slopes of the rows except 0 and infinity; if there are too many, every n-th. */
static void fill_breaks(csv_source *source, const vndf_csv_rows *rows)
{
    size_t count = rows->count < BREAKS ? rows->count : BREAKS;
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        double slope = slope_of_row(rows, i * (rows->count - 1) / (count - 1));
        if (slope > 0 && isfinite(slope))
            source->breaks[kept++] = slope;
    }
    source->base.breaks = source->breaks;
    source->base.break_count = kept;
}

/* How far the curve is from the chord between row i and the next. */
static double bend_of(const vndf_curve *curve, size_t i)
{
    double h = curve->x[i + 1] - curve->x[i], rise = curve->y[i + 1] - curve->y[i];
    return 4.0 / 27 * (fabs(curve->slope[i] * h - rise) + fabs(curve->slope[i + 1] * h - rise));
}

/* Leaves out rows at slope 0 and at 90 degrees. */
static void fill_rows(csv_source *source, const vndf_csv_rows *given)
{
    vndf_rows *rows = &source->rows;
    for (size_t i = 0; i < given->count; i++) {
        double r = slope_of_row(given, i), f = p22_of_row(given, i) * r * r;
        double bend = i + 1 < given->count ? bend_of(&source->curve, i) : 0;
        if (!(r > 0) || !isfinite(r))
            continue;
        rows->u[rows->count] = log(r);
        rows->f[rows->count] = f;
        rows->bend[rows->count++] = bend * (source->logarithmic   ? f
                                            : given->value[i] > 0 ? f / given->value[i]
                                                                  : 0);
    }
}

/* How far rounding moves the rows, relative: two standard deviations. The last digits of many rows make fourth
 * differences of 6.7 standard deviations in the mean. Differences above ROUNDING_MOST do not come from
 * rounding. */
static double rounding_of(const csv_source *source)
{
    const double *y = source->curve.y;
    double sum = 0, most = 0;
    for (size_t i = 2; i + 2 < source->curve.count; i++) {
        sum += fabs(y[i - 2] - 4 * y[i - 1] + 6 * y[i] - 4 * y[i + 1] + y[i + 2]);
        most = fmax(most, fabs(y[i]));
    }
    double deviation = sum / (double)source->curve.count / 6.7;
    return fmin(2 * deviation / (source->logarithmic ? 1 : fmax(most, DBL_MIN)), ROUNDING_MOST);
}

static char *describe(const char *name, const char *text, size_t size, vndf_error *error)
{
    char checksum[32];
    vndf_text words = {NULL, 0, 0, 0};
    snprintf(checksum, sizeof checksum, " (crc32 %08lx)", (unsigned long)vndf_crc32(0, text, size));
    vndf_text_add_word(&words, "--csv");
    vndf_text_add_word(&words, name ? name : "unnamed");
    vndf_text_add(&words, checksum);
    return vndf_text_finish(&words, error);
}

vndf_source *vndf_csv_source(const vndf_csv_rows *rows, char *description, vndf_error *error)
{
    csv_source *source = calloc(1, sizeof *source);
    if (source) {
        source->base = (vndf_source){
            .p22 = p22, .destroy = destroy, .description = description, .operations = OPERATIONS, .reach = reach};
        source->breaks = malloc(BREAKS * sizeof *source->breaks);
    }
    int many = rows->count > BREAKS;
    if (!source || !source->breaks || !vndf_curve_allocate(&source->curve, rows->count) ||
        (many && !vndf_rows_allocate(&source->rows, rows->count))) {
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for %zu rows", rows->count);
        if (source)
            destroy(&source->base);
        else
            free(description);
        return NULL;
    }
    source->first = rows->first;
    source->second = rows->second;
    fit_curve(source, rows);
    fit_tail(source, rows);
    fill_breaks(source, rows);
    if (many) {
        fill_rows(source, rows);
        source->base.rounding = rounding_of(source);
    }
    return &source->base;
}

vndf_source *vndf_source_csv_text(const char *name, const char *text, size_t size, vndf_error *error)
{
    vndf_csv_rows rows;
    vndf_error inner = {VNDF_OK, ""};
    if (!text) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "the text of the CSV is NULL");
        return NULL;
    }
    if (name && strlen(name) > VNDF_LIMIT_NAME_LENGTH) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "the name of the CSV has %zu characters; at most %d are possible",
                  strlen(name), VNDF_LIMIT_NAME_LENGTH);
        return NULL;
    }
    if (vndf_csv_read(text, size, &rows, &inner) != VNDF_OK) {
        vndf_fail(error, inner.status, "%s: %s", name ? name : "unnamed", inner.message);
        return NULL;
    }
    char *description = describe(name, text, size, error);
    vndf_source *source = description ? vndf_csv_source(&rows, description, error) : NULL;
    vndf_csv_rows_free(&rows);
    return source;
}

/* ---- files ------------------------------------------------------------------------------------ */

/* Reads to the end, since a pipe does not tell its size. NULL and an error if that fails. */
static char *read_stream(FILE *file, const char *path, size_t *size, vndf_error *error)
{
    size_t capacity = 0, used = 0, got = 1;
    char *bytes = NULL;
    while (got > 0 && used <= VNDF_LIMIT_CSV_BYTES) {
        if (used == capacity) {
            capacity = 2 * capacity + 65536;
            char *more = realloc(bytes, capacity);
            if (!more) {
                free(bytes);
                vndf_fail(error, VNDF_ERROR_MEMORY, "%s: no memory for %zu bytes", path, capacity);
                return NULL;
            }
            bytes = more;
        }
        got = fread(bytes + used, 1, capacity - used, file);
        used += got;
    }
    *size = used;
    if (!ferror(file) && used <= VNDF_LIMIT_CSV_BYTES)
        return bytes;
    if (ferror(file))
        vndf_fail(error, VNDF_ERROR_IO, "%s: cannot be read: %s", path, strerror(errno));
    else
        vndf_fail(error, VNDF_ERROR_SYNTAX, "%s: more than %d bytes; too long for a CSV of %d rows", path,
                  VNDF_LIMIT_CSV_BYTES, VNDF_LIMIT_CSV_ROWS);
    free(bytes);
    return NULL;
}

vndf_source *vndf_source_csv_file(const char *path, vndf_error *error)
{
    size_t size = 0;
    FILE *file = path ? fopen(path, "rb") : NULL;
    if (!file) {
        vndf_fail(error, path ? VNDF_ERROR_IO : VNDF_ERROR_ARGUMENT, "%s: cannot be opened: %s",
                  path ? path : "the path is NULL", path ? strerror(errno) : "a file name is needed");
        return NULL;
    }
    char *text = read_stream(file, path, &size, error);
    fclose(file);
    vndf_source *source = text ? vndf_source_csv_text(path, text, size, error) : NULL;
    free(text);
    return source;
}
