#include "render/whole_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/files.h"

static const char *why(void)
{
    return errno ? strerror(errno) : "it cannot be read";
}

/* Grows by half as it reads: a pipe or a device does not tell its length beforehand. */
static char *read_all(FILE *file, size_t most, size_t *size, char *reason, size_t reason_size)
{
    size_t room = 65536, count = 0;
    char *bytes = malloc(room);
    while (bytes) {
        count += fread(bytes + count, 1, room - 1 - count, file);
        if (count < room - 1 || count > most)
            break;
        room += room / 2;
        char *larger = realloc(bytes, room);
        if (!larger)
            free(bytes);
        bytes = larger;
    }
    *size = count;
    if (!bytes)
        snprintf(reason, reason_size, "there is no memory for it");
    else if (ferror(file))
        snprintf(reason, reason_size, "%s", why());
    else if (count > most)
        snprintf(reason, reason_size, "it has more than %zu bytes", most);
    else {
        bytes[count] = '\0';
        return bytes;
    }
    free(bytes);
    return NULL;
}

char *whole_file(const char *path, size_t most, size_t *size, char *reason, size_t reason_size)
{
    const char *role = files_note_input(path);
    if (role) {
        snprintf(reason, reason_size, "it is %s as well", role);
        return NULL;
    }
    errno = 0;
    FILE *file = fopen(path, "rb");
    if (!file) {
        snprintf(reason, reason_size, "%s", why());
        return NULL;
    }
    char *bytes = read_all(file, most, size, reason, reason_size);
    fclose(file);
    return bytes;
}
