/* Images as PNG: with a palette, in base64, for a data: URI; and of red, green and blue, to a file. */
#ifndef TOOLS_DRAW_PNG_H
#define TOOLS_DRAW_PNG_H

#include <stddef.h>
#include <stdio.h>

typedef struct png_colour {
    unsigned char red, green, blue;
} png_colour;

/* Bytes as text, without line breaks. */
void base64_write(FILE *file, const unsigned char *data, size_t size);

/* Writes width x height palette indices (rows from the top) as base64; index 0 is transparent. 0 if there is no
 * memory. */
int png_write_base64(FILE *file, const unsigned char *index, size_t width, size_t height,
                     const png_colour palette[256]);

/* Writes width x height pixels of three bytes, rows from the top. 0 if there is no memory or writing fails. */
int png_write_rgb(FILE *file, const unsigned char *rgb, size_t width, size_t height);

#endif
