/* Images in memory, and looking pixels up. */
#include "render/image/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int image_make(image *made, int width, int height)
{
    *made = (image){0, 0, NULL};
    if (width < 1 || height < 1 || width > IMAGE_SIDE_MAX || height > IMAGE_SIDE_MAX)
        return 0;
    made->rgb = calloc((size_t)width * (size_t)height, 3 * sizeof *made->rgb);
    if (!made->rgb)
        return 0;
    made->width = width;
    made->height = height;
    return 1;
}

void image_free(image *freed)
{
    free(freed->rgb);
    *freed = (image){0, 0, NULL};
}

void image_at(const image *of, int x, int y, float rgb[3])
{
    memcpy(rgb, of->rgb + 3 * ((size_t)y * (size_t)of->width + (size_t)x), 3 * sizeof *rgb);
}

/* The place of u in a row that repeats, in pixels: [0, count). The product may round up to count; u may be any
 * float. */
static inline float repeated(float u, int count)
{
    float inside = u >= 0.0f && u < 1.0f ? u : u - floorf(u), place = inside * (float)count;
    return place >= 0.0f && place < (float)count ? place : 0.0f;
}

/* Interpolates between the centres of four pixels, which lie at halves. */
void image_bilinear(const image *of, float u, float v, float rgb[3])
{
    float x = repeated(u, of->width) - 0.5f, y = repeated(v, of->height) - 0.5f;
    int left = (int)x - (x < 0.0f), top = (int)y - (y < 0.0f); /* both are above -1 */
    int x0 = left < 0 ? of->width - 1 : left, y0 = top < 0 ? of->height - 1 : top;
    int x1 = x0 + 1 < of->width ? x0 + 1 : 0, y1 = y0 + 1 < of->height ? y0 + 1 : 0;
    float a = x - (float)left, b = y - (float)top;
    float corner[4][3];
    image_at(of, x0, y0, corner[0]);
    image_at(of, x1, y0, corner[1]);
    image_at(of, x0, y1, corner[2]);
    image_at(of, x1, y1, corner[3]);
    for (int i = 0; i < 3; i++) {
        float upper = corner[0][i] + a * (corner[1][i] - corner[0][i]);
        float lower = corner[2][i] + a * (corner[3][i] - corner[2][i]);
        rgb[i] = upper + b * (lower - upper);
    }
}
