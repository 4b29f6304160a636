/* Families on disk (family.h). */
#include <stdlib.h>
#include <string.h>

#include "core/cursor.h"
#include "core/error.h"
#include "core/frame.h"
#include "table/family/family.h"
#include "table/file.h"

static const vndf_frame FRAME = {"VNDFfam\n", "family", 1, VNDF_LIMIT_FAMILY_BYTES};

void vndf_family_write(const vndf_family *family, vndf_writer *w)
{
    vndf_frame_begin(&FRAME, w);
    vndf_write_u32(w, (uint32_t)family->count);
    vndf_write_u32(w, family->reciprocal != 0);
    vndf_write_f32(w, family->grazing);
    vndf_write_text(w, family->source);
    vndf_write_text(w, family->tool);
    for (size_t i = 0; i < family->count; i++)
        vndf_write_f32(w, family->parameter[i]);
    for (size_t i = 0; i + 1 < family->count; i++)
        vndf_write_f32(w, family->distance[i]);
    for (size_t i = 0; i < family->count; i++) {
        vndf_writer table = {NULL, 0, 0, 0};
        vndf_table_write_loaded(family->distribution[i], &table);
        vndf_write_u32(w, (uint32_t)table.size);
        vndf_write_bytes(w, table.bytes, table.size);
        w->failed |= table.failed;
        free(table.bytes);
    }
    vndf_frame_end(w);
}

size_t vndf_family_size(const vndf_family *family)
{
    size_t size =
        VNDF_FRAME_HEAD + 4 * (5 + 2 * family->count - 1 + 1) + strlen(family->source) + strlen(family->tool);
    for (size_t i = 0; i < family->count; i++)
        size += 4 + family->distribution[i]->bytes;
    return size;
}

/* ---- reading ---- */

static vndf_status inconsistent(const char *why, vndf_error *error)
{
    return vndf_fail(error, VNDF_ERROR_TABLE, "not a consistent family: %s", why);
}

static vndf_status read_table(vndf_reader *r, vndf_family *family, size_t index, vndf_error *error)
{
    vndf_error inner = {VNDF_OK, ""};
    uint32_t size = vndf_read_u32(r);
    const unsigned char *bytes = vndf_read_bytes(r, size);
    if (!bytes)
        return inconsistent("its tables do not fill the file", error);
    family->distribution[index] = vndf_load_memory(bytes, size, &inner);
    if (family->distribution[index])
        return VNDF_OK;
    return vndf_fail(error, inner.status, "table %lu: %s", (unsigned long)index + 1, inner.message);
}

static vndf_status read_family(vndf_reader *r, vndf_family *family, vndf_error *error)
{
    family->grazing = vndf_read_f32(r);
    family->source = vndf_read_text(r);
    family->tool = vndf_read_text(r);
    for (size_t i = 0; i < family->count; i++)
        family->parameter[i] = vndf_read_f32(r);
    for (size_t i = 0; i + 1 < family->count; i++)
        family->distance[i] = vndf_read_f32(r);
    if (r->failed)
        return inconsistent("it ends early", error);
    if (!family->source || !family->tool)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a family of %lu bytes", (unsigned long)r->size);
    const char *why = vndf_family_invalid(family);
    vndf_status status = why ? inconsistent(why, error) : VNDF_OK;
    for (size_t i = 0; i < family->count && status == VNDF_OK; i++)
        status = read_table(r, family, i, error);
    if (status == VNDF_OK && r->at + 4 != r->size)
        return inconsistent("its tables do not fill the file", error);
    return status;
}

vndf_family *vndf_family_load_memory(const void *bytes, size_t size, vndf_error *error)
{
    if (vndf_frame_check(&FRAME, bytes, size, error) != VNDF_OK)
        return NULL;
    vndf_reader r = {bytes, size, VNDF_FRAME_HEAD, 0};
    uint32_t count = vndf_read_u32(&r), reciprocal = vndf_read_u32(&r);
    if (count < 1 || count > VNDF_LIMIT_FAMILY_KNOTS || reciprocal > 1) {
        vndf_fail(error, VNDF_ERROR_TABLE, "the family's counts are outside the limits of the format");
        return NULL;
    }
    vndf_family *family = vndf_family_allocate(count);
    if (!family) {
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a family of %lu bytes", (unsigned long)size);
        return NULL;
    }
    family->owns = 1;
    family->reciprocal = reciprocal != 0;
    family->bytes = size;
    if (read_family(&r, family, error) == VNDF_OK)
        return family;
    vndf_family_free(family);
    return NULL;
}

static void *decode(const void *bytes, size_t size, vndf_error *error)
{
    return vndf_family_load_memory(bytes, size, error);
}

vndf_family *vndf_family_load(const char *path, vndf_error *error)
{
    return vndf_frame_load(&FRAME, path, decode, error);
}
