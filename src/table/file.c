#include "table/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/cursor.h"
#include "core/error.h"
#include "core/frame.h"
#include "table/layout.h"
#include "table/validate.h"

static const vndf_frame FRAME = {"VNDFtab\n", "table", 3, VNDF_LIMIT_TABLE_BYTES};

/* ---- writing ---- */

static void write_array(vndf_writer *w, const float *values, size_t count, size_t stride)
{
    for (size_t i = 0; i < count; i++)
        vndf_write_f32(w, values[i * stride]);
}

static void write_radial(vndf_writer *w, const vndf_distribution *table)
{
    size_t n = table->radial_count, cell = sizeof *table->cells / sizeof(float);
    write_array(w, &table->knots.at->x, n + 1, 2);
    write_array(w, &table->knots.at->z, n + 1, 2);
    write_array(w, &table->cells->f0, n, cell);
    write_array(w, &table->cells->f1, n, cell);
    write_array(w, &table->cells->mu0, n, cell);
    write_array(w, &table->cells->mu1, n, cell);
}

static void write_wedge(vndf_writer *w, const vndf_wedge *wedge)
{
    size_t cells = wedge->cell_count, rows = wedge->row_count, knots = wedge->knot_count;
    write_array(w, wedge->q, cells + 1, 1);
    write_array(w, wedge->row_y, vndf_row_knots(wedge->row_count), 1);
    for (size_t i = 0; i < rows; i++)
        vndf_write_f32(w, *vndf_aspect_p(wedge, i));
    for (size_t i = 0; i < rows; i++)
        vndf_write_f32(w, *vndf_aspect_r(wedge, i));
    for (size_t i = 0; i < rows; i++)
        write_array(w, &vndf_row_cells(wedge, i)->mass, cells, 2);
    for (size_t i = 0; i < rows; i++)
        write_array(w, &vndf_row_cells(wedge, i)->density, cells + 1, 2);
    write_array(w, wedge->knot_y, knots, 1);
    write_array(w, wedge->mass, knots, 1);
    write_array(w, wedge->slope, knots, 1);
    write_array(w, wedge->curve, knots, 1);
}

/* The order of the numbers in the file and in memory. */
static void write_certificate(vndf_writer *w, vndf_certificate c)
{
    if (c.quick > 0)
        c.weight_bounded = c.weight_bounded > 0 ? 2.0f : -0.0f;
    write_array(w, &c.tv, VNDF_CERTIFICATE_FLOATS, 1);
}

static void write_head(vndf_writer *w, const vndf_distribution *table, uint32_t size)
{
    vndf_frame_begin(&FRAME, w, size);
    vndf_write_f64(w, table->normalization);
    vndf_write_f64(w, table->scale);
    vndf_write_u32(w, table->radial_count);
    vndf_write_u32(w, table->above.cell_count);
    vndf_write_u32(w, table->above.row_count);
    vndf_write_u32(w, table->above.knot_count);
    vndf_write_u32(w, table->below.cell_count);
    vndf_write_u32(w, table->below.row_count);
    vndf_write_u32(w, table->below.knot_count);
    write_certificate(w, table->certificate);
    vndf_write_text(w, table->source);
    vndf_write_text(w, table->tool);
}

static size_t write_all(const vndf_distribution *table, unsigned char *bytes, size_t capacity, uint32_t size)
{
    vndf_writer w = {bytes, capacity, 0};
    write_head(&w, table, size);
    write_radial(&w, table);
    write_wedge(&w, &table->above);
    write_wedge(&w, &table->below);
    vndf_frame_end(&w);
    return w.at;
}

size_t vndf_table_encode(const vndf_distribution *table, unsigned char *bytes, size_t capacity)
{
    size_t size = write_all(table, NULL, 0, 0);
    return size > capacity ? size : write_all(table, bytes, capacity, (uint32_t)size);
}

/* ---- reading ---- */

static void read_array(vndf_reader *r, float *values, size_t count, size_t stride)
{
    for (size_t i = 0; i < count; i++)
        values[i * stride] = vndf_read_f32(r);
}

static void read_radial(vndf_reader *r, vndf_distribution *table)
{
    size_t n = table->radial_count, cell = sizeof *table->cells / sizeof(float);
    read_array(r, &table->knots.at->x, n + 1, 2);
    read_array(r, &table->knots.at->z, n + 1, 2);
    read_array(r, &table->cells->f0, n, cell);
    read_array(r, &table->cells->f1, n, cell);
    read_array(r, &table->cells->mu0, n, cell);
    read_array(r, &table->cells->mu1, n, cell);
}

