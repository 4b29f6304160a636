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

/* ---- heights ------------------------------------------------------------------------------------- */

enum { WORD_MAX = 64 };

/* The next word of a line, which ends before `stop` or with a comment; 0 where there is none. It is cut after
 * WORD_MAX - 1 letters; what is no ASCII becomes '?'. */
static int next_word(const unsigned char **at, const unsigned char *stop, char word[WORD_MAX])
{
    size_t letters = 0;
    while (*at < stop && (**at == ' ' || (**at >= '\t' && **at <= '\r')))
        ++*at;
    for (; *at < stop && **at != ' ' && !(**at >= '\t' && **at <= '\r') && (letters || **at != '#'); ++*at)
        if (letters < WORD_MAX - 1)
            word[letters++] = **at > ' ' && **at <= '~' ? (char)**at : '?';
    word[letters] = '\0';
    return letters > 0;
}

/* Numbers between blanks, a line for each row. */
static int read_rows(data_file *file, height_field *made)
{
    const unsigned char *at = file->bytes, *end = at + file->size;
    char word[WORD_MAX], *behind;
    size_t count = 0, room = 0;
    int width = 0, height = 0;
    if (file->size >= 3 && memcmp(at, "\xEF\xBB\xBF", 3) == 0) /* the mark of UTF-8, from spreadsheets */
        at += 3;
    for (size_t line = 1; at < end; line++) {
        const unsigned char *stop = memchr(at, '\n', (size_t)(end - at));
        int here = 0;
        for (stop = stop ? stop : end; next_word(&at, stop, word); here++, count++) {
            double z = strtod(word, &behind);
            if (*behind || fabs(z) > 1e30)
                return refuse(file,
                              "line %zu: '%.40s' is no height; numbers between blanks are needed, nan where there "
                              "is none",
                              line, word);
            if (count == SURFACE_MAX)
                return refuse(file, "line %zu: more than %d heights", line, SURFACE_MAX);
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
            return refuse(file, "line %zu: %d numbers, and %d in the lines before; every row needs as many", line,
                          here, width);
        width = here > 0 ? here : width;
        at = stop < end ? stop + 1 : end;
    }
    *made = (height_field){width, height, 1, 1, 0, made->z};
    return heights_fit(made, file);
}

static int read_image(data_file *file, image *made)
{
    vndf_error error = {VNDF_OK, ""};
    if (image_read_bytes(made, file->name, file->bytes, file->size, &error))
        return 1;
    memcpy(file->refused, error.message, sizeof file->refused);
    return 0;
}

static int read_heights_image(data_file *file, height_field *made)
{
    image from;
    if (!read_image(file, &from))
        return 0;
    int good = from.channels == 1 || from.quantum == 0 || refuse(file, "a PPM has colours; heights are a PGM, P5");
    good = good && heights_make(made, from.width, from.height, file);
    for (size_t i = 0; good && i < (size_t)from.width * (size_t)from.height; i++)
        made->z[i] = fabsf(from.rgb[3 * i]) <= 1e30f ? from.rgb[3 * i] : NAN;
    made->quantum = from.quantum;
    image_free(&from);
    return good;
}

int heights_read(data_file *file, height_field *made)
{
    const unsigned char *b = file->bytes;
    *made = (height_field){0};
    if (file->size >= 2 && b[0] == 'P' ? read_heights_image(file, made) : read_rows(file, made))
        return 1;
    heights_free(made);
    return 0;
}

/* ---- normals ------------------------------------------------------------------------------------- */

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

static int add_normals(data_file *file, const image *map, slope_set *made)
{
    size_t count = (size_t)map->width * (size_t)map->height, left_out = 0;
    int is_signed = 0;
    for (size_t i = 0; i < 3 * count && map->quantum == 0; i++)
        is_signed |= map->rgb[i] < 0;
    if (!slopes_make(made, count, file))
        return 0;
    made->quantum = 2 * map->quantum;
    for (size_t i = 0; i < count; i++) {
        double n[3];
        for (size_t k = 0; k < 3; k++)
            n[k] = is_signed ? (double)map->rgb[3 * i + k] : 2 * (double)map->rgb[3 * i + k] - 1;
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
    image map;
    *made = (slope_set){0};
    if (!read_image(file, &map))
        return 0;
    int good = map.channels == 3 || refuse(file, "an image of one channel; a normal map has three, P6 or PF");
    good = good && add_normals(file, &map, made);
    image_free(&map);
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
