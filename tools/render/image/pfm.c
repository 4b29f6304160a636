/* PFM, the portable float map: a line "PF" (colour) or "Pf" (grey), a line "WIDTH HEIGHT", a line with a scale -
 * whose sign tells the byte order, negative for the least byte first - and then floats, rows from the bottom.
 * The absolute value of the scale has no agreed meaning; it is not read. Floats are read and written byte by byte,
 * so the byte order of this machine does not matter. */
#include "render/image/image.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "render/whole_file.h"

enum { HEAD_MAX = 128 }; /* bytes of the three lines */

typedef struct pfm_head {
    int channels, width, height, little;
    size_t size; /* of the three lines */
} pfm_head;

static int refuse(image_error *error, const char *name, const char *format, ...)
{
    int length = snprintf(error->message, sizeof error->message, "%.400s: ", name);
    va_list list;
    va_start(list, format);
    vsnprintf(error->message + length, sizeof error->message - (size_t)length, format, list);
    va_end(list);
    return 0;
}

/* ---- reading ---- */

/* Reads the next word of the head, of at most 31 letters, and the one blank that ends it; 0 if there is none. */
static int next_word(const char *bytes, size_t size, size_t *at, char word[32])
{
    size_t length = 0, most = size < HEAD_MAX ? size : HEAD_MAX;
    while (*at < most && length < 31 && bytes[*at] > ' ' && bytes[*at] <= '~')
        word[length++] = bytes[(*at)++];
    word[length] = '\0';
    if (!length || *at >= most || !strchr(" \t\r\n", bytes[*at]))
        return 0;
    *at += bytes[*at] == '\r' && *at + 1 < most && bytes[*at + 1] == '\n' ? 2 : 1;
    return 1;
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
    char kind[32], width[32], height[32], order[32], *end;
    size_t at = 0;
    if (size < 3 || bytes[0] != 'P' || (bytes[1] != 'F' && bytes[1] != 'f') ||
        !next_word(bytes, size, &at, kind) || kind[2])
        return refuse(error, name, "this is no PFM image; it would begin with PF or Pf");
    if (!next_word(bytes, size, &at, width) || !next_word(bytes, size, &at, height) ||
        !next_word(bytes, size, &at, order))
        return refuse(error, name, "the head of the PFM is not whole: after %s come width, height and a scale",
                      kind);
    head->channels = bytes[1] == 'F' ? 3 : 1;
    if (!read_side(width, &head->width) || !read_side(height, &head->height))
        return refuse(error, name, "width %s and height %s: both must be whole numbers from 1 to %d", width,
                      height, IMAGE_SIDE_MAX);
    if ((int64_t)head->width * head->height > IMAGE_PIXELS_MAX)
        return refuse(error, name, "%s x %s pixels are more than %d", width, height, IMAGE_PIXELS_MAX);
    double scale = strtod(order, &end);
    if (*end || !(fabs(scale) > 0.0))
        return refuse(error, name, "'%s' must be a number other than 0; negative: the least byte comes first",
                      order);
    head->little = scale < 0.0;
    head->size = at;
    return 1;
}

static float float_from(const unsigned char *b, int little)
{
    uint32_t bits = little ? (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0]
                           : (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Returns 0 at the first number that is not finite, with its place in x, y. */
static int read_rows(image *made, const pfm_head *head, const unsigned char *bytes, int *x, int *y)
{
    for (*y = made->height - 1; *y >= 0; --*y)
        for (*x = 0; *x < made->width; ++*x) {
            float *rgb = made->rgb + 3 * ((size_t)*y * (size_t)made->width + (size_t)*x);
            for (int i = 0; i < 3; i++) {
                rgb[i] = float_from(bytes + (head->channels == 3 ? 4 * i : 0), head->little);
                if (!isfinite(rgb[i]))
                    return 0;
            }
            bytes += 4 * head->channels;
        }
    return 1;
}

int image_read_pfm_bytes(image *made, const char *name, const void *bytes, size_t size, image_error *error)
{
    pfm_head head = {0};
    int x = 0, y = 0;
    *made = (image){0, 0, NULL};
    if (!read_head(bytes, size, &head, name, error))
        return 0;
    size_t want = (size_t)head.width * (size_t)head.height * (size_t)head.channels * 4, have = size - head.size;
    if (have != want)
        return refuse(error, name, "%d x %d pixels take %zu bytes after the head, and there are %zu", head.width,
                      head.height, want, have);
    if (!image_make(made, head.width, head.height))
        return refuse(error, name, "there is no memory for %d x %d pixels", head.width, head.height);
    if (read_rows(made, &head, (const unsigned char *)bytes + head.size, &x, &y))
        return 1;
    image_free(made);
    return refuse(error, name, "the pixel in column %d of row %d (from the top, from 0) is not finite", x, y);
}

int image_read_pfm(image *made, const char *path, image_error *error)
{
    char reason[128];
    size_t size;
    *made = (image){0, 0, NULL};
    char *bytes = whole_file(path, (size_t)IMAGE_PIXELS_MAX * 12 + HEAD_MAX, &size, reason, sizeof reason);
    if (!bytes)
        return refuse(error, path, "%s", reason);
    int good = image_read_pfm_bytes(made, path, bytes, size, error);
    free(bytes);
    return good;
}

/* ---- writing ---- */

static void put_float(unsigned char *b, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; i++)
        b[i] = (unsigned char)(bits >> 8 * i & 255u);
}

int image_write_pfm(FILE *file, const image *written)
{
    unsigned char pixel[12];
    fprintf(file, "PF\n%d %d\n-1.0\n", written->width, written->height);
    for (int y = written->height - 1; y >= 0; y--)
        for (int x = 0; x < written->width; x++) {
            float rgb[3];
            image_at(written, x, y, rgb);
            for (int i = 0; i < 3; i++)
                put_float(pixel + 4 * i, rgb[i]);
            fwrite(pixel, 1, sizeof pixel, file);
        }
    return fflush(file) == 0 && !ferror(file);
}
