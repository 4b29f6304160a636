/* Saving tables and families (core/frame.h). */
#include "core/error.h"
#include "core/frame.h"
#include "table/family/family.h"
#include "table/file.h"
#include "vndf_build.h"

vndf_status vndf_save(const vndf_distribution *distribution, const char *path, vndf_error *error)
{
    vndf_writer writer = {NULL, 0, 0, 0};
    if (!distribution || !path || !vndf_is_table(distribution))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "a table and a path are needed to save; closed forms have no file");
    vndf_table_write_loaded(distribution, &writer);
    return vndf_frame_save(&writer, path, error);
}

vndf_status vndf_save_memory(const vndf_distribution *distribution, void *bytes, size_t size, vndf_error *error)
{
    vndf_writer writer = {NULL, 0, 0, 0};
    if (!distribution || !bytes || !vndf_is_table(distribution))
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "a table and memory are needed to save; closed forms have no file");
    vndf_table_write_loaded(distribution, &writer);
    return vndf_frame_save_memory(&writer, bytes, size, error);
}

/* Writes a family. One of vndf_family_of has no texts, and may hold closed forms. */
static vndf_status write_family(const vndf_family *family, const void *to, vndf_writer *writer, vndf_error *error)
{
    *writer = (vndf_writer){NULL, 0, 0, 0};
    if (!family || !to || !family->owns)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT,
                         "a family that was built or loaded, and a place, are needed to save");
    vndf_family_write(family, writer);
    return VNDF_OK;
}

vndf_status vndf_family_save(const vndf_family *family, const char *path, vndf_error *error)
{
    vndf_writer writer;
    vndf_status status = write_family(family, path, &writer, error);
    return status == VNDF_OK ? vndf_frame_save(&writer, path, error) : status;
}

vndf_status vndf_family_save_memory(const vndf_family *family, void *bytes, size_t size, vndf_error *error)
{
    vndf_writer writer;
    vndf_status status = write_family(family, bytes, &writer, error);
    return status == VNDF_OK ? vndf_frame_save_memory(&writer, bytes, size, error) : status;
}
