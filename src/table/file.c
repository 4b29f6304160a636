#include "table/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/cursor.h"
#include "core/error.h"

static const vndf_frame FRAME = {"VNDFtab\n", "table", 4, VNDF_LIMIT_TABLE_BYTES};

/* Whether the file holds this array. */
static int has_array(unsigned moments, int i)
{
    return i != VNDF_ARRAY_OF_CUBES || moments == 4;
}

/* ---- writing ---- */

void vndf_table_write(const vndf_table_draft *d, vndf_writer *w)
{
    const float *claims = &d->certificate.tv;
    vndf_frame_begin(&FRAME, w);
    vndf_write_f64(w, d->normalization);
    vndf_write_f64(w, d->scale);
    vndf_write_u32(w, d->cells);
    vndf_write_u32(w, d->moments);
    vndf_write_u32(w, d->squarings);
    for (int i = 0; i < VNDF_CERTIFICATE_FLOATS; i++)
        vndf_write_f32(w, claims[i]);
    vndf_write_text(w, d->source);
    vndf_write_text(w, d->tool);
    for (int i = 0; i < VNDF_ARRAYS; i++)
        for (size_t j = 0; has_array(d->moments, i) && j <= d->cells; j++)
            vndf_write_f32(w, d->array[i][j * (d->stride ? d->stride : 1)]);
    vndf_frame_end(w);
}

size_t vndf_table_size(size_t knots, unsigned moments, const char *source, const char *tool)
{
    size_t numbers = (size_t)(VNDF_ARRAYS - 1 + has_array(moments, VNDF_ARRAY_OF_CUBES)) * knots;
    size_t counts = 3 + VNDF_CERTIFICATE_FLOATS + 2; /* of 4 bytes, with the lengths of both texts */
    return VNDF_FRAME_HEAD + 2 * sizeof(double) + 4 * (counts + numbers + 1) + strlen(source) + strlen(tool);
}

/* ---- reading ---- */

/* VNDF_OK and a table, or an error: also where the bytes end early (the reader fails). */
static vndf_status read_table(vndf_reader *bytes, vndf_distribution *table, vndf_table_draft *d, vndf_error *error)
{
    const char *why = NULL;
    float *claims = &d->certificate.tv;
    d->normalization = vndf_read_f64(bytes);
    d->scale = vndf_read_f64(bytes);
    d->cells = vndf_read_u32(bytes);
    d->moments = vndf_read_u32(bytes);
    d->squarings = vndf_read_u32(bytes);
    if (d->cells < 2 || d->cells > VNDF_CELLS_MAX || d->moments < 2 || d->moments > 4 ||
        d->squarings > VNDF_SQUARINGS_MAX)
        return vndf_fail(error, VNDF_ERROR_TABLE, "the table's counts are outside the limits of the format");
    for (int i = 0; i < VNDF_CERTIFICATE_FLOATS; i++)
        claims[i] = vndf_read_f32(bytes);
    table->source = vndf_read_text(bytes);
    table->tool = vndf_read_text(bytes);
    int good = table->source && table->tool && vndf_table_draft_allocate(d);
    for (int i = 0; good && i < VNDF_ARRAYS; i++)
        for (size_t j = 0; has_array(d->moments, i) && j <= d->cells; j++)
            d->array[i][j] = vndf_read_f32(bytes);
    if (d->moments < 4)
        d->cubes = NULL;
    bytes->failed |= good && bytes->at + 4 != bytes->size;
    good = good && !bytes->failed && vndf_table_fill(table, d, &why);
    if (good && !why)
        return VNDF_OK;
    if (!why && !bytes->failed)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a table of %lu bytes",
                         (unsigned long)bytes->size);
    return vndf_fail(error, VNDF_ERROR_TABLE, "not a consistent table: %s",
                     why ? why : "its parts do not fill the file");
}

vndf_distribution *vndf_load_memory(const void *bytes, size_t size, vndf_error *error)
{
    if (vndf_frame_check(&FRAME, bytes, size, error) != VNDF_OK)
        return NULL;
    vndf_reader reader = {bytes, size, VNDF_FRAME_HEAD, 0};
    vndf_table_draft draft = {0};
    vndf_distribution *table = calloc(1, sizeof *table);
    int good = table && read_table(&reader, table, &draft, error) == VNDF_OK;
    free(draft.knot);
    if (good) {
        table->bytes = size;
        return table;
    }
    if (!table)
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
    free((char *)distribution->source);
    free((char *)distribution->tool);
    free(distribution);
}
