#include "core/read_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/cursor.h"
#include "core/error.h"

unsigned char *vndf_read_file(const char *path, size_t most, size_t *size, vndf_error *error)
{
    FILE *file = path ? fopen(path, "rb") : NULL;
    if (!file) {
        vndf_fail(error, path ? VNDF_ERROR_IO : VNDF_ERROR_ARGUMENT, "%s: cannot be opened: %s",
                  path ? path : "the path is NULL", path ? strerror(errno) : "a file name is needed");
        return NULL;
    }
    vndf_writer all = {NULL, 0, 0, 0};
    unsigned char part[16384];
    size_t got = 1;
    errno = 0;
    while (got > 0 && all.size <= most && !all.failed) { /* in steps, since a pipe does not tell its size */
        got = fread(part, 1, most + 1 - all.size < sizeof part ? most + 1 - all.size : sizeof part, file);
        vndf_write_bytes(&all, part, got);
    }
    vndf_write_bytes(&all, "", 1); /* so that an empty file has bytes */
    int reason = errno, failed = ferror(file);
    fclose(file);
    *size = all.size - 1;
    if (!all.failed && !failed)
        return all.bytes;
    if (!all.failed)
        vndf_fail(error, VNDF_ERROR_IO, "%s: cannot be read: %s", path,
                  reason ? strerror(reason) : "unknown reason");
    else
        vndf_fail(error, VNDF_ERROR_MEMORY, "%s: no memory to read it", path);
    free(all.bytes);
    return NULL;
}
