/* Measured curves: D or P22 against angle or slope, as CSV or as rows of numbers, each row checked against the one
 * before; and the curve through them.
 *
 * The first line that is neither blank nor a comment (#) names two columns: theta_deg, theta (radians) or
 * slope (= tan theta), then ndf (D) or p22. Each line after it holds two numbers, the first ascending from 0
 * or above, the second finite and not negative. 90 degrees is allowed for ndf: D may be anything there.
 *
 * Between the rows: a shape-preserving cubic. It interpolates the logarithm of the second column if all
 * values are positive, so that a curve over many decades keeps its shape in each; if there are zeros, the column
 * itself. The abscissa is asinh(x/s), x the first column: linear for x << s, logarithmic beyond.
 * s = last x * first step/last step makes the first step as wide as the last: even rows are joined almost as they
 * stand (s >= last x), rows that double are joined in log x. s stays within 1e-12 and 1e3 of the last x.
 *
 * Below the first row: the second column keeps its first value.
 *
 * Beyond the last row: P22 falls as r^-k, k fitted to the last two rows, but never slower than r^-4, for which
 * D is constant: finite at 90 degrees. (k is 4 too if the last two rows give none: P22 rises, or the last row but
 * one is at slope 0.) If the last value is 0, P22 is 0 beyond it: end with 0 for a support that ends. A row of 0 at 90
 * degrees behind one that is not 0 stands for half of that half-way there; from there on k is at least 5, as for
 * D ~ cos.
 *
 * The cubic is Steffen's (slopes by eq. 11 inside, eqs. 24-29 at the ends, then Hermite's form), in Astronomy and
 * Astrophysics 239 (1990). Its first derivative is continuous, it never leaves the range of two neighbours, and it is
 * exact for straight lines. */
#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "core/error.h"
#include "math/ascending.h"
#include "source/source.h"
#include "source/words.h"

enum { OPERATIONS = 8 };

static const double APART = 1e-12; /* of themselves: the abscissa of the curve could not tell closer rows apart */
static const double RIGHT_ANGLE = 1.57079632679489661923;

/* Points with x ascending, at least two, and dy/dx there. */
typedef struct curve {
    double *x, *y, *slope;
    size_t count;
} curve;

typedef struct csv_source {
    vndf_source base; /* first: a vndf_source* is cast back to this */
    vndf_rows_over over;
    vndf_rows_of of;
    curve curve; /* over asinh(x/scale) */
    double scale;
    int logarithmic;       /* the curve is the logarithm of the second column */
    double last_slope;     /* where the tail begins; infinite if the rows reach 90 degrees */
    double last_p22, tail; /* beyond it P22 falls as r^-tail */
    double *numbers;       /* owned: the slopes of all rows, and the numbers of the curve */
} csv_source;

/* What is read, row by row. Angles become radians; the last may be pi/2. */
typedef struct reader {
    vndf_span rest;    /* the text that has not been read */
    const char *unit;  /* "line", or "row" of numbers in memory */
    size_t at, before; /* number of the current one; of that of the row before */
    const char *name;  /* of the text, NULL for numbers in memory */
    vndf_status refusal;
    vndf_rows_over over;
    vndf_rows_of of;
    int degrees; /* the first column */
    vndf_writer x, value;
    size_t count;
    double last; /* of x */
    vndf_error *error;
} reader;

/* ---- the cubic -------------------------------------------------------------------------------- */

/* The slope between the secants a and b of widths p and q: that of the parabola, reduced until both sides are monotone;
 * 0 at a local extremum. */
static double inner_slope(double a, double p, double b, double q)
{
    double parabola = fabs((a * q + b * p) / (p + q)), most = 2 * fmin(fabs(a), fabs(b));
    return (a > 0) != (b > 0) ? 0 : copysign(fmin(parabola, most), a);
}

/* The same at an end, whose secant is a; b is the next one. */
static double end_slope(double a, double p, double b, double q)
{
    double parabola = a + (a - b) * p / (p + q);
    if ((parabola > 0) != (a > 0))
        return 0;
    return fabs(parabola) > 2 * fabs(a) ? 2 * a : parabola;
}

