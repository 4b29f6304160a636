#include "core/read_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"

/* In steps, since a pipe does not tell its size. NULL if there is no memory. */
static unsigned char *read_stream(FILE *file, size_t most, size_t *size)
{
    size_t capacity = 0, used = 0, got = 1;
    unsigned char *bytes = NULL;
    while (got > 0 && used <= most) {
        if (used == capacity) {
            capacity = 2 * capacity + 65536 < most + 1 ? 2 * capacity + 65536 : most + 1;
            unsigned char *more = realloc(bytes, capacity);
            if (!more) {
                free(bytes);
                return NULL;
            }
            bytes = more;
        }
        got = fread(bytes + used, 1, capacity - used, file);
        used += got;
    }
    *size = used;
    return bytes;
}

unsigned char *vndf_read_file(const char *path, size_t most, size_t *size, vndf_error *error)
{
    FILE *file = path ? fopen(path, "rb") : NULL;
    if (!file) {
        vndf_fail(error, path ? VNDF_ERROR_IO : VNDF_ERROR_ARGUMENT, "%s: cannot be opened: %s",
                  path ? path : "the path is NULL", path ? strerror(errno) : "a file name is needed");
        return NULL;
    }
    errno = 0;
    unsigned char *bytes = read_stream(file, most, size);
    int reason = errno, failed = ferror(file);
    fclose(file);
    if (bytes && !failed)
        return bytes;
    if (bytes)
        vndf_fail(error, VNDF_ERROR_IO, "%s: cannot be read: %s", path,
                  reason ? strerror(reason) : "unknown reason");
    else
        vndf_fail(error, VNDF_ERROR_MEMORY, "%s: no memory to read it", path);
    free(bytes);
    return NULL;
}
