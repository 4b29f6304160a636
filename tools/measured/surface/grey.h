/* PGM and PPM, binary, of 8 or 16 bits: a line "P5" (grey) or "P6" (colour), then width, height and the largest value
 * between blanks, with comments from # to the end of a line; one blank; then rows from the top, numbers of two bytes
 * with the greater byte first where the largest value is above 255. */
#ifndef TOOLS_MEASURED_SURFACE_GREY_H
#define TOOLS_MEASURED_SURFACE_GREY_H

#include "measured/refusal.h"

typedef struct grey_map {
    int channels, width, height, most; /* the largest value */
    const unsigned char *pixel;        /* of the bytes that were read */
} grey_map;

/* 1, or 0 and the reason; untrusted bytes are safe. The map is valid while the bytes are. */
int grey_read(grey_map *made, const char *name, const unsigned char *bytes, size_t size, refusal *why);

/* Number i, of channel i % channels, over the largest value. */
double grey_at(const grey_map *map, size_t i);

#endif