static void fit_cubic(curve *c)
{
    size_t last = c->count - 1;
    double a = 0, p = 0; /* secant and width of the piece before */
    for (size_t i = 0; i < last; i++) {
        double q = c->x[i + 1] - c->x[i], b = (c->y[i + 1] - c->y[i]) / q;
        c->slope[i] = i > 0 ? inner_slope(a, p, b, q) : b;
        if (i == 1)
            c->slope[0] = end_slope(a, p, b, q);
        c->slope[last] = i > 0 ? end_slope(b, q, a, p) : b;
        a = b;
        p = q;
    }
}

static double value_at(const curve *c, double x)
{
    size_t last = c->count - 1;
    if (!(x > c->x[0]))
        return c->y[0];
    if (x >= c->x[last])
        return c->y[last];
    size_t i = vndf_last_before(c->x, sizeof *c->x, c->count, x);
    double h = c->x[i + 1] - c->x[i], t = (x - c->x[i]) / h, u = 1 - t, y0 = c->y[i], y1 = c->y[i + 1];
    double bend = t * u * (u * (c->slope[i] * h) - t * (c->slope[i + 1] * h));
    double y = y0 + (y1 - y0) * t * t * (3 - 2 * t) + bend;
    /* Rounding alone could leave the range, and a density must not be negative. */
    return fmin(fmax(y, fmin(y0, y1)), fmax(y0, y1));
}

/* ---- P22 -------------------------------------------------------------------------------------- */

/* cos(theta)^4 at the slope r: P22 = D c^4. */
static double cosine4(double r)
{
    double c = 1 / hypot(1, r), c2 = c * c;
    return c2 * c2;
}

static double p22_at(const csv_source *source, double r)
{
    if (r > source->last_slope)
        return source->last_p22 == 0 ? 0 : source->last_p22 * pow(r / source->last_slope, -source->tail);
    double x = source->over == VNDF_ROWS_OVER_SLOPE ? r : atan(r);
    double y = value_at(&source->curve, asinh(x / source->scale)), value = source->logarithmic ? exp(y) : y;
    return source->of == VNDF_ROWS_OF_NDF ? value * cosine4(r) : value;
}

static void p22(const vndf_source *self, const double *r, size_t count, double *values)
{
    for (size_t i = 0; i < count; i++)
        values[i] = p22_at((const csv_source *)self, r[i]);
}

/* All rows are breaks, and between two of them the curve is one cubic, or the exponential of one, which a few points
 * determine. */
static vndf_reach reach(const vndf_source *self, double low, double high)
{
    const csv_source *source = (const csv_source *)self;
    return (vndf_reach){p22_at(source, low), p22_at(source, high), 0};
}

static void destroy(vndf_source *self)
{
    free(((csv_source *)self)->numbers);
    free(self->description);
    free(self);
}

/* ---- fits ------------------------------------------------------------------------------------- */

static void fit_curve(csv_source *source, const double *given, const double *value)
{
    size_t last = source->curve.count - 1;
    double x = given[last], first_step = given[1] - given[0], last_step = x - given[last - 1];
    source->scale = fmax(x * fmin(fmax(first_step / last_step, 1e-12), 1e3), DBL_MIN);
    source->logarithmic = 1;
    for (size_t i = 0; i <= last; i++)
        source->logarithmic &= value[i] > 0;
    for (size_t i = 0; i <= last; i++) {
        source->curve.x[i] = asinh(given[i] / source->scale);
        source->curve.y[i] = source->logarithmic ? log(value[i]) : value[i];
    }
    fit_cubic(&source->curve);
}

/* By the slopes and values of the last two rows. */
static void fit_tail(csv_source *source, const double *slope, const double *value, double least)
{
    int is_ndf = source->of == VNDF_ROWS_OF_NDF;
    double before = value[0] * (is_ndf ? cosine4(slope[0]) : 1),
           last = value[1] * (is_ndf ? cosine4(slope[1]) : 1);
    source->last_slope = slope[1];
    source->last_p22 = last;
    source->tail = least;
    if (slope[0] > 0 && before > 0 && last > 0 && isfinite(slope[1]))
        source->tail = fmax(least, log(before / last) / log(slope[1] / slope[0]));
}

