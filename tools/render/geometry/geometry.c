/* The arrays of shapes, and the hierarchy over the finite ones. */
#include "render/geometry/geometry.h"

#include <stdlib.h>
#include <string.h>

#include "render/geometry/shape.h"

/* Nodes and references have 32 bits: 2 count - 1 nodes. */
static const size_t shapes_max = 0x7FFFFFFF;

/* Makes room for one more; NULL if there is no memory, and the array stays as it was. */
static void *room_for_one(void *array, size_t count, size_t *room, size_t size)
{
    if (count < *room)
        return array;
    const size_t wanted = *room < 16 ? 16 : *room + *room / 2;
    void *larger = wanted <= SIZE_MAX / size ? realloc(array, wanted * size) : NULL;
    if (larger)
        *room = wanted;
    return larger;
}

static int add_shape(geometry *g, shape_kind kind, size_t at, int material)
{
    shape *shapes = room_for_one(g->shapes, g->shape_count, &g->shape_room, sizeof *shapes);
    if (!shapes)
        return 0;
    g->shapes = shapes;
    if (g->shape_count >= shapes_max)
        return 0;
    g->shapes[g->shape_count++] = (shape){kind, material, (uint32_t)at};
    return 1;
}

int geometry_add_sphere(geometry *g, sphere s, int material)
{
    sphere *all = room_for_one(g->spheres, g->sphere_count, &g->sphere_room, sizeof *all);
    if (!all)
        return 0;
    g->spheres = all;
    if (!add_shape(g, SHAPE_SPHERE, g->sphere_count, material))
        return 0;
    g->spheres[g->sphere_count++] = s;
    return 1;
}

int geometry_add_rectangle(geometry *g, rectangle r, int material)
{
    rectangle *all = room_for_one(g->rectangles, g->rectangle_count, &g->rectangle_room, sizeof *all);
    if (!all)
        return 0;
    g->rectangles = all;
    if (!add_shape(g, SHAPE_RECTANGLE, g->rectangle_count, material))
        return 0;
    g->rectangles[g->rectangle_count++] = r;
    return 1;
}

int geometry_add_triangle(geometry *g, const triangle *t, int material)
{
    triangle *all = room_for_one(g->triangles, g->triangle_count, &g->triangle_room, sizeof *all);
    if (!all)
        return 0;
    g->triangles = all;
    if (!add_shape(g, SHAPE_TRIANGLE, g->triangle_count, material))
        return 0;
    g->triangles[g->triangle_count++] = *t;
    return 1;
}

/* Seen from outside, u goes to the right and v up on each side; on top and bottom, right is x. */
int geometry_add_box(geometry *g, vndf_vec3 low, vndf_vec3 high, int material)
{
    const vndf_vec3 x = vec(high.x - low.x, 0.0f, 0.0f), y = vec(0.0f, high.y - low.y, 0.0f);
    const vndf_vec3 z = vec(0.0f, 0.0f, high.z - low.z);
    const vndf_vec3 left = scale(x, -1.0f), back = scale(z, -1.0f);
    const rectangle sides[6] = {
        {vec(low.x, low.y, high.z), x, y},     /* +z */
        {vec(high.x, low.y, low.z), left, y},  /* -z */
        {vec(high.x, low.y, high.z), back, y}, /* +x */
        {low, z, y},                           /* -x */
        {vec(low.x, high.y, high.z), x, back}, /* +y */
        {low, x, z},                           /* -y */
    };
    for (int i = 0; i < 6; i++)
        if (!geometry_add_rectangle(g, sides[i], material))
            return 0;
    return 1;
}

/* Gathers the boxes of the shapes that have one; returns how many. */
static uint32_t gather(const geometry *g, bvh_reference *references)
{
    uint32_t count = 0;
    for (size_t i = 0; i < g->shape_count; i++)
        if (shape_box(g, &g->shapes[i], &references[count].box))
            references[count++].shape = (uint32_t)i;
    return count;
}

static void forget_hierarchy(geometry *g)
{
    free(g->nodes);
    free(g->order);
    g->nodes = NULL;
    g->order = NULL;
}

/* Cuts the block to the nodes in use; keeps a block that cannot be cut. */
static bvh_node *trimmed(bvh_node *nodes, uint32_t count)
{
    bvh_node *less = realloc(nodes, count * sizeof *nodes);
    return less ? less : nodes;
}

int geometry_build(geometry *g)
{
    forget_hierarchy(g);
    if (g->shape_count == 0)
        return 1;
    bvh_reference *references = malloc(g->shape_count * sizeof *references);
    g->order = malloc(g->shape_count * sizeof *g->order);
    const uint32_t count = references && g->order ? gather(g, references) : 0;
    if (count > 0)
        g->nodes = malloc((2 * (size_t)count - 1) * sizeof *g->nodes);
    const int is_made = references && g->order && (count == 0 || g->nodes);
    if (g->nodes)
        g->nodes = trimmed(g->nodes, bvh_build(g->nodes, references, count));
    for (uint32_t i = 0; is_made && i < count; i++)
        g->order[i] = references[i].shape;
    free(references);
    if (!is_made)
        forget_hierarchy(g);
    return is_made;
}

void geometry_free(geometry *g)
{
    forget_hierarchy(g);
    free(g->shapes);
    free(g->spheres);
    free(g->rectangles);
    free(g->triangles);
    memset(g, 0, sizeof *g);
}
