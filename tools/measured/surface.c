#include "measured/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/image.h"

static int heights_fit(const height_field *made, data_file *file)
{
    int width = made->width, height = made->height;
    if (width < 3 || height < 3 || width > SURFACE_SIDE_MAX || height > SURFACE_SIDE_MAX)
        return refuse(file, "%d x %d heights; both sides must be from 3 to %d", width, height, SURFACE_SIDE_MAX);
    return (size_t)width * (size_t)height <= SURFACE_MAX ||
           refuse(file, "%d x %d heights are more than %d", width, height, SURFACE_MAX);
}

int heights_make(height_field *made, int width, int height, data_file *file)
{
    *made = (height_field){width, height, 1, 1, 0, NULL};
    if (!heights_fit(made, file))
        return 0;
    made->z = malloc((size_t)width * (size_t)height * sizeof *made->z);
    return made->z != NULL || refuse(file, "there is no memory for %d x %d heights", width, height);
}

void heights_free(height_field *freed)
{
    free(freed->z);
    *freed = (height_field){0};
}

/* ---- texts --------------------------------------------------------------------------------------- */

/* Numbers between blanks, a line for each row. */
static int read_rows(data_file *file, height_field *made)
{
    scan text = scan_from(file);
    char word[WORD_MAX];
    size_t count = 0, room = 0;
    int width = 0, height = 0;
    do {
        int here = 0;
        for (; scan_word(&text, word); here++, count++) {
            double z;
            if (!word_number(word, &z) || fabs(z) > 1e30)
                return refuse(
                    file,
                    "line %zu: '%.40s' is no height; numbers between blanks are needed, nan where there is "
                    "none",
                    text.line, word);
            if (count == SURFACE_MAX)
                return refuse(file, "line %zu: more than %d heights", text.line, SURFACE_MAX);
            if (count == room) {
                room = 2 * room + 4096;
                float *larger = realloc(made->z, room * sizeof *larger);
                if (!larger)
                    return refuse(file, "there is no memory for %zu heights", room);
                made->z = larger;
            }
            made->z[count] = (float)z;
        }
        if (here > 0 && height++ > 0 && here != width)
            return refuse(file, "line %zu: %d numbers, and %d in the lines before; every row needs as many",
                          text.line, here, width);
        width = here > 0 ? here : width;
    } while (scan_line(&text));
    *made = (height_field){width, height, 1, 1, 0, made->z};
    return heights_fit(made, file);
}

/* ---- images -------------------------------------------------------------------------------------- */

/* PGM and PPM, binary, of 8 or 16 bits (a line P5 or P6, then width, height and the largest
 * value, with comments from # to the end of a line; one blank; rows from the top, the greater byte first), and PFM. */
typedef struct raster {
    int width, height, channels; /* 1 or 3 */
    size_t stride;               /* numbers a pixel */
    double quantum;              /* 1 over the largest value; 0 of floats */
    float *value;                /* owned; 0 to 1 of PGM and PPM */
} raster;

static int read_pfm(data_file *file, raster *made)
{
    image picture;
    image_error error = {""};
    if (!image_read_pfm_bytes(&picture, file->name, file->bytes, file->size, &error)) {
        memcpy(file->refused, error.message, sizeof file->refused);
        return 0;
    }
    *made = (raster){picture.width, picture.height, file->bytes[1] == 'F' ? 3 : 1, 3, 0, picture.rgb};
    if ((size_t)made->width * (size_t)made->height <= SURFACE_MAX)
        return 1;
    free(made->value);
    return refuse(file, "%d x %d pixels are more than %d", made->width, made->height, SURFACE_MAX);
}

/* A whole number from 1 to `most` in the head of an image; 0 where there is none. */
static int read_side(scan *head, int most)
{
    char word[WORD_MAX];
    double value;
    int is_number = scan_word_anywhere(head, word) && word_number(word, &value);
    return is_number && value >= 1 && value <= most && value == (int)value ? (int)value : 0;
}

