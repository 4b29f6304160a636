/* Images of three floats a pixel, rows from the top: read from PFM, PGM or PPM, made by a named pattern, written as
 * PFM and as PNG (8 bits, sRGB). */
#pragma once

#include <stdio.h>

#include "cli/arguments.h"
#include "vndf.h"

typedef struct image {
    int width, height;
    float *rgb;     /* width * height * 3, owned */
    int channels;   /* of the file: 1 or 3 */
    double quantum; /* 1 over the largest whole number of the file; 0 of floats */
} image;

/* HEAD_MAX: bytes of the head of a file, with its comments. */
enum { IMAGE_SIDE_MAX = 16384, IMAGE_PIXELS_MAX = 1 << 25, HEAD_MAX = 1024 };
enum { IMAGE_BYTES_MAX = 12 * IMAGE_PIXELS_MAX + HEAD_MAX };

/* A black image. 0 if there is no memory, or a side is not within 1 to IMAGE_SIDE_MAX. */
int image_make(image *made, int width, int height);
void image_free(image *image);

static inline float *image_pixel(const image *of, int x, int y)
{
    return of->rgb + 3 * ((size_t)y * (size_t)of->width + (size_t)x);
}

/* Interpolates between the centres of pixels; u, v in [0, 1) from the left and the top, repeated outside. */
void image_bilinear(const image *of, double u, double v, float rgb[3]);

/* What is wrong with a file: "NAME: ...", control characters as '?'. Returns 0. */
int refuse_at(vndf_error *error, const char *name, const char *format, ...) PRINTF_LIKE(3, 4);

/* Reads an image: PFM of either byte order, whose numbers must be finite; binary PGM and PPM of 8 or 16 bits, 0 to 1.
 * A grey pixel has three equal numbers. Returns 1, or 0 and an error; bytes that are not trusted are safe. Errors
 * call the file `name`. */
int image_read_bytes(image *made, const char *name, const void *bytes, size_t size, vndf_error *error);

/* 0 if there are too many pixels, or there is no memory. */
typedef enum image_pattern { IMAGE_TILES, IMAGE_GRID, IMAGE_STUDIO } image_pattern;
int image_make_pattern(image *made, image_pattern of, int width, int height);

/* Writes to an open file; 0 if that fails. In a PNG numbers are clamped to [0, 1]. */
int image_write_pfm(FILE *file, const image *image);
int image_write_png(FILE *file, const image *image);