/* The curve through rows that have been checked; it takes description, also where it fails. */
static vndf_source *curve_through(const reader *r, char *description, vndf_error *error)
{
    double *x = (double *)(void *)r->x.bytes, *value = (double *)(void *)r->value.bytes;
    csv_source *source = calloc(1, sizeof *source);
    size_t n = r->count;
    double *slope = calloc(4 * n, sizeof *slope);
    if (!source || !slope) {
        free(source);
        free(slope);
        free(description);
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for %zu rows", n);
        return NULL;
    }
    int over_slope = r->over == VNDF_ROWS_OVER_SLOPE,
        vanishes = !over_slope && x[n - 1] >= RIGHT_ANGLE && value[n - 1] == 0 && value[n - 2] > 0;
    if (vanishes) {
        x[n - 1] = (x[n - 2] + RIGHT_ANGLE) / 2;
        value[n - 1] = value[n - 2] / 2;
    }
    for (size_t i = 0; i < n; i++)
        slope[i] = over_slope ? x[i] : x[i] >= RIGHT_ANGLE ? INFINITY : tan(x[i]);
    *source = (csv_source){.base = {.p22 = p22,
                                    .destroy = destroy,
                                    .reach = reach,
                                    .description = description,
                                    .operations = OPERATIONS,
                                    .breaks = slope + (slope[0] == 0)},
                           .over = r->over,
                           .of = r->of,
                           .curve = {slope + n, slope + 2 * n, slope + 3 * n, n},
                           .numbers = slope};
    source->base.break_count = n - (slope[0] == 0) - (size_t) !!isinf(slope[n - 1]);
    fit_curve(source, x, value);
    fit_tail(source, slope + n - 2, value + n - 2, vanishes ? 5 : 4);
    return &source->base;
}

/* ---- what is read ---- */

/* Columns, in the order of vndf_rows_over behind degrees, and of vndf_rows_of. */
static const char *const first_names[] = {"theta_deg", "theta", "slope"};
static const char *const second_names[] = {"ndf", "p22"};

static vndf_status refuse(const reader *r, const char *format, ...) VNDF_PRINTF(2, 3);

