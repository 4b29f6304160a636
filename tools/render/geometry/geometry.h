/* Shapes, and the nearest one along a ray: a bounding-volume hierarchy over all of them. */
#ifndef TOOLS_RENDER_GEOMETRY_GEOMETRY_H
#define TOOLS_RENDER_GEOMETRY_GEOMETRY_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "render/image/image.h"
#include "render/vector.h"

typedef struct ray {
    vndf_vec3 origin, direction; /* unit */
    float from, to;              /* distances */
} ray;

/* The place where a ray meets a shape. `normal` is the geometric normal, outwards. The z of `shading` is that
 * normal, or the interpolated normal of a mesh; its x is the direction of u. */
typedef struct hit {
    float distance;
    vndf_vec3 place, normal;
    frame shading;
    float u, v;     /* for textures: from the left and the top if the shape has an upright */
    float error;    /* of `place`, beyond its rounding to float: for ray_from */
    uint32_t shape; /* index of the shape */
    int material;
} hit;

typedef enum shape_kind { SHAPE_SPHERE, SHAPE_RECTANGLE, SHAPE_TRIANGLE } shape_kind;

/* u is the longitude over 2 pi, from +z by way of +x; v the angle from +y over pi. */
typedef struct sphere {
    vndf_vec3 centre;
    float radius;
} sphere;

/* corner + u edge_u + (1 - v) edge_v: an image stands upright where edge_v goes up. The normal is edge_u x edge_v.
 * The edges are at right angles. */
typedef struct rectangle {
    vndf_vec3 corner, edge_u, edge_v;
} rectangle;

/* Corners, with the normals and texture coordinates of the mesh there. Seen from outside the corners go
 * counter-clockwise. */
typedef struct triangle {
    vndf_vec3 corner[3], normal[3]; /* normals all 0: takes the normal of the triangle */
    float u[3], v[3];
} triangle;

typedef struct shape {
    shape_kind kind;
    int material; /* index into the materials of the scene */
    uint32_t at;  /* index among the shapes of its kind */
} shape;

typedef struct bvh_node bvh_node;

/* The arrays are owned. Add shapes, then build once. */
typedef struct geometry {
    shape *shapes;
    size_t shape_count, shape_room;
    sphere *spheres;
    size_t sphere_count, sphere_room;
    rectangle *rectangles;
    size_t rectangle_count, rectangle_room;
    triangle *triangles;
    size_t triangle_count, triangle_room;
    bvh_node *nodes;
    uint32_t *order; /* shapes in the order of the leaves */
} geometry;

/* Each returns 0 if there is no memory. A box is six rectangles with outward normals. No ray meets a shape that is
 * not finite or reaches beyond GEOMETRY_REACH. */
#define GEOMETRY_REACH 1e30f

int geometry_add_sphere(geometry *g, sphere s, int material);
int geometry_add_rectangle(geometry *g, rectangle r, int material);
int geometry_add_box(geometry *g, vndf_vec3 low, vndf_vec3 high, int material);
int geometry_add_triangle(geometry *g, const triangle *t, int material);

/* The rectangle as a mesh of two triangles a pixel, whose corners, the upper left ones of pixels, stand over it by the
 * red of the image times `height`. */
int geometry_add_displaced(geometry *g, rectangle plate, const image *heights, float height, int material);

/* Adds the triangles of an OBJ file (v, vt, vn, f with convex polygons and negative indices; other lines are
 * ignored), scaled, then turned about y by `turn` degrees (z towards x), then moved. The vt lines count v from the
 * bottom, hits count it from the top. Returns 1; or 0 and a message with file, line and error, and then adds
 * nothing. Untrusted files are safe. */
typedef struct placement {
    float scale, turn;
    vndf_vec3 move;
} placement;

int geometry_add_obj(geometry *g, const char *path, const placement *where, int material, char *message,
                     size_t size);
/* The same from an open file; messages call it `name`. */
int geometry_read_obj(geometry *g, FILE *file, const char *name, const placement *where, int material,
                      char *message, size_t size);

/* 0 if there is no memory. */
int geometry_build(geometry *g);
void geometry_free(geometry *g);

/* The nearest shape in (from, to); 0 if there is none. */
int geometry_hit(const geometry *g, const ray *r, hit *h);

/* Whether any shape is in (from, to). */
int geometry_blocked(const geometry *g, const ray *r);

/* Whether another shape is before shape `at`; if the ray misses `at`, whether a shape is in (from, to). */
int geometry_hides(const geometry *g, const ray *r, uint32_t at);

/* A ray from a hit to the side of `direction`, which does not meet the same place again. */
ray ray_from(const hit *h, vndf_vec3 direction);

#endif
