/* Images in memory, and their files.
 *
 * A file is a head of four words - "PF" (colour) or "Pf" (grey), "P6" or "P5", then width, height and a number - and
 * one blank; from # on, a line of it is a comment. Of PFM the number is a scale, whose sign tells the byte order
 * (negative: the least byte first) and whose absolute value has no agreed meaning and is not read; floats follow,
 * rows from the bottom. Of PPM and PGM it is the largest value, and whole numbers of 8 or 16 bits follow, the greater
 * byte first, rows from the top. Numbers are read and written byte by byte: the order of this machine's bytes does
 * not matter. */
#include "render/image.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "cli/files.h"
#include "draw/png.h"

int refuse_at(vndf_error *error, const char *name, const char *format, ...)
{
    char *text = error->message;
    const size_t size = sizeof error->message, used = (size_t)snprintf(text, size, "%.360s: ", name);
    va_list list;
    va_start(list, format);
    vsnprintf(text + used, size - used, format, list);
    va_end(list);
    for (; *text; text++)
        *text = (unsigned char)*text < ' ' || *text == 127 ? '?' : *text;
    error->status = VNDF_ERROR_SYNTAX;
    return 0;
}

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
    int is_float, channels, is_little;
    double width, height, most; /* most: of whole numbers */
    unsigned each;              /* bytes a number */
    size_t size;
} image_head;

static int is_whole(double x, double most)
{
    return x >= 1 && x <= most && x == floor(x);
}

