/* Light from far away. An image has longitude across and latitude down: its centre is seen along -z, its right
 * half along +x, its top row at the zenith, +y. It is interpolated between the centres of pixels, but not across
 * the poles.
 *
 * Directions are drawn from cells: squares of pixels, of a size that leaves at most CELLS_MAX. A draw takes a cell
 * with the probability of its light, then a direction in it evenly by solid angle: longitude and height y are
 * even. So it reads one place of memory and needs no angle of latitude, and the density is one number for each
 * cell. A cell has the mean luminance of the image interpolated in it: positive wherever the image is. Constants
 * and images that are nearly even are not drawn: every direction finds their light. */
#include "render/path/parts.h"

#include <stdlib.h>

enum { CELLS_MAX = 1 << 17 };

static const float pi = 3.14159265f;
static const double even = 2; /* the contrast below which drawing costs more than it gives */

/* ---- angles ---- */

/* The angle of (side, ahead) from (0, 1) towards (1, 0), as a part of a full turn, in [-1/2, 1/2]: a polynomial
 * for an eighth of a turn, within 3e-8. */
static inline float turn_of(float side, float ahead)
{
    static const float c[8] = {0.159154924f,  -0.0530492275f,  0.0317784067f,  -0.0222869285f,
                               0.0157067872f, -0.00936304601f, 0.00378478708f, -0.000725713434f};
    float a = fabsf(side), b = fabsf(ahead), large = a > b ? a : b, small = a > b ? b : a;
    float q = large > 0.0f ? small / large : 0.0f, s = q * q, sum = c[7];
    for (int i = 6; i >= 0; i--)
        sum = sum * s + c[i];
    sum *= q;
    sum = a > b ? 0.25f - sum : sum;
    sum = ahead < 0.0f ? 0.5f - sum : sum;
    return copysignf(sum, side);
}

/* The fraction of a number in (-2^20, 2^20) above the whole number below it. */
static inline float fraction(float x)
{
    float part = x - (float)(int)x;
    part += part < 0.0f ? 1.0f : 0.0f;
    return part < 1.0f ? part : 0.0f;
}

/* u in [0, 1), v in [0, 1]. */
static inline void to_image(const path_environment *e, vndf_vec3 w, float *u, float *v)
{
    *u = fraction(0.5f + turn_of(w.x, -w.z) + e->turn);
    *v = 2.0f * turn_of(sqrtf(w.x * w.x + w.z * w.z), w.y);
}

/* ---- radiance ---- */

static void image_radiance(const path_environment *e, float u, float v, float rgb[3])
{
    const image *map = e->is->map;
    float half = 0.5f / (float)map->height, below = v > half ? v : half;
    image_bilinear(map, u, below < 1.0f - half ? below : 1.0f - half, rgb);
    for (int i = 0; i < 3; i++)
        rgb[i] = e->is->constant[i] + e->is->scale * rgb[i];
}

static float cell_density(const path_environment *e, float u, float v)
{
    const image *map = e->is->map;
    int x = (int)(u * (float)map->width), y = (int)(v * (float)map->height);
    x = x < map->width ? x : map->width - 1;
    y = y < map->height ? y : map->height - 1;
    return e->cells[(size_t)(y >> e->shift) * e->columns + (size_t)(x >> e->shift)].own;
}

