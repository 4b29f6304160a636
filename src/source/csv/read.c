/* Reads measured curves: the lines of a CSV, its header, then rows, each checked against the one before; and rows of
 * numbers in memory, by the same rules. */
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "core/error.h"
#include "core/read_file.h"
#include "source/csv/csv.h"
#include "source/words.h"

static const double APART = 1e-12; /* of themselves: the abscissa of the curve could not tell closer rows apart */

/* Columns, in the order of vndf_rows_over behind degrees, and of vndf_rows_of. */
static const char *const first_names[] = {"theta_deg", "theta", "slope"};
static const char *const second_names[] = {"ndf", "p22"};

typedef struct span {
    const char *text;
    size_t size;
} span;

typedef struct reader {
    span rest;         /* the text that has not been read */
    const char *unit;  /* "line", or "row" of numbers in memory */
    size_t at, before; /* number of the current one; of that of the row before */
    const char *name;  /* of the text, NULL for numbers in memory */
    vndf_status refusal;
    size_t capacity; /* in rows */
    vndf_csv_rows rows;
    int degrees; /* the first column */
    vndf_error *error;
} reader;

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
    vndf_source *source = description ? vndf_csv_source(&r->rows, description, r->error) : NULL;
    free(r->rows.x);
    free(r->rows.value);
    return source;
}

/* ---- rows ------------------------------------------------------------------------------------- */

static const char *first_name(const reader *r)
{
    return first_names[r->degrees ? 0 : 1 + r->rows.over];
}

static vndf_status append(reader *r, double x, double value)
{
    vndf_csv_rows *rows = &r->rows;
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
    r->before = r->at;
    return VNDF_OK;
}

/* Checks a row and appends it, its angle in radians; 90 degrees is exact, also where an angle in radians is within 1e-9
 * of it. */
static vndf_status take_row(reader *r, double given, double value)
{
    const vndf_csv_rows *rows = &r->rows;
    const char *first = first_name(r);
    int degrees = r->degrees, angle = rows->over == VNDF_ROWS_OVER_THETA;
    int grazing = degrees ? given == 90 : angle && fabs(given - VNDF_RIGHT_ANGLE) <= 1e-9;
    double x = grazing ? VNDF_RIGHT_ANGLE : degrees ? given * (VNDF_RIGHT_ANGLE / 90) : given;
    char number[VNDF_NUMBER_TEXT];
    if (!isfinite(given) || given < 0)
        return refuse(r, "%s is %s; it must be finite and not negative", first, vndf_number_print(number, given));
    if (!isfinite(value) || value < 0)
        return refuse(r, "%s is %s; it must be finite and not negative", second_names[rows->of],
                      vndf_number_print(number, value));
    if (grazing && rows->of == VNDF_ROWS_OF_P22)
        return refuse(r, "at 90 degrees the slope is infinite and p22 always 0; leave the row out or give ndf");
    if (angle && x > VNDF_RIGHT_ANGLE)
        return refuse(r, "%s is %s; angles from the normal are at most %s", first,
                      vndf_number_print(number, given), degrees ? "90" : "pi/2");
    if (rows->count > 0 && !(x > rows->x[rows->count - 1] * (1 + APART)))
        return refuse(r, "%s is %s, which is not above that of %s %zu; rows must ascend and not repeat", first,
                      vndf_number_print(number, given), r->unit, r->before);
    return append(r, x, value);
}

/* ---- lines ------------------------------------------------------------------------------------ */

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