/* Four words and the blank behind them. */
static int read_head(const char *bytes, size_t size, image_head *head, const char *name, vndf_error *error)
{
    char text[HEAD_MAX + 1] = "", kind = '0';
    int end = 0;
    memcpy(text, bytes, size < HEAD_MAX ? size : HEAD_MAX);
    for (char *at = text; (at = strchr(at, '#')) != NULL;)
        memset(at, ' ', strcspn(at, "\n"));
    sscanf(text, " P%c %lf %lf %lf%n", &kind, &head->width, &head->height, &head->most, &end);
    if (!kind || !strchr("Ff56", kind))
        return refuse_at(error, name, "this is no PFM, PGM or PPM image, which begins with PF, Pf, P5 or P6");
    head->is_float = kind == 'F' || kind == 'f';
    head->channels = kind == 'F' || kind == '6' ? 3 : 1;
    if (!end || !isspace((unsigned char)text[end]))
        return refuse_at(error, name, "the head is not whole: after P%c come width, height, %s and a blank", kind,
                         head->is_float ? "a scale" : "the largest value");
    if (!is_whole(head->width, IMAGE_SIDE_MAX) || !is_whole(head->height, IMAGE_SIDE_MAX) ||
        head->width * head->height > IMAGE_PIXELS_MAX)
        return refuse_at(error, name, "%g x %g pixels: sides are from 1 to %d, and there are %d pixels at most",
                         head->width, head->height, IMAGE_SIDE_MAX, IMAGE_PIXELS_MAX);
    head->is_little = head->is_float && head->most < 0;
    head->each = head->is_float ? 4 : head->most > 255 ? 2 : 1;
    head->size = (size_t)end + (text[end] == '\r' && text[end + 1] == '\n' ? 2 : 1);
    return (head->is_float ? fabs(head->most) > 0 : is_whole(head->most, 65535)) ||
           refuse_at(error, name, "%g must be %s", head->most,
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
    const size_t pixel = (size_t)head.channels * head.each;
    const size_t want = (size_t)head.width * (size_t)head.height * pixel;
    if (size - head.size != want)
        return refuse_at(error, name, "%g x %g pixels take %zu bytes after the head, and there are %zu",
                         head.width, head.height, want, size - head.size);
    if (!image_make(made, (int)head.width, (int)head.height))
        return refuse_at(error, name, "there is no memory for %g x %g pixels", head.width, head.height);
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
                return refuse_at(error, name,
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

/* ---- patterns: formulas of (u, v), from the left and the top ---- */

static void blend(float rgb[3], const float other[3], float part)
{
    for (int i = 0; i < 3; i++)
        rgb[i] += part * (other[i] - rgb[i]);
}

static float smooth(float from, float to, float x)
{
    const float t = fminf(fmaxf((x - from) / (to - from), 0.0f), 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

static void shade_tiles(float u, float v, float rgb[3])
{
    rgb[0] = rgb[1] = rgb[2] = ((int)(u * 16.0f) + (int)(v * 16.0f)) % 2 ? 0.75f : 0.25f;
}

/* Distance to the nearest of `count` lines, in units of their distance. */
static float from_line(float u, float count)
{
    return fabsf(u * count - floorf(u * count + 0.5f));
}

static void shade_grid(float u, float v, float rgb[3])
{
    static const float red[3] = {0.75f, 0.08f, 0.05f};
    const int is_line = fminf(from_line(u, 48.0f), from_line(v, 24.0f)) < 0.1f;
    rgb[0] = rgb[1] = rgb[2] = is_line ? 0.05f : 0.85f;
    if (fminf(from_line(u, 16.0f), from_line(v, 8.0f)) < 0.03f)
        memcpy(rgb, red, sizeof red);
}

/* A grey room, brighter towards the zenith, over a floor that is dark at the horizon; soft boxes. */
static void shade_studio(float u, float v, float rgb[3])
{
    static const float wall[3] = {0.16f, 0.18f, 0.22f}, zenith[3] = {0.5f, 0.52f, 0.55f};
    static const float floor_near[3] = {0.3f, 0.28f, 0.26f}, floor_far[3] = {0.07f, 0.065f, 0.06f};
    static const struct {
        float longitude, latitude, width, height; /* of the middle and of half the sides, degrees */
        float rgb[3];
    } boxes[] = {
        {60.0f, 38.0f, 22.0f, 16.0f, {14.0f, 13.0f, 11.5f}},
        {155.0f, 34.0f, 8.0f, 30.0f, {6.0f, 6.6f, 8.0f}},
        {250.0f, 52.0f, 30.0f, 7.0f, {9.0f, 9.0f, 9.0f}},
        {320.0f, 20.0f, 5.0f, 16.0f, {10.0f, 7.0f, 4.0f}},
    };
    const float longitude = 360.0f * u, latitude = 90.0f - 180.0f * v;
    const int is_floor = latitude < 0.0f;
    memcpy(rgb, is_floor ? floor_far : wall, sizeof wall);
    blend(rgb, is_floor ? floor_near : zenith, smooth(0.0f, is_floor ? 70.0f : 90.0f, fabsf(latitude)));
    for (size_t i = 0; i < sizeof boxes / sizeof *boxes && !is_floor; i++) {
        const float away = fabsf(longitude - boxes[i].longitude), up = fabsf(latitude - boxes[i].latitude);
        const float across = fminf(away, 360.0f - away);
        blend(rgb, boxes[i].rgb,
              smooth(1.02f, 0.96f, across / boxes[i].width) * smooth(1.02f, 0.96f, up / boxes[i].height));
    }
}

/* A pixel is the mean of SIDE x SIDE points. */
int image_make_pattern(image *made, image_pattern of, int width, int height)
{
    enum { SIDE = 3 };
    static void (*const shade[])(float u, float v, float rgb[3]) = {shade_tiles, shade_grid, shade_studio};
    if ((int64_t)width * height > IMAGE_PIXELS_MAX || !image_make(made, width, height))
        return 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (int i = 0; i < SIDE * SIDE; i++) {
                float *rgb = image_pixel(made, x, y), one[3];
                shade[of](((float)x + ((float)(i % SIDE) + 0.5f) / SIDE) / (float)width,
                          ((float)y + ((float)(i / SIDE) + 0.5f) / SIDE) / (float)height, one);
                for (int channel = 0; channel < 3; channel++)
                    rgb[channel] += one[channel] / (SIDE * SIDE);
            }
    return 1;
}
