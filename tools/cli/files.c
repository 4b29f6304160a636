#define _XOPEN_SOURCE 700
#include "cli/files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/arguments.h"
#include "core/cursor.h"

enum { NOTED_MAX = 4096 };

static struct {
    dev_t device;
    ino_t inode;
    int is_output;
} noted[NOTED_MAX];
static size_t noted_count;

const char *files_note(const char *path, int is_output)
{
    struct stat file;
    if (stat(path, &file) != 0 || !S_ISREG(file.st_mode))
        return NULL;
    for (size_t i = 0; i < noted_count; i++)
        if (noted[i].device == file.st_dev && noted[i].inode == file.st_ino && noted[i].is_output != is_output)
            return is_output ? "an input of this command" : "an output of this command";
    if (noted_count == NOTED_MAX)
        return "one file more than this program reads";
    noted[noted_count].device = file.st_dev;
    noted[noted_count].inode = file.st_ino;
    noted[noted_count++].is_output = is_output;
    return NULL;
}

static int same_inode(const char *a, const char *b)
{
    struct stat of_a, of_b;
    return stat(a, &of_a) == 0 && stat(b, &of_b) == 0 && of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
}

/* What is not there yet is known by its last name and its folder. */
int files_same(const char *a, const char *b)
{
    const char *slash_a = strrchr(a, '/'), *slash_b = strrchr(b, '/');
    const char *last_a = slash_a ? slash_a + 1 : a, *last_b = slash_b ? slash_b + 1 : b;
    char in_a[4096], in_b[4096];
    snprintf(in_a, sizeof in_a, "%.*s.", (int)(last_a - a), a);
    snprintf(in_b, sizeof in_b, "%.*s.", (int)(last_b - b), b);
    return same_inode(a, b) || (strcmp(last_a, last_b) == 0 && same_inode(in_a, in_b));
}

const char *input_name(const char *path)
{
    return strcmp(path, "-") == 0 ? "stdin" : path;
}

char *input_read(const char *command, const char *path, size_t most, size_t *size)
{
    static int stdin_is_taken; /* what is read once is gone */
    const int is_stdin = strcmp(path, "-") == 0;
    const char *role = is_stdin ? stdin_is_taken++ ? "read already" : NULL : files_note(path, 0);
    FILE *file = role ? NULL : is_stdin ? stdin : fopen(path, "rb");
    char *bytes = file ? (char *)vndf_read_all(file, most, size) : NULL;
    const char *reason = role ? role : strerror(errno);
    if (file && !is_stdin)
        fclose(file);
    if (!bytes)
        return complain(command, "cannot read %s: %s%s", input_name(path), role ? "it is " : "", reason), NULL;
    if (*size <= most)
        return bytes;
    free(bytes);
    return complain(command, "cannot read %s: it has more than %zu bytes", input_name(path), most), NULL;
}

uint64_t little_whole(const unsigned char *at, size_t bytes)
{
    uint64_t value = 0;
    for (size_t i = 0; i < bytes; i++)
        value |= (uint64_t)at[i] << 8 * i;
    return value;
}

double little_number(const unsigned char *at, size_t bytes)
{
    const uint64_t bits = little_whole(at, bytes);
    const uint32_t low = (uint32_t)bits;
    float narrow;
    double wide;
    memcpy(&narrow, &low, sizeof narrow);
    memcpy(&wide, &bits, sizeof wide);
    return bytes == 4 ? (double)narrow : wide;
}

void put_little(FILE *file, uint64_t value, size_t bytes)
{
    for (size_t i = 0; i < bytes; i++)
        fputc((int)(value >> 8 * i & 255), file);
}

void floats_to_bytes(unsigned char *bytes, const float *x, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, x + i, sizeof bits);
        for (size_t k = 0; k < 4; k++)
            bytes[4 * i + k] = (unsigned char)(bits >> 8 * k & 255);
    }
}

void put_floats(FILE *file, const float *x, size_t count)
{
    unsigned char bytes[4];
    for (size_t i = 0; i < count; i++) {
        floats_to_bytes(bytes, x + i, 1);
        fwrite(bytes, 1, sizeof bytes, file);
    }
}
