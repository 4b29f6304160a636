#include "render/image/relief.h"

#include <math.h>

enum { MOMENTS = 5 };

/* Adds the moments of the slope (x, y), of which a part sees so much. */
static void add_slope(double moments[MOMENTS], double x, double y, double part)
{
    const double of[MOMENTS] = {x, y, x * x, x * y, y * y};
    for (int i = 0; i < MOMENTS; i++)
        moments[i] += part * of[i];
}

/* ---- one pixel ---- */

typedef struct slopes_of {
    const image *map;
    const relief_form *form;
    void (*add)(const struct slopes_of *of, int x, int y, double moments[MOMENTS], double *steepest);
} slopes_of;

static double height_at(const image *map, int x, int y)
{
    float rgb[3];
    image_at(map, x < map->width ? x : 0, y < map->height ? y : 0, rgb);
    return (double)rgb[0];
}

static void add_triangle(const slopes_of *of, double right, double down, double moments[MOMENTS], double *steepest)
{
    double x = right * of->map->width * (double)of->form->scale_x;
    double y = -down * of->map->height * (double)of->form->scale_y;
    add_slope(moments, x, y, 0.5);
    *steepest = fmax(*steepest, fmax(fabs(x), fabs(y)));
}

static void add_heights(const slopes_of *of, int x, int y, double moments[MOMENTS], double *steepest)
{
    double a = height_at(of->map, x, y), b = height_at(of->map, x + 1, y);
    double c = height_at(of->map, x, y + 1), d = height_at(of->map, x + 1, y + 1);
    add_triangle(of, b - a, d - b, moments, steepest);
    add_triangle(of, d - c, c - a, moments, steepest);
}

static void add_normal(const slopes_of *of, int x, int y, double moments[MOMENTS], double *steepest)
{
    float rgb[3];
    image_at(of->map, x, y, rgb);
    double nx = 2 * (double)rgb[0] - 1, ny = 2 * (double)rgb[1] - 1, nz = 2 * (double)rgb[2] - 1;
    double along_u = -nx / nz * (double)of->form->scale_x, up = -ny / nz * (double)of->form->scale_y;
    add_slope(moments, along_u, up, 1);
    *steepest = fmax(*steepest, fmax(fabs(along_u), fabs(up)));
}

/* ---- all of them ---- */

static void set_square(relief *made, int x, int y, const double moments[MOMENTS])
{
    size_t at = 3 * ((size_t)y * (size_t)made->first.width + (size_t)x);
    for (size_t i = 0; i < 3; i++)
        made->first.rgb[at + i] = (float)moments[i];
    for (size_t i = 0; i < 2 && made->second.rgb; i++)
        made->second.rgb[at + i] = (float)moments[3 + i];
}

static void filter(relief *made, const slopes_of *of, int side)
{
    double steepest = 0, area = (double)side * side;
    for (int y = 0; y < made->first.height; y++)
        for (int x = 0; x < made->first.width; x++) {
            double moments[MOMENTS] = {0};
            for (int i = 0; i < side * side; i++)
                of->add(of, x * side + i % side, y * side + i / side, moments, &steepest);
            for (int i = 0; i < MOMENTS; i++)
                moments[i] /= area;
            set_square(made, x, y, moments);
        }
    made->steepest = (float)steepest;
}

static int make(relief *made, const slopes_of *of)
{
    const int filters = of->form->texels > 0, side = filters ? of->form->texels : 1;
    const int width = of->map->width / side, height = of->map->height / side;
    *made = (relief){.steepest = 0.0f};
    if (!image_make(&made->first, width, height) || (filters && !image_make(&made->second, width, height))) {
        relief_free(made);
        return 0;
    }
    filter(made, of, side);
    return 1;
}

int relief_of_heights(relief *made, const image *heights, const relief_form *form)
{
    const slopes_of of = {heights, form, add_heights};
    return make(made, &of);
}

int relief_of_normals(relief *made, const image *normals, const relief_form *form)
{
    const slopes_of of = {normals, form, add_normal};
    return make(made, &of);
}

void relief_free(relief *freed)
{
    image_free(&freed->first);
    image_free(&freed->second);
}

/* ---- looking up ---- */

void relief_at(const relief *r, float u, float v, relief_slopes *s)
{
    float first[3], second[3];
    image_bilinear(&r->first, u, v, first);
    *s = (relief_slopes){first[0], first[1], 0.0f, 0.0f, 0.0f};
    if (!r->second.rgb)
        return;
    image_bilinear(&r->second, u, v, second);
    s->xx = fmaxf(first[2] - first[0] * first[0], 0.0f); /* a difference of rounded numbers */
    s->xy = second[0] - first[0] * first[1];
    s->yy = fmaxf(second[1] - first[1] * first[1], 0.0f);
}
