/* Light from far away. An image is longitude over latitude: its centre is seen along -z, its right half along +x,
 * its top row at the zenith, +y. Between the centres of pixels it is interpolated, not across the poles.
 * Directions are drawn evenly inside a pixel, that by the mean luminance of what is interpolated there times the
 * sine of its latitude: positive wherever the image is. A constant is not drawn: every direction finds it. */
#include "render/path_parts.h"

#include <stdlib.h>

static const float pi = 3.14159265f;

/* ---- radiance ---- */

static void to_image(const path_environment *e, vndf_vec3 w, float *u, float *v)
{
    float turned = 0.5f + atan2f(w.x, -w.z) / (2.0f * pi) + e->turn;
    *u = turned - floorf(turned);
    *v = atan2f(sqrtf(w.x * w.x + w.z * w.z), w.y) / pi;
}

static vndf_vec3 from_image(const path_environment *e, float u, float v)
{
    float longitude = 2.0f * pi * (u - 0.5f - e->turn), sine = sinf(pi * v);
    return vec(sine * sinf(longitude), cosf(pi * v), -sine * cosf(longitude));
}

static void image_radiance(const path_environment *e, float u, float v, float rgb[3])
{
    const image *map = e->is->map;
    float half = 0.5f / (float)map->height;
    image_bilinear(map, u, fminf(fmaxf(v, half), 1.0f - half), rgb);
    for (int i = 0; i < 3; i++)
        rgb[i] = e->is->constant[i] + e->is->scale * rgb[i];
}

/* Of pixel (x, y): its probability times the number of pixels. */
static float pixel_density(const path_environment *e, int x, int y)
{
    const image *map = e->is->map;
    const float *sums = e->column + (size_t)y * (size_t)map->width;
    float row = e->row[y] - (y ? e->row[y - 1] : 0.0f), column = sums[x] - (x ? sums[x - 1] : 0.0f);
    return row * column * (float)map->width * (float)map->height;
}

/* The unit square of (u, v) has 2 pi^2 sin(theta) steradians a part. */
static float per_steradian(float density, float sine)
{
    return sine > 0.0f ? density / (2.0f * pi * pi * sine) : 0.0f;
}

static float image_density(const path_environment *e, float u, float v, float sine)
{
    const image *map = e->is->map;
    int x = (int)(u * (float)map->width), y = (int)(v * (float)map->height);
    x = x < map->width ? x : map->width - 1;
    y = y < map->height ? y : map->height - 1;
    return per_steradian(pixel_density(e, x, y), sine);
}

static void mapped(const path_environment *e, vndf_vec3 w, float rgb[3], float *density)
{
    float u, v;
    to_image(e, w, &u, &v);
    image_radiance(e, u, v, rgb);
    if (density)
        *density = image_density(e, u, v, sqrtf(w.x * w.x + w.z * w.z));
}

static void constant(const path_environment *e, vndf_vec3 direction, float rgb[3], float *density)
{
    (void)direction;
    for (int i = 0; i < 3; i++)
        rgb[i] = e->is->constant[i];
    if (density)
        *density = 0.0f;
}

/* ---- making ---- */

static float pixel(const image *map, int x, int y)
{
    float rgb[3];
    image_at(map, x, y, rgb);
    return fmaxf(luminance(rgb), 0.0f);
}

/* The mean over a pixel of what is interpolated between it and its neighbours: 1, 6, 1 eighths either way. */
static float pixel_mean(const image *map, int x, int y)
{
    const float part[3] = {0.125f, 0.75f, 0.125f};
    float sum = 0.0f;
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) {
            int row = y + j - 1 < 0 ? 0 : y + j - 1 >= map->height ? map->height - 1 : y + j - 1;
            sum += part[i] * part[j] * pixel(map, (x + i - 1 + map->width) % map->width, row);
        }
    return sum;
}

/* Sums in double, kept as parts of their last. The total. */
static double sum_row(const image *map, int y, float *sums)
{
    double sum = 0;
    for (int x = 0; x < map->width; x++)
        sums[x] = (float)(sum += (double)pixel_mean(map, x, y));
    for (int x = 0; x < map->width; x++)
        sums[x] = sum > 0 ? (float)((double)sums[x] / sum) : (float)(x + 1) / (float)map->width;
    return sum * sin((double)pi * (y + 0.5) / map->height);
}

static void sum_rows(path_environment *e, double *rows)
{
    const image *map = e->is->map;
    double total = 0, below = 0;
    for (int y = 0; y < map->height; y++)
        total += rows[y] = sum_row(map, y, e->column + (size_t)y * (size_t)map->width);
    for (int y = 0; y < map->height; y++)
        e->row[y] = total > 0 ? (float)((below += rows[y]) / total) : 1.0f;
    if (!(total > 0))
        path_environment_free(e);
}

int path_environment_make(path_environment *made, const environment *is, int drawn)
{
    *made = (path_environment){.is = is, .turn = is->turn / 360.0f, .radiance = is->map ? mapped : constant};
    if (!drawn || !is->map)
        return 1;
    size_t width = (size_t)is->map->width, height = (size_t)is->map->height;
    double *rows = malloc(height * sizeof *rows);
    made->row = malloc(height * sizeof *made->row);
    made->column = malloc(width * height * sizeof *made->column);
    int good = rows && made->row && made->column;
    if (good)
        sum_rows(made, rows);
    free(rows);
    return good;
}

void path_environment_free(path_environment *e)
{
    free(e->row);
    free(e->column);
    e->row = e->column = NULL;
}

/* ---- drawing ---- */

/* The first whose sum is above u, the last with a part of its own if rounding left none; *u becomes the place in
 * it. */
static int find(const float *sums, int count, float *u)
{
    int low = 0, high = count - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (sums[middle] > *u)
            high = middle;
        else
            low = middle + 1;
    }
    float before = low ? sums[low - 1] : 0.0f, part = sums[low] - before;
    *u = part > 0.0f ? fminf((*u - before) / part, 0.99999994f) : 0.5f;
    return low;
}

int path_environment_draw(const path_environment *e, const float u[3], light_sample *s)
{
    const image *map = e->is->map;
    float across = u[1], along = u[2];
    int y = find(e->row, map->height, &along);
    int x = find(e->column + (size_t)y * (size_t)map->width, map->width, &across);
    across = ((float)x + across) / (float)map->width;
    along = ((float)y + along) / (float)map->height;
    s->direction = unit(from_image(e, across, along));
    s->distance = INFINITY;
    s->density = per_steradian(pixel_density(e, x, y), sinf(pi * along));
    image_radiance(e, across, along, s->radiance);
    return s->density > 0.0f;
}
