/* Images in memory, and their files.
 *
 * A file is a head of four words - "PF" (colour) or "Pf" (grey), "P6" or "P5", then width, height and a number - and
 * one blank; from # on, a line of it is a comment. Of PFM the number is a scale, whose sign tells the byte order
 * (negative: the least byte first) and whose absolute value has no agreed meaning and is not read; floats follow,
 * rows from the bottom. Of PPM and PGM it is the largest value, and whole numbers of 8 or 16 bits follow, the greater
 * byte first, rows from the top. Numbers are read and written byte by byte: the order of this machine's bytes does
 * not matter. */
#include "render/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/files.h"
#include "draw/png.h"
#include "render/lines.h"

int image_make(image *made, int width, int height)
{
    *made = (image){0};
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
    *freed = (image){0};
}

/* The pixel whose centre is before u of a row that repeats, the one after it, and the way between them. */
static double pair_of(double u, int count, int *one, int *other)
{
    const double place = (u - floor(u)) * count - 0.5, before = floor(place);
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

typedef struct image_head {
    char word[4][32];
    int is_float, channels, width, height, is_little;
    unsigned each; /* bytes a number */
    double most;   /* of whole numbers */
    size_t size;
} image_head;

/* A whole number from 1 to `most`, or 0. */
static int read_side(const char *word, int most)
{
    char *end;
    const long value = strtol(word, &end, 10);
    return *end == '\0' && value > 0 && value <= most ? (int)value : 0;
}

/* Four words and the blank behind them. */
static int read_head(const char *bytes, size_t size, image_head *head, const char *name, vndf_error *error)
{
    char text[HEAD_MAX + 1] = "", *behind;
    const char *kind = head->word[0], *number = head->word[3];
    int end = 0;
    memcpy(text, bytes, size < HEAD_MAX ? size : HEAD_MAX);
    for (char *at = text; (at = strchr(at, '#')) != NULL;)
        memset(at, ' ', strcspn(at, "\n"));
    sscanf(text, " %31s %31s %31s %31s%n", head->word[0], head->word[1], head->word[2], head->word[3], &end);
    if (strlen(kind) != 2 || kind[0] != 'P' || !strchr("Ff56", kind[1]))
        return refuse_at(error, name, 0, "this is no PFM, PGM or PPM image, which begins with PF, Pf, P5 or P6");
    head->is_float = kind[1] == 'F' || kind[1] == 'f';
    if (!end || !text[end])
        return refuse_at(error, name, 0, "the head is not whole: after %s come width, height, %s and a blank",
                         kind, head->is_float ? "a scale" : "the largest value");
    const double order = strtod(number, &behind);
    head->channels = kind[1] == 'F' || kind[1] == '6' ? 3 : 1;
    head->width = read_side(head->word[1], IMAGE_SIDE_MAX);
    head->height = read_side(head->word[2], IMAGE_SIDE_MAX);
    head->most = read_side(number, 65535);
    head->is_little = head->is_float && order < 0.0;
    head->each = head->is_float ? 4 : head->most > 255 ? 2 : 1;
    head->size = (size_t)end + (text[end] == '\r' && text[end + 1] == '\n' ? 2 : 1);
    if (!head->width || !head->height || (int64_t)head->width * head->height > IMAGE_PIXELS_MAX)
        return refuse_at(error, name, 0, "%s x %s pixels: sides are from 1 to %d, and there are %d pixels at most",
                         head->word[1], head->word[2], IMAGE_SIDE_MAX, IMAGE_PIXELS_MAX);
    return (head->is_float ? !*behind && fabs(order) > 0.0 : head->most > 0) ||
           refuse_at(error, name, 0, "'%s' must be %s", number,
                     head->is_float ? "a number other than 0; negative: the least byte comes first"
                                    : "the largest value, from 1 to 65535");
}

static float number_at(const unsigned char *b, const image_head *head)
{
    uint32_t bits = 0;
    float value;
    for (unsigned i = 0; i < head->each; i++)
        bits = bits << 8 | b[head->is_little ? head->each - 1 - i : i];
    memcpy(&value, &bits, sizeof value);
    return head->is_float ? value : (float)(bits / head->most);
}

int image_read_bytes(image *made, const char *name, const void *bytes, size_t size, vndf_error *error)
{
    image_head head = {.is_float = 0};
    *made = (image){0};
    if (!read_head(bytes, size, &head, name, error))
        return 0;
    const size_t pixel = (size_t)head.channels * head.each,
                 want = (size_t)head.width * (size_t)head.height * pixel;
    if (size - head.size != want)
        return refuse_at(error, name, 0, "%d x %d pixels take %zu bytes after the head, and there are %zu",
                         head.width, head.height, want, size - head.size);
    if (!image_make(made, head.width, head.height))
        return refuse_at(error, name, 0, "there is no memory for %d x %d pixels", head.width, head.height);
    made->channels = head.channels;
    made->quantum = head.is_float ? 0 : 1 / head.most;
    const unsigned char *at = (const unsigned char *)bytes + head.size;
    for (int row = 0; row < made->height; row++)
        for (int x = 0; x < made->width; x++, at += pixel)
            for (unsigned i = 0; i < 3; i++) {
                const int y = head.is_float ? made->height - 1 - row : row;
                const float value = number_at(at + (head.channels == 3 ? i * head.each : 0), &head);
                image_pixel(made, x, y)[i] = value;
                if (isfinite(value))
                    continue;
                image_free(made);
                return refuse_at(error, name, 0,
                                 "the pixel in column %d of row %d (from the top, from 0) is not finite", x, y);
            }
    return 1;
}

/* ---- writing ---- */

int image_write_pfm(FILE *file, const image *written)
{
    fprintf(file, "PF\n%d %d\n-1.0\n", written->width, written->height);
    for (int y = written->height - 1; y >= 0; y--)
        put_floats(file, image_pixel(written, 0, y), 3 * (size_t)written->width);
    return fflush(file) == 0 && !ferror(file);
}

/* IEC 61966-2-1 */
static unsigned char srgb(float linear)
{
    float x = linear > 0.0f ? (linear < 1.0f ? linear : 1.0f) : 0.0f; /* NaN: 0 */
    float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1.0f / 2.4f) - 0.055f;
    return (unsigned char)(255.0f * encoded + 0.5f);
}

int image_write_png(FILE *file, const image *written)
{
    size_t count = (size_t)written->width * (size_t)written->height * 3;
    unsigned char *rgb = malloc(count);
    if (!rgb)
        return 0;
    for (size_t i = 0; i < count; i++)
        rgb[i] = srgb(written->rgb[i]);
    int good = png_write(file, rgb, (size_t)written->width, (size_t)written->height, NULL);
    free(rgb);
    return good && fflush(file) == 0 && !ferror(file);
}
