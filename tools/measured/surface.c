#include "measured/measured.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Numbers between blanks, a line for each row; # begins a comment. */
static int read_rows(data_file *file, image *made)
{
    const char *at = (const char *)file->bytes, *end = at + file->size;
    size_t count = 0, room = 0;
    if (file->size >= 3 && memcmp(at, "\xEF\xBB\xBF", 3) == 0) /* the mark of UTF-8, from spreadsheets */
        at += 3;
    for (size_t line = 1; at < end; line++, at++) {
        int here = 0;
        for (; at += strspn(at, " \t\r\v\f"), at < end && *at != '\n' && *at != '#'; here++) {
            char *behind;
            const double z = strtod(at, &behind);
            if (behind == at || (*behind && !strchr(" \t\r\v\f\n#", *behind)) || fabs(z) > 1e30)
                return refuse(
                    file,
                    "line %zu: '%.*s' is no height; numbers between blanks are needed, nan where there is none",
                    line, (int)fmin((double)strcspn(at, " \t\r\v\f\n#"), 40), at);
            if (count == room) {
                room = 2 * room + 4096;
                float *larger = room <= 2 * SURFACE_MAX ? realloc(made->rgb, 3 * room * sizeof *larger) : NULL;
                if (!larger)
                    return refuse(file, "line %zu: there is no memory for more than %zu heights", line, count);
                made->rgb = larger;
            }
            made->rgb[3 * count++] = (float)z;
            at = behind;
        }
        if (here && made->height++ && here != made->width)
            return refuse(file, "line %zu: %d numbers, and %d in the lines before; every row needs as many", line,
                          here, made->width);
        made->width = here ? here : made->width;
        at += strcspn(at, "\n");
    }
    return 1;
}

int heights_read(data_file *file, image *made)
{
    *made = (image){0};
    int good = file->size < 2 || file->bytes[0] != 'P'
                   ? read_rows(file, made)
                   : image_read_bytes(made, file->name, file->bytes, file->size, &file->error);
    const int w = made->width, h = made->height;
    if (good && made->channels == 3 && made->quantum > 0)
        good = refuse(file, "a PPM has colours; heights are a PGM, P5");
    if (good && (w < 3 || h < 3 || w > IMAGE_SIDE_MAX || h > IMAGE_SIDE_MAX || w * h > SURFACE_MAX))
        good = refuse(file, "%d x %d heights; both sides must be from 3 to %d, and %d heights are the most", w, h,
                      IMAGE_SIDE_MAX, SURFACE_MAX);
    if (!good)
        image_free(made);
    return good;
}

/* One of 8 x 8 equal parts of a grid. */
static int part_of(int width, int height, int x, int y)
{
    return (int)((long)y * 8 / height) * 8 + (int)((long)x * 8 / width);
}

static int add_normals(data_file *file, const image *map, slope_set *made)
{
    const size_t count = (size_t)map->width * (size_t)map->height;
    int is_signed = 0;
    for (size_t i = 0; i < 3 * count && map->quantum == 0; i++)
        is_signed |= map->rgb[i] < 0;
    if (!slopes_make(made, count, file))
        return 0;
    made->quantum = 2 * map->quantum;
    for (size_t i = 0; i < count; i++) {
        double n[3], square = 0;
        for (size_t k = 0; k < 3; k++) {
            n[k] = is_signed ? (double)map->rgb[3 * i + k] : 2 * (double)map->rgb[3 * i + k] - 1;
            square += n[k] * n[k];
        }
        /* a map of bytes cannot hold 0: 127 and 128 are half a step away, and what is nearer to flat is flat */
        const int x = (int)(i % (size_t)map->width), y = (int)(i / (size_t)map->width);
        if (square >= 0.25 && square <= 2.25 && n[2] > 0.01)
            slopes_add(made, -n[0] / n[2], -n[1] / n[2], part_of(map->width, map->height, x, y));
    }
    const size_t left_out = count - made->count;
    note(file, "normals %d x %d, %s, %s\nleft_out %zu", map->width, map->height, is_signed ? "n" : "n/2 + 1/2",
         map->quantum > 0 ? "whole numbers" : "floats", left_out);
    if (left_out <= count / 2)
        return 1;
    slopes_free(made);
    return refuse(file,
                  "%zu of %zu pixels are no normals with z above 0 and a length near 1: is this a normal map?",
                  left_out, count);
}

