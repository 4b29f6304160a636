/* Measured curves: D or P22 against angle or slope, as CSV or as rows of numbers, each row checked against the one
 * before; and the curve through them.
 *
 * The first line that is neither blank nor a comment (#) names two columns: theta_deg, theta (radians) or slope (= tan
 * theta), then ndf (D) or p22. Each line after it holds two numbers, the first ascending from 0 or above, the second
 * finite and not negative. 90 degrees is allowed for ndf: D may be anything there.
 *
 * Between the rows: a shape-preserving cubic. It interpolates the logarithm of the second column if all values are
 * positive, so that a curve over many decades keeps its shape in each; if there are zeros, the column itself. The
 * abscissa is asinh(x/s), x the first column: linear for x << s, logarithmic beyond. s = last x * first step/last step
 * makes the first step as wide as the last: even rows are joined almost as they stand (s >= last x), rows that double
 * are joined in log x. s stays within 1e-12 and 1e3 of the last x.
 *
 * Below the first row: the second column keeps its first value.
 *
 * Beyond the last row: P22 falls as r^-k, k fitted to the last two rows, but never slower than r^-4, for which D is
 * constant: finite at 90 degrees. (k is 4 too if the last two rows give none: P22 rises, or the last row but one is at
 * slope 0.) If the last value is 0, P22 is 0 beyond it: end with 0 for a support that ends. A row of 0 at 90 degrees
 * behind one that is not 0 stands for half of that half-way there; from there on k is at least 5, as for D ~ cos.
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

typedef struct csv_source {
    vndf_source base; /* first: a vndf_source* is cast back to this */
    vndf_rows_over over;
    vndf_rows_of of;
    size_t count;   /* of rows */
    double *slope;  /* owned, with the next three: of each row */
    double *x, *y;  /* as given, angles in radians; then asinh(x/scale), and y or its logarithm */
    double *change; /* dy/dx */
    double scale;
    int logarithmic;
    double last_slope;     /* where the tail begins; infinite if the rows reach 90 degrees */
    double last_p22, tail; /* beyond it P22 falls as r^-tail */
} csv_source;

/* What is read into a source, row by row. */
typedef struct reader {
    csv_source *to;
    const char *name;          /* of the text, NULL for numbers in memory */
    const char *unit;          /* "line", or "row" of numbers */
    size_t at, before;         /* number of the current one; of that of the row before */
    const char *first, *value; /* names of the columns */
    int degrees;               /* the first column */
    vndf_error *error;
} reader;

/* ---- P22 -------------------------------------------------------------------------------------- */

/* cos(theta)^4 at the slope r: P22 = D c^4. */
static double cosine4(double r)
{
    double c = 1 / hypot(1, r), c2 = c * c;
    return c2 * c2;
}

/* The cubic. */
static double value_at(const csv_source *s, double x)
{
    size_t last = s->count - 1;
    if (!(x > s->x[0]))
        return s->y[0];
    if (x >= s->x[last])
        return s->y[last];
    size_t i = vndf_last_before(s->x, sizeof *s->x, s->count, x);
    double h = s->x[i + 1] - s->x[i], t = (x - s->x[i]) / h, u = 1 - t, y0 = s->y[i], y1 = s->y[i + 1];
    double bend = t * u * (u * (s->change[i] * h) - t * (s->change[i + 1] * h));
    double y = y0 + (y1 - y0) * t * t * (3 - 2 * t) + bend;
    /* Rounding alone could leave the range, and a density must not be negative. */
    return fmin(fmax(y, fmin(y0, y1)), fmax(y0, y1));
}

static double p22_at(const csv_source *s, double r)
{
    if (r > s->last_slope)
        return s->last_p22 == 0 ? 0 : s->last_p22 * pow(r / s->last_slope, -s->tail);
    double y = value_at(s, asinh((s->over == VNDF_ROWS_OVER_SLOPE ? r : atan(r)) / s->scale));
    return (s->logarithmic ? exp(y) : y) * (s->of == VNDF_ROWS_OF_NDF ? cosine4(r) : 1);
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
    const csv_source *s = (const csv_source *)self;
    return (vndf_reach){p22_at(s, low), p22_at(s, high), 0};
}

static void destroy(vndf_source *self)
{
    free(((csv_source *)self)->slope);
    free(self->description);
    free(self);
}

/* ---- the curve -------------------------------------------------------------------------------- */

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

