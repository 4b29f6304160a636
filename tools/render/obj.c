/* Wavefront OBJ, as far as triangles go:
 *
 *   v x y z ...       a corner; numbers after z are ignored
 *   vt u [v [w]]      a texture coordinate, v from the bottom; images here begin at the top, so v is flipped
 *   vn x y z          a normal, of any length
 *   f A B C ...       a convex polygon, cut into triangles (A, B, C), (A, C, D), ...; each corner is v, v/vt,
 *                     v//vn or v/vt/vn: numbers from 1, or from -1 backwards, of items before the line
 *
 * Blanks separate words, # begins a comment; other lines and triangles without an area are ignored. Where
 * the normals of a triangle contradict the order of its corners, the normals win. */
#include "render/geometry.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/files.h"

/* Against hostile files: with all of them a mesh takes some 1 GiB, and half of that for its hierarchy. */
enum { BYTES_MAX = 1 << 29, ITEMS_MAX = 1 << 22 };

enum { V, VT, VN, TABLES };
static const char *const table_names[TABLES] = {"corners (v)", "texture coordinates (vt)", "normals (vn)"};

/* How large their numbers may be: beyond 1e6 float has no digits for the place in a texture. */
static const double reach[TABLES] = {1e7, 1e6, 1e30};

typedef struct table {
    vec3 *row;
    size_t count, room;
} table;

typedef struct reader {
    const char *name, *at; /* at: the rest of the text */
    unsigned long long line;
    const char *word; /* the last one, of so many letters */
    size_t letters;
    table of[TABLES];
    size_t triangles;
    const placement *where;
    geometry *g;
    int material;
    char *message;
    size_t size;
} reader;

/* Returns 0. Bytes that cannot be printed become '?'. */
PRINTF_LIKE(2, 3) static int complain_at(reader *r, const char *format, ...)
{
    const int head = snprintf(r->message, r->size, "%s:%llu: ", r->name, r->line);
    va_list values;
    va_start(values, format);
    if (head >= 0 && (size_t)head < r->size)
        vsnprintf(r->message + head, r->size - (size_t)head, format, values);
    va_end(values);
    for (char *c = r->message; *c; c++)
        *c = *c >= ' ' && *c < 127 ? *c : '?';
    return 0;
}

/* The same of the last word, whose first letters go before the text. */
static int complain_of(reader *r, const char *what)
{
    return complain_at(r, "'%.*s'%s", (int)(r->letters < 40 ? r->letters : 40), r->word, what);
}

/* Reads the next word of the line; 0 where the line has no more. */
static int next_word(reader *r)
{
    r->at += strspn(r->at, " \t\r\v\f");
    r->word = r->at;
    r->letters = *r->at == '#' ? 0 : strcspn(r->at, " \t\r\v\f\n");
    r->at += r->letters;
    return r->letters > 0;
}

/* ---- items ---- */

/* The numbers of a line, of which the first three count, as an item of one of the tables; 0 after a complaint. */
static int read_item(reader *r, int which)
{
    table *t = &r->of[which];
    double p[3] = {0, 0, 0};
    int count = 0, least = which == VT ? 1 : 3;
    for (; next_word(r); count++) {
        char *end;
        const double value = strtod(r->word, &end); /* which takes nan too */
        if (strspn(r->word, "0123456789+-.eE") < r->letters || end != r->word + r->letters)
            return complain_of(r, " should be a number");
        p[count < 3 ? count : 2] = count < 3 ? value : p[2];
    }
    if (count < least)
        return complain_at(r, "there are %d numbers of %d in this line", count, least);
    vec3 at = which == VT ? vec(p[0], 1 - p[1], 0) : placement_turn(r->where, vec(p[0], p[1], p[2]));
    if (which == V)
        at = along(r->where->move, r->where->scale, at);
    const double largest = fmax(fabs(at.x), fmax(fabs(at.y), fabs(at.z)));
    if (!(largest <= reach[which]))
        return complain_at(r, "%s lie within %g of 0, and these do not", table_names[which], reach[which]);
    if (which == VN && largest > 0)
        at = unit(scale(at, 1 / largest));
    if (t->count == t->room && t->room < ITEMS_MAX) {
        const size_t room = t->room ? 2 * t->room : 64;
        vec3 *larger = realloc(t->row, room * sizeof *larger);
        t->row = larger ? larger : t->row;
        t->room = larger ? room : t->room;
    }
    if (t->count == t->room)
        return complain_at(r, "there is no memory for more than %zu %s", t->count, table_names[which]);
    t->row[t->count++] = at;
    return 1;
}

/* ---- faces ---- */

/* Numbers of its items, from 1; 0: not there. */
typedef struct corner {
    size_t of[TABLES];
} corner;

