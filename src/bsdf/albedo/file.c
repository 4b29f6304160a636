#include "bsdf/albedo/file.h"

#include <math.h>
#include <stddef.h>

#include "core/cursor.h"
#include "core/error.h"
#include "core/frame.h"

static const vndf_frame FRAME = {"VNDFalb\n", "table of albedos", 1, VNDF_LIMIT_ALBEDO_BYTES};

/* Splines through values in [0, 1] have coefficients below 200, and these are at the ends of coarse grids. */
#define COEFFICIENT_MAX 1000.0f

/* What was measured, in the order of the file, and what a file may say. */
typedef struct measured {
    size_t at; /* in vndf_albedo_properties */
    float least, most;
} measured;

static const measured MEASURED[] = {
    {offsetof(vndf_albedo_properties, error), 0.0f, 2.0f},
    {offsetof(vndf_albedo_properties, error_cosine), -1.0f, 1.0f},
    {offsetof(vndf_albedo_properties, error_alpha), 0.0f, VNDF_ALBEDO_ALPHA_MAX},
    {offsetof(vndf_albedo_properties, error_usual), 0.0f, 2.0f},
    {offsetof(vndf_albedo_properties, split_error), 0.0f, 2.0f},
    {offsetof(vndf_albedo_properties, split_usual), 0.0f, 2.0f},
    {offsetof(vndf_albedo_properties, average_error), 0.0f, 2.0f},
    {offsetof(vndf_albedo_properties, quadrature_error), 0.0f, 2.0f},
};
enum { MEASURED_COUNT = sizeof MEASURED / sizeof MEASURED[0] };

static float *measured_at(vndf_albedo_properties *is, int i)
{
    return (float *)((char *)is + MEASURED[i].at);
}

/* ---- writing ------------------------------------------------------------------------------------- */

static size_t write_all(const vndf_albedo *albedo, unsigned char *bytes, size_t capacity, uint32_t size)
{
    vndf_writer w = {bytes, capacity, 0};
    vndf_albedo_properties is = albedo->is;
    vndf_frame_begin(&FRAME, &w, size);
    vndf_write_f32(&w, albedo->is.eta);
    vndf_write_f32(&w, albedo->is.scale);
    vndf_write_u32(&w, (uint32_t)albedo->is.columns);
    vndf_write_u32(&w, (uint32_t)albedo->is.rows);
    for (int i = 0; i < MEASURED_COUNT; i++)
        vndf_write_f32(&w, *measured_at(&is, i));
    vndf_write_text(&w, albedo->source);
    vndf_write_text(&w, albedo->tool);
    for (size_t i = 0; i < albedo->is.values; i++)
        vndf_write_f32(&w, albedo->value[i]);
    vndf_frame_end(&w);
    return w.at;
}

size_t vndf_albedo_encode(const vndf_albedo *albedo, unsigned char *bytes, size_t capacity)
{
    size_t size = write_all(albedo, NULL, 0, 0);
    return size > capacity ? size : write_all(albedo, bytes, capacity, (uint32_t)size);
}

static size_t encode(const void *albedo, unsigned char *bytes, size_t capacity)
{
    return vndf_albedo_encode(albedo, bytes, capacity);
}

vndf_status vndf_albedo_save(const vndf_albedo *albedo, const char *path, vndf_error *error)
{
    if (!albedo || !path)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "a table of albedos and a path are needed to save");
    return vndf_frame_save(albedo, encode, path, error);
}

vndf_status vndf_albedo_save_memory(const vndf_albedo *albedo, void *bytes, size_t size, vndf_error *error)
{
    if (!albedo || !bytes)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "a table of albedos and memory are needed to save");
    return vndf_frame_save_memory(albedo, encode, bytes, size, error);
}

/* ---- reading ------------------------------------------------------------------------------------- */

int vndf_albedo_eta_valid(float eta)
{
    return eta == 0.0f || (eta >= 0.00999999f && eta <= 100.0001f && fabsf(eta - 1.0f) >= 1e-3f);
}

int vndf_albedo_scale_valid(float scale)
{
    return scale >= 1e-6f && scale <= 1e6f;
}

static int within(float value, float least, float most)
{
    return value >= least && value <= most;
}

/* NULL, or what is wrong with the numbers. */
static const char *numbers_invalid(vndf_albedo *albedo)
{
    if (!vndf_albedo_eta_valid(albedo->is.eta) || !vndf_albedo_scale_valid(albedo->is.scale))
        return "eta or the scale is out of range";
    for (int i = 0; i < MEASURED_COUNT; i++)
        if (!within(*measured_at(&albedo->is, i), MEASURED[i].least, MEASURED[i].most))
            return "a measured error is out of range";
    for (size_t i = 0; i < albedo->is.values; i++)
        if (!within(albedo->value[i], -COEFFICIENT_MAX, COEFFICIENT_MAX))
            return "a coefficient is out of range";
    return NULL;
}

/* 0 if the bytes end early (the reader fails) or memory is short. */
static int read_body(vndf_reader *r, vndf_albedo *albedo)
{
    vndf_albedo_properties *is = &albedo->is;
    for (int i = 0; i < MEASURED_COUNT; i++)
        *measured_at(is, i) = vndf_read_f32(r);
    is->source = albedo->source = vndf_read_text(r);
    is->tool = albedo->tool = vndf_read_text(r);
    if (!albedo->source || !albedo->tool)
        return 0;
    for (size_t i = 0; i < is->values; i++)
        albedo->value[i] = vndf_read_f32(r);
    r->failed |= r->at + 4 != r->size;
    return !r->failed;
}

static int count_valid(uint32_t count)
{
    return count >= VNDF_ALBEDO_GRID_MIN && count <= VNDF_ALBEDO_GRID_MAX;
}

vndf_albedo *vndf_albedo_load_memory(const void *bytes, size_t size, vndf_error *error)
{
    if (!bytes) {
        vndf_fail(error, VNDF_ERROR_ARGUMENT, "no bytes: NULL was given");
        return NULL;
    }
    if (vndf_frame_check(&FRAME, bytes, size, error) != VNDF_OK)
        return NULL;
    vndf_reader r = {bytes, size, VNDF_FRAME_HEAD, 0};
    float eta = vndf_read_f32(&r), scale = vndf_read_f32(&r);
    uint32_t columns = vndf_read_u32(&r), rows = vndf_read_u32(&r);
    if (!count_valid(columns) || !count_valid(rows)) {
        vndf_fail(error, VNDF_ERROR_TABLE,
                  "the columns or rows of the table are outside the limits of the format");
        return NULL;
    }
    vndf_albedo *albedo = vndf_albedo_allocate(columns, rows, eta == 0.0f ? 1 : VNDF_ALBEDO_LAYERS);
    if (!albedo) {
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a table of albedos");
        return NULL;
    }
    albedo->is.eta = eta;
    albedo->is.scale = scale;
    albedo->is.bytes = size;
    int whole = read_body(&r, albedo);
    const char *why = whole ? numbers_invalid(albedo) : r.failed ? "its parts do not fill the file" : NULL;
    if (whole && !why)
        return albedo;
    if (why)
        vndf_fail(error, VNDF_ERROR_TABLE, "not a consistent table of albedos: %s", why);
    else
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a table of albedos");
    vndf_albedo_free(albedo);
    return NULL;
}

static void *decode(const void *bytes, size_t size, vndf_error *error)
{
    return vndf_albedo_load_memory(bytes, size, error);
}

vndf_albedo *vndf_albedo_load(const char *path, vndf_error *error)
{
    return vndf_frame_load(&FRAME, path, decode, error);
}