/* An error with the message of `format`, and the place before it: "gloss.csv: line 7: ...", "row 3: ...". */
static vndf_status refuse(const reader *r, const char *format, ...)
{
    char text[sizeof r->error->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return vndf_fail(r->error, r->refusal, "%s%s%s %zu: %s", r->name ? r->name : "", r->name ? ": " : "", r->unit,
                     r->at, text);
}

/* The source of rows that have been checked, or, where status is an error, none. Its description is
 * "--csv 'my gloss.csv' (crc32 0f3a22bc)". */
static vndf_source *source_of(reader *r, vndf_status status, const char *option, const char *name, uint32_t crc)
{
    char checksum[32];
    snprintf(checksum, sizeof checksum, " (crc32 %08lx)", (unsigned long)crc);
    char *description = status == VNDF_OK ? vndf_text_pair(option, name, checksum, r->error) : NULL;
    vndf_source *source = description ? curve_through(r, description, r->error) : NULL;
    free(r->x.bytes);
    free(r->value.bytes);
    return source;
}

/* ---- rows ------------------------------------------------------------------------------------- */

static const char *first_name(const reader *r)
{
    return first_names[r->degrees ? 0 : 1 + r->over];
}

/* Checks a row and appends it, its angle in radians; 90 degrees is exact, also where an angle in radians is within 1e-9
 * of it. */
static vndf_status take_row(reader *r, double given, double value)
{
    const char *first = first_name(r), *second = second_names[r->of];
    int angle = r->over == VNDF_ROWS_OVER_THETA;
    int grazing = r->degrees ? given == 90 : angle && fabs(given - RIGHT_ANGLE) <= 1e-9;
    double x = grazing ? RIGHT_ANGLE : r->degrees ? given * (RIGHT_ANGLE / 90) : given;
    char number[VNDF_NUMBER_TEXT];
    int bad_first = !isfinite(given) || given < 0;
    if (bad_first || !isfinite(value) || value < 0)
        return refuse(r, "%s is %s; it must be finite and not negative", bad_first ? first : second,
                      vndf_number_print(number, bad_first ? given : value));
    if (grazing && r->of == VNDF_ROWS_OF_P22)
        return refuse(r, "at 90 degrees the slope is infinite and p22 always 0; leave the row out or give ndf");
    if (angle && x > RIGHT_ANGLE)
        return refuse(r, "%s is %s; angles from the normal are at most %s", first,
                      vndf_number_print(number, given), r->degrees ? "90" : "pi/2");
    if (r->count > 0 && !(x > r->last * (1 + APART)))
        return refuse(r, "%s is %s, which is not above that of %s %zu; rows must ascend and not repeat", first,
                      vndf_number_print(number, given), r->unit, r->before);
    if (r->count == VNDF_LIMIT_CSV_ROWS)
        return refuse(r, "more than %d rows", VNDF_LIMIT_CSV_ROWS);
    vndf_write_bytes(&r->x, &x, sizeof x);
    vndf_write_bytes(&r->value, &value, sizeof value);
    r->last = x;
    r->before = r->at;
    r->count++;
    return r->x.failed || r->value.failed
               ? vndf_fail(r->error, VNDF_ERROR_MEMORY, "no memory for %zu rows", r->count)
               : VNDF_OK;
}

/* ---- lines ------------------------------------------------------------------------------------ */

static vndf_span trim(vndf_span s)
{
    static const char blanks[3] = {' ', '\t', '\r'};
    for (; s.size > 0 && memchr(blanks, s.text[0], sizeof blanks); s.size--)
        s.text++;
    while (s.size > 0 && memchr(blanks, s.text[s.size - 1], sizeof blanks))
        s.size--;
    return s;
}

/* The two fields of the next line that is neither blank nor a comment; *found is 0 at the end of the text. */
static vndf_status next_line(reader *r, vndf_span field[2], int *found)
{
    size_t count = 1;
    for (*found = 0; r->rest.size > 0;) {
        vndf_span line = vndf_cut(&r->rest, '\n');
        r->at++;
        if (line.size > VNDF_LIMIT_CSV_LINE)
            return refuse(r, "%zu characters; at most %d are possible", line.size, VNDF_LIMIT_CSV_LINE);
        line = trim(line);
        if (line.size == 0 || line.text[0] == '#')
            continue;
        for (size_t i = 0; i < line.size; i++)
            count += line.text[i] == ',';
        if (count != 2)
            return refuse(r, "%zu field%s; two are needed, separated by a comma: an angle or slope, and a density",
                          count, count == 1 ? "" : "s");
        field[0] = trim(vndf_cut(&line, ','));
        field[1] = trim(line);
        *found = 1;
        break;
    }
    return VNDF_OK;
}

static vndf_status read_header(reader *r)
{
    char excerpt[VNDF_EXCERPT];
    vndf_span field[2];
    int found, first = 0, second = 0;
    vndf_status status = next_line(r, field, &found);
    r->at += status == VNDF_OK && r->at == 0; /* an empty file lacks its header on line 1 */
    if (status == VNDF_OK && !found)
        return refuse(r, "no header line; one like theta_deg,ndf or slope,p22 is needed");
    if (status != VNDF_OK)
        return status;
    while (first < 3 && !vndf_is_word(field[0].text, field[0].size, first_names[first]))
        first++;
    while (second < 2 && !vndf_is_word(field[1].text, field[1].size, second_names[second]))
        second++;
    if (first == 3)
        return refuse(r, "the first column is called '%s'; the header names it theta_deg, theta or slope",
                      vndf_excerpt(excerpt, field[0].text, field[0].size));
    if (second == 2)
        return refuse(r, "the second column is called '%s'; the header names it ndf or p22",
                      vndf_excerpt(excerpt, field[1].text, field[1].size));
    r->degrees = first == 0;
    r->over = first == 2 ? VNDF_ROWS_OVER_SLOPE : VNDF_ROWS_OVER_THETA;
    r->of = second == 0 ? VNDF_ROWS_OF_NDF : VNDF_ROWS_OF_P22;
    return VNDF_OK;
}

static vndf_status read_number(reader *r, vndf_span field, const char *name, double *value)
{
    char excerpt[VNDF_EXCERPT];
    int good = vndf_number_is_all(field.text, field.size, value);
    vndf_excerpt(excerpt, field.text, field.size);
    if (!good)
        return refuse(r, "%s is '%s', which is no number; one like 0.25 or 1e-3 is needed", name, excerpt);
    return isinf(*value) ? refuse(r, "%s is '%s', too large for a double", name, excerpt) : VNDF_OK;
}

static vndf_status read_all(reader *r)
{
    vndf_span field[2];
    double x = 0, value = 0;
    int found = 1;
    vndf_status status = read_header(r);
    while (status == VNDF_OK && (status = next_line(r, field, &found)) == VNDF_OK && found)
        if (read_number(r, field[0], first_name(r), &x) != VNDF_OK ||
            read_number(r, field[1], second_names[r->of], &value) != VNDF_OK || take_row(r, x, value) != VNDF_OK)
            return VNDF_ERROR_SYNTAX;
    if (status == VNDF_OK && r->count < 2)
        return refuse(r, "the text ends with %zu row%s; at least two are needed", r->count,
                      r->count == 1 ? "" : "s");
    return status;
}

vndf_source *vndf_source_csv_text(const char *name, const char *text, size_t size, vndf_error *error)
{
    vndf_error own;
    reader r = {.rest = {text, size, 1},
                .unit = "line",
                .name = name ? name : "unnamed",
                .refusal = VNDF_ERROR_SYNTAX,
                .error = error ? error : &own};
    if (!text) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "the text of the CSV is NULL");
        return NULL;
    }
    if (size >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) /* the mark of UTF-8 by spreadsheets */
        r.rest = (vndf_span){text + 3, size - 3, 1};
    vndf_status status = read_all(&r);
    return source_of(&r, status, "--csv", name, vndf_crc32(0, text, size));
}