static int read_grey(data_file *file, raster *made)
{
    scan head = scan_from(file);
    head.at = 2;
    *made = (raster){read_side(&head, SURFACE_SIDE_MAX), read_side(&head, SURFACE_SIDE_MAX), 0, 0, 0, NULL};
    int most = read_side(&head, 65535);
    if (made->width == 0 || made->height == 0 || most == 0 || head.at == file->size)
        return refuse(
            file,
            "the head of the image is not whole: width and height up to %d, the largest value up to 65535, "
            "and a blank",
            SURFACE_SIDE_MAX);
    if ((size_t)made->width * (size_t)made->height > SURFACE_MAX)
        return refuse(file, "%d x %d pixels are more than %d", made->width, made->height, SURFACE_MAX);
    made->channels = file->bytes[1] == '6' ? 3 : 1;
    made->stride = (size_t)made->channels;
    made->quantum = 1.0 / most;
    size_t count = (size_t)made->width * (size_t)made->height * made->stride, each = most > 255 ? 2 : 1;
    const unsigned char *b = file->bytes + head.at + 1;
    if (file->size - head.at - 1 != count * each)
        return refuse(file, "%d x %d pixels take %zu bytes after the head, and there are %zu", made->width,
                      made->height, count * each, file->size - head.at - 1);
    made->value = malloc(count * sizeof *made->value);
    if (!made->value)
        return refuse(file, "there is no memory for %zu numbers", count);
    for (size_t i = 0; i < count; i++)
        made->value[i] = (float)((each == 2 ? b[2 * i] << 8 | b[2 * i + 1] : b[i]) * made->quantum);
    return 1;
}

static int read_raster(data_file *file, raster *made)
{
    const unsigned char *b = file->bytes;
    *made = (raster){0};
    if (file->size >= 2 && b[0] == 'P' && (b[1] == 'F' || b[1] == 'f'))
        return read_pfm(file, made);
    if (file->size < 2 || b[0] != 'P' || (b[1] != '5' && b[1] != '6'))
        return refuse(file, "of PGM and PPM the binary ones are read, which begin with P5 or P6");
    return read_grey(file, made);
}

static int read_image(data_file *file, height_field *made)
{
    raster from;
    if (!read_raster(file, &from))
        return 0;
    int good = from.channels == 1 || from.quantum == 0 || refuse(file, "a PPM has colours; heights are a PGM, P5");
    good = good && heights_make(made, from.width, from.height, file);
    for (size_t i = 0; good && i < (size_t)from.width * (size_t)from.height; i++) {
        float z = from.value[from.stride * i];
        made->z[i] = fabs((double)z) <= 1e30 ? z : NAN;
    }
    made->quantum = from.quantum;
    free(from.value);
    return good;
}

int heights_read(data_file *file, height_field *made)
{
    const unsigned char *b = file->bytes;
    *made = (height_field){0};
    if (file->size >= 2 && b[0] == 'P' ? read_image(file, made) : read_rows(file, made))
        return 1;
    heights_free(made);
    return 0;
}

/* A map of bytes cannot hold 0: 127 and 128 are both half a step away. What is nearer to flat than that is flat. */
static int is_usable(const double n[3])
{
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return length >= 0.5 && length <= 1.5 && n[2] > 0.01;
}

/* One of 8 x 8 equal parts of a grid. */
static int part_of(int width, int height, int x, int y)
{
    return (int)((long)y * 8 / height) * 8 + (int)((long)x * 8 / width);
}

static int add_normals(data_file *file, const raster *map, slope_set *made)
{
    size_t count = (size_t)map->width * (size_t)map->height, left_out = 0;
    int is_signed = 0;
    for (size_t i = 0; i < 3 * count && map->quantum == 0; i++)
        is_signed |= map->value[i] < 0;
    if (!slopes_make(made, count, file))
        return 0;
    made->quantum = 2 * map->quantum;
    for (size_t i = 0; i < count; i++) {
        double n[3];
        for (size_t k = 0; k < 3; k++)
            n[k] = is_signed ? (double)map->value[3 * i + k] : 2 * (double)map->value[3 * i + k] - 1;
        int x = (int)(i % (size_t)map->width), y = (int)(i / (size_t)map->width);
        if (is_usable(n))
            slopes_add(made, -n[0] / n[2], -n[1] / n[2], part_of(map->width, map->height, x, y));
        else
            left_out++;
    }
    note(file, "normals %d x %d, %s, %s", map->width, map->height, is_signed ? "n" : "n/2 + 1/2",
         map->quantum > 0 ? "whole numbers" : "floats");
    note(file, "left_out %zu", left_out);
    if (left_out <= count / 2)
        return 1;
    slopes_free(made);
    return refuse(file,
                  "%zu of %zu pixels are no normals with z above 0 and a length near 1: is this a normal map?",
                  left_out, count);
}

