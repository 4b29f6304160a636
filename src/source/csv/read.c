/* Reads measured curves: the lines of a CSV, its header, then rows, each checked against the one before; and rows of
 * numbers in memory, by the same rules. */
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "core/error.h"
#include "source/csv/csv.h"
#include "source/words.h"

static const double RIGHT_ANGLE = 1.57079632679489661923;
static const double APART = 1e-12; /* of themselves: the abscissa of the curve could not tell closer rows apart */
static const char GRAZING[] =
    "at 90 degrees the slope is infinite and p22 always 0; leave the row out or give ndf";

static const char *const first_names[] = {"theta_deg", "theta", "slope"};
static const char *const second_names[] = {"ndf", "p22"};

/* An angle of pi/2, 1e-9 around it included. */
static int is_grazing(double theta)
{
    return fabs(theta - RIGHT_ANGLE) <= 1e-9;
}

/* Provenance: "--csv 'my gloss.csv' (crc32 0f3a22bc)". */
static char *describe(const char *option, const char *name, uint32_t crc, vndf_error *error)
{
    char checksum[32];
    vndf_text words = {NULL, 0, 0, 0};
    snprintf(checksum, sizeof checksum, " (crc32 %08lx)", (unsigned long)crc);
    vndf_text_add_word(&words, option);
    vndf_text_add_word(&words, name ? name : "unnamed");
    vndf_text_add(&words, checksum);
    return vndf_text_finish(&words, error);
}

static void free_rows(vndf_csv_rows *rows)
{
    free(rows->x);
    free(rows->value);
}

/* The source of rows that have been checked, or, where status is an error, none. */
static vndf_source *source_of(vndf_csv_rows *rows, vndf_status status, const char *option, const char *name,
                              uint32_t crc, vndf_error *error)
{
    char *description = status == VNDF_OK ? describe(option, name, crc, error) : NULL;
    vndf_source *source = description ? vndf_csv_source(rows, description, error) : NULL;
    free_rows(rows);
    return source;
}

/* ---- lines ------------------------------------------------------------------------------------ */

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

/* Degrees to radians. 90 degrees is exact; in radians an angle within 1e-9 of it counts as 90 degrees. */
static vndf_status convert_angle(reader *r, double *x)
{
    int degrees = r->rows->first == VNDF_CSV_THETA_DEG;
    double limit = degrees ? 90 : RIGHT_ANGLE;
    int grazing = degrees ? *x == 90 : is_grazing(*x);
    if (r->rows->first == VNDF_CSV_SLOPE)
        return VNDF_OK;
    if (grazing && r->rows->second == VNDF_CSV_P22)
        return refuse(r, "%s", GRAZING);
    if (!grazing && *x >= limit)
        return refuse(r, "%s is %.10g; angles from the normal are at most %.10g", first_names[r->rows->first], *x,
                      limit);
    *x = grazing ? RIGHT_ANGLE : degrees ? *x * (RIGHT_ANGLE / 90) : *x;
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
    if (rows->count > 0 && !(x > rows->x[rows->count - 1] * (1 + APART)))
        return refuse(r, "%s is %s, which is not above that of line %zu; rows must ascend and not repeat",
                      first_names[rows->first], vndf_excerpt(excerpt, field[0].text, field[0].size), r->last_row);
    return append(r, x, value);
}

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

vndf_source *vndf_source_csv_text(const char *name, const char *text, size_t size, vndf_error *error)
{
    vndf_csv_rows rows = {VNDF_CSV_SLOPE, VNDF_CSV_P22, NULL, NULL, 0};
    vndf_error inner = {VNDF_OK, ""};
    reader r = {{text, size}, 0, 0, 0, &rows, &inner};
    if (!text) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "the text of the CSV is NULL");
        return NULL;
    }
    if (name && strlen(name) > VNDF_LIMIT_NAME_LENGTH) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "the name of the CSV has %zu characters; at most %d are possible",
                  strlen(name), VNDF_LIMIT_NAME_LENGTH);
        return NULL;
    }
    if (size >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) /* the mark of UTF-8 by spreadsheets */
        r.rest = (span){text + 3, size - 3};
    vndf_status status = read_all(&r);
    if (status != VNDF_OK)
        vndf_fail(error, status, "%s: %s", name ? name : "unnamed", inner.message);
    return source_of(&rows, status, "--csv", name, vndf_crc32(0, text, size), error);
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

/* ---- numbers ---------------------------------------------------------------------------------- */

static vndf_status check_arguments(vndf_rows_over over, vndf_rows_of of, const double *x, const double *value,
                                   size_t count, const char *name, vndf_error *error)
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
    if (name && strlen(name) > VNDF_LIMIT_NAME_LENGTH)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "the name of the rows has %zu characters; at most %d are possible", strlen(name),
                         VNDF_LIMIT_NAME_LENGTH);
    return VNDF_OK;
}

/* rows hold all rows as they were given; an angle of 90 degrees becomes exact. */
static vndf_status check_row(const vndf_csv_rows *rows, size_t i, vndf_error *error)
{
    const char *over = first_names[rows->first], *of = second_names[rows->second];
    double *x = &rows->x[i];
    int grazing = rows->first != VNDF_CSV_SLOPE && is_grazing(*x);
    if (!isfinite(*x) || *x < 0)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "row %zu: %s is %.10g; it must be finite and not negative", i, over, *x);
    if (!isfinite(rows->value[i]) || rows->value[i] < 0)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "row %zu: %s is %.10g; it must be finite and not negative", i, of, rows->value[i]);
    if (grazing && rows->second == VNDF_CSV_P22)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION, "row %zu: %s", i, GRAZING);
    if (!grazing && rows->first != VNDF_CSV_SLOPE && *x > RIGHT_ANGLE)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "row %zu: theta is %.10g; angles from the normal are at most pi/2 radians", i, *x);
    if (i > 0 && !(*x > rows->x[i - 1] * (1 + APART)))
        return vndf_fail(
            error, VNDF_ERROR_DISTRIBUTION,
            "row %zu: %s is %.17g, which is not above that of the row before; rows must ascend and not "
            "repeat",
            i, over, *x);
    if (grazing)
        *x = RIGHT_ANGLE;
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

static vndf_status copy(vndf_csv_rows *rows, const double *x, const double *value, size_t count, vndf_error *error)
{
    rows->x = malloc(count * sizeof *x);
    rows->value = malloc(count * sizeof *value);
    if (!rows->x || !rows->value)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for %zu rows", count);
    memcpy(rows->x, x, count * sizeof *x);
    memcpy(rows->value, value, count * sizeof *value);
    rows->count = count;
    return VNDF_OK;
}

vndf_source *vndf_source_rows(vndf_rows_over over, vndf_rows_of of, const double *x, const double *value,
                              size_t count, const char *name, vndf_error *error)
{
    vndf_csv_rows rows = {over == VNDF_ROWS_OVER_SLOPE ? VNDF_CSV_SLOPE : VNDF_CSV_THETA,
                          of == VNDF_ROWS_OF_P22 ? VNDF_CSV_P22 : VNDF_CSV_NDF, NULL, NULL, 0};
    vndf_status status = check_arguments(over, of, x, value, count, name, error);
    if (status == VNDF_OK)
        status = copy(&rows, x, value, count, error);
    for (size_t i = 0; i < count && status == VNDF_OK; i++)
        status = check_row(&rows, i, error);
    uint32_t crc = status == VNDF_OK ? checksum(checksum(0, x, count), value, count) : 0;
    return source_of(&rows, status, "--rows", name, crc, error);
}
