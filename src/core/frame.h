/* What our files have in common: 8 bytes of magic, u32 version, u32 size of the whole, ..., u32 CRC-32 of all bytes
 * before it. Little-endian. Bytes are not trusted. */
#ifndef VNDF_CORE_FRAME_H
#define VNDF_CORE_FRAME_H

#include <stddef.h>
#include <stdint.h>

#include "core/cursor.h"
#include "vndf.h"

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
