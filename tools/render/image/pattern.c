/* Patterns: images by formulas of (u, v), from the left and the top, averaged over each pixel. All patterns but
 * the two environments with an up and a down repeat without a seam in both directions. Environments have longitude
 * across and latitude down, as `environment image` takes them: the zenith is the top row, the horizon the middle.
 *
 * Map: hash and value noise; maps for roughness; fine detail; the studio; stars; the list. */
#include "render/image/image.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "cli/arguments.h"

static const float pi = 3.14159265f;

static void grey(float value, float rgb[3])
{
    rgb[0] = rgb[1] = rgb[2] = value;
}

static void blend(float rgb[3], const float other[3], float part)
{
    for (int i = 0; i < 3; i++)
        rgb[i] += part * (other[i] - rgb[i]);
}

static float smooth(float from, float to, float x)
{
    float t = fminf(fmaxf((x - from) / (to - from), 0.0f), 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/* ---- noise ---- */

/* A number in [0, 1) for each point of a lattice, by the finaliser of SplitMix64. */
static float lattice(uint32_t x, uint32_t y, uint32_t layer)
{
    uint64_t h = ((uint64_t)x << 32 | y) + 0x9E3779B97F4A7C15u * (layer + 1u);
    h = (h ^ h >> 30) * 0xBF58476D1CE4E5B9u;
    h = (h ^ h >> 27) * 0x94D049BB133111EBu;
    return (float)((h ^ h >> 31) >> 40) * 0x1p-24f;
}

/* After the last comes the first again. */
static uint32_t around(uint32_t i, uint32_t count)
{
    return i < count ? i : 0;
}

static float between(float low, float high, float part)
{
    return low + part * part * (3.0f - 2.0f * part) * (high - low);
}

/* Smooth noise with `nx` x `ny` cells in the unit square. */
static float noise(float u, float v, uint32_t nx, uint32_t ny, uint32_t layer)
{
    float x = u * (float)nx, y = v * (float)ny;
    uint32_t column = (uint32_t)x, row = (uint32_t)y;
    uint32_t x0 = around(column, nx), y0 = around(row, ny), x1 = around(x0 + 1, nx), y1 = around(y0 + 1, ny);
    float a = x - (float)column, b = y - (float)row;
    float upper = between(lattice(x0, y0, layer), lattice(x1, y0, layer), a);
    float lower = between(lattice(x0, y1, layer), lattice(x1, y1, layer), a);
    return between(upper, lower, b);
}

/* Octaves of noise, in (0, 1). */
static float cloud(float u, float v, uint32_t nx, uint32_t ny)
{
    float sum = 0.0f, weight = 0.5f;
    for (uint32_t layer = 0; layer < 5; layer++, weight *= 0.5f)
        sum += weight * noise(u, v, nx << layer, ny << layer, layer);
    return sum / (1.0f - 2.0f * weight);
}

/* ---- maps for roughness: within [0.1, 1] ---- */

static void shade_noise(float u, float v, float rgb[3])
{
    grey(0.1f + 0.9f * smooth(0.25f, 0.75f, cloud(u, v, 6, 6)), rgb);
}

static void shade_brushed(float u, float v, float rgb[3])
{
    grey(0.25f + 0.75f * cloud(u, v, 3, 48), rgb);
}

static void shade_ramp(float u, float v, float rgb[3])
{
    (void)v;
    grey(0.1f + 0.9f * (1.0f - fabsf(2.0f * u - 1.0f)), rgb);
}

static void shade_blots(float u, float v, float rgb[3])
{
    grey(0.1f + 0.9f * smooth(0.52f, 0.54f, cloud(u, v, 8, 8)), rgb);
}

/* ---- heights: within [0, 1] ---- */

static float wave(float u, float v, float across, float down, float phase)
{
    return cosf(2.0f * pi * (across * u + down * v + phase));
}

/* Fine waves, 300 to 400 of them along a side: of all directions, or nearly all along u. */
static float fine(float u, float v, int brushed)
{
    float sum = 0.0f;
    for (uint32_t i = 0; i < 16; i++) {
        float turn = pi * ((float)i + lattice(i, 0, 11)) / 16.0f, count = 300.0f + 100.0f * lattice(i, 1, 11);
        turn = brushed ? 0.12f * (turn - 0.5f * pi) : turn;
        sum += wave(u, v, floorf(count * cosf(turn)), floorf(count * sinf(turn)), lattice(i, 2, 11));
    }
    return sum;
}

/* Fine waves over slow ones: hammered, polished, and brushed. */
static void shade_hammered(float u, float v, float rgb[3])
{
    float slow = 0.6f * wave(u, v, 3.0f, 1.0f, 0.1f) + 0.4f * wave(u, v, 1.0f, -2.0f, 0.6f);
    float part = cloud(u, v, 6, 6), hammered = smooth(0.5f, 0.56f, part), brushed = smooth(0.46f, 0.4f, part);
    float detail = 0.0f;
    if (hammered > 0.0f)
        detail += hammered * fine(u, v, 0);
    if (brushed > 0.0f)
        detail += brushed * fine(u, v, 1);
    grey(0.5f + 0.4f * slow + 0.0012f * detail, rgb);
}

/* ---- fine detail ---- */

static void shade_checks(float u, float v, float rgb[3])
{
    grey(((int)(u * 64.0f) + (int)(v * 32.0f)) % 2 ? 0.9f : 0.05f, rgb);
}

static void shade_tiles(float u, float v, float rgb[3])
{
    grey(((int)(u * 16.0f) + (int)(v * 16.0f)) % 2 ? 0.75f : 0.25f, rgb);
}

static void shade_stripes(float u, float v, float rgb[3])
{
    static const float warm[3] = {1.0f, 0.75f, 0.45f}, cold[3] = {0.03f, 0.06f, 0.12f};
    (void)v;
    memcpy(rgb, (int)(u * 128.0f) % 2 ? warm : cold, 3 * sizeof *rgb);
}

/* Distance to the nearest of `count` lines, in units of their distance. */
static float from_line(float u, float count)
{
    float place = u * count;
    return fabsf(place - (float)(int)(place + 0.5f));
}

static void shade_grid(float u, float v, float rgb[3])
{
    static const float red[3] = {0.75f, 0.08f, 0.05f};
    float fine = fminf(from_line(u, 48.0f), from_line(v, 24.0f));
    float wide = fminf(from_line(u, 16.0f), from_line(v, 8.0f));
    grey(fine < 0.1f ? 0.05f : 0.85f, rgb);
    if (wide < 0.03f)
        memcpy(rgb, red, sizeof red);
}

/* ---- studio ---- */

typedef struct soft_box {
    float longitude, latitude, width, height; /* of the middle and of half the sides, degrees */
    float rgb[3];
} soft_box;

static const soft_box soft_boxes[] = {
    {60.0f, 38.0f, 22.0f, 16.0f, {14.0f, 13.0f, 11.5f}},
    {155.0f, 34.0f, 8.0f, 30.0f, {6.0f, 6.6f, 8.0f}},
    {250.0f, 52.0f, 30.0f, 7.0f, {9.0f, 9.0f, 9.0f}},
    {320.0f, 20.0f, 5.0f, 16.0f, {10.0f, 7.0f, 4.0f}},
};

static float inside(const soft_box *box, float longitude, float latitude)
{
    float across = fabsf(longitude - box->longitude);
    across = across > 180.0f ? 360.0f - across : across;
    return (1.0f - smooth(0.96f, 1.02f, across / box->width)) *
           (1.0f - smooth(0.96f, 1.02f, fabsf(latitude - box->latitude) / box->height));
}

/* A grey room, brighter towards the zenith, over a floor that is dark at the horizon; soft boxes. */
static void shade_studio(float u, float v, float rgb[3])
{
    static const float wall[3] = {0.16f, 0.18f, 0.22f}, zenith[3] = {0.5f, 0.52f, 0.55f};
    static const float floor_near[3] = {0.3f, 0.28f, 0.26f}, floor_far[3] = {0.07f, 0.065f, 0.06f};
    float longitude = 360.0f * u, latitude = 90.0f - 180.0f * v;
    if (latitude < 0.0f) {
        memcpy(rgb, floor_far, sizeof floor_far);
        blend(rgb, floor_near, smooth(0.0f, 70.0f, -latitude));
        return;
    }
    memcpy(rgb, wall, sizeof wall);
    blend(rgb, zenith, smooth(0.0f, 90.0f, latitude));
    for (size_t i = 0; i < sizeof soft_boxes / sizeof soft_boxes[0]; i++)
        blend(rgb, soft_boxes[i].rgb, inside(&soft_boxes[i], longitude, latitude));
}

/* ---- stars ---- */

static void shade_night(float u, float v, float rgb[3])
{
    float height = cosf(pi * v);
    rgb[0] = 0.02f + 0.01f * cosf(2.0f * pi * u);
    rgb[1] = 0.025f;
    rgb[2] = 0.05f + 0.03f * height;
}

/* 1500 stars, even over the sphere, one pixel each; few are bright. */
static void add_stars(image *sky)
{
    static const float warm[3] = {1.0f, 0.75f, 0.5f}, cold[3] = {0.6f, 0.8f, 1.0f};
    for (uint32_t i = 0; i < 1500; i++) {
        float u = lattice(i, 0, 7), v = acosf(1.0f - 2.0f * lattice(i, 1, 7)) / pi;
        float bright = 4.0f / (0.02f + lattice(i, 2, 7)), tint[3];
        size_t x = (size_t)fminf(u * (float)sky->width, (float)sky->width - 1.0f);
        size_t y = (size_t)fminf(v * (float)sky->height, (float)sky->height - 1.0f);
        memcpy(tint, warm, sizeof tint);
        blend(tint, cold, lattice(i, 3, 7));
        for (int channel = 0; channel < 3; channel++)
            sky->rgb[3 * (y * (size_t)sky->width + x) + (size_t)channel] += bright * tint[channel];
    }
}

/* ---- the list ---- */

typedef struct pattern {
    const char *name;
    void (*shade)(float u, float v, float rgb[3]);
    int across, down; /* how often it repeats */
} pattern;

static const pattern patterns[] = {
    {"checks", shade_checks, 32, 16}, {"tiles", shade_tiles, 8, 8},       {"stripes", shade_stripes, 64, 1},
    {"grid", shade_grid, 16, 8},      {"studio", shade_studio, 1, 1},     {"stars", shade_night, 1, 1},
    {"noise", shade_noise, 1, 1},     {"blots", shade_blots, 1, 1},       {"brushed", shade_brushed, 1, 1},
    {"ramp", shade_ramp, 1, 1},       {"hammered", shade_hammered, 1, 1},
};
enum { PATTERNS = sizeof patterns / sizeof patterns[0] };

/* The mean of shade over a pixel, from SIDE x SIDE points. */
static void shade_pixel(const pattern *p, float x, float y, const image *of, float rgb[3])
{
    enum { SIDE = 3 };
    float sum[3] = {0.0f, 0.0f, 0.0f}, one[3];
    for (int i = 0; i < SIDE * SIDE; i++) {
        float u = (x + ((float)(i % SIDE) + 0.5f) / SIDE) / (float)of->width;
        float v = (y + ((float)(i / SIDE) + 0.5f) / SIDE) / (float)of->height;
        p->shade(u, v, one);
        for (int channel = 0; channel < 3; channel++)
            sum[channel] += one[channel];
    }
    for (int channel = 0; channel < 3; channel++)
        rgb[channel] = sum[channel] / (SIDE * SIDE);
}

/* Shades whole pixels that repeat only once: 4096 x 2048 of the grid take some 0.03 s, not 0.8. */
static void shade_all(const pattern *p, image *made)
{
    size_t width = (size_t)made->width, height = (size_t)made->height;
    size_t columns = made->width % p->across ? width : width / (size_t)p->across;
    size_t rows = made->height % p->down ? height : height / (size_t)p->down;
    for (size_t y = 0; y < height; y++) {
        float *row = made->rgb + 3 * width * y;
        if (y >= rows) {
            memcpy(row, row - 3 * width * rows, 3 * width * sizeof *row);
            continue;
        }
        for (size_t x = 0; x < columns; x++)
            shade_pixel(p, (float)x, (float)y, made, row + 3 * x);
        for (size_t x = columns; x < width; x++)
            memcpy(row + 3 * x, row + 3 * (x - columns), 3 * sizeof *row);
    }
}

static const pattern *find_pattern(const char *name, image_error *error)
{
    const char *names[PATTERNS];
    for (size_t i = 0; i < PATTERNS; i++) {
        names[i] = patterns[i].name;
        if (strcmp(name, patterns[i].name) == 0)
            return &patterns[i];
    }
    const char *near = nearest_word(name, names, PATTERNS);
    int length = snprintf(error->message, sizeof error->message, "there is no pattern '%.64s'", name);
    if (near)
        snprintf(error->message + length, sizeof error->message - (size_t)length, "; did you mean '%s'?", near);
    else
        snprintf(
            error->message + length, sizeof error->message - (size_t)length,
            "; there are checks, tiles, stripes, grid, studio, stars, noise, blots, brushed, ramp and hammered");
    return NULL;
}

int image_make_pattern(image *made, const char *name, int width, int height, image_error *error)
{
    *made = (image){0, 0, NULL};
    const pattern *p = find_pattern(name, error);
    if (!p)
        return 0;
    if (width > IMAGE_SIDE_MAX || height > IMAGE_SIDE_MAX || (int64_t)width * height > IMAGE_PIXELS_MAX ||
        !image_make(made, width, height)) {
        snprintf(error->message, sizeof error->message, "there is no memory for %d x %d pixels", width, height);
        return 0;
    }
    shade_all(p, made);
    if (p->shade == shade_night)
        add_stars(made);
    return 1;
}
