/* Saving is atomic: writes a temporary beside the file, flushes it to the disk, closes it without an error, then
 * renames it over the file. Whatever fails, the old file stays whole and the temporary is removed. Symbolic links
 * are followed: the file at their end is replaced, and keeps its mode. */
#if defined(__unix__) || defined(__APPLE__)
#  define _XOPEN_SOURCE 700
#  include <fcntl.h>
#  include <sys/stat.h>
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

enum {
    NAMES_MAX = 100,
    KEPT_MAX = 100, /* bytes of the name that its temporary keeps: some systems allow 143 in all */
    SUFFIX_MAX = 48,
    LINKS_MAX = 40, /* as many as the system follows */
    LINK_BYTES = 4096
};

/* Bytes of path before its last name. */
static size_t folder_length(const char *path)
{
    size_t length = strlen(path);
    while (length && path[length - 1] != '/')
        length--;
    return length;
}

/* The first bytes of `folder`, then `name`; the caller frees it. NULL and ENOMEM if there is no memory. */
static char *join(const char *folder, size_t length, const char *name)
{
    size_t size = strlen(name) + 1;
    char *path = malloc(length + size);
    if (!path) {
        errno = ENOMEM;
        return NULL;
    }
    memcpy(path, folder, length);
    memcpy(path + length, name, size);
    return path;
}

/* ---- what systems differ in ---------------------------------------------------------------------- */

#ifdef VNDF_HAS_POSIX

/* Reads the target of the link at path: returns 1; 0 if there is no link; -1 and errno on an error. */
static int read_link(const char *path, char held[LINK_BYTES])
{
    ssize_t length = readlink(path, held, LINK_BYTES - 1);
    if (length < 0)
        return errno == EINVAL || errno == ENOENT ? 0 : -1;
    held[length] = '\0';
    return 1;
}

/* The name at the end of all links, even if no file is there yet; the caller frees it. NULL and errno on an
 * error. */
static char *end_of_links(const char *path)
{
    char held[LINK_BYTES];
    int found = 1, reason = ELOOP;
    char *at = join(path, 0, path);
    for (int i = 0; at && i < LINKS_MAX && (found = read_link(at, held)) > 0; i++) {
        char *next = join(at, held[0] == '/' ? 0 : folder_length(at), held);
        free(at);
        at = next;
    }
    if (found == 0 || !at)
        return at;
    if (found < 0)
        reason = errno;
    free(at);
    errno = reason;
    return NULL;
}

/* Keeps the mode, and the owner as far as the system lets us, so that root does not take a user's file away. 0 and
 * errno if the mode cannot be kept. */
static int keep_mode(int made, const struct stat *old)
{
    struct stat now;
    if (fchown(made, old->st_uid, old->st_gid) != 0)
        errno = 0;
    return fstat(made, &now) == 0 &&
           (((now.st_mode ^ old->st_mode) & 0777) == 0 || fchmod(made, old->st_mode & 0777) == 0);
}

static FILE *create_with(const char *name, const struct stat *old)
{
    int made = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, old ? old->st_mode & 0777 : 0666);
    FILE *file = made >= 0 && (!old || keep_mode(made, old)) ? fdopen(made, "wb") : NULL;
    int reason = errno;
    if (made >= 0 && !file) {
        close(made);
        remove(name);
    }
    errno = reason;
    return file;
}

/* A new file with the mode of the file that it replaces. NULL and errno on an error, EEXIST if the name is
 * taken. */
static FILE *create_new(const char *name, const char *target)
{
    struct stat old;
    if (stat(target, &old) != 0)
        return create_with(name, NULL);
    if (S_ISREG(old.st_mode))
        return create_with(name, &old);
    errno = S_ISDIR(old.st_mode) ? EISDIR : EINVAL; /* a rename would destroy a device or a pipe */
    return NULL;
}

static long process_number(void)
{
    return (long)getpid();
}

/* Syncs the file; a file that cannot be synced passes. */
static int reaches_disk(FILE *file)
{
    return fsync(fileno(file)) == 0 || errno == EINVAL || errno == EROFS;
}

#else

static char *end_of_links(const char *path)
{
    return join(path, 0, path);
}

static FILE *create_new(const char *name, const char *target)
{
    (void)target;
    return fopen(name, "wbx");
}

static long process_number(void)
{
    return 0;
}

static int reaches_disk(FILE *file)
{
    (void)file;
    return 1;
}

#endif

/* ---- writing ------------------------------------------------------------------------------------- */

/* How many bytes of a name its temporary keeps; characters of UTF-8 stay whole. */
static size_t kept_length(const char *name)
{
    size_t length = strlen(name);
    if (length <= KEPT_MAX)
        return length;
    for (length = KEPT_MAX; length && ((unsigned char)name[length] & 0xC0) == 0x80;)
        length--;
    return length;
}

/* A new file beside target: NAME.PROCESS.tmp, or another number if another thread or the rest of a crash has that
 * name. It never opens a file that exists. The caller frees *name, its name. NULL and errno on an error. */
static FILE *create_temporary(const char *target, char **name)
{
    FILE *file = NULL;
    size_t length = folder_length(target);
    length += kept_length(target + length);
    *name = malloc(length + SUFFIX_MAX);
    errno = *name ? EEXIST : ENOMEM;
    for (int i = 0; !file && errno == EEXIST && i < NAMES_MAX; i++) {
        memcpy(*name, target, length);
        snprintf(*name + length, SUFFIX_MAX, i ? ".%ld.%d.tmp" : ".%ld.tmp", process_number(), i);
        file = create_new(*name, target);
    }
    return file;
}

/* 0 and errno if a byte was not written. */
static int write_whole(FILE *file, const unsigned char *bytes, size_t size)
{
    int good = fwrite(bytes, 1, size, file) == size && fflush(file) == 0 && reaches_disk(file);
    int reason = errno, closed = fclose(file) == 0;
    if (!good)
        errno = reason;
    return good && closed;
}

/* 0 and errno on an error, with nothing left behind. */
static int replace(const char *target, const unsigned char *bytes, size_t size)
{
    char *temporary;
    FILE *file = create_temporary(target, &temporary);
    int good = file && write_whole(file, bytes, size) && rename(temporary, target) == 0, reason = errno;
    if (file && !good)
        remove(temporary);
    free(temporary);
    errno = reason;
    return good;
}

static vndf_status write_file(const char *path, const unsigned char *bytes, size_t size, vndf_error *error)
{
    char *target = end_of_links(path);
    int good = target && replace(target, bytes, size), reason = errno;
    free(target);
    if (good)
        return VNDF_OK;
    if (reason == ENOMEM)
        return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to save %s", path);
    return vndf_fail(error, VNDF_ERROR_IO, "cannot write %s: %s", path, strerror(reason));
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
