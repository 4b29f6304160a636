/* Distributions given by numbers in memory: the rules of a CSV, checked row by row, and its curve. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "core/error.h"
#include "source/csv/csv.h"
#include "source/words.h"

static const double right_angle = 1.57079632679489661923;

static const char *const over_names[] = {"theta", "slope"};
static const char *const of_names[] = {"ndf", "p22"};

static vndf_status check_arguments(vndf_rows_over over, vndf_rows_of of, const double *x, const double *value,
                                   size_t count, const char *name, vndf_error *error)
{
    if ((over != VNDF_ROWS_OVER_THETA && over != VNDF_ROWS_OVER_SLOPE) ||
        (of != VNDF_ROWS_OF_NDF && of != VNDF_ROWS_OF_P22))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the columns are neither theta or slope nor ndf or p22");
    if (!x || !value)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the array of %s is NULL",
                         x ? of_names[of] : over_names[over]);
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
    const char *over = rows->first == VNDF_CSV_SLOPE ? over_names[1] : over_names[0], *of = of_names[rows->second];
    double *x = &rows->x[i];
    int grazing = rows->first != VNDF_CSV_SLOPE && vndf_csv_is_grazing(*x);
    if (!isfinite(*x) || *x < 0)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "row %zu: %s is %.10g; it must be finite and not negative", i, over, *x);
    if (!isfinite(rows->value[i]) || rows->value[i] < 0)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "row %zu: %s is %.10g; it must be finite and not negative", i, of, rows->value[i]);
    if (grazing && rows->second == VNDF_CSV_P22)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION, "row %zu: " VNDF_CSV_GRAZING, i);
    if (!grazing && rows->first != VNDF_CSV_SLOPE && *x > right_angle)
        return vndf_fail(error, VNDF_ERROR_DISTRIBUTION,
                         "row %zu: theta is %.10g; angles from the normal are at most pi/2 radians", i, *x);
    if (i > 0 && !(*x > rows->x[i - 1] * (1 + VNDF_CSV_APART)))
        return vndf_fail(
            error, VNDF_ERROR_DISTRIBUTION,
            "row %zu: %s is %.17g, which is not above that of the row before; rows must ascend and not "
            "repeat",
            i, over, *x);
    if (grazing)
        *x = right_angle;
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

static char *describe(const char *name, const double *x, const double *value, size_t count, vndf_error *error)
{
    char end[32];
    vndf_text words = {NULL, 0, 0, 0};
    unsigned long crc = checksum(checksum(0, x, count), value, count);
    snprintf(end, sizeof end, " (crc32 %08lx)", crc);
    vndf_text_add_word(&words, "--rows");
    vndf_text_add_word(&words, name ? name : "unnamed");
    vndf_text_add(&words, end);
    return vndf_text_finish(&words, error);
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
    char *description = status == VNDF_OK ? describe(name, x, value, count, error) : NULL;
    vndf_source *source = description ? vndf_csv_source(&rows, description, error) : NULL;
    vndf_csv_rows_free(&rows);
    return source;
}
