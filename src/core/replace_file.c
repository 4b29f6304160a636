#if defined(__unix__) || defined(__APPLE__)
#  define _XOPEN_SOURCE 700
#  include <fcntl.h>
#  include <sys/stat.h>
#  include <unistd.h>
#  define VNDF_HAS_POSIX 1
#endif

#include "core/replace_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum {
    NAMES_MAX = 100,
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

/* The first bytes of `folder`, then `name`, with room for a suffix; to be freed. NULL and ENOMEM. */
static char *join(const char *folder, size_t length, const char *name)
{
    size_t size = strlen(name) + 1;
    char *path = malloc(length + size + SUFFIX_MAX);
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

/* The name at the end of all links, also where nothing is there yet; to be freed. NULL and errno. */
static char *end_of_links(const char *path)
{
    char held[LINK_BYTES], *at = join(path, 0, path);
    int reason = ELOOP;
    for (int i = 0; at && i < LINKS_MAX; i++) {
        ssize_t length = readlink(at, held, sizeof held - 1);
        if (length < 0 && (errno == EINVAL || errno == ENOENT))
            return at;
        reason = length < 0 ? errno : reason;
        if (length < 0)
            break;
        held[length] = '\0';
        char *next = join(at, held[0] == '/' ? 0 : folder_length(at), held);
        free(at);
        at = next;
    }
    errno = at ? reason : ENOMEM;
    free(at);
    return NULL;
}

/* A new file with the mode of the file that it replaces. O_EXCL: never write through something that is there
 * already. */
static FILE *create_new(const char *name, const char *target)
{
    struct stat old;
    int replaces = stat(target, &old) == 0;
    if (replaces && !S_ISREG(old.st_mode)) {
        errno = S_ISDIR(old.st_mode) ? EISDIR : EINVAL; /* a rename would destroy a device or a pipe */
        return NULL;
    }
    int made = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, replaces ? old.st_mode & 0777 : 0666);
    FILE *file = made >= 0 && (!replaces || fchmod(made, old.st_mode & 0777) == 0) ? fdopen(made, "wb") : NULL;
    int reason = errno;
    if (made >= 0 && !file) {
        close(made);
        remove(name);
    }
    errno = reason;
    return file;
}

static long process_number(void)
{
    return (long)getpid();
}

/* To the disk; not every file can be synced. */
static int reaches_disk(FILE *file)
{
    return fsync(fileno(file)) == 0 || errno == EINVAL || errno == EROFS;
}

/* Of a write that failed before, the reason is lost; a byte more, which nobody will read, fails for the same. */
int vndf_replace_flush(FILE *file)
{
    int failed_before = ferror(file);
    errno = 0;
    if (fflush(file) == 0 && !failed_before)
        return 1;
    if (errno == 0 && write(fileno(file), "", 1) >= 0)
        errno = 0; /* it would work by now */
    return 0;
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
    return file != NULL;
}

int vndf_replace_flush(FILE *file)
{
    return fflush(file) == 0 && !ferror(file);
}

#endif

/* ---- the calls ----------------------------------------------------------------------------------- */

/* Closes the file if there is one, removes it unless `good`, and keeps errno. Returns `good`. */
static int finish(vndf_replacement *r, int good)
{
    int reason = errno;
    if (!good && r->file) {
        fclose(r->file);
        remove(r->temporary);
    }
    free(r->target);
    free(r->temporary);
    *r = (vndf_replacement){NULL, NULL, NULL};
    errno = reason;
    return good;
}

/* To vndf.PROCESS.tmp in the folder of the target, or another number where a crash left one of that name. */
int vndf_replace_begin(vndf_replacement *r, const char *path)
{
    *r = (vndf_replacement){end_of_links(path), NULL, NULL};
    size_t length = r->target ? folder_length(r->target) : 0;
    r->temporary = r->target ? join(r->target, length, "") : NULL;
    for (int i = 0; r->temporary && !r->file && i < NAMES_MAX && (i == 0 || errno == EEXIST); i++) {
        snprintf(r->temporary + length, SUFFIX_MAX, i ? "vndf.%ld.%d.tmp" : "vndf.%ld.tmp", process_number(), i);
        r->file = create_new(r->temporary, r->target);
    }
    return r->file ? 1 : finish(r, 0);
}

/* Synced before the rename, so that a crash leaves the old file or the new one. */
int vndf_replace_commit(vndf_replacement *r)
{
    int good = vndf_replace_flush(r->file) && reaches_disk(r->file), reason = errno, closed = fclose(r->file) == 0;
    r->file = NULL;
    if (!good)
        errno = reason;
    good = good && closed && rename(r->temporary, r->target) == 0;
    reason = errno;
    if (!good)
        remove(r->temporary);
    errno = reason;
    return finish(r, good);
}

void vndf_replace_discard(vndf_replacement *r)
{
    finish(r, 0);
}

int vndf_replace_whole(const char *path, const void *bytes, size_t size)
{
    vndf_replacement r;
    if (!vndf_replace_begin(&r, path))
        return 0;
    return fwrite(bytes, 1, size, r.file) == size ? vndf_replace_commit(&r) : finish(&r, 0);
}
