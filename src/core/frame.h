/* What our files have in common: 8 bytes of magic, u32 version, u32 size of the whole, ..., u32 CRC-32 of all bytes
 * before it. Little-endian. Bytes are not trusted. */
#ifndef VNDF_CORE_FRAME_H
#define VNDF_CORE_FRAME_H

#include <stddef.h>
#include <stdint.h>

#include "vndf.h"

enum { VNDF_FRAME_HEAD = 16 };

typedef struct vndf_frame {
    const char *magic;      /* 7 printable characters and a line feed */
    const char *name;       /* of such a file, for messages: "table" */
    uint32_t version, most; /* bytes */
} vndf_frame;

/* VNDF_OK if magic, version, size and checksum are right; else VNDF_ERROR_TABLE. */
vndf_status vndf_frame_check(const vndf_frame *frame, const unsigned char *bytes, size_t size, vndf_error *error);

/* The whole of a file, to be freed; NULL and an error. It reads no more than the head states, and one byte. Magic and
 * version are checked, the rest is not. */
unsigned char *vndf_frame_read(const vndf_frame *frame, const char *path, size_t *size, vndf_error *error);

#endif
