/* Shapes, and the nearest one along a ray: a bounding-volume hierarchy over all of them. */
#pragma once

#include <stdint.h>

#include "render/vector.h"

typedef struct ray {
    vec3 origin, direction; /* unit */
    double to;              /* the farthest distance that counts */
} ray;

typedef enum shape_kind { SHAPE_SPHERE, SHAPE_RECTANGLE, SHAPE_TRIANGLE } shape_kind;

/* A sphere has a radius about `corner`: u is the longitude over 2 pi, from +z by way of +x; v the angle from +y
 * over pi. A rectangle is corner + u edge_u + (1 - v) edge_v, or another parallelogram: an image stands upright
 * where edge_v goes up. A triangle has the corners corner, corner + edge_u, corner + edge_v, which go
 * counter-clockwise seen from outside, and there the normals of a mesh (all 0: its own).
 * Normals point outwards: edge_u x edge_v. */
typedef struct shape {
    shape_kind kind;
    int material; /* index into the materials of the scene */
    vec3 corner, edge_u, edge_v;
    double radius;
    vndf_vec3 normal[3];
} shape;

typedef struct bvh_node bvh_node;

/* Zeroed it is empty. Add shapes, then build once. */
typedef struct geometry {
    shape *shapes; /* owned, as all arrays here; geometry_build changes their order */
    size_t count, room;
    bvh_node *nodes;
    uint32_t node_count;
} geometry;

/* 0 if there is no memory. */
int geometry_add(geometry *g, const shape *s);
int geometry_build(geometry *g);
void geometry_free(geometry *g);

/* ---- meshes ---- */

/* Adds the triangles of `length` bytes of an OBJ file with a 0 behind them, which it changes and complaints call
 * `name`. 0 after a complaint, and then none is added. Files that are not trusted are safe. */
enum { OBJ_BYTES_MAX = 1 << 29 };
int obj_read_text(geometry *g, const char *name, char *text, size_t length, int material);

/* Scales the shapes from `first` on, turns them about y (z towards x), then moves them. */
void geometry_place(geometry *g, size_t first, double size, double radians, vec3 move);

/* ---- rays ---- */

/* Where a ray meets a shape. The z of `shading` is the normal, or the interpolated normal of a mesh; its x is the
 * direction in which u grows, on a mesh any. */
typedef struct hit {
    const shape *shape;
    double distance, u, v; /* u and v: for textures, from the left and the top; 0 on a mesh */
    vec3 place, normal;    /* the geometric normal, outwards */
    frame shading;
} hit;

/* The nearest shape before r->to; 0 if there is none. And whether there is any. */
int geometry_hit(const geometry *g, const ray *r, hit *h);
int geometry_blocked(const geometry *g, const ray *r);

/* A ray from a hit to the side of `direction`, which does not meet the same place again. */
ray ray_from(const hit *h, vec3 direction);