/* The two fields of the next line that is neither blank nor a comment; *found is 0 at the end of the text. */
static vndf_status next_line(reader *r, span field[2], int *found)
{
    size_t count = 1;
    for (*found = 0; r->rest.size > 0;) {
        span line = cut(&r->rest, '\n');
        r->at++;
        if (line.size > VNDF_LIMIT_CSV_LINE)
            return refuse(r, "%zu characters; at most %d are possible", line.size, VNDF_LIMIT_CSV_LINE);
        if (line.size > 0 && memchr(line.text, '\0', line.size))
            return refuse(r, "a byte of value 0; a CSV is plain text");
        line = trim(line);
        if (line.size == 0 || line.text[0] == '#')
            continue;
        for (size_t i = 0; i < line.size; i++)
            count += line.text[i] == ',';
        if (count != 2)
            return refuse(r, "%zu field%s; two are needed, separated by a comma: an angle or slope, and a density",
                          count, count == 1 ? "" : "s");
        field[0] = trim(cut(&line, ','));
        field[1] = trim(line);
        *found = 1;
        break;
    }
    return VNDF_OK;
}

static vndf_status read_header(reader *r)
{
    char excerpt[VNDF_EXCERPT];
    span field[2];
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
    r->rows.over = first == 2 ? VNDF_ROWS_OVER_SLOPE : VNDF_ROWS_OVER_THETA;
    r->rows.of = second == 0 ? VNDF_ROWS_OF_NDF : VNDF_ROWS_OF_P22;
    return VNDF_OK;
}

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
    return isinf(*value) ? refuse(r, "%s is '%s', too large for a double", name, excerpt) : VNDF_OK;
}

static vndf_status read_all(reader *r)
{
    span field[2];
    double x = 0, value = 0;
    int found = 1;
    vndf_status status = read_header(r);
    while (status == VNDF_OK && (status = next_line(r, field, &found)) == VNDF_OK && found)
        if (read_number(r, field[0], first_name(r), &x) != VNDF_OK ||
            read_number(r, field[1], second_names[r->rows.of], &value) != VNDF_OK ||
            take_row(r, x, value) != VNDF_OK)
            return VNDF_ERROR_SYNTAX;
    if (status == VNDF_OK && r->rows.count < 2)
        return refuse(r, "the text ends with %zu row%s; at least two are needed", r->rows.count,
                      r->rows.count == 1 ? "" : "s");
    return status;
}

vndf_source *vndf_source_csv_text(const char *name, const char *text, size_t size, vndf_error *error)
{
    vndf_error own;
    reader r = {.rest = {text, size},
                .unit = "line",
                .name = name ? name : "unnamed",
                .refusal = VNDF_ERROR_SYNTAX,
                .error = error ? error : &own};
    if (!text) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "the text of the CSV is NULL");
        return NULL;
    }
    if (size >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) /* the mark of UTF-8 by spreadsheets */
        r.rest = (span){text + 3, size - 3};
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
                         x                              ? second_names[of]
                         : over == VNDF_ROWS_OVER_SLOPE ? "slope"
                                                        : "theta");
    if (count < 2 || count > VNDF_LIMIT_CSV_ROWS)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "%zu rows; from 2 to %d are possible", count,
                         VNDF_LIMIT_CSV_ROWS);
    return VNDF_OK;
}

/* Of the bytes as a little-endian machine holds them. */
static uint32_t checksum(uint32_t crc, const double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        unsigned char bytes[8];
        memcpy(&bits, &numbers[i], sizeof bits);
        for (int b = 0; b < 8; b++)
            bytes[b] = (unsigned char)(bits >> 8 * b & 255);
        crc = vndf_crc32(crc, bytes, sizeof bytes);
    }
    return crc;
}

vndf_source *vndf_source_rows(vndf_rows_over over, vndf_rows_of of, const double *x, const double *value,
                              size_t count, const char *name, vndf_error *error)
{
    vndf_error own;
    reader r = {.unit = "row", .refusal = VNDF_ERROR_DISTRIBUTION, .error = error ? error : &own};
    vndf_status status = check_arguments(over, of, x, value, count, error);
    r.rows.over = over;
    r.rows.of = of;
    for (; r.at < count && status == VNDF_OK; r.at++)
        status = take_row(&r, x[r.at], value[r.at]);
    uint32_t crc = status == VNDF_OK ? checksum(checksum(0, x, count), value, count) : 0;
    return source_of(&r, status, "--rows", name, crc);
}
