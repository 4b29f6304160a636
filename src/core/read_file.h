/* A file that states its size in its first bytes, read whole and no farther: an endless file or pipe is not read for
 * ever. */
#ifndef VNDF_CORE_READ_FILE_H
#define VNDF_CORE_READ_FILE_H

#include <stddef.h>
#include <stdint.h>

#include "vndf.h"

/* Checks the first bytes; *stated becomes the size of the file that they state. Not VNDF_OK: an error. */
typedef vndf_status vndf_head_check(const unsigned char *bytes, size_t size, uint32_t *stated, vndf_error *error);

/* The bytes of the file, to be freed, whose first `head` bytes `check` accepts; no more than these state. NULL and an
 * error, which names the file. */
unsigned char *vndf_read_file(const char *path, size_t head, vndf_head_check *check, size_t *size,
                              vndf_error *error);

#endif