static int read_corner(reader *r, corner *c)
{
    const char *at = r->word, *end = at + r->letters;
    *c = (corner){{0, 0, 0}};
    for (int i = 0; i < TABLES; i++) {
        char *behind;
        if (i > 0 && *at != '/')
            break;
        if (i > 0 && *++at == '/' && i == VT) /* v//vn */
            continue;
        const long long given = strtoll(at, &behind, 10); /* a number too large becomes the largest */
        const long long count = (long long)r->of[i].count;
        if (behind == at || behind > end)
            return complain_of(r, " should be v, v/vt, v//vn or v/vt/vn, in numbers");
        if (given == 0 || given > count || given < -count)
            return complain_at(r, "number %lld is none of %lld %s so far, which are counted from 1", given, count,
                               table_names[i]);
        c->of[i] = (size_t)(given > 0 ? given : count + 1 + given);
        at = behind;
    }
    return at == end || complain_of(r, " should be v, v/vt, v//vn or v/vt/vn, and end there");
}

static vec3 item_of(const reader *r, const corner *c, int which)
{
    return r->of[which].row[c->of[which] - 1];
}

/* Normals of a mesh win over the order of its corners. */
static int add_triangle(reader *r, const corner *a, const corner *b, const corner *c)
{
    const corner *at[3] = {a, b, c};
    shape t = {.kind = SHAPE_TRIANGLE, .material = r->material, .corner = item_of(r, a, V)};
    t.edge_u = subtract(item_of(r, b, V), t.corner);
    t.edge_v = subtract(item_of(r, c, V), t.corner);
    const vec3 across = cross(t.edge_u, t.edge_v);
    double agreement = 0;
    if (!(length(across) > 1e-15 * (dot(t.edge_u, t.edge_u) + dot(t.edge_v, t.edge_v)))) /* no area but rounding */
        return 1;
    for (int i = 0; i < 3; i++) {
        if (a->of[VN] && b->of[VN] && c->of[VN]) {
            const vec3 n = item_of(r, at[i], VN);
            t.normal[i] = (vndf_vec3){(float)n.x, (float)n.y, (float)n.z};
            agreement += dot(across, n);
        }
        if (a->of[VT] && b->of[VT] && c->of[VT]) {
            t.u[i] = (float)item_of(r, at[i], VT).x;
            t.v[i] = (float)item_of(r, at[i], VT).y;
        }
    }
    if (agreement < 0)
        return add_triangle(r, a, c, b);
    if (r->triangles++ == ITEMS_MAX)
        return complain_at(r, "there are more than %d triangles", ITEMS_MAX);
    return geometry_add(r->g, &t) || complain_at(r, "no memory for its triangles");
}

static int read_face(reader *r)
{
    corner c[3]; /* the first corner, the one before, and this one */
    int count = 0;
    for (; next_word(r); count++) {
        if (!read_corner(r, &c[count < 2 ? count : 2]) || (count >= 2 && !add_triangle(r, &c[0], &c[1], &c[2])))
            return 0;
        if (count >= 2)
            c[1] = c[2];
    }
    return count >= 3 || complain_at(r, "a face has 3 corners or more, this one has %d", count);
}

/* ---- files ---- */

/* Other lines are ignored. */
static int read_line(reader *r)
{
    static const char *const names[TABLES] = {"v", "vt", "vn"};
    if (!next_word(r))
        return 1;
    if (r->letters == 1 && *r->word == 'f')
        return read_face(r);
    for (int i = 0; i < TABLES; i++)
        if (r->letters == strlen(names[i]) && memcmp(r->word, names[i], r->letters) == 0)
            return read_item(r, i);
    return 1;
}

static int read_all(reader *r, size_t length)
{
    if (memchr(r->at, '\0', length))
        return complain_at(r, "the file has a byte 0: it is no text");
    for (; read_line(r); r->at++, r->line++) {
        r->at += strcspn(r->at, "\n");
        if (!*r->at || !r->at[1])
            return r->triangles > 0 || complain_at(r, "the file ends here without a triangle that has an area");
    }
    return 0;
}

int obj_read_text(geometry *g, const char *name, const char *text, size_t length, const placement *where,
                  int material, char *message, size_t size)
{
    const size_t before = g->count;
    reader r = {.name = name,
                .at = text,
                .line = 1,
                .where = where,
                .g = g,
                .material = material,
                .message = message,
                .size = size};
    const int is_read = read_all(&r, length);
    if (!is_read)
        g->count = before;
    for (int i = 0; i < TABLES; i++)
        free(r.of[i].row);
    return is_read;
}

int obj_read(geometry *g, const char *path, const placement *where, int material, char *message, size_t size)
{
    char reason[128];
    size_t length;
    char *text = files_read(path, BYTES_MAX, &length, reason, sizeof reason);
    if (!text) {
        snprintf(message, size, "%s: %s", path, reason);
        return 0;
    }
    const int is_read = obj_read_text(g, path, text, length, where, material, message, size);
    free(text);
    return is_read;
}