vndf_source *vndf_source_csv_file(const char *path, vndf_error *error)
{
    size_t size = 0;
    char *text = (char *)vndf_read_file(path, VNDF_LIMIT_CSV_BYTES, &size, error);
    vndf_source *source = NULL;
    if (text && size > VNDF_LIMIT_CSV_BYTES)
        vndf_fail(error, VNDF_ERROR_SYNTAX, "%s: more than %d bytes; too long for a CSV of %d rows", path,
                  VNDF_LIMIT_CSV_BYTES, VNDF_LIMIT_CSV_ROWS);
    else if (text)
        source = vndf_source_csv_text(path, text, size, error);
    free(text);
    return source;
}

/* ---- numbers ---------------------------------------------------------------------------------- */

static vndf_status check_arguments(vndf_rows_over over, vndf_rows_of of, const double *x, const double *value,
                                   size_t count, vndf_error *error)
{
    if ((over != VNDF_ROWS_OVER_THETA && over != VNDF_ROWS_OVER_SLOPE) ||
        (of != VNDF_ROWS_OF_NDF && of != VNDF_ROWS_OF_P22))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the columns are neither theta or slope nor ndf or p22");
    if (!x || !value)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the array of %s is NULL",
                         x ? second_names[of] : first_names[1 + over]);
    if (count < 2 || count > VNDF_LIMIT_CSV_ROWS)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "%zu rows; from 2 to %d are possible", count,
                         VNDF_LIMIT_CSV_ROWS);
    return VNDF_OK;
}

vndf_source *vndf_source_rows(vndf_rows_over over, vndf_rows_of of, const double *x, const double *value,
                              size_t count, const char *name, vndf_error *error)
{
    vndf_error own;
    reader r = {
        .unit = "row", .refusal = VNDF_ERROR_DISTRIBUTION, .over = over, .of = of, .error = error ? error : &own};
    vndf_status status = check_arguments(over, of, x, value, count, error);
    for (; r.at < count && status == VNDF_OK; r.at++)
        status = take_row(&r, x[r.at], value[r.at]);
    size_t bytes = status == VNDF_OK ? count * sizeof *x : 0; /* as the machine holds them */
    uint32_t crc = vndf_crc32(vndf_crc32(0, x, bytes), value, bytes);
    return source_of(&r, status, "--rows", name, crc);
}