int normals_slopes(data_file *file, slope_set *made)
{
    image map;
    *made = (slope_set){0};
    if (!image_read_bytes(&map, file->name, file->bytes, file->size, &file->error))
        return 0;
    int good = map.channels == 3 || refuse(file, "an image of one channel; a normal map has three, P6 or PF");
    good = good && add_normals(file, &map, made);
    image_free(&map);
    return good;
}

/* `count` numbers `stride` apart: each becomes the mean of those around it that are there, weighed by distance. */
static void smooth_line(float *line, size_t stride, int count, const double *kernel, int reach, float *room)
{
    for (int at = 0; at < count; at++) {
        double sum = 0, whole = 0;
        for (int i = at - reach < 0 ? 0 : at - reach; i <= at + reach && i < count; i++) {
            const double z = (double)line[(size_t)i * stride], weight = kernel[i < at ? at - i : i - at];
            sum += isnan(z) ? 0 : weight * z;
            whole += isnan(z) ? 0 : weight;
        }
        room[at] = isnan(line[(size_t)at * stride]) ? NAN : (float)(sum / whole);
    }
    for (int i = 0; i < count; i++)
        line[(size_t)i * stride] = room[i];
}

/* exp(-pi (x/(a cutoff))^2), a = sqrt(ln 2/pi): half is left of a wave as long as the cut-off. */
int heights_smooth(image *changed, int cutoff)
{
    const double pi = 3.14159265358979323846, a2 = log(2) / pi;
    const size_t width = (size_t)changed->width, height = (size_t)changed->height;
    double kernel[CUTOFF_MAX + 1];
    float *room = malloc((width > height ? width : height) * sizeof *room);
    if (!room)
        return 0;
    for (int i = 0; i <= cutoff; i++)
        kernel[i] = exp(-pi * i * i / (a2 * cutoff * cutoff));
    for (size_t y = 0; y < height; y++)
        smooth_line(changed->rgb + 3 * y * width, 3, changed->width, kernel, cutoff, room);
    for (size_t x = 0; x < width; x++)
        smooth_line(changed->rgb + 3 * x, 3 * width, changed->height, kernel, cutoff, room);
    free(room);
    changed->quantum = 0;
    return 1;
}

int heights_slopes(const image *of, const double step[2], int margin, slope_set *made, data_file *file)
{
    const size_t width = (size_t)of->width;
    const int rim = margin > 0 ? margin : 1;
    *made = (slope_set){0};
    if (2 * rim >= of->width || 2 * rim >= of->height)
        return refuse(file, "%d x %d heights: nothing is left inside a rim of %d, half the cut-off", of->width,
                      of->height, rim);
    if (!slopes_make(made, width * (size_t)of->height, file))
        return 0;
    made->quantum = of->quantum / 2 / fmax(step[0], step[1]);
    for (int y = rim; y < of->height - rim; y++)
        for (int x = rim; x < of->width - rim; x++) {
            const float *z = image_pixel(of, x, y);
            const double sx = ((double)z[3] - (double)*(z - 3)) / (2 * step[0]);
            const double sy = ((double)z[3 * width] - (double)*(z - 3 * width)) / (2 * step[1]);
            if (fabs(sx) <= 1e30 && fabs(sy) <= 1e30) /* false for NaN */
                slopes_add(made, sx, sy, part_of(of->width, of->height, x, y));
        }
    return 1;
}
