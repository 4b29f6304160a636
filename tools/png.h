/* A palette image as a PNG in base64, for a data: URI. */
#ifndef TOOLS_PNG_H
#define TOOLS_PNG_H

#include <stddef.h>
#include <stdio.h>

typedef struct colour {
    unsigned char red, green, blue;
} colour;

/* Writes width x height palette indices (rows from the top) as base64; index 0 is transparent. 0 if there is no
 * memory. */
int png_write_base64(FILE *file, const unsigned char *index, size_t width, size_t height,
                     const colour palette[256]);

#endif
