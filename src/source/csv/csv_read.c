/* The reader of CSV: lines, then the header, then rows, each checked against the one before. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "source/csv/csv.h"
#include "source/number.h"
#include "source/words.h"

static const double right_angle = 1.57079632679489661923;

static const char *const first_names[] = {"theta_deg", "theta", "slope"};
static const char *const second_names[] = {"ndf", "p22"};

typedef struct span {
    const char *text;
    size_t size;
} span;

typedef struct reader {
    span rest;       /* the text that has not been read */
    size_t line;     /* number of the current line, from 1 */
    size_t last_row; /* line of the row before */
    size_t capacity; /* in rows */
    vndf_csv_rows *rows;
    vndf_error *error;
} reader;

static vndf_status refuse(const reader *r, const char *format, ...) VNDF_PRINTF(2, 3);

/* An error with the message of `format`, and the current line before it. */
static vndf_status refuse(const reader *r, const char *format, ...)
{
    char text[sizeof r->error->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return vndf_fail(r->error, VNDF_ERROR_SYNTAX, "line %zu: %s", r->line, text);
}

static span trim(span s)
{
    while (s.size > 0 && (*s.text == ' ' || *s.text == '\t')) {
        s.text++;
        s.size--;
    }
    while (s.size > 0 && strchr(" \t\r", s.text[s.size - 1]))
        s.size--;
    return s;
}

static int equals(span s, const char *word)
{
    return s.size == strlen(word) && memcmp(s.text, word, s.size) == 0;
}

/* Cuts the text before the first separator off s (all of it if there is none). */
static span cut(span *s, char separator)
{
    const char *end = s->size > 0 ? memchr(s->text, separator, s->size) : NULL;
    span head = {s->text, end ? (size_t)(end - s->text) : s->size};
    size_t used = head.size + (end != NULL);
    s->text += used;
    s->size -= used;
    return head;
}

/* The next line that is neither blank nor a comment, trimmed; size 0 at the end of the text. */
static vndf_status next_line(reader *r, span *line)
{
    while (r->rest.size > 0) {
        *line = cut(&r->rest, '\n');
        r->line++;
        if (line->size > VNDF_LIMIT_CSV_LINE)
            return refuse(r, "%zu characters; at most %d are possible", line->size, VNDF_LIMIT_CSV_LINE);
        if (line->size > 0 && memchr(line->text, '\0', line->size))
            return refuse(r, "a byte of value 0; a CSV is plain text");
        *line = trim(*line);
        if (line->size > 0 && line->text[0] != '#')
            return VNDF_OK;
    }
    *line = (span){NULL, 0};
    return VNDF_OK;
}

/* Splits a line into its two fields. */
static vndf_status split(reader *r, span line, span field[2])
{
    size_t count = 1;
    for (size_t i = 0; i < line.size; i++)
        count += line.text[i] == ',';
    if (count != 2)
        return refuse(r, "%zu field%s; two are needed, separated by a comma: an angle or slope, and a density",
                      count, count == 1 ? "" : "s");
    field[0] = trim(cut(&line, ','));
    field[1] = trim(line);
    return VNDF_OK;
}

/* ---- header ----------------------------------------------------------------------------------- */

static vndf_status read_header(reader *r)
{
    char excerpt[VNDF_EXCERPT];
    span line, field[2] = {{NULL, 0}, {NULL, 0}};
    size_t first = 0, second = 0;
    vndf_status status = next_line(r, &line);
    r->line += status == VNDF_OK && r->line == 0; /* an empty file lacks its header on line 1 */
    if (status == VNDF_OK && line.size == 0)
        return refuse(r, "no header line; one like theta_deg,ndf or slope,p22 is needed");
    if (status == VNDF_OK)
        status = split(r, line, field);
    if (status != VNDF_OK)
        return status;
    while (first < 3 && !equals(field[0], first_names[first]))
        first++;
    while (second < 2 && !equals(field[1], second_names[second]))
        second++;
    if (first == 3)
        return refuse(r, "the first column is called '%s'; the header names it theta_deg, theta or slope",
                      vndf_excerpt(excerpt, field[0].text, field[0].size));
    if (second == 2)
        return refuse(r, "the second column is called '%s'; the header names it ndf or p22",
                      vndf_excerpt(excerpt, field[1].text, field[1].size));
    r->rows->first = (vndf_csv_first)first;
    r->rows->second = (vndf_csv_second)second;
    return VNDF_OK;
}

/* ---- rows ------------------------------------------------------------------------------------- */

static vndf_status read_number(reader *r, span field, const char *name, double *value)
{
    char excerpt[VNDF_EXCERPT];
    size_t used = vndf_number_read(field.text, field.size, value);
    vndf_excerpt(excerpt, field.text, field.size);
    if (field.size == 0)
        return refuse(r, "%s is missing", name);
    if (used == 0)
        return refuse(r, "%s is '%s', which is no number; one like 0.25 or 1e-3 is needed", name, excerpt);
    if (used < field.size)
        return refuse(r, "%s is '%s', a number with something behind it", name, excerpt);
    if (isinf(*value))
        return refuse(r, "%s is '%s', too large for a double", name, excerpt);
    if (*value < 0)
        return refuse(r, "%s is %s; it must not be negative", name, excerpt);
    return VNDF_OK;
}

int vndf_csv_is_grazing(double theta)
{
    return fabs(theta - right_angle) <= 1e-9;
}

/* Degrees to radians. 90 degrees is exact; in radians an angle within 1e-9 of it counts as 90 degrees. */
static vndf_status convert_angle(reader *r, double *x)
{
    int degrees = r->rows->first == VNDF_CSV_THETA_DEG;
    double limit = degrees ? 90 : right_angle;
    int grazing = degrees ? *x == 90 : vndf_csv_is_grazing(*x);
    if (r->rows->first == VNDF_CSV_SLOPE)
        return VNDF_OK;
    if (grazing && r->rows->second == VNDF_CSV_P22)
        return refuse(r, VNDF_CSV_GRAZING);
    if (!grazing && *x >= limit)
        return refuse(r, "%s is %.10g; angles from the normal are at most %.10g", first_names[r->rows->first], *x,
                      limit);
    *x = grazing ? right_angle : degrees ? *x * (right_angle / 90) : *x;
    return VNDF_OK;
}

static vndf_status append(reader *r, double x, double value)
{
    vndf_csv_rows *rows = r->rows;
    if (rows->count == VNDF_LIMIT_CSV_ROWS)
        return refuse(r, "more than %d rows", VNDF_LIMIT_CSV_ROWS);
    if (rows->count == r->capacity) {
        size_t capacity = 2 * r->capacity + 64;
        double *more_x = realloc(rows->x, capacity * sizeof *more_x);
        rows->x = more_x ? more_x : rows->x;
        double *more_values = realloc(rows->value, capacity * sizeof *more_values);
        rows->value = more_values ? more_values : rows->value;
        if (!more_x || !more_values)
            return vndf_fail(r->error, VNDF_ERROR_MEMORY, "no memory for %zu rows", capacity);
        r->capacity = capacity;
    }
    rows->x[rows->count] = x;
    rows->value[rows->count++] = value;
    r->last_row = r->line;
    return VNDF_OK;
}

static vndf_status read_row(reader *r, span line)
{
    span field[2] = {{NULL, 0}, {NULL, 0}};
    double x = 0, value = 0;
    vndf_csv_rows *rows = r->rows;
    char excerpt[VNDF_EXCERPT];
    vndf_status status = split(r, line, field);
    if (status == VNDF_OK)
        status = read_number(r, field[0], first_names[rows->first], &x);
    if (status == VNDF_OK)
        status = read_number(r, field[1], second_names[rows->second], &value);
    if (status == VNDF_OK)
        status = convert_angle(r, &x);
    if (status != VNDF_OK)
        return status;
    if (rows->count > 0 && !(x > rows->x[rows->count - 1] * (1 + VNDF_CSV_APART)))
        return refuse(r, "%s is %s, which is not above that of line %zu; rows must ascend and not repeat",
                      first_names[rows->first], vndf_excerpt(excerpt, field[0].text, field[0].size), r->last_row);
    return append(r, x, value);
}

/* ---- the whole -------------------------------------------------------------------------------- */

static vndf_status read_all(reader *r)
{
    span line;
    vndf_status status = read_header(r);
    while (status == VNDF_OK) {
        status = next_line(r, &line);
        if (status == VNDF_OK && line.size == 0)
            break;
        if (status == VNDF_OK)
            status = read_row(r, line);
    }
    if (status == VNDF_OK && r->rows->count < 2)
        return refuse(r, "the text ends with %zu row%s; at least two are needed", r->rows->count,
                      r->rows->count == 1 ? "" : "s");
    return status;
}

vndf_status vndf_csv_read(const char *text, size_t size, vndf_csv_rows *rows, vndf_error *error)
{
    reader r = {{text, size}, 0, 0, 0, rows, error};
    *rows = (vndf_csv_rows){VNDF_CSV_SLOPE, VNDF_CSV_P22, NULL, NULL, 0};
    if (size >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) { /* the mark of UTF-8 by spreadsheets */
        r.rest.text += 3;
        r.rest.size -= 3;
    }
    vndf_status status = read_all(&r);
    if (status != VNDF_OK)
        vndf_csv_rows_free(rows);
    return status;
}

void vndf_csv_rows_free(vndf_csv_rows *rows)
{
    free(rows->x);
    free(rows->value);
    rows->x = rows->value = NULL;
    rows->count = 0;
}
