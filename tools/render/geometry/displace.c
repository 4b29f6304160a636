/* A rectangle displaced by the heights of an image: two triangles a pixel. */
#include "render/geometry/geometry.h"

typedef struct grid {
    const rectangle *plate;
    const image *heights;
    vndf_vec3 up; /* as long as a height of 1 */
} grid;

/* The corner of pixels (x, y) at its upper left; the image repeats. */
static vndf_vec3 corner_at(const grid *g, int x, int y)
{
    const image *map = g->heights;
    const float u = (float)x / (float)map->width, from_below = 1.0f - (float)y / (float)map->height;
    float rgb[3];
    image_at(map, x < map->width ? x : 0, y < map->height ? y : 0, rgb);
    const vndf_vec3 flat =
        add(g->plate->corner, add(scale(g->plate->edge_u, u), scale(g->plate->edge_v, from_below)));
    return add(flat, scale(g->up, rgb[0]));
}

/* Corners by their steps from the upper left one, counter-clockwise seen from above. */
static int add_half(geometry *g, const grid *of, int x, int y, const int step[3][2], int material)
{
    triangle t = {.normal = {{0.0f, 0.0f, 0.0f}}};
    for (int i = 0; i < 3; i++) {
        const int column = x + step[i][0], row = y + step[i][1];
        t.corner[i] = corner_at(of, column, row);
        t.u[i] = (float)column / (float)of->heights->width;
        t.v[i] = (float)row / (float)of->heights->height;
    }
    return geometry_add_triangle(g, &t, material);
}

int geometry_add_displaced(geometry *g, rectangle plate, const image *heights, float height, int material)
{
    static const int above[3][2] = {{0, 0}, {1, 1}, {1, 0}}, below[3][2] = {{0, 0}, {0, 1}, {1, 1}};
    const grid of = {&plate, heights, scale(unit(cross(plate.edge_u, plate.edge_v)), height)};
    for (int y = 0; y < heights->height; y++)
        for (int x = 0; x < heights->width; x++)
            if (!add_half(g, &of, x, y, above, material) || !add_half(g, &of, x, y, below, material))
                return 0;
    return 1;
}
