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

/* ---- names --------------------------------------------------------------------------------------- */

size_t vndf_replace_folder_length(const char *path)
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

char *vndf_replace_end_of_links(const char *path)
{
    char held[LINK_BYTES];
    int found = 1, reason = ELOOP;
    char *at = join(path, 0, path);
    for (int i = 0; at && i < LINKS_MAX && (found = read_link(at, held)) > 0; i++) {
        char *next = join(at, held[0] == '/' ? 0 : vndf_replace_folder_length(at), held);
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

/* O_EXCL: never write through something that is there already. old: the file to be replaced, if there is one. */
static FILE *create_with(const char *name, const struct stat *old)
{
    int made = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, old ? old->st_mode & 0777 : 0666);
    FILE *file = made >= 0 && (!old || fchmod(made, old->st_mode & 0777) == 0) ? fdopen(made, "wb") : NULL;
    int reason = errno;
    if (made >= 0 && !file) {
        close(made);
        remove(name);
    }
    errno = reason;
    return file;
}

/* A new file with the mode of the file that it replaces. */
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

/* To the disk; not every file can be synced. */
static int reaches_disk(FILE *file)
{
    return fsync(fileno(file)) == 0 || errno == EINVAL || errno == EROFS;
}

/* Of a write before, the reason may be lost: another one, of a byte that nobody will read, shows it. */
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

char *vndf_replace_end_of_links(const char *path)
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

int vndf_replace_flush(FILE *file)
{
    return fflush(file) == 0 && !ferror(file);
}

#endif

/* ---- the calls ----------------------------------------------------------------------------------- */

/* vndf.PROCESS.tmp in the folder of the target, or another number where a crash left one of that name. */
static FILE *create_temporary(vndf_replacement *r)
{
    FILE *file = NULL;
    size_t length = vndf_replace_folder_length(r->target);
    r->temporary = malloc(length + SUFFIX_MAX);
    errno = r->temporary ? EEXIST : ENOMEM;
    for (int i = 0; !file && errno == EEXIST && i < NAMES_MAX; i++) {
        memcpy(r->temporary, r->target, length);
        snprintf(r->temporary + length, SUFFIX_MAX, i ? "vndf.%ld.%d.tmp" : "vndf.%ld.tmp", process_number(), i);
        file = create_new(r->temporary, r->target);
    }
    return file;
}

static void forget(vndf_replacement *r)
{
    free(r->target);
    free(r->temporary);
    *r = (vndf_replacement){NULL, NULL, NULL};
}

int vndf_replace_begin(vndf_replacement *r, const char *path)
{
    *r = (vndf_replacement){vndf_replace_end_of_links(path), NULL, NULL};
    if (r->target && (r->file = create_temporary(r)) != NULL)
        return 1;
    int reason = errno;
    forget(r);
    errno = reason;
    return 0;
}

/* Synced before the rename, so that a crash leaves the old file or the new one. */
static int close_whole(FILE *file)
{
    int good = vndf_replace_flush(file) && reaches_disk(file);
    int reason = errno, closed = fclose(file) == 0;
    if (!good)
        errno = reason;
    return good && closed;
}

int vndf_replace_commit(vndf_replacement *r)
{
    int good = close_whole(r->file) && rename(r->temporary, r->target) == 0, reason = errno;
    if (!good)
        remove(r->temporary);
    forget(r);
    errno = reason;
    return good;
}

void vndf_replace_discard(vndf_replacement *r)
{
    fclose(r->file);
    remove(r->temporary);
    forget(r);
}

int vndf_replace_whole(const char *path, const void *bytes, size_t size)
{
    vndf_replacement r;
    if (!vndf_replace_begin(&r, path))
        return 0;
    if (fwrite(bytes, 1, size, r.file) == size)
        return vndf_replace_commit(&r);
    int reason = errno;
    vndf_replace_discard(&r);
    errno = reason;
    return 0;
}
