#include "measured/surface/maps.h"

#include <math.h>
#include <string.h>

#include "measured/surface/grey.h"
#include "measured/surface/heights.h"
#include "render/image.h"

/* Pixels of either kind as normals. */
typedef struct normal_map {
    int width, height;
    grey_map grey; /* of a PPM */
    image floats;  /* of a PFM; rgb is NULL for a PPM */
    int is_signed;
} normal_map;

static void normal_at(const normal_map *map, int x, int y, double n[3])
{
    size_t i = 3 * ((size_t)y * (size_t)map->width + (size_t)x);
    for (size_t k = 0; k < 3; k++) {
        double value = map->floats.rgb ? (double)map->floats.rgb[i + k] : grey_at(&map->grey, i + k);
        n[k] = map->is_signed ? value : 2 * value - 1;
    }
}

/* A map of bytes cannot hold 0: 127 and 128 are both half a step away. What is nearer to flat than that is flat. */
static int is_usable(const double n[3])
{
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return length >= 0.5 && length <= 1.5 && n[2] > 0.01;
}

static int read_floats(normal_map *map, const char *name, const void *bytes, size_t size, refusal *why)
{
    image_error error = {""};
    if (!image_read_pfm_bytes(&map->floats, name, bytes, size, &error)) {
        memcpy(why->message, error.message, sizeof why->message);
        return 0;
    }
    map->width = map->floats.width;
    map->height = map->floats.height;
    if ((size_t)map->width * (size_t)map->height > HEIGHTS_MAX)
        return refuse_data(why, name, "%d x %d normals are more than %d", map->width, map->height, HEIGHTS_MAX);
    for (size_t i = 0; i < 3 * (size_t)map->width * (size_t)map->height; i++)
        map->is_signed |= map->floats.rgb[i] < 0;
    return 1;
}

static int open_map(normal_map *map, const char *name, const void *bytes, size_t size, refusal *why)
{
    const char *text = bytes;
    *map = (normal_map){0};
    if (size >= 2 && text[0] == 'P' && text[1] == 'F')
        return read_floats(map, name, bytes, size, why);
    if (size >= 2 && text[0] == 'P' && text[1] == 'f')
        return refuse_data(why, name, "a PFM of one channel; a normal map has three, PF");
    if (!grey_read(&map->grey, name, bytes, size, why))
        return 0;
    if (map->grey.channels != 3)
        return refuse_data(why, name, "a PGM has one channel; a normal map has three, P6");
    map->width = map->grey.width;
    map->height = map->grey.height;
    return 1;
}

static void add_slopes(const normal_map *map, slope_set *made, size_t *left_out)
{
    for (int y = 0; y < map->height; y++)
        for (int x = 0; x < map->width; x++) {
            double n[3];
            int part = (int)((long)y * 8 / map->height) * 8 + (int)((long)x * 8 / map->width);
            normal_at(map, x, y, n);
            if (is_usable(n))
                slopes_add(made, -n[0] / n[2], -n[1] / n[2], part);
            else
                ++*left_out;
        }
}

static int fill(const normal_map *map, const char *name, slope_set *made, notes *to, refusal *why)
{
    size_t left_out = 0, count = (size_t)map->width * (size_t)map->height;
    if (!slopes_make(made, count))
        return refuse_data(why, name, "there is no memory for %zu slopes", count);
    made->quantum = map->floats.rgb ? 0 : 2.0 / map->grey.most;
    add_slopes(map, made, &left_out);
    note(to, "normals %d x %d, %s", map->width, map->height,
         !map->floats.rgb ? "n/2 + 1/2, whole numbers"
         : map->is_signed ? "n, floats"
                          : "n/2 + 1/2, floats");
    note(to, "left_out %zu", left_out);
    if (left_out <= count / 2)
        return 1;
    slopes_free(made);
    return refuse_data(why, name,
                       "%zu of %zu pixels are no normals with z above 0 and a length near 1: is this a "
                       "normal map?",
                       left_out, count);
}

int maps_read(slope_set *made, const char *name, const void *bytes, size_t size, notes *to, refusal *why)
{
    normal_map map;
    *made = (slope_set){NULL, NULL, NULL, 0, 0, 0};
    int good = open_map(&map, name, bytes, size, why) && fill(&map, name, made, to, why);
    image_free(&map.floats);
    return good;
}