static void mapped(const path_environment *e, vndf_vec3 w, float rgb[3], float *density)
{
    float u, v;
    to_image(e, w, &u, &v);
    image_radiance(e, u, v, rgb);
    if (density)
        *density = cell_density(e, u, v);
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

/* The luminance of row y, softened by 1, 6, 1 eighths: the mean of the interpolated image over each pixel. Takes
 * absolute values, so that colours below 0 cannot cancel others. */
static void soften_row(const image *map, int y, float *soft)
{
    const float *row = map->rgb + 3 * (size_t)y * (size_t)map->width;
    float before = 0.0f, here = 0.0f;
    for (int x = -2; x < map->width; x++) {
        const float *p = row + 3 * ((x + 1 + map->width) % map->width);
        const float size[3] = {fabsf(p[0]), fabsf(p[1]), fabsf(p[2])};
        float after = (float)luminance(size);
        if (x >= 0)
            soft[x] = 0.125f * before + 0.75f * here + 0.125f * after;
        before = here;
        here = after;
    }
}

/* The solid angle of a pixel of row y. */
static double pixel_angle(const image *map, int y)
{
    double top = cos((double)pi * y / map->height), bottom = cos((double)pi * (y + 1) / map->height);
    return 2 * (double)pi * (top - bottom) / map->width;
}

/* Adds a row of pixels, from the softened rows about it, to its cells. */
static void add_row(const path_environment *e, int y, float *const soft[3], double *weights)
{
    const image *map = e->is->map;
    double angle = pixel_angle(map, y), *row = weights + (size_t)(y >> e->shift) * e->columns;
    for (int x = 0; x < map->width; x++)
        row[x >> e->shift] += angle * (double)(0.125f * soft[0][x] + 0.75f * soft[1][x] + 0.125f * soft[2][x]);
}

/* `rows` has room for three of them. */
static void weigh_cells(const path_environment *e, float *rows, double *weights)
{
    const image *map = e->is->map;
    size_t width = (size_t)map->width;
    float *soft[3] = {rows, rows + width, rows + 2 * width};
    soften_row(map, 0, soft[0]);
    soften_row(map, 0, soft[1]);
    for (int y = 0; y < map->height; y++) {
        float *first = soft[0];
        soften_row(map, y + 1 < map->height ? y + 1 : y, soft[2]);
        add_row(e, y, soft, weights);
        soft[0] = soft[1];
        soft[1] = soft[2];
        soft[2] = first;
    }
}

static int cell_end(uint32_t cell, unsigned shift, int pixels)
{
    int end = (int)((cell + 1) << shift);
    return end < pixels ? end : pixels;
}

/* cos(v pi) minus its value at the pole, without cancellation. */
static float from_pole(double v, float pole)
{
    double s = sin(0.5 * (double)pi * (pole > 0.0f ? v : 1 - v));
    return (float)(pole > 0.0f ? -2 * s * s : pole < 0.0f ? 2 * s * s : cos((double)pi * v));
}

/* The solid angle of a column of pixels in a row of cells. */
static double column_angle(const path_environment *e, uint32_t row)
{
    const image *map = e->is->map;
    double angle = 0;
    for (int y = (int)(row << e->shift); y < cell_end(row, e->shift, map->height); y++)
        angle += pixel_angle(map, y);
    return angle;
}

/* Columns of pixels in a cell. */
static int columns_of(const path_environment *e, uint32_t x)
{
    return cell_end(x, e->shift, e->is->map->width) - (int)(x << e->shift);
}

static environment_row row_limits(const path_environment *e, uint32_t row)
{
    int height = e->is->map->height, first = (int)(row << e->shift), end = cell_end(row, e->shift, height);
    float pole = 2 * end <= height ? 1.0f : 2 * first >= height ? -1.0f : 0.0f;
    float top = from_pole((double)first / height, pole), bottom = from_pole((double)end / height, pole);
    environment_row limits = {top, bottom, pole};
    return limits;
}

/* Fills in the limits of the rows and turns probabilities into densities. */
static void finish_cells(path_environment *e)
{
    for (uint32_t row = 0; row < e->rows; row++) {
        double angle = column_angle(e, row);
        e->limits[row] = row_limits(e, row);
        for (uint32_t x = 0; x < e->columns; x++)
            e->cells[row * e->columns + x].own /= (float)(angle * columns_of(e, x));
    }
    for (uint32_t i = 0; i < e->rows * e->columns; i++)
        e->cells[i].others = e->cells[e->cells[i].other].own;
}

static uint32_t cells_along(int pixels, unsigned shift)
{
    return ((uint32_t)pixels + (1u << shift) - 1) >> shift;
}

/* The mean square of the light over the square of its mean: 1 where it is even. */
static double contrast(const path_environment *e, const double *weights)
{
    double sum = 0, square = 0;
    for (uint32_t row = 0; row < e->rows; row++) {
        double angle = column_angle(e, row);
        for (uint32_t x = 0; x < e->columns; x++) {
            double weight = weights[row * e->columns + x];
            sum += weight;
            square += weight * weight / (angle * columns_of(e, x));
        }
    }
    return sum > 0 ? 4 * (double)pi * square / (sum * sum) : 0;
}

/* 0 if there is no memory. */
static int draw_from(path_environment *e, const double *weights)
{
    uint32_t count = e->rows * e->columns;
    double sum = 0;
    for (uint32_t i = 0; i < count; i++)
        sum += weights[i];
    e->power = (float)sum * e->is->scale;
    e->limits = malloc(e->rows * sizeof *e->limits);
    e->cells = alias_make(weights, count);
    if (!e->limits || !e->cells)
        return 0;
    finish_cells(e);
    return 1;
}

/* 0 if there is no memory. Images that are nearly even get no cells. */
static int make_cells(path_environment *e)
{
    const image *map = e->is->map;
    while (cells_along(map->width, e->shift) * cells_along(map->height, e->shift) > CELLS_MAX)
        e->shift++;
    e->columns = cells_along(map->width, e->shift);
    e->rows = cells_along(map->height, e->shift);
    double *weights = calloc((size_t)e->columns * e->rows, sizeof *weights);
    float *soft = malloc(3 * (size_t)map->width * sizeof *soft);
    int good = weights && soft;
    if (good) {
        weigh_cells(e, soft, weights);
        good = contrast(e, weights) < even || draw_from(e, weights);
    }
    free(weights);
    free(soft);
    return good;
}

int path_environment_make(path_environment *made, const environment *is, int drawn)
{
    float turn = is->turn / 360.0f;
    *made = (path_environment){.is = is, .turn = turn - floorf(turn), .radiance = is->map ? mapped : constant};
    return !drawn || !is->map || make_cells(made);
}

void path_environment_free(path_environment *e)
{
    free(e->cells);
    free(e->limits);
    e->cells = NULL;
    e->limits = NULL;
}

/* ---- drawing ---- */

void path_environment_draw(const path_environment *e, uint64_t choice, const float u[2], light_sample *s)
{
    const image *map = e->is->map;
    uint32_t cell = alias_draw(e->cells, e->columns * e->rows, choice, &s->density);
    uint32_t row = cell / e->columns, column = cell - row * e->columns;
    const environment_row *limits = &e->limits[row];
    float left = (float)(column << e->shift), right = (float)cell_end(column, e->shift, map->width);
    float fall = limits->top + u[1] * (limits->bottom - limits->top), y = limits->pole + fall;
    float above = limits->pole > 0.0f ? -fall : 1.0f - y, below = limits->pole < 0.0f ? fall : 1.0f + y;
    float sine = sqrtf(above * below);
    float longitude = 2.0f * pi * ((left + u[0] * (right - left)) / (float)map->width - 0.5f - e->turn);
    s->direction = vec(sine * sinf(longitude), y, -sine * cosf(longitude));
    s->distance = INFINITY;
    s->radiance = NULL;
}
