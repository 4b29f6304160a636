/* Saving is atomic: a temporary beside the file, flushed to the disk and closed without an error, then renamed
 * over it. Whatever fails, the old file stays whole and the temporary is removed. */
#if defined(__unix__) || defined(__APPLE__)
#  define _POSIX_C_SOURCE 200809L
#  include <unistd.h>
#  define VNDF_HAS_POSIX 1
#endif

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"
#include "table/file.h"
#include "vndf_build.h"

enum { NAMES_MAX = 100, SUFFIX_MAX = 48 };

/* A new file beside path: path.<process>.tmp, or another number where that name is taken: by another thread, or
 * by what a crash left. Nothing that exists is ever opened. *name, to be freed, is its name. */
static FILE *create_temporary(const char *path, char **name)
{
    long process = 0;
    FILE *file = NULL;
    size_t size = strlen(path) + SUFFIX_MAX;
#ifdef VNDF_HAS_POSIX
    process = (long)getpid();
#endif
    *name = malloc(size);
    for (int i = 0; *name && !file && i < NAMES_MAX; i++) {
        snprintf(*name, size, i ? "%s.%ld.%d.tmp" : "%s.%ld.tmp", path, process, i);
        file = fopen(*name, "wbx");
        if (!file && errno != EEXIST)
            break;
    }
    return file;
}

/* 0 and errno if anything was not written. */
static int write_whole(FILE *file, const unsigned char *bytes, size_t size)
{
    int good = fwrite(bytes, 1, size, file) == size && fflush(file) == 0;
#ifdef VNDF_HAS_POSIX
    /* not every file can be synced */
    good = good && (fsync(fileno(file)) == 0 || errno == EINVAL || errno == EROFS);
#endif
    int reason = errno, closed = fclose(file) == 0;
    if (!good)
        errno = reason;
    return good && closed;
}

static vndf_status write_file(const char *path, const unsigned char *bytes, size_t size, vndf_error *error)
{
    char *temporary;
    FILE *file = create_temporary(path, &temporary);
    vndf_status status = VNDF_OK;
    if (!temporary)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to save %s", path);
    if (!file)
        status = vndf_fail(error, VNDF_ERROR_IO, "cannot write %s: cannot create %s: %s", path, temporary,
                           strerror(errno));
    else if (!write_whole(file, bytes, size) || rename(temporary, path) != 0) {
        status = vndf_fail(error, VNDF_ERROR_IO, "cannot write %s: %s", path, strerror(errno));
        remove(temporary);
    }
    free(temporary);
    return status;
}

vndf_status vndf_save(const vndf_distribution *distribution, const char *path, vndf_error *error)
{
    if (!distribution || !path || distribution->kind != VNDF_KIND_TABLE)
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
