/* Images as PNG, and bytes as base64. */
#pragma once

#include <stddef.h>
#include <stdio.h>

typedef struct png_colour {
    unsigned char red, green, blue;
} png_colour;

/* Bytes as text, without line breaks. */
void base64_write(FILE *file, const unsigned char *data, size_t size);

/* Writes width x height pixels, rows from the top: a file of three bytes a pixel; or, of indices into a palette whose
 * first colour is transparent, base64 for a data: URI. 0 if there is no memory or the file cannot be written. */
int png_write(FILE *file, const unsigned char *pixels, size_t width, size_t height, const png_colour *palette);
