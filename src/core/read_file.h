/* Whole files that are read at once. */
#ifndef VNDF_CORE_READ_FILE_H
#define VNDF_CORE_READ_FILE_H

#include <stddef.h>

#include "vndf.h"

/* The bytes of a file, to be freed; of one that has more than `most`, most + 1 of them, since a pipe may be endless.
 * NULL and an error that names the file. */
unsigned char *vndf_read_file(const char *path, size_t most, size_t *size, vndf_error *error);

#endif