/* Through rows that have been checked. */
static void fit(csv_source *s)
{
    size_t last = s->count - 1;
    double *x = s->x, *y = s->y, least = 4;
    if (s->over == VNDF_ROWS_OVER_THETA && x[last] >= RIGHT_ANGLE && y[last] == 0 && y[last - 1] > 0) {
        x[last] = (x[last - 1] + RIGHT_ANGLE) / 2;
        y[last] = y[last - 1] / 2;
        least = 5;
    }
    for (size_t i = 0; i <= last; i++)
        s->slope[i] = s->over == VNDF_ROWS_OVER_SLOPE ? x[i] : x[i] >= RIGHT_ANGLE ? INFINITY : tan(x[i]);
    s->base.breaks = s->slope + (s->slope[0] == 0);
    s->base.break_count = s->count - (s->slope[0] == 0) - (size_t) !!isinf(s->slope[last]);

    int is_ndf = s->of == VNDF_ROWS_OF_NDF;
    double r0 = s->slope[last - 1], r1 = s->slope[last], before = y[last - 1] * (is_ndf ? cosine4(r0) : 1);
    s->last_slope = r1;
    s->last_p22 = y[last] * (is_ndf ? cosine4(r1) : 1);
    s->tail = least;
    if (r0 > 0 && before > 0 && s->last_p22 > 0)
        s->tail = fmax(least, log(before / s->last_p22) / log(r1 / r0));

    double first_step = x[1] - x[0], last_step = x[last] - x[last - 1];
    s->scale = fmax(x[last] * fmin(fmax(first_step / last_step, 1e-12), 1e3), DBL_MIN);
    s->logarithmic = 1;
    for (size_t i = 0; i <= last; i++)
        s->logarithmic &= y[i] > 0;
    for (size_t i = 0; i <= last; i++) {
        x[i] = asinh(x[i] / s->scale);
        y[i] = s->logarithmic ? log(y[i]) : y[i];
    }
    double a = 0, p = 0; /* secant and width of the piece before */
    for (size_t i = 0; i < last; i++) {
        double q = x[i + 1] - x[i], b = (y[i + 1] - y[i]) / q;
        s->change[i] = i > 0 ? inner_slope(a, p, b, q) : b;
        if (i == 1)
            s->change[0] = end_slope(a, p, b, q);
        s->change[last] = i > 0 ? end_slope(b, q, a, p) : b;
        a = b;
        p = q;
    }
}

/* ---- rows ------------------------------------------------------------------------------------- */

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
    return vndf_fail(r->error, r->name ? VNDF_ERROR_SYNTAX : VNDF_ERROR_DISTRIBUTION, "%s%s%s %zu: %s",
                     r->name ? r->name : "", r->name ? ": " : "", r->unit, r->at, text);
}

/* Checks a row and appends it, its angle in radians; 90 degrees is exact, also where an angle in radians is within 1e-9
 * of it. */
static vndf_status take_row(reader *r, double given, double value)
{
    csv_source *s = r->to;
    int angle = s->over == VNDF_ROWS_OVER_THETA, bad_first = !isfinite(given) || given < 0;
    int grazing = r->degrees ? given == 90 : angle && fabs(given - RIGHT_ANGLE) <= 1e-9;
    double x = grazing ? RIGHT_ANGLE : r->degrees ? given * (RIGHT_ANGLE / 90) : given;
    char number[VNDF_NUMBER_TEXT];
    if (bad_first || !isfinite(value) || value < 0)
        return refuse(r, "%s is %s; it must be finite and not negative", bad_first ? r->first : r->value,
                      vndf_number_print(number, bad_first ? given : value));
    if (grazing && s->of == VNDF_ROWS_OF_P22)
        return refuse(r, "at 90 degrees the slope is infinite and p22 always 0; leave the row out or give ndf");
    if (angle && x > RIGHT_ANGLE)
        return refuse(r, "%s is %s; angles from the normal are at most %s", r->first,
                      vndf_number_print(number, given), r->degrees ? "90" : "pi/2");
    if (s->count > 0 && !(x > s->x[s->count - 1] * (1 + APART)))
        return refuse(r, "%s is %s, which is not above that of %s %zu; rows must ascend and not repeat", r->first,
                      vndf_number_print(number, given), r->unit, r->before);
    if (s->count == VNDF_LIMIT_CSV_ROWS)
        return refuse(r, "more than %d rows", VNDF_LIMIT_CSV_ROWS);
    s->x[s->count] = x;
    s->y[s->count++] = value;
    r->before = r->at;
    return VNDF_OK;
}

/* A source with room for rows; NULL and an error if there is no memory. */
static csv_source *allocate(size_t rows, vndf_rows_over over, vndf_rows_of of, vndf_error *error)
{
    csv_source *s = calloc(1, sizeof *s);
    double *numbers = calloc(4 * rows, sizeof *numbers);
    if (s && numbers) {
        s->base = (vndf_source){.p22 = p22, .destroy = destroy, .reach = reach, .operations = OPERATIONS};
        s->over = over, s->of = of;
        s->slope = numbers, s->x = numbers + rows, s->y = numbers + 2 * rows, s->change = numbers + 3 * rows;
        return s;
    }
    free(s);
    free(numbers);
    vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for %zu rows", rows);
    return NULL;
}

/* The source that was read, or, where status is an error, none. Its description is
 * "--csv 'my gloss.csv' (crc32 0f3a22bc)". */
