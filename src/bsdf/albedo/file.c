#include "bsdf/albedo/file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "core/cursor.h"
#include "core/error.h"
#include "core/frame.h"
#include "core/replace_file.h"

static const vndf_frame FRAME = {"VNDFalb\n", "table of albedos", 1, VNDF_LIMIT_ALBEDO_BYTES};
enum { MEASURED = 8 };

/* Splines through values in [0, 1] have coefficients below 200, and these are at the ends of coarse grids. */
#define COEFFICIENT_MAX 1000.0f

/* ---- writing ------------------------------------------------------------------------------------- */

static void measured_of(const vndf_albedo_properties *is, float measured[MEASURED])
{
    const float all[MEASURED] = {is->error,       is->error_cosine, is->error_alpha,   is->error_usual,
                                 is->split_error, is->split_usual,  is->average_error, is->quadrature_error};
    memcpy(measured, all, sizeof all);
}

static size_t write_all(const vndf_albedo *albedo, unsigned char *bytes, size_t capacity, uint32_t size)
{
    vndf_writer w = {bytes, capacity, 0};
    float measured[MEASURED];
    measured_of(&albedo->is, measured);
    vndf_frame_begin(&FRAME, &w, size);
    vndf_write_f32(&w, albedo->is.eta);
    vndf_write_f32(&w, albedo->is.scale);
    vndf_write_u32(&w, (uint32_t)albedo->is.columns);
    vndf_write_u32(&w, (uint32_t)albedo->is.rows);
    for (int i = 0; i < MEASURED; i++)
        vndf_write_f32(&w, measured[i]);
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

vndf_status vndf_albedo_save(const vndf_albedo *albedo, const char *path, vndf_error *error)
{
    if (!albedo || !path)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "a table of albedos and a path are needed to save");
    unsigned char *bytes = malloc(albedo->is.bytes);
    if (!bytes)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to save %s", path);
    vndf_albedo_encode(albedo, bytes, albedo->is.bytes);
    int good = vndf_replace_whole(path, bytes, albedo->is.bytes), reason = errno;
    free(bytes);
    if (good)
        return VNDF_OK;
    if (reason == ENOMEM)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to save %s", path);
    return vndf_fail(error, VNDF_ERROR_IO, "cannot write %s: %s", path, strerror(reason));
}

vndf_status vndf_albedo_save_memory(const vndf_albedo *albedo, void *bytes, size_t size, vndf_error *error)
{
    if (!albedo || !bytes)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "a table of albedos and memory are needed to save");
    if (size != albedo->is.bytes)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the memory has %lu bytes, the table %lu",
                         (unsigned long)size, (unsigned long)albedo->is.bytes);
    vndf_albedo_encode(albedo, bytes, size);
    return VNDF_OK;
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
static const char *numbers_invalid(const vndf_albedo *albedo)
{
    float measured[MEASURED];
    measured_of(&albedo->is, measured);
    if (!vndf_albedo_eta_valid(albedo->is.eta) || !vndf_albedo_scale_valid(albedo->is.scale))
        return "eta or the scale is out of range";
    for (int i = 0; i < MEASURED; i++)
        if (!within(measured[i], i == 1 ? -1.0f : 0.0f, i == 2 ? VNDF_ALBEDO_ALPHA_MAX : 2.0f))
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
    float *const measured[MEASURED] = {&is->error,         &is->error_cosine,    &is->error_alpha,
                                       &is->error_usual,   &is->split_error,     &is->split_usual,
                                       &is->average_error, &is->quadrature_error};
    for (int i = 0; i < MEASURED; i++)
        *measured[i] = vndf_read_f32(r);
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
