/* Patterns: images by formulas of (u, v), from the left and the top, averaged over each pixel: fine detail, and a
 * studio as an environment (longitude across, latitude down; the zenith is the top row). */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "render/image.h"

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
