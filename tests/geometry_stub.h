/* Shapes that are kept and never met by a ray: in the place of the renderer's own, for tests of what a scene file
 * says. An OBJ file gives one triangle, if it is there. */
#ifndef VNDF_GEOMETRY_STUB_H
#define VNDF_GEOMETRY_STUB_H

#include <stdio.h>
#include <stdlib.h>

#include "render/geometry.h"

/* A larger array; the old one stays where there is no memory. */
static int stub_grow(void *array, size_t size, size_t count)
{
    void *larger, *old;
    memcpy(&old, array, sizeof old);
    larger = realloc(old, (count + 1) * size);
    if (larger)
        memcpy(array, &larger, sizeof larger);
    return larger != NULL;
}

static int stub_shape(geometry *g, shape_kind kind, size_t at, int of)
{
    const shape added = {kind, of, (uint32_t)at};
    if (!stub_grow(&g->shapes, sizeof *g->shapes, g->shape_count))
        return 0;
    g->shapes[g->shape_count++] = added;
    return 1;
}

int geometry_add_sphere(geometry *g, sphere s, int of)
{
    if (!stub_grow(&g->spheres, sizeof s, g->sphere_count))
        return 0;
    g->spheres[g->sphere_count] = s;
    return stub_shape(g, SHAPE_SPHERE, g->sphere_count++, of);
}

int geometry_add_rectangle(geometry *g, rectangle r, int of)
{
    if (!stub_grow(&g->rectangles, sizeof r, g->rectangle_count))
        return 0;
    g->rectangles[g->rectangle_count] = r;
    return stub_shape(g, SHAPE_RECTANGLE, g->rectangle_count++, of);
}

int geometry_add_box(geometry *g, vndf_vec3 low, vndf_vec3 high, int of)
{
    const rectangle face = {low, subtract(high, low), {0.0f, 0.0f, 0.0f}};
    int good = 1;
    for (int i = 0; i < 6; i++)
        good = good && geometry_add_rectangle(g, face, of);
    return good;
}

int geometry_add_obj(geometry *g, const char *path, const placement *where, int of, char *message, size_t size)
{
    FILE *file = fopen(path, "rb");
    (void)where;
    if (!file) {
        snprintf(message, size, "%s: it cannot be read", path);
        return 0;
    }
    fclose(file);
    return stub_shape(g, SHAPE_TRIANGLE, g->triangle_count++, of);
}

int geometry_build(geometry *g)
{
    (void)g;
    return 1;
}

void geometry_free(geometry *g)
{
    free(g->shapes);
    free(g->spheres);
    free(g->rectangles);
    memset(g, 0, sizeof *g);
}

#endif
