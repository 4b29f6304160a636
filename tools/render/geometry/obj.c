/* Wavefront OBJ, as far as triangles go:
 *
 *   v x y z [w | r g b]   a corner; numbers after z are ignored
 *   vt u [v [w]]          a texture coordinate, v from the bottom; images here begin at the top, so v is flipped
 *   vn x y z              a normal, of any length
 *   f A B C ...           a convex polygon, cut into triangles (A, B, C), (A, C, D), ...; each corner is v, v/vt,
 *                         v//vn or v/vt/vn: numbers from 1, or from -1 backwards, of items before the line
 *
 * Corners, coordinates and normals are placed as they are read (obj_items.c). Triangles without an area are
 * ignored. Where the normals of a triangle contradict the order of its corners, the normals win. A polygon is cut
 * while it is read and takes no memory of its own. A file has at most OBJ_BYTES_MAX bytes, and at most
 * OBJ_ITEMS_MAX each of v, vt, vn and triangles: the most hostile file takes some 3.2 GiB, and 1.5 GiB for the
 * hierarchy. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "render/geometry/obj_items.h"

#define PI 3.14159265358979323846

typedef struct corner {
    long long v, vt, vn; /* from 1; 0: not there */
} corner;

/* ---- faces -------------------------------------------------------------------------------------- */

/* Reads an index at *at, which moves behind it; 0 after a complaint. */
static int read_index(obj_reader *r, const char **at, const obj_table *of, long long *index)
{
    char *end;
    const long long given = strtoll(*at, &end, 10); /* a number too large becomes the largest */
    const long long count = (long long)of->count;
    if (end == *at)
        return obj_complain(&r->text, "'%s' should be v, v/vt, v//vn or v/vt/vn, in numbers", r->text.word);
    *at = end;
    if (given == 0)
        return obj_complain(&r->text, "'%s': %s are counted from 1", r->text.word, of->name);
    if (given > count || given < -count)
        return obj_complain(&r->text, "'%s': there are %lld %s so far", r->text.word, count, of->name);
    *index = given > 0 ? given : count + 1 + given;
    return 1;
}

/* As obj_word. */
static int read_corner(obj_reader *r, corner *c)
{
    const int is_there = obj_word(&r->text);
    if (is_there != 1)
        return is_there;
    const char *at = r->text.word;
    const corner none = {0, 0, 0};
    *c = none;
    if (!read_index(r, &at, &r->v, &c->v))
        return -1;
    if (at[0] == '/' && at[1] != '/') {
        at++;
        if (!read_index(r, &at, &r->vt, &c->vt))
            return -1;
    } else if (at[0] == '/') {
        at++;
    }
    if (at[0] == '/') {
        at++;
        if (!read_index(r, &at, &r->vn, &c->vn))
            return -1;
    }
    return *at == '\0' ? 1
                       : obj_complain(&r->text, "'%s' should end after '%.*s'", r->text.word,
                                      (int)(at - r->text.word), r->text.word) -
                             1;
}

static vndf_vec3 row_of(const obj_table *t, long long index)
{
    const float *row = t->data + (size_t)(index - 1) * t->width;
    return vec(row[0], row[1], row[2]);
}

/* The normal by the order of corners; 0 if the triangle has no area. */
static wide winding(const triangle *t)
{
    const wide a = widen(t->corner[0]);
    return wide_cross(wide_subtract(widen(t->corner[1]), a), wide_subtract(widen(t->corner[2]), a));
}

static triangle triangle_of(const obj_reader *r, const corner c[3])
{
    triangle t;
    memset(&t, 0, sizeof t);
    const int has_uv = c[0].vt && c[1].vt && c[2].vt, has_normals = c[0].vn && c[1].vn && c[2].vn;
    for (int i = 0; i < 3; i++) {
        t.corner[i] = row_of(&r->v, c[i].v);
        if (has_normals)
            t.normal[i] = row_of(&r->vn, c[i].vn);
        if (has_uv) {
            const float *uv = r->vt.data + 2 * (size_t)(c[i].vt - 1);
            t.u[i] = uv[0];
            t.v[i] = uv[1];
        }
    }
    return t;
}