static vndf_source *source_of(csv_source *s, vndf_status status, const char *option, const char *name,
                              uint32_t crc, vndf_error *error)
{
    char checksum[32];
    snprintf(checksum, sizeof checksum, " (crc32 %08lx)", (unsigned long)crc);
    s->base.description = status == VNDF_OK ? vndf_text_pair(option, name, checksum, error) : NULL;
    if (s->base.description) {
        fit(s);
        return &s->base;
    }
    destroy(&s->base);
    return NULL;
}

vndf_source *vndf_source_rows(vndf_rows_over over, vndf_rows_of of, const double *x, const double *value,
                              size_t count, const char *name, vndf_error *error)
{
    if ((over != VNDF_ROWS_OVER_THETA && over != VNDF_ROWS_OVER_SLOPE) ||
        (of != VNDF_ROWS_OF_NDF && of != VNDF_ROWS_OF_P22))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the columns are neither theta or slope nor ndf or p22"),
               NULL;
    reader r = {.unit = "row", .first = first_names[1 + over], .value = second_names[of], .error = error};
    if (!x || !value)
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "the array of %s is NULL", x ? r.value : r.first);
    else if (count < 2 || count > VNDF_LIMIT_CSV_ROWS)
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "%zu rows; from 2 to %d are possible", count, VNDF_LIMIT_CSV_ROWS);
    else
        r.to = allocate(count, over, of, error);
    if (!r.to)
        return NULL;
    vndf_status status = VNDF_OK;
    for (; r.at < count && status == VNDF_OK; r.at++)
        status = take_row(&r, x[r.at], value[r.at]);
    size_t bytes = count * sizeof *x; /* as the machine holds them */
    return source_of(r.to, status, "--rows", name, vndf_crc32(vndf_crc32(0, x, bytes), value, bytes), error);
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

static vndf_status read_header(reader *r, const vndf_span field[2])
{
    char excerpt[VNDF_EXCERPT];
    int first = 0, second = 0;
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
    r->first = first_names[first];
    r->value = second_names[second];
    r->degrees = first == 0;
    r->to->over = first == 2 ? VNDF_ROWS_OVER_SLOPE : VNDF_ROWS_OVER_THETA;
    r->to->of = second == 0 ? VNDF_ROWS_OF_NDF : VNDF_ROWS_OF_P22;
    return VNDF_OK;
}

static vndf_status read_numbers(reader *r, const vndf_span field[2])
{
    double number[2];
    for (int i = 0; i < 2; i++) {
        char excerpt[VNDF_EXCERPT];
        const char *name = i ? r->value : r->first, *text = vndf_excerpt(excerpt, field[i].text, field[i].size);
        if (!vndf_number_is_all(field[i].text, field[i].size, &number[i]))
            return refuse(r, "%s is '%s', which is no number; one like 0.25 or 1e-3 is needed", name, text);
        if (isinf(number[i]))
            return refuse(r, "%s is '%s', too large for a double", name, text);
    }
    return take_row(r, number[0], number[1]);
}

/* All lines; those that are neither blank nor a comment have two fields. */
static vndf_status read_lines(reader *r, vndf_span rest)
{
    while (rest.size > 0) {
        vndf_span line = vndf_cut(&rest, '\n');
        r->at++;
        if (line.size > VNDF_LIMIT_CSV_LINE)
            return refuse(r, "%zu characters; at most %d are possible", line.size, VNDF_LIMIT_CSV_LINE);
        line = trim(line);
        if (line.size == 0 || line.text[0] == '#')
            continue;
        size_t fields = 1;
        for (size_t i = 0; i < line.size; i++)
            fields += line.text[i] == ',';
        if (fields != 2)
            return refuse(r, "fields: %zu; two are needed: an angle or slope, a comma, a density", fields);
        vndf_span first = vndf_cut(&line, ',');
        const vndf_span field[2] = {trim(first), trim(line)};
        vndf_status status = r->first ? read_numbers(r, field) : read_header(r, field);
        if (status != VNDF_OK)
            return status;
    }
    r->at += r->at == 0; /* an empty file lacks its header on line 1 */
    if (!r->first)
        return refuse(r, "no header line; one like theta_deg,ndf or slope,p22 is needed");
    if (r->to->count < 2)
        return refuse(r, "rows of numbers: %zu; at least two are needed", r->to->count);
    return VNDF_OK;
}

vndf_source *vndf_source_csv_text(const char *name, const char *text, size_t size, vndf_error *error)
{
    if (!text)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the text of the CSV is NULL"), NULL;
    size_t mark = size >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0; /* of UTF-8 by spreadsheets */
    size_t lines = 1;
    for (size_t i = 0; i < size && lines < VNDF_LIMIT_CSV_ROWS; i++)
        lines += text[i] == '\n';
    reader r = {
        .to = allocate(lines, 0, 0, error), .name = name ? name : "unnamed", .unit = "line", .error = error};
    if (!r.to)
        return NULL;
    vndf_status status = read_lines(&r, (vndf_span){text + mark, size - mark, 1});
    return source_of(r.to, status, "--csv", name, vndf_crc32(0, text, size), error);
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
