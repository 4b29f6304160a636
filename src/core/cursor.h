/* A bounded little-endian cursor over bytes: reads past the end give zeros and set `failed`. Bytes that grow, and files
 * that are read at once. */
#ifndef VNDF_CORE_CURSOR_H
#define VNDF_CORE_CURSOR_H

#include <stddef.h>
#include <stdint.h>

#include "vndf.h"

typedef struct vndf_reader {
    const unsigned char *bytes;
    size_t size, at;
    int failed;
} vndf_reader;

/* Bytes to be freed; a zeroed one is empty. It remembers a failed allocation, and then takes no more. */
typedef struct vndf_writer {
    unsigned char *bytes;
    size_t size, capacity;
    int failed;
} vndf_writer;

/* The next n bytes, or NULL (and failed) if fewer are left. */
const unsigned char *vndf_read_bytes(vndf_reader *reader, size_t n);
uint32_t vndf_read_u32(vndf_reader *reader);
float vndf_read_f32(vndf_reader *reader);
double vndf_read_f64(vndf_reader *reader);

/* A terminated copy, to be freed, of the next length-prefixed text; NULL if there is no text (the reader fails) or no
 * memory. */
char *vndf_read_text(vndf_reader *reader);

void vndf_write_bytes(vndf_writer *writer, const void *bytes, size_t n);
void vndf_write_u32(vndf_writer *writer, uint32_t value);
void vndf_write_f32(vndf_writer *writer, float value);
void vndf_write_f64(vndf_writer *writer, double value);
void vndf_write_text(vndf_writer *writer, const char *text);

/* The bytes of a file, to be freed; of one that has more than `most`, most + 1 of them, since a pipe may be endless.
 * NULL and an error that names the file. */
unsigned char *vndf_read_file(const char *path, size_t most, size_t *size, vndf_error *error);

#endif