static int add_triangle(obj_reader *r, const corner c[3])
{
    triangle t = triangle_of(r, c);
    const wide n = winding(&t);
    if (!(wide_dot(n, n) > 0.0))
        return 1;
    const wide normals = wide_add(widen(t.normal[0]), wide_add(widen(t.normal[1]), widen(t.normal[2])));
    const double agreement = wide_dot(n, normals);
    if (agreement < 0.0 || (agreement == 0.0 && r->scale < 0.0)) { /* mirrored, without normals to say so */
        const corner other[3] = {c[0], c[2], c[1]};
        t = triangle_of(r, other);
    }
    if (r->triangles == OBJ_ITEMS_MAX)
        return obj_complain(&r->text, "there are more than %d triangles", OBJ_ITEMS_MAX);
    r->triangles++;
    return geometry_add_triangle(r->g, &t, r->material) || obj_complain(&r->text, "no memory for its triangles");
}

static int read_f(obj_reader *r)
{
    corner c[3]; /* the first corner, the one before, and this one */
    int count = 0, is_there;
    while ((is_there = read_corner(r, &c[count < 2 ? count : 2])) == 1) {
        if (++count < 3)
            continue;
        if (!add_triangle(r, c))
            return 0;
        c[1] = c[2];
        count = 3;
    }
    if (is_there == 0 && count < 3)
        return obj_complain(&r->text, "f has %d corner%s, it should have 3 or more", count, count == 1 ? "" : "s");
    return is_there == 0;
}

/* ---- files -------------------------------------------------------------------------------------- */

static int read_line(obj_reader *r)
{
    const int is_there = obj_keyword(&r->text);
    if (is_there != 1)
        return is_there == 0;
    const char *word = r->text.word;
    return strcmp(word, "v") == 0    ? obj_read_v(r)
           : strcmp(word, "f") == 0  ? read_f(r)
           : strcmp(word, "vt") == 0 ? obj_read_vt(r)
           : strcmp(word, "vn") == 0 ? obj_read_vn(r)
                                     : 1;
}

static int read_all(obj_reader *r)
{
    int good;
    do
        good = read_line(r);
    while (good && obj_next_line(&r->text));
    if (r->text.bytes > OBJ_BYTES_MAX) /* perhaps a device or a pipe: its last line is cut */
        return obj_complain(&r->text, "the file has more than %d bytes", OBJ_BYTES_MAX);
    if (!good)
        return 0;
    if (ferror(r->text.file))
        return obj_complain(&r->text, "the file cannot be read on from here");
    return r->triangles > 0 || obj_complain(&r->text, "the file ends here without a triangle that has an area");
}

static void reader_begin(obj_reader *r, FILE *file, const char *name, const placement *where)
{
    const double turn = (double)where->turn * (PI / 180.0);
    r->text.file = file;
    r->text.name = name;
    r->text.line = 1;
    r->v = (obj_table){NULL, 0, 0, 3, "corners (v)"};
    r->vt = (obj_table){NULL, 0, 0, 2, "texture coordinates (vt)"};
    r->vn = (obj_table){NULL, 0, 0, 3, "normals (vn)"};
    r->scale = (double)where->scale;
    r->cosine = cos(turn);
    r->sine = sin(turn);
    r->move = widen(where->move);
}

int geometry_read_obj(geometry *g, FILE *file, const char *name, const placement *where, int material,
                      char *message, size_t size)
{
    const size_t shapes = g->shape_count, triangles = g->triangle_count;
    obj_reader *r = calloc(1, sizeof *r); /* its block of text is too long for a stack */
    if (!r) {
        snprintf(message, size, "%s: no memory to read it", name);
        return 0;
    }
    reader_begin(r, file, name, where);
    r->text.message = message;
    r->text.size = size;
    r->g = g;
    r->material = material;
    const int is_read = read_all(r);
    if (!is_read) {
        g->shape_count = shapes;
        g->triangle_count = triangles;
    }
    free(r->v.data);
    free(r->vt.data);
    free(r->vn.data);
    free(r);
    return is_read;
}

int geometry_add_obj(geometry *g, const char *path, const placement *where, int material, char *message,
                     size_t size)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        snprintf(message, size, "%s: cannot be opened: %s", path, strerror(errno));
        return 0;
    }
    const int is_read = geometry_read_obj(g, file, path, where, material, message, size);
    fclose(file);
    return is_read;
}
