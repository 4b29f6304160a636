#include "table/family/family.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/cursor.h"
#include "core/error.h"

vndf_family *vndf_family_allocate(size_t count)
{
    vndf_family *family = calloc(1, sizeof *family);
    if (family)
        family->count = count;
    return family;
}

void vndf_family_free(vndf_family *family)
{
    if (!family)
        return;
    for (size_t i = 0; family->owns && i < family->count; i++)
        vndf_free((vndf_distribution *)family->distribution[i]);
    free(family->source);
    free(family->tool);
    free(family);
}

/* Why the numbers are none of a family; NULL if they are. */
static const char *invalid(const vndf_family *family)
{
    const float *p = family->parameter, *distance = family->distance;
    if (family->reciprocal && !(p[0] > 0.0f))
        return "parameters that are mixed by 1/p must be positive";
    for (size_t i = 0; i < family->count; i++)
        if (!isfinite(p[i]))
            return "a parameter is infinite or not a number";
    for (size_t i = 0; i + 1 < family->count; i++)
        if (!(p[i] < p[i + 1]))
            return "parameters must ascend";
    for (size_t i = 0; i < family->count; i++) {
        float x = i + 1 < family->count ? distance[i] : family->grazing;
        if (!(x >= 0.0f && x <= 1.0f))
            return "a distance is no part of 1";
    }
    return NULL;
}

/* ---- the calls ---- */

vndf_family *vndf_family_of(const vndf_distribution *const *distributions, const float *parameters, size_t count,
                            vndf_error *error)
{
    int complete = distributions && parameters && count >= 1 && count <= VNDF_LIMIT_FAMILY_KNOTS;
    for (size_t i = 0; complete && i < count; i++)
        complete = distributions[i] != NULL;
    vndf_family *family = complete ? vndf_family_allocate(count) : NULL;
    if (!family)
        return vndf_fail(error, complete ? VNDF_ERROR_MEMORY : VNDF_ERROR_ARGUMENT,
                         complete ? "no memory for a family"
                                  : "a family needs 1 to %d distributions, each with a parameter",
                         VNDF_LIMIT_FAMILY_KNOTS),
               NULL;
    memcpy(family->parameter, parameters, count * sizeof *parameters);
    memcpy((void *)family->distribution, (const void *)distributions, count * sizeof *distributions);
    const char *why = invalid(family);
    if (!why)
        return family;
    vndf_fail(error, VNDF_ERROR_ARGUMENT, "not a family: %s", why);
    vndf_family_free(family);
    return NULL;
}

vndf_family_facts vndf_family_info(const vndf_family *family)
{
    vndf_family_facts facts = {.source = "", .tool = ""};
    if (!family)
        return facts;
    facts.source = family->source ? family->source : "";
    facts.tool = family->tool ? family->tool : "";
    facts.bytes = family->bytes;
    facts.count = family->count;
    facts.low = family->parameter[0];
    facts.high = family->parameter[family->count - 1];
    facts.reciprocal = family->reciprocal;
    facts.grazing = family->grazing;
    for (size_t i = 0; i < family->count; i++) {
        facts.memory += vndf_distribution_info(family->distribution[i]).memory;
        facts.distance = fmaxf(facts.distance, family->distance[i]);
    }
    return facts;
}

float vndf_family_parameter(const vndf_family *family, size_t index)
{
    return family && index < family->count ? family->parameter[index] : 0.0f;
}

const vndf_distribution *vndf_family_distribution(const vndf_family *family, size_t index)
{
    return family && index < family->count ? family->distribution[index] : NULL;
}

float vndf_family_distance(const vndf_family *family, size_t index)
{
    return family && index < family->count ? family->distance[index] : 0.0f;
}

/* ---- on disk ---- */

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
        vndf_table_write(family->distribution[i], &table);
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

/* Reads all that stands behind the counts. NULL or what is wrong; *error is that of a table, or of memory. */
static const char *read_family(vndf_reader *r, vndf_family *family, vndf_error *error)
{
    family->grazing = vndf_read_f32(r);
    family->source = vndf_read_text(r, 0);
    family->tool = vndf_read_text(r, 0);
    for (size_t i = 0; i < family->count; i++)
        family->parameter[i] = vndf_read_f32(r);
    for (size_t i = 0; i + 1 < family->count; i++)
        family->distance[i] = vndf_read_f32(r);
    const char *why = r->failed ? "it ends early" : invalid(family);
    if (!why && (!family->source || !family->tool))
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a family of %lu bytes", (unsigned long)r->size);
    for (size_t i = 0; i < family->count && !why && error->status == VNDF_OK; i++) {
        vndf_error inner = {VNDF_OK, ""};
        uint32_t size = vndf_read_u32(r);
        const unsigned char *bytes = vndf_read_bytes(r, size);
        why = bytes ? NULL : "its tables do not fill the file";
        family->distribution[i] = bytes ? vndf_load_memory(bytes, size, &inner) : NULL;
        if (bytes && !family->distribution[i])
            vndf_fail(error, inner.status, "table %lu: %s", (unsigned long)i + 1, inner.message);
    }
    return why || r->at + 4 == r->size ? why : "its tables do not fill the file";
}

vndf_family *vndf_family_load_memory(const void *bytes, size_t size, vndf_error *error)
{
    if (vndf_frame_check(&FRAME, bytes, size, error) != VNDF_OK)
        return NULL;
    vndf_reader r = {bytes, size, VNDF_FRAME_HEAD, 0};
    uint32_t count = vndf_read_u32(&r), reciprocal = vndf_read_u32(&r);
    if (count < 1 || count > VNDF_LIMIT_FAMILY_KNOTS || reciprocal > 1)
        return vndf_fail(error, VNDF_ERROR_TABLE, "the family's counts are outside the limits of the format"),
               NULL;
    vndf_family *family = vndf_family_allocate(count);
    if (!family)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for a family of %lu bytes", (unsigned long)size),
               NULL;
    vndf_error inner = {VNDF_OK, ""};
    family->owns = 1;
    family->reciprocal = reciprocal != 0;
    family->bytes = size;
    const char *why = read_family(&r, family, &inner);
    if (!why && inner.status == VNDF_OK)
        return family;
    if (inner.status == VNDF_OK)
        vndf_fail(&inner, VNDF_ERROR_TABLE, "not a consistent family: %s", why);
    vndf_fail(error, inner.status, "%s", inner.message);
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
