/* A bounded little-endian cursor over bytes: reads past the end give zeros and set `failed`. Bytes that grow, files
 * that are read at once, and what our files have in common. */
#ifndef VNDF_CORE_CURSOR_H
#define VNDF_CORE_CURSOR_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

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

/* A terminated copy, to be freed, of the next length-prefixed text, of one line or of `lines`; NULL if there is no text
 * (the reader fails) or no memory. */
char *vndf_read_text(vndf_reader *reader, int lines);

void vndf_write_bytes(vndf_writer *writer, const void *bytes, size_t n);
void vndf_write_u32(vndf_writer *writer, uint32_t value);
void vndf_write_f32(vndf_writer *writer, float value);
void vndf_write_f64(vndf_writer *writer, double value);
void vndf_write_text(vndf_writer *writer, const char *text);

/* The bytes of a file, with a 0 behind them, to be freed; of one that has more than `most`, most + 1 of them, since a
 * pipe may be endless. NULL and errno, or an error that names the file. */
unsigned char *vndf_read_all(FILE *file, size_t most, size_t *size);
unsigned char *vndf_read_file(const char *path, size_t most, size_t *size, vndf_error *error);

/* ---- our files ----
 *
 * 8 bytes of magic, u32 version, u32 size of the whole, ..., u32 CRC-32 of all bytes before it. Bytes are not trusted.
 */
enum { VNDF_FRAME_HEAD = 16 };

typedef struct vndf_frame {
    const char *magic;      /* 7 printable characters and a line feed */
    const char *name;       /* of such a file, for messages: "table" */
    uint32_t version, most; /* bytes */
} vndf_frame;

/* VNDF_OK if magic, version, size and checksum are right; else VNDF_ERROR_TABLE. */
vndf_status vndf_frame_check(const vndf_frame *frame, const unsigned char *bytes, size_t size, vndf_error *error);

/* What `decode`, which checks the frame, makes of the bytes of a file; NULL and an error that names the file. */
typedef void *vndf_frame_decode(const void *bytes, size_t size, vndf_error *error);
void *vndf_frame_load(const vndf_frame *frame, const char *path, vndf_frame_decode *decode, vndf_error *error);

/* The first bytes of a file; its size and the checksum at its end. */
void vndf_frame_begin(const vndf_frame *frame, vndf_writer *writer);
void vndf_frame_end(vndf_writer *writer);

/* Saves to a file, whole or not at all (replace_file.h); where the path is NULL to memory, whose size must be that of
 * all. Frees the bytes. */
vndf_status vndf_frame_save(vndf_writer *writer, const char *path, void *bytes, size_t size, vndf_error *error);

#endif
