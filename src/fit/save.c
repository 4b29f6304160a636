/* Saving is atomic (core/replace_file.h): whatever fails, the old file stays whole and nothing is left beside it. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "core/replace_file.h"
#include "table/family/family.h"
#include "table/file.h"
#include "vndf_build.h"

static vndf_status write_file(const char *path, const unsigned char *bytes, size_t size, vndf_error *error)
{
    if (vndf_replace_whole(path, bytes, size))
        return VNDF_OK;
    if (errno == ENOMEM)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to save %s", path);
    return vndf_fail(error, VNDF_ERROR_IO, "cannot write %s: %s", path, strerror(errno));
}

/* ---- the calls ----------------------------------------------------------------------------------- */

vndf_status vndf_save(const vndf_distribution *distribution, const char *path, vndf_error *error)
{
    if (!distribution || !path || !vndf_is_table(distribution))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "a table and a path are needed to save; closed forms have no file");
    size_t size = vndf_table_encode(distribution, NULL, 0);
    unsigned char *bytes = malloc(size);
    if (!bytes)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to save %s", path);
    vndf_table_encode(distribution, bytes, size);
    vndf_status status = write_file(path, bytes, size, error);
    free(bytes);
    return status;
}

vndf_status vndf_save_memory(const vndf_distribution *distribution, void *bytes, size_t size, vndf_error *error)
{
    if (!distribution || !bytes || !vndf_is_table(distribution))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "a table and memory are needed to save; closed forms have no file");
    if (size != vndf_table_encode(distribution, NULL, 0))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the memory has %lu bytes, the table %lu",
                         (unsigned long)size, (unsigned long)vndf_table_encode(distribution, NULL, 0));
    vndf_table_encode(distribution, bytes, size);
    return VNDF_OK;
}

/* ---- families ------------------------------------------------------------------------------------ */

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
    if (status != VNDF_OK)
        return status;
    size_t size = vndf_family_encode(family, NULL, 0);
    unsigned char *bytes = malloc(size);
    if (!bytes)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to save %s", path);
    vndf_family_encode(family, bytes, size);
    status = write_file(path, bytes, size, error);
    free(bytes);
    return status;
}

vndf_status vndf_family_save_memory(const vndf_family *family, void *bytes, size_t size, vndf_error *error)
{
    vndf_status status = check_family(family, bytes, error);
    if (status != VNDF_OK)
        return status;
    if (size != vndf_family_encode(family, NULL, 0))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the memory has %lu bytes, the family %lu",
                         (unsigned long)size, (unsigned long)vndf_family_encode(family, NULL, 0));
    vndf_family_encode(family, bytes, size);
    return VNDF_OK;
}
