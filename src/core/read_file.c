#include "core/read_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"

enum { HEAD_MAX = 64 };

/* Reads the size that the head states and one byte more. */
static unsigned char *read_stream(FILE *file, size_t head_size, vndf_head_check *check, size_t *size,
                                  vndf_error *error)
{
    unsigned char head[HEAD_MAX];
    uint32_t stated = 0;
    size_t n = fread(head, 1, head_size, file);
    if (ferror(file) || check(head, n, &stated, error) != VNDF_OK)
        return NULL;
    unsigned char *bytes = malloc((size_t)stated + 1);
    if (!bytes) {
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for %u bytes", (unsigned)stated);
        return NULL;
    }
    memcpy(bytes, head, head_size);
    *size = n + fread(bytes + n, 1, (size_t)stated + 1 - n, file);
    if (!ferror(file) && *size <= stated)
        return bytes;
    if (!ferror(file))
        vndf_fail(error, VNDF_ERROR_TABLE, "the table says that it has %u bytes, and more follow",
                  (unsigned)stated);
    free(bytes);
    return NULL;
}

unsigned char *vndf_read_file(const char *path, size_t head, vndf_head_check *check, size_t *size,
                              vndf_error *error)
{
    vndf_error inner = {VNDF_OK, ""};
    FILE *file = path ? fopen(path, "rb") : NULL;
    if (!file) {
        vndf_fail(error, path ? VNDF_ERROR_IO : VNDF_ERROR_ARGUMENT, "cannot open %s: %s", path ? path : "(NULL)",
                  path ? strerror(errno) : "no path");
        return NULL;
    }
    errno = 0;
    unsigned char *bytes = read_stream(file, head, check, size, &inner);
    if (!bytes && inner.status == VNDF_OK)
        vndf_fail(error, VNDF_ERROR_IO, "cannot read %s: %s", path, errno ? strerror(errno) : "unknown reason");
    else if (!bytes)
        vndf_fail(error, inner.status, "%s: %s", path, inner.message);
    fclose(file);
    return bytes;
}
