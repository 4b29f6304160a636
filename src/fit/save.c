/* Saving tables and families (core/frame.h). */
#include "core/error.h"
#include "core/frame.h"
#include "table/family/family.h"
#include "table/file.h"
#include "vndf_build.h"

static vndf_status save(const vndf_distribution *table, const char *path, void *bytes, size_t size,
                        vndf_error *error)
{
    vndf_writer writer = {NULL, 0, 0, 0};
    if (!table || !(path || bytes) || !vndf_is_table(table))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "a table and a place are needed to save; closed forms have no file");
    vndf_table_write_loaded(table, &writer);
    return vndf_frame_save(&writer, path, bytes, size, error);
}

vndf_status vndf_save(const vndf_distribution *distribution, const char *path, vndf_error *error)
{
    return save(distribution, path, NULL, 0, error);
}

vndf_status vndf_save_memory(const vndf_distribution *distribution, void *bytes, size_t size, vndf_error *error)
{
    return save(distribution, NULL, bytes, size, error);
}

/* A family of vndf_family_of has no texts, and may hold closed forms. */
static vndf_status save_family(const vndf_family *family, const char *path, void *bytes, size_t size,
                               vndf_error *error)
{
    vndf_writer writer = {NULL, 0, 0, 0};
    if (!family || !(path || bytes) || !family->owns)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "a family that was built or loaded, and a place, are needed to save");
    vndf_family_write(family, &writer);
    return vndf_frame_save(&writer, path, bytes, size, error);
}

vndf_status vndf_family_save(const vndf_family *family, const char *path, vndf_error *error)
{
    return save_family(family, path, NULL, 0, error);
}

vndf_status vndf_family_save_memory(const vndf_family *family, void *bytes, size_t size, vndf_error *error)
{
    return save_family(family, NULL, bytes, size, error);
}
