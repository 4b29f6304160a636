/* Compression for PNG: a zlib stream (RFC 1950) of one deflate block with the fixed codes (RFC 1951, 3.2.6). */
#ifndef TOOLS_DRAW_DEFLATE_H
#define TOOLS_DRAW_DEFLATE_H

#include <stddef.h>

/* The stream of `size` bytes; the caller frees it. NULL if there is no memory. */
unsigned char *deflate_bytes(const unsigned char *data, size_t size, size_t *packed);

#endif
