#define _POSIX_C_SOURCE 200809L
#include "draw/folder.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/arguments.h"
#include "command.h"
#include "cli/output.h"

enum { HEAD_BYTES = 1024 };

static char *path_in(const char *folder, const char *name)
{
    size_t size = strlen(folder) + strlen(name) + 2;
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s", folder, name);
    return path;
}

/* ---- what is there ------------------------------------------------------------------------------- */

static int has_our_page(const char *command, const char *folder)
{
    char head[HEAD_BYTES + 1], mark[PAGE_MARK_MAX];
    char *path = path_in(folder, "index.html");
    FILE *file = path ? fopen(path, "rb") : NULL;
    free(path);
    if (!file)
        return 0;
    head[fread(head, 1, HEAD_BYTES, file)] = '\0';
    fclose(file);
    page_mark(mark, command);
    return strstr(head, mark) != NULL;
}

/* Returns 1 or 0; -1 if the folder cannot be read. */
static int is_empty(const char *folder)
{
    DIR *directory = opendir(folder);
    const struct dirent *entry;
    int empty = 1;
    if (!directory)
        return -1;
    while (empty && (entry = readdir(directory)) != NULL)
        empty = strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0;
    closedir(directory);
    return empty;
}

/* Whether a folder can be made at `path`: the folder around it must exist. */
static int can_be_made(const char *path)
{
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/')
        length--;
    while (length > 0 && path[length - 1] != '/')
        length--;
    char *parent = malloc(length + 2);
    if (!parent)
        return 0;
    snprintf(parent, length + 2, "%.*s", length ? (int)length : 1, length ? path : ".");
    int good = access(parent, W_OK | X_OK) == 0;
    int reason = errno;
    free(parent);
    errno = reason;
    return good;
}

folder_state folder_examine(const char *command, const char *path)
{
    struct stat status;
    if (path[0] == '\0') {
        complain(command, "the name of the folder is empty");
        return FOLDER_REFUSED;
    }
    if (output_is_stdout(path)) {
        complain(command, "'-' is stdout, and this needs a folder for its files; one of that name is './-'");
        return FOLDER_REFUSED;
    }
    if (stat(path, &status) != 0 && errno == ENOENT) {
        if (can_be_made(path))
            return FOLDER_NEW;
        complain(command, "cannot make the folder '%s': %s", path, strerror(errno));
        return FOLDER_REFUSED;
    }
    int empty = is_empty(path);
    if (empty < 0)
        complain(command, "'%s' is no folder that can be read: %s", path, strerror(errno));
    else if (access(path, W_OK | X_OK) != 0)
        complain(command, "cannot write into '%s': %s", path, strerror(errno));
    else if (!empty && !has_our_page(command, path))
        complain(command,
                 "'%s' has files in it, and no page of `%s`: name a new folder, an empty one, or one with such a "
                 "page, which is replaced",
                 path, command);
    else
        return empty ? FOLDER_EMPTY : FOLDER_OURS;
    return FOLDER_REFUSED;
}

/* ---- writing ------------------------------------------------------------------------------------- */

typedef struct opened_files {
    output_file output[PAGE_FILES_MAX];
    char *path[PAGE_FILES_MAX];
    size_t count;
} opened_files;

/* Whether the file is there already, byte for byte. Then it is left alone: it may be an input that the page only
 * repeats, as the reference of an earlier comparison. */
static int is_there(const char *path, const page_file *file)
{
    char part[4096];
    size_t done = 0, got;
    struct stat status;
    FILE *old = stat(path, &status) == 0 && S_ISREG(status.st_mode) ? fopen(path, "rb") : NULL;
    if (!old)
        return 0;
    while ((got = fread(part, 1, sizeof part, old)) > 0 && got <= file->size - done &&
           memcmp(part, file->text + done, got) == 0)
        done += got;
    fclose(old);
    return got == 0 && done == file->size;
}

static int write_temporary(opened_files *opened, const char *command, const char *folder, const page_file *file)
{
    output_file *output = &opened->output[opened->count];
    char *path = path_in(folder, file->name);
    if (!path)
        return complain(command, "no memory");
    int repeats = is_there(path, file);
    if (repeats || !output_open(output, command, path)) {
        free(path);
        return repeats ? STATUS_GOOD : STATUS_USE;
    }
    opened->path[opened->count++] = path;
    if (fwrite(file->text, 1, file->size, output->file) == file->size && fflush(output->file) == 0)
        return STATUS_GOOD;
    return complain(command, "cannot write '%s': %s", path, strerror(errno));
}

/* Removes the files that are not committed, without a message: the reason has been reported. */
static void give_up(opened_files *opened, size_t from)
{
    for (size_t i = from; i < opened->count; i++)
        output_discard(&opened->output[i]);
}

static int commit(opened_files *opened)
{
    for (size_t i = 0; i < opened->count; i++)
        if (output_commit(&opened->output[i]) != STATUS_GOOD) {
            give_up(opened, i + 1);
            return STATUS_USE;
        }
    return STATUS_GOOD;
}

/* Renames the page, which is the first file, last, so that no new page stands beside old data. */
static int write_files(const char *command, const char *folder, const page_file *files, size_t count,
                       unsigned held)
{
    opened_files opened = {.count = 0};
    int status = STATUS_GOOD;
    for (size_t i = count; i-- > 0 && status == STATUS_GOOD;)
        status = write_temporary(&opened, command, folder, &files[i]);
    if (status == STATUS_GOOD && output_stopping(held))
        status = complain(command, "interrupted; '%s' was not touched", folder);
    if (status == STATUS_GOOD)
        status = commit(&opened);
    else
        give_up(&opened, 0);
    for (size_t i = 0; i < opened.count; i++)
        free(opened.path[i]);
    return status;
}

int folder_write(const char *command, const char *path, const page_file *files, size_t count, unsigned held)
{
    int made = mkdir(path, 0777) == 0;
    if (!made && errno != EEXIST)
        return complain(command, "cannot make the folder '%s': %s", path, strerror(errno));
    int status = write_files(command, path, files, count, held);
    if (status != STATUS_GOOD && made)
        rmdir(path); /* fails, and the folder stays, if a file was committed */
    return status;
}
