/* Saving tables and families (core/cursor.h). */
#include "core/error.h"
#include "core/cursor.h"
#include "table/family/family.h"
#include "vndf_build.h"

/* One of a table and a family, to one of a file and memory. A family of vndf_family_of has no texts, and may hold
 * closed forms. */
static vndf_status save(const vndf_distribution *table, const vndf_family *family, const char *path, void *bytes,
                        size_t size, vndf_error *error)
{
    vndf_writer writer = {NULL, 0, 0, 0};
    int good = table ? vndf_is_table(table) : family && family->owns;
    if (!good || !(path || bytes))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "to save, a table or a family that was built or loaded, and a place are needed; closed "
                         "forms have no file");
    if (table)
        vndf_table_write(table, &writer);
    else
        vndf_family_write(family, &writer);
    return vndf_frame_save(&writer, path, bytes, size, error);
}

vndf_status vndf_save(const vndf_distribution *distribution, const char *path, vndf_error *error)
{
    return save(distribution, NULL, path, NULL, 0, error);
}

vndf_status vndf_save_memory(const vndf_distribution *distribution, void *bytes, size_t size, vndf_error *error)
{
    return save(distribution, NULL, NULL, bytes, size, error);
}

vndf_status vndf_family_save(const vndf_family *family, const char *path, vndf_error *error)
{
    return save(NULL, family, path, NULL, 0, error);
}

vndf_status vndf_family_save_memory(const vndf_family *family, void *bytes, size_t size, vndf_error *error)
{
    return save(NULL, family, NULL, bytes, size, error);
}
