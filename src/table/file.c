#include "table/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/cursor.h"
#include "core/error.h"
#include "core/frame.h"

static const vndf_frame FRAME = {"VNDFtab\n", "table", 4, VNDF_LIMIT_TABLE_BYTES};

enum { ARRAYS = 11 };

/* The arrays of a draft in the order of the file. */
static void arrays_of(vndf_table_draft *d, float **array[ARRAYS])
{
    float **const all[ARRAYS] = {&d->knot,  &d->g0, &d->g1, &d->m0,   &d->m1,   &d->m2,
                                 &d->cubes, &d->b0, &d->b1, &d->area, &d->slope};
    memcpy(array, all, sizeof all);
}

/* ---- writing ---- */

static void write_floats(vndf_writer *w, const float *values, size_t count, size_t stride)
{
    for (size_t i = 0; i < count; i++)
        vndf_write_f32(w, values[i * stride]);
}

static size_t write_all(const vndf_table_draft *draft, unsigned char *bytes, size_t capacity, size_t size)
{
    vndf_writer w = {bytes, capacity, 0};
    vndf_table_draft d = *draft;
    float **array[ARRAYS];
    arrays_of(&d, array);
    vndf_frame_begin(&FRAME, &w, size);
    vndf_write_f64(&w, d.normalization);
    vndf_write_f64(&w, d.scale);
    vndf_write_u32(&w, d.cells);
    vndf_write_u32(&w, d.moments);
    vndf_write_u32(&w, d.squarings);
    write_floats(&w, &d.certificate.tv, VNDF_CERTIFICATE_FLOATS, 1);
    vndf_write_text(&w, d.source);
    vndf_write_text(&w, d.tool);
    for (int i = 0; i < ARRAYS; i++)
        if (array[i] != &d.cubes || d.moments == 4)
            write_floats(&w, *array[i], (size_t)d.cells + 1, d.stride ? d.stride : 1);
    vndf_frame_end(&w);
    return w.at;
}

size_t vndf_table_encode(const vndf_table_draft *draft, unsigned char *bytes, size_t capacity)
{
    size_t size = write_all(draft, NULL, 0, 0);
    return size > capacity ? size : write_all(draft, bytes, capacity, size);
}

/* ---- reading ---- */

/* What is read before it is known to be a table; owns what it points to. */
typedef struct reading {
    vndf_table_draft draft;
    float *block;
    vndf_distribution *table;
} reading;

static void forget(reading *r)
{
    free(r->block);
    vndf_free(r->table);
}

static int counts_valid(const vndf_table_draft *d)
{
    return d->cells >= 2 && d->cells <= VNDF_CELLS_MAX && d->moments >= 2 && d->moments <= 4 &&
           d->squarings <= VNDF_SQUARINGS_MAX;
}

/* 0 if there is no memory. */
static int allocate(reading *r)
{
    size_t n = (size_t)r->draft.cells + 1, count = VNDF_HEAD + 4 * VNDF_GROUPS * n;
    float **array[ARRAYS];
    arrays_of(&r->draft, array);
    r->block = malloc(ARRAYS * n * sizeof *r->block);
    r->table = calloc(1, sizeof *r->table);
    if (!r->block || !r->table)
        return 0;
    for (int i = 0; i < ARRAYS; i++)
        *array[i] = array[i] != &r->draft.cubes || r->draft.moments == 4 ? r->block + (size_t)i * n : NULL;
    r->table->number_count = count;
    r->table->numbers = malloc(count * sizeof(float));
    r->table->columns = malloc(vndf_table_columns(r->draft.cells) * sizeof(float));
    return r->table->numbers && r->table->columns;
}

/* Everything after the counts; 0 if the bytes end early (the reader fails) or memory is short. */
static int read_body(vndf_reader *bytes, reading *r)
{
    float **array[ARRAYS], *claims = &r->draft.certificate.tv;
    arrays_of(&r->draft, array);
    for (int i = 0; i < VNDF_CERTIFICATE_FLOATS; i++)
        claims[i] = vndf_read_f32(bytes);
    r->table->source = vndf_read_text(bytes);
    r->table->tool = vndf_read_text(bytes);
    if (!r->table->source || !r->table->tool)
        return 0;
    for (int i = 0; i < ARRAYS; i++)
        for (size_t j = 0; *array[i] && j <= r->draft.cells; j++)
            (*array[i])[j] = vndf_read_f32(bytes);
    bytes->failed |= bytes->at + 4 != bytes->size;
    return !bytes->failed;
}

/* VNDF_OK and a table, or an error. */
static vndf_status read_table(vndf_reader *bytes, reading *r, vndf_error *error)
{
    vndf_table_draft *d = &r->draft;
    d->normalization = vndf_read_f64(bytes);
    d->scale = vndf_read_f64(bytes);
    d->cells = vndf_read_u32(bytes);
    d->moments = vndf_read_u32(bytes);
    d->squarings = vndf_read_u32(bytes);
    if (!counts_valid(d))
        return vndf_fail(error, VNDF_ERROR_TABLE, "the table's counts are outside the limits of the format");
    if (!allocate(r) || (!read_body(bytes, r) && !bytes->failed))
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a table of %lu bytes",
                         (unsigned long)bytes->size);
    const char *why = bytes->failed ? "its parts do not fill the file" : vndf_table_fill(r->table, d);
    return why ? vndf_fail(error, VNDF_ERROR_TABLE, "not a consistent table: %s", why) : VNDF_OK;
}

vndf_distribution *vndf_load_memory(const void *bytes, size_t size, vndf_error *error)
{
    if (!bytes) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "no bytes: NULL was given");
        return NULL;
    }
    if (vndf_frame_check(&FRAME, bytes, size, error) != VNDF_OK)
        return NULL;
    vndf_reader reader = {bytes, size, VNDF_FRAME_HEAD, 0};
    reading r = {{0}, NULL, NULL};
    if (read_table(&reader, &r, error) != VNDF_OK) {
        forget(&r);
        return NULL;
    }
    r.table->bytes = size;
    free(r.block);
    return r.table;
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
