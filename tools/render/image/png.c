/* An image for the eye: 8 bits in sRGB (IEC 61966-2-1); values above white are white. */
#include <math.h>
#include <stdlib.h>

#include "draw/png.h"
#include "render/image/image.h"

static unsigned char level_of(float linear)
{
    float x = linear > 0.0f ? (linear < 1.0f ? linear : 1.0f) : 0.0f; /* NaN: 0 */
    float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1.0f / 2.4f) - 0.055f;
    return (unsigned char)(255.0f * encoded + 0.5f);
}

int image_write_png(FILE *file, const image *written, float exposure)
{
    size_t count = (size_t)written->width * (size_t)written->height * 3;
    unsigned char *rgb = malloc(count);
    if (!rgb)
        return 0;
    for (size_t i = 0; i < count; i++)
        rgb[i] = level_of(exposure * written->rgb[i]);
    int good = png_write_rgb(file, rgb, (size_t)written->width, (size_t)written->height);
    free(rgb);
    return good && fflush(file) == 0 && !ferror(file);
}