int normals_slopes(data_file *file, slope_set *made)
{
    raster map;
    *made = (slope_set){0};
    if (!read_raster(file, &map))
        return 0;
    int good = map.channels == 3 || refuse(file, "an image of one channel; a normal map has three, P6 or PF");
    good = good && add_normals(file, &map, made);
    free(map.value);
    return good;
}

/* ---- cut-off and slopes -------------------------------------------------------------------------- */

/* `count` numbers `stride` apart: each becomes the mean of those around it that are there, weighed by distance. */
static void smooth_line(float *line, size_t stride, int count, const double *kernel, int reach, float *room)
{
    for (int at = 0; at < count; at++) {
        double sum = 0, whole = 0;
        for (int i = at - reach < 0 ? 0 : at - reach; i <= at + reach && i < count; i++) {
            double z = (double)line[(size_t)i * stride], weight = kernel[i < at ? at - i : i - at];
            sum += isnan(z) ? 0 : weight * z;
            whole += isnan(z) ? 0 : weight;
        }
        room[at] = isnan(line[(size_t)at * stride]) ? NAN : (float)(sum / whole);
    }
    for (int i = 0; i < count; i++)
        line[(size_t)i * stride] = room[i];
}

/* exp(-pi (x/(a cutoff))^2), a = sqrt(ln 2/pi): half is left of a wave as long as the cut-off. */
int heights_smooth(height_field *changed, int cutoff)
{
    const double pi = 3.14159265358979323846, a2 = log(2) / pi;
    double kernel[CUTOFF_MAX + 1];
    size_t width = (size_t)changed->width;
    float *room = malloc((changed->width > changed->height ? width : (size_t)changed->height) * sizeof *room);
    if (!room)
        return 0;
    for (int i = 0; i <= cutoff; i++)
        kernel[i] = exp(-pi * i * i / (a2 * cutoff * cutoff));
    for (int y = 0; y < changed->height; y++)
        smooth_line(changed->z + (size_t)y * width, 1, changed->width, kernel, cutoff, room);
    for (int x = 0; x < changed->width; x++)
        smooth_line(changed->z + x, width, changed->height, kernel, cutoff, room);
    free(room);
    changed->quantum = 0;
    return 1;
}

static double difference(const float *z, size_t stride)
{
    return (double)z[stride] - (double)*(z - stride);
}

int heights_slopes(const height_field *of, int margin, slope_set *made, data_file *file)
{
    size_t width = (size_t)of->width;
    int rim = margin > 0 ? margin : 1;
    *made = (slope_set){0};
    if (2 * rim >= of->width || 2 * rim >= of->height)
        return refuse(file, "%d x %d heights: nothing is left inside a rim of %d, half the cut-off", of->width,
                      of->height, rim);
    if (!slopes_make(made, width * (size_t)of->height, file))
        return 0;
    made->quantum = of->quantum / 2 / fmax(of->step_x, of->step_y);
    for (int y = rim; y < of->height - rim; y++)
        for (int x = rim; x < of->width - rim; x++) {
            const float *z = of->z + (size_t)y * width + (size_t)x;
            double sx = difference(z, 1) / (2 * of->step_x), sy = difference(z, width) / (2 * of->step_y);
            if (fabs(sx) <= 1e30 && fabs(sy) <= 1e30) /* false for NaN */
                slopes_add(made, sx, sy, part_of(of->width, of->height, x, y));
        }
    return 1;
}
