/* The items of an OBJ file beside faces: corners, texture coordinates and normals, placed, a row each. */
#ifndef TOOLS_RENDER_GEOMETRY_OBJ_ITEMS_H
#define TOOLS_RENDER_GEOMETRY_OBJ_ITEMS_H

#include "render/geometry/geometry.h"
#include "render/geometry/obj_words.h"
#include "render/geometry/wide.h"

enum { OBJ_ITEMS_MAX = 1 << 24 };

/* Rows of `width` floats. */
typedef struct obj_table {
    float *data;
    size_t count, room, width;
    const char *name; /* for people */
} obj_table;

typedef struct obj_reader {
    obj_text text;
    obj_table v, vt, vn;
    double scale, cosine, sine;
    wide move;
    geometry *g;
    size_t triangles; /* of this file */
    int material;
} obj_reader;

/* Each reads the rest of a line that begins with v, vt or vn, and adds a row; 0 after a complaint. */
int obj_read_v(obj_reader *r);
int obj_read_vt(obj_reader *r);
int obj_read_vn(obj_reader *r);

#endif
