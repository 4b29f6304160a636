/* Patterns: images by formulas of (u, v), from the left and the top, averaged over each pixel: fine detail, and a
 * studio as an environment (longitude across, latitude down; the zenith is the top row); and a mesh by a formula. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "render/geometry.h"
#include "render/image.h"

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

/* ---- fine detail ---- */

static void shade_tiles(float u, float v, float rgb[3])
{
    grey(((int)(u * 16.0f) + (int)(v * 16.0f)) % 2 ? 0.75f : 0.25f, rgb);
}

/* Distance to the nearest of `count` lines, in units of their distance. */
static float from_line(float u, float count)
{
    float place = u * count;
    return fabsf(place - floorf(place + 0.5f));
}

static void shade_grid(float u, float v, float rgb[3])
{
    static const float red[3] = {0.75f, 0.08f, 0.05f};
    grey(fminf(from_line(u, 48.0f), from_line(v, 24.0f)) < 0.1f ? 0.05f : 0.85f, rgb);
    if (fminf(from_line(u, 16.0f), from_line(v, 8.0f)) < 0.03f)
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

/* A grey room, brighter towards the zenith, over a floor that is dark at the horizon; soft boxes. */
static void shade_studio(float u, float v, float rgb[3])
{
    static const float wall[3] = {0.16f, 0.18f, 0.22f}, zenith[3] = {0.5f, 0.52f, 0.55f};
    static const float floor_near[3] = {0.3f, 0.28f, 0.26f}, floor_far[3] = {0.07f, 0.065f, 0.06f};
    float longitude = 360.0f * u, latitude = 90.0f - 180.0f * v;
    memcpy(rgb, latitude < 0.0f ? floor_far : wall, sizeof wall);
    blend(rgb, latitude < 0.0f ? floor_near : zenith,
          smooth(0.0f, latitude < 0.0f ? 70.0f : 90.0f, fabsf(latitude)));
    for (size_t i = 0; i < sizeof soft_boxes / sizeof soft_boxes[0] && latitude >= 0.0f; i++) {
        const soft_box *b = &soft_boxes[i];
        float across = fabsf(longitude - b->longitude), up = fabsf(latitude - b->latitude);
        blend(rgb, b->rgb,
              smooth(1.02f, 0.96f, fminf(across, 360.0f - across) / b->width) *
                  smooth(1.02f, 0.96f, up / b->height));
    }
}

/* ---- the list ---- */

typedef struct pattern {
    const char *name;
    void (*shade)(float u, float v, float rgb[3]);
} pattern;

enum { PATTERNS = 3 };
static const pattern patterns[PATTERNS] = {{"tiles", shade_tiles}, {"grid", shade_grid}, {"studio", shade_studio}};

/* A pixel is the mean of SIDE x SIDE points. */
int image_make_pattern(image *made, const char *name, int width, int height, vndf_error *error)
{
    enum { SIDE = 3 };
    const pattern *p = patterns;
    *made = (image){0};
    while (p < patterns + PATTERNS && strcmp(name, p->name) != 0)
        p++;
    if (p == patterns + PATTERNS)
        return refuse_at(error, name, 0, 0, "there is no such pattern, but tiles, grid and studio");
    if ((int64_t)width * height > IMAGE_PIXELS_MAX || !image_make(made, width, height))
        return refuse_at(error, name, 0, 0, "there is no memory for %d x %d pixels", width, height);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (int i = 0; i < SIDE * SIDE; i++) {
                float *rgb = image_pixel(made, x, y), one[3];
                p->shade(((float)x + ((float)(i % SIDE) + 0.5f) / SIDE) / (float)width,
                         ((float)y + ((float)(i / SIDE) + 0.5f) / SIDE) / (float)height, one);
                for (int channel = 0; channel < 3; channel++)
                    rgb[channel] += one[channel] / (SIDE * SIDE);
            }
    return 1;
}

/* ---- a torus knot (2, 3) ----
 *
 * A closed tube about the axis
 *
 *     P(t) = ((R + r cos 3t) cos 2t, 1.15 r sin 3t, (R + r cos 3t) sin 2t),    R = 0.62, r = 0.26, 0 <= t <= 2 pi,
 *
 * which is nowhere vertical, so that each ring of the tube begins at its top. */

enum { RINGS = 96, SIDES = 12 };

static const double tube = 0.15;

/* A corner and its normal. */
static void corner_at(int ring, int side, vec3 *place, vec3 *normal)
{
    const double t = 2 * PI * (ring % RINGS) / RINGS, turn = 2 * PI * (side % SIDES) / SIDES;
    const double from_axis = 0.62 + 0.26 * cos(3 * t), change = -0.78 * sin(3 * t);
    const vec3 axis = {from_axis * cos(2 * t), 0.299 * sin(3 * t), from_axis * sin(2 * t)};
    const vec3 tangent = {change * cos(2 * t) - 2 * from_axis * sin(2 * t), 0.897 * cos(3 * t),
                          change * sin(2 * t) + 2 * from_axis * cos(2 * t)};
    const frame f = frame_about(unit(tangent), vec(0, 1, 0));
    *normal = along(scale(f.x, cos(turn)), sin(turn), f.y);
    *place = along(axis, tube, *normal);
}

/* Two triangles for each quarter of a ring, counter-clockwise seen from outside. */
int knot_add(geometry *g, int material)
{
    static const int steps[2][3][2] = {{{0, 0}, {0, 1}, {1, 1}}, {{0, 0}, {1, 1}, {1, 0}}}; /* along, around */
    for (int i = 0; i < 2 * RINGS * SIDES; i++) {
        shape s = {.kind = SHAPE_TRIANGLE, .material = material};
        vec3 place[3], normal;
        for (int k = 0; k < 3; k++) {
            const int *step = steps[i % 2][k];
            corner_at(i / 2 / SIDES + step[0], i / 2 % SIDES + step[1], &place[k], &normal);
            s.normal[k] = narrow(normal);
        }
        s.corner = place[0];
        s.edge_u = subtract(place[1], place[0]);
        s.edge_v = subtract(place[2], place[0]);
        if (!geometry_add(g, &s))
            return 0;
    }
    return 1;
}
