/* The table on disk, version 5. All little-endian; strings without terminator; floats are IEEE single.
 *
 *     8 bytes  "VNDFtab\n"        u32 version      u32 size of the whole file
 *     f64 normalization           f64 scale
 *     u32 cells N, moments, squarings
 *     14 f32 certificate (order of vndf_certificate)
 *     u32 n, n bytes each: source, tool, notes (lines `key value`)
 *     f32[N + 1] each: knot, g0, g1, m0, m1, m2, m4 (only if moments is 4), b0, b1, area, slope
 *     u32 CRC-32 of all bytes before it
 *
 * A reader checks the size, the checksum, every count against its limit, and every array against what the sampler
 * relies on: ascending knots, positive masses that add up to 1, finite densities. */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "table/table.h"

static const vndf_frame FRAME = {"VNDFtab\n", "table", 5, VNDF_LIMIT_TABLE_BYTES};

/* Which numbers of a knot the arrays of the file hold. */
#define AT(number) offsetof(vndf_knot_numbers, number) / sizeof(float)
enum { ARRAYS = 11, ARRAY_OF_CUBES = 6 };
static const size_t PLACES[ARRAYS] = {AT(r),    AT(left), AT(right), AT(m0),   AT(m1),   AT(m2),
                                      AT(cube), AT(b0),   AT(b1),    AT(area), AT(slope)};

/* The number after this one in the file, the first after NULL; NULL after the last. */
static float *next_number(const vndf_distribution *table, int *array, size_t *knot)
{
    if (*knot > (size_t)table->cells) {
        *knot = 0;
        *array += *array + 1 == ARRAY_OF_CUBES && table->moments < 4 ? 2 : 1;
    }
    return *array < ARRAYS ? &vndf_knot_at(table, (*knot)++)->r + PLACES[*array] : NULL;
}

/* ---- writing ---- */

void vndf_table_write(const vndf_distribution *table, vndf_writer *w)
{
    const float *claims = &table->certificate.tv, *number;
    int array = 0;
    size_t knot = 0;
    vndf_frame_begin(&FRAME, w);
    vndf_write_f64(w, table->normalization);
    vndf_write_f64(w, table->scale);
    vndf_write_u32(w, (uint32_t)table->cells);
    vndf_write_u32(w, (uint32_t)table->moments);
    vndf_write_u32(w, (uint32_t)table->squarings);
    for (int i = 0; i < VNDF_CERTIFICATE_FLOATS; i++)
        vndf_write_f32(w, claims[i]);
    vndf_write_text(w, table->source);
    vndf_write_text(w, table->tool);
    vndf_write_text(w, table->notes);
    while ((number = next_number(table, &array, &knot)) != NULL)
        vndf_write_f32(w, *number);
    vndf_frame_end(w);
}

size_t vndf_table_size(size_t knots, unsigned moments, const char *source, const char *tool, const char *notes)
{
    size_t numbers = (ARRAYS - (size_t)(moments < 4)) * knots;
    size_t counts = 3 + VNDF_CERTIFICATE_FLOATS + 3; /* of 4 bytes, with the lengths of texts */
    size_t letters = strlen(source) + strlen(tool) + (notes ? strlen(notes) : 0);
    return VNDF_FRAME_HEAD + 2 * sizeof(double) + 4 * (counts + numbers + 1) + letters;
}

/* ---- reading ---- */

const char *vndf_notes_invalid(const char *notes)
{
    if (strlen(notes) > VNDF_LIMIT_NOTES)
        return "its notes are longer than the limit";
    while (*notes) {
        size_t key = strspn(notes, "abcdefghijklmnopqrstuvwxyz0123456789_"), end = key;
        while (notes[end] >= ' ' && notes[end] < 127)
            end++;
        if (key < 1 || notes[key] != ' ' || end < key + 2 || notes[key + 1] == ' ' || notes[end] != '\n')
            return "a line of its notes is no `key value`";
        notes += end + 1;
    }
    return NULL;
}

vndf_distribution *vndf_load_memory(const void *bytes, size_t size, vndf_error *error)
{
    if (vndf_frame_check(&FRAME, bytes, size, error) != VNDF_OK)
        return NULL;
    vndf_reader r = {bytes, size, VNDF_FRAME_HEAD, 0};
    double normalization = vndf_read_f64(&r), scale = vndf_read_f64(&r);
    uint32_t cells = vndf_read_u32(&r), moments = vndf_read_u32(&r), squarings = vndf_read_u32(&r);
    if (cells < 2 || cells > VNDF_CELLS_MAX || moments < 2 || moments > 4 || squarings > VNDF_SQUARINGS_MAX)
        return vndf_fail(error, VNDF_ERROR_TABLE, "the table's counts are outside the limits of the format"), NULL;
    vndf_distribution *table = vndf_table_allocate(cells, moments, squarings);
    const char *why = NULL;
    if (table) {
        float *claims = &table->certificate.tv, *number;
        int array = 0;
        size_t knot = 0;
        table->normalization = normalization;
        table->scale = scale;
        table->bytes = size;
        for (int i = 0; i < VNDF_CERTIFICATE_FLOATS; i++)
            claims[i] = vndf_read_f32(&r);
        table->source = vndf_read_text(&r, 0);
        table->tool = vndf_read_text(&r, 0);
        table->notes = vndf_read_text(&r, 1);
        while ((number = next_number(table, &array, &knot)) != NULL)
            *number = vndf_read_f32(&r);
        why = r.failed || r.at + 4 != size ? "its parts do not fill the file" : vndf_table_fill(table);
        if (!why && table->notes)
            why = vndf_notes_invalid(table->notes);
    }
    if (table && table->source && table->tool && table->notes && !why)
        return table;
    if (why)
        vndf_fail(error, VNDF_ERROR_TABLE, "not a consistent table: %s", why);
    else
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a table of %lu bytes", (unsigned long)size);
    vndf_free(table);
    return NULL;
}

static void *decode(const void *bytes, size_t size, vndf_error *error)
{
    return vndf_load_memory(bytes, size, error);
}

vndf_distribution *vndf_load(const char *path, vndf_error *error)
{
    return vndf_frame_load(&FRAME, path, decode, error);
}

void vndf_free(vndf_distribution *distribution)
{
    if (!distribution || !vndf_is_table(distribution))
        return;
    free(distribution->numbers);
    free(distribution->columns);
    free(distribution->room);
    free((char *)distribution->source);
    free((char *)distribution->tool);
    free((char *)distribution->notes);
    free(distribution);
}
