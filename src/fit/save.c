/* Saving is atomic: a temporary beside the file, flushed to the disk and closed without an error, then renamed
 * over it. Whatever fails, the old file stays whole and the temporary is removed. Behind symbolic links it is the
 * file at their end that is replaced, and its mode is kept. */
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
    KEPT_MAX = 100, /* bytes of the name that its temporary keeps: some systems have room for 143 */
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

/* The first bytes of `folder`, then `name`; to be freed. NULL and ENOMEM. */
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

/* What the link at path holds: 1, 0 if there is none, -1 and errno. */
static int read_link(const char *path, char held[LINK_BYTES])
{
    ssize_t length = readlink(path, held, LINK_BYTES - 1);
    if (length < 0)
        return errno == EINVAL || errno == ENOENT ? 0 : -1;
    held[length] = '\0';
    return 1;
}

/* The name at the end of all links, also where nothing is there yet; to be freed. NULL and errno. */
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

/* The owner is kept as far as the system lets us: root does not take a user's file away. 0 and errno if the mode
 * cannot be. */
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

/* A new file, with the mode of the one that it replaces. NULL and errno, EEXIST if the name is taken. */
static FILE *create_new(const char *name, const char *target)
{
    struct stat old;
    if (stat(target, &old) != 0)
        return create_with(name, NULL);
    if (S_ISREG(old.st_mode))
        return create_with(name, &old);
    errno = S_ISDIR(old.st_mode) ? EISDIR : EINVAL; /* a device or a pipe would be gone */
    return NULL;
}

static long process_number(void)
{
    return (long)getpid();
}

/* Not every file can be synced. */
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

/* Bytes of a name that its temporary keeps; characters of UTF-8 stay whole. */
static size_t kept_length(const char *name)
{
    size_t length = strlen(name);
    if (length <= KEPT_MAX)
        return length;
    for (length = KEPT_MAX; length && ((unsigned char)name[length] & 0xC0) == 0x80;)
        length--;
    return length;
}

/* A new file beside target: NAME.PROCESS.tmp, or another number where that is taken: by another thread, or by
 * what a crash left. Nothing that exists is ever opened. *name, to be freed, is its name. NULL and errno. */
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

/* 0 and errno if anything was not written. */
static int write_whole(FILE *file, const unsigned char *bytes, size_t size)
{
    int good = fwrite(bytes, 1, size, file) == size && fflush(file) == 0 && reaches_disk(file);
    int reason = errno, closed = fclose(file) == 0;
    if (!good)
        errno = reason;
    return good && closed;
}

/* 0 and errno, with nothing left behind. */
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
