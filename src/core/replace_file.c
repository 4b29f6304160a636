#if defined(__unix__) || defined(__APPLE__)
#  define _XOPEN_SOURCE 700
#  include <fcntl.h>
#  include <limits.h>
#  include <sys/stat.h>
#  include <unistd.h>
#  define VNDF_HAS_POSIX 1
#endif

#include "core/replace_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { NAMES_MAX = 1000, SUFFIX_MAX = 32 };

/* With room for a temporary's name; to be freed. NULL and ENOMEM. */
static char *copy_of(const char *path)
{
    char *copy = malloc(strlen(path) + SUFFIX_MAX);
    if (copy)
        return strcpy(copy, path);
    errno = ENOMEM;
    return NULL;
}

/* ---- what systems differ in ---------------------------------------------------------------------- */

#ifdef VNDF_HAS_POSIX

/* The file at the end of all links; to be freed. NULL and errno. */
static char *end_of_links(const char *path)
{
    char end[PATH_MAX];
    if (realpath(path, end))
        return copy_of(end);
    return errno == ENOENT ? copy_of(path) : NULL;
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
    return copy_of(path);
}

static FILE *create_new(const char *name, const char *target)
{
    (void)target;
    return fopen(name, "wbx");
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

/* Ends r, whose file is closed if there was one, and removes it unless `good`. Returns `good`, keeps errno. */
static int finish(vndf_replacement *r, int good)
{
    int reason = errno;
    if (!good && r->file)
        remove(r->temporary);
    free(r->target);
    free(r->temporary);
    *r = (vndf_replacement){NULL, NULL, NULL};
    errno = reason;
    return good;
}

/* To vndf.NUMBER.tmp in the folder of the target, with the first number that no other write or crash has taken. */
int vndf_replace_begin(vndf_replacement *r, const char *path)
{
    *r = (vndf_replacement){end_of_links(path), NULL, NULL};
    size_t folder = r->target ? strlen(r->target) : 0;
    while (folder && r->target[folder - 1] != '/')
        folder--;
    r->temporary = r->target ? copy_of(r->target) : NULL;
    for (int i = 0; r->temporary && !r->file && i < NAMES_MAX && (i == 0 || errno == EEXIST); i++) {
        snprintf(r->temporary + folder, SUFFIX_MAX, "vndf.%d.tmp", i);
        r->file = create_new(r->temporary, r->target);
    }
    return r->file ? 1 : finish(r, 0);
}

/* Synced before the rename, so that a crash leaves the old file or the new one. */
int vndf_replace_commit(vndf_replacement *r)
{
    int good = vndf_replace_flush(r->file) && reaches_disk(r->file), reason = errno, closed = fclose(r->file) == 0;
    if (!good)
        errno = reason;
    return finish(r, good && closed && rename(r->temporary, r->target) == 0);
}

void vndf_replace_discard(vndf_replacement *r)
{
    fclose(r->file);
    finish(r, 0);
}

int vndf_replace_whole(const char *path, const void *bytes, size_t size)
{
    vndf_replacement r;
    if (!vndf_replace_begin(&r, path))
        return 0;
    fwrite(bytes, 1, size, r.file);
    return vndf_replace_commit(&r);
}
