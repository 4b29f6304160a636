/* Saving tables and families (core/frame.h). */
#include "core/error.h"
#include "core/frame.h"
#include "table/family/family.h"
#include "table/file.h"
#include "vndf_build.h"

/* ---- tables -------------------------------------------------------------------------------------- */

static size_t encode_table(const void *table, unsigned char *bytes, size_t capacity)
{
    return vndf_table_encode_loaded(table, bytes, capacity);
}

vndf_status vndf_save(const vndf_distribution *distribution, const char *path, vndf_error *error)
{
    if (!distribution || !path || !vndf_is_table(distribution))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "a table and a path are needed to save; closed forms have no file");
    return vndf_frame_save(distribution, encode_table, path, error);
}

vndf_status vndf_save_memory(const vndf_distribution *distribution, void *bytes, size_t size, vndf_error *error)
{
    if (!distribution || !bytes || !vndf_is_table(distribution))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "a table and memory are needed to save; closed forms have no file");
    return vndf_frame_save_memory(distribution, encode_table, bytes, size, error);
}

/* ---- families ------------------------------------------------------------------------------------ */

static size_t encode_family(const void *family, unsigned char *bytes, size_t capacity)
{
    return vndf_family_encode(family, bytes, capacity);
}

/* A family of vndf_family_of has no texts, and may hold closed forms. */
static vndf_status check_family(const vndf_family *family, const void *to, vndf_error *error)
{
    if (family && to && family->owns)
        return VNDF_OK;
    return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                     "a family that was built or loaded, and a place, are needed to save");
}

vndf_status vndf_family_save(const vndf_family *family, const char *path, vndf_error *error)
{
    vndf_status status = check_family(family, path, error);
    return status == VNDF_OK ? vndf_frame_save(family, encode_family, path, error) : status;
}

vndf_status vndf_family_save_memory(const vndf_family *family, void *bytes, size_t size, vndf_error *error)
{
    vndf_status status = check_family(family, bytes, error);
    return status == VNDF_OK ? vndf_frame_save_memory(family, encode_family, bytes, size, error) : status;
}