static void read_wedge(vndf_reader *r, vndf_wedge *wedge)
{
    size_t cells = wedge->cell_count, rows = wedge->row_count, knots = wedge->knot_count;
    read_array(r, wedge->q, cells + 1, 1);
    read_array(r, wedge->row_y, vndf_row_knots(wedge->row_count), 1);
    for (size_t i = 0; i < rows; i++)
        *vndf_aspect_p(wedge, i) = vndf_read_f32(r);
    for (size_t i = 0; i < rows; i++)
        *vndf_aspect_r(wedge, i) = vndf_read_f32(r);
    for (size_t i = 0; i < rows; i++)
        read_array(r, &vndf_row_cells(wedge, i)->mass, cells, 2);
    for (size_t i = 0; i < rows; i++)
        read_array(r, &vndf_row_cells(wedge, i)->density, cells + 1, 2);
    read_array(r, wedge->knot_y, knots, 1);
    read_array(r, wedge->mass, knots, 1);
    read_array(r, wedge->slope, knots, 1);
    read_array(r, wedge->curve, knots, 1);
}

static vndf_table_size read_counts(vndf_reader *r)
{
    vndf_table_size size;
    size.radial = vndf_read_u32(r);
    size.above_cells = vndf_read_u32(r);
    size.above_rows = vndf_read_u32(r);
    size.above_knots = vndf_read_u32(r);
    size.below_cells = vndf_read_u32(r);
    size.below_rows = vndf_read_u32(r);
    size.below_knots = vndf_read_u32(r);
    return size;
}

static int within(uint32_t value, uint32_t least, uint32_t most)
{
    return value >= least && value <= most;
}

static int counts_valid(vndf_table_size s)
{
    return within(s.radial, 2, VNDF_RADIAL_CELLS_MAX) && within(s.above_cells, 2, VNDF_WEDGE_CELLS_MAX) &&
           within(s.below_cells, 2, VNDF_WEDGE_CELLS_MAX) && within(s.above_rows, 3, VNDF_WEDGE_ROWS_MAX) &&
           within(s.below_rows, 3, VNDF_WEDGE_ROWS_MAX) && s.above_rows % 2 == 1 && s.below_rows % 2 == 1 &&
           within(s.above_knots, 2, VNDF_AREA_KNOTS_MAX) && within(s.below_knots, 2, VNDF_AREA_KNOTS_MAX);
}

static void read_certificate(vndf_reader *r, vndf_certificate *c)
{
    read_array(r, &c->tv, VNDF_CERTIFICATE_FLOATS, 1);
    c->quick =
        c->weight_bounded == 2.0f || (c->weight_bounded == 0.0f && signbit(c->weight_bounded)) ? 1.0f : 0.0f;
    if (c->quick > 0)
        c->weight_bounded = c->weight_bounded > 0 ? 1.0f : 0.0f;
}

/* Reads everything after the counts; 0 if the bytes end early (the reader fails) or memory is short. */
static int read_body(vndf_reader *r, vndf_distribution *table)
{
    read_certificate(r, &table->certificate);
    table->source = vndf_read_text(r);
    table->tool = vndf_read_text(r);
    if (!table->source || !table->tool)
        return 0;
    read_radial(r, table);
    read_wedge(r, &table->above);
    read_wedge(r, &table->below);
    r->failed |= r->at + 4 != r->size;
    return !r->failed;
}

vndf_distribution *vndf_load_memory(const void *bytes, size_t size, vndf_error *error)
{
    if (!bytes) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "no bytes: NULL was given");
        return NULL;
    }
    if (vndf_frame_check(&FRAME, bytes, size, error) != VNDF_OK)
        return NULL;
    vndf_reader r = {bytes, size, VNDF_FRAME_HEAD, 0};
    double normalization = vndf_read_f64(&r), scale = vndf_read_f64(&r);
    vndf_table_size counts = read_counts(&r);
    if (!counts_valid(counts)) {
        vndf_fail(error, VNDF_ERROR_TABLE, "the table's counts are outside the limits of the format");
        return NULL;
    }
    vndf_distribution *table = vndf_table_allocate(counts);
    if (!table) {
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a table of %lu bytes", (unsigned long)size);
        return NULL;
    }
    table->normalization = normalization;
    table->scale = scale;
    table->bytes = size;
    int whole = read_body(&r, table);
    const char *why = whole ? vndf_table_invalid(table) : r.failed ? "its parts do not fill the file" : NULL;
    if (whole && !why && vndf_table_derive(table) && !(why = vndf_table_invalid_derived(table)))
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
