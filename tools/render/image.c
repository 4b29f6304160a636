/* Images in memory, and their files.
 *
 * PFM is a line "PF" (colour) or "Pf" (grey), a line "WIDTH HEIGHT", a line with a scale, whose sign tells the
 * byte order (negative: the least byte first), and floats, rows from the bottom. The absolute value of the scale
 * has no agreed meaning and is not read. Floats are read and written byte by byte: the order of this machine's
 * bytes does not matter. */
#include "render/image.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/files.h"
#include "draw/png.h"

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

/* The pixel whose centre is before u of a row that repeats, the one after it, and the way between them. */
static double pair_of(double u, int count, int *one, int *other)
{
    double place = (u - floor(u)) * count - 0.5, before = floor(place);
    *one = before < 0 ? count - 1 : (int)before;
    *other = *one + 1 < count ? *one + 1 : 0;
    return place - before;
}

void image_bilinear(const image *of, double u, double v, float rgb[3])
{
    int x0, x1, y0, y1;
    float a = (float)pair_of(u, of->width, &x0, &x1), b = (float)pair_of(v, of->height, &y0, &y1);
    const float *p = image_pixel(of, x0, y0), *q = image_pixel(of, x1, y0);
    const float *r = image_pixel(of, x0, y1), *s = image_pixel(of, x1, y1);
    for (int i = 0; i < 3; i++) {
        float upper = p[i] + a * (q[i] - p[i]), lower = r[i] + a * (s[i] - r[i]);
        rgb[i] = upper + b * (lower - upper);
    }
}

/* ---- reading ---- */

enum { HEAD_MAX = 128 }; /* bytes of the three lines */

typedef struct pfm_head {
    int channels, width, height, is_little;
    size_t size; /* of the three lines */
} pfm_head;

PRINTF_LIKE(3, 4) static int refuse(image_error *error, const char *name, const char *format, ...)
{
    int head = snprintf(error->message, sizeof error->message, "%.400s: ", name);
    va_list list;
    va_start(list, format);
    vsnprintf(error->message + head, sizeof error->message - (size_t)head, format, list);
    va_end(list);
    return 0;
}

static int read_side(const char *word, int *side)
{
    char *end;
    long value = strtol(word, &end, 10);
    *side = value > 0 && value <= IMAGE_SIDE_MAX ? (int)value : 0;
    return *end == '\0' && *side > 0;
}

static int read_head(const char *bytes, size_t size, pfm_head *head, const char *name, image_error *error)
{
    char text[HEAD_MAX + 1] = "", kind[4] = "", width[32], height[32], order[32], *end;
    int at = 0;
    memcpy(text, bytes, size < HEAD_MAX ? size : HEAD_MAX);
    int found = sscanf(text, "%3s%31s%31s%31s%n", kind, width, height, order, &at);
    if (memcmp(text, kind, 2) != 0 || (strcmp(kind, "PF") != 0 && strcmp(kind, "Pf") != 0))
        return refuse(error, name, "this is no PFM image; it would begin with PF or Pf");
    if (found < 4 || !text[at] || !strchr(" \t\r\n", text[at]))
        return refuse(error, name, "the head of the PFM is not whole: after %s come width, height and a scale",
                      kind);
    if (!read_side(width, &head->width) || !read_side(height, &head->height))
        return refuse(error, name, "width %s and height %s: both must be whole numbers from 1 to %d", width,
                      height, IMAGE_SIDE_MAX);
    if ((int64_t)head->width * head->height > IMAGE_PIXELS_MAX)
        return refuse(error, name, "%s x %s pixels are more than %d", width, height, IMAGE_PIXELS_MAX);
    double order_of = strtod(order, &end);
    if (*end || !(fabs(order_of) > 0.0))
        return refuse(error, name, "'%s' must be a number other than 0; negative: the least byte comes first",
                      order);
    head->channels = kind[1] == 'F' ? 3 : 1;
    head->is_little = order_of < 0.0;
    head->size = (size_t)at + (text[at] == '\r' && text[at + 1] == '\n' ? 2 : 1);
    return 1;
}

static float float_from(const unsigned char *b, int is_little)
{
    uint32_t bits = is_little ? (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0]
                              : (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

int image_read_pfm_bytes(image *made, const char *name, const void *bytes, size_t size, image_error *error)
{
    pfm_head head = {0};
    *made = (image){0, 0, NULL};
    if (!read_head(bytes, size, &head, name, error))
        return 0;
    size_t want = (size_t)head.width * (size_t)head.height * (size_t)head.channels * 4, have = size - head.size;
    if (have != want)
        return refuse(error, name, "%d x %d pixels take %zu bytes after the head, and there are %zu", head.width,
                      head.height, want, have);
    if (!image_make(made, head.width, head.height))
        return refuse(error, name, "there is no memory for %d x %d pixels", head.width, head.height);
    const unsigned char *at = (const unsigned char *)bytes + head.size;
    for (int y = made->height - 1; y >= 0; y--)
        for (int x = 0; x < made->width; x++, at += 4 * head.channels)
            for (int i = 0; i < 3; i++) {
                float value = float_from(at + (head.channels == 3 ? 4 * i : 0), head.is_little);
                image_pixel(made, x, y)[i] = value;
                if (isfinite(value))
                    continue;
                image_free(made);
                return refuse(error, name, "the pixel in column %d of row %d (from the top, from 0) is not finite",
                              x, y);
            }
    return 1;
}

int image_read_pfm(image *made, const char *path, image_error *error)
{
    char reason[128];
    size_t size;
    *made = (image){0, 0, NULL};
    char *bytes = files_read(path, (size_t)IMAGE_PIXELS_MAX * 12 + HEAD_MAX, &size, reason, sizeof reason);
    if (!bytes)
        return refuse(error, path, "%s", reason);
    int good = image_read_pfm_bytes(made, path, bytes, size, error);
    free(bytes);
    return good;
}

/* ---- writing ---- */

int image_write_pfm(FILE *file, const image *written)
{
    unsigned char bytes[4];
    uint32_t bits;
    fprintf(file, "PF\n%d %d\n-1.0\n", written->width, written->height);
    for (int y = written->height - 1; y >= 0; y--)
        for (int i = 0; i < 3 * written->width; i++) {
            memcpy(&bits, image_pixel(written, 0, y) + i, sizeof bits);
            for (int k = 0; k < 4; k++)
                bytes[k] = (unsigned char)(bits >> 8 * k & 255u);
            fwrite(bytes, 1, sizeof bytes, file);
        }
    return fflush(file) == 0 && !ferror(file);
}

/* IEC 61966-2-1 */
static unsigned char srgb(float linear)
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
        rgb[i] = srgb(exposure * written->rgb[i]);
    int good = png_write_rgb(file, rgb, (size_t)written->width, (size_t)written->height);
    free(rgb);
    return good && fflush(file) == 0 && !ferror(file);
}
