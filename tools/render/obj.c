/* Wavefront OBJ, as far as triangles go:
 *
 *   v x y z ...       a corner; numbers after z are ignored
 *   vt u [v [w]]      a texture coordinate, v from the bottom; images here begin at the top, so v is flipped
 *   vn x y z          a normal, of any length
 *   f A B C ...       a convex polygon, cut into triangles (A, B, C), (A, C, D), ...; each corner is v, v/vt,
 * v//vn or v/vt/vn: numbers from 1, or from -1 backwards, of items before the line
 *
 * Blanks separate words, a backslash before the end of a line joins it to the next, # begins a comment; other
 * lines are ignored. Triangles without an area are ignored. Where the normals of a triangle contradict the order
 * of its corners, the normals win. */
#include "render/geometry.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/files.h"

/* Against hostile files: with all of them a mesh takes some 1 GiB, and half of that for its hierarchy. */
enum { BYTES_MAX = 1 << 29, ITEMS_MAX = 1 << 22 };

/* Rows of three numbers. */
typedef struct table {
    double (*row)[3];
    size_t count, room;
    const char *name; /* "corners (v)" */
} table;

typedef struct reader {
    const char *name, *at; /* at: the rest of the text */
    unsigned long long line;
    const char *word; /* the last one, of so many letters, and how many of them messages quote */
    size_t letters;
    int quoted;
    table v, vt, vn;
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

/* ---- words ---- */

/* Reads the next word of the line: 1; 0 where the line has no more, -1 after a complaint. */
static int next_word(reader *r)
{
    for (;;) {
        r->at += strspn(r->at, " \t\r\v\f");
        if (*r->at != '\\')
            break;
        size_t end = 1 + (r->at[1] == '\r');
        if (r->at[end] != '\n')
            return complain_at(r, "a backslash stands only at the end of a line, which it joins to the next") - 1;
        r->at += end + 1;
        r->line++;
    }
    r->word = r->at;
    r->letters = *r->at == '#' ? 0 : strcspn(r->at, " \t\r\v\f\n\\");
    r->quoted = r->letters < 40 ? (int)r->letters : 40;
    r->at += r->letters;
    return r->letters > 0;
}

static int is_word(const reader *r, const char *word)
{
    return r->letters == strlen(word) && memcmp(r->word, word, r->letters) == 0;
}

/* Reads the numbers up to the end of the line, `least` at least, and keeps the first three; 0 after a complaint. */
static int read_numbers(reader *r, const char *what, int least, double values[3])
{
    int count = 0, is_there;
    while ((is_there = next_word(r)) == 1) {
        char *end;
        const double value = strtod(r->word, &end); /* which takes nan too */
        if (strspn(r->word, "0123456789+-.eE") < r->letters || end != r->word + r->letters)
            return complain_at(r, "'%.*s' should be a number", r->quoted, r->word);
        if (!(fabs(value) <= 1e30))
            return complain_at(r, "'%.*s' is too large a number", r->quoted, r->word);
        if (count < 3)
            values[count] = value;
        count++;
    }
    if (is_there == 0 && count < least)
        return complain_at(r, "%s has %d number%s, it should have %d", what, count, count == 1 ? "" : "s", least);
    return is_there == 0;
}

/* ---- items ---- */

static int append(reader *r, table *t, vec3 v)
{
    if (t->count == ITEMS_MAX)
        return complain_at(r, "there are more than %d %s", ITEMS_MAX, t->name);
    if (t->count == t->room) {
        const size_t room = 64 + 2 * t->room;
        double(*larger)[3] = realloc(t->row, room * sizeof *larger);
        if (!larger)
            return complain_at(r, "no memory for %zu %s", room, t->name);
        t->row = larger;
        t->room = room;
    }
    const double row[3] = {v.x, v.y, v.z};
    memcpy(t->row[t->count++], row, sizeof row);
    return 1;
}

static int read_v(reader *r)
{
    double p[3];
    if (!read_numbers(r, "v", 3, p))
        return 0;
    const vec3 placed = along(r->where->move, r->where->scale, placement_turn(r->where, vec(p[0], p[1], p[2])));
    const double reach = 1e7;
    if (!(fabs(placed.x) <= reach && fabs(placed.y) <= reach && fabs(placed.z) <= reach))
        return complain_at(r, "this corner lies farther than %g from the origin", reach);
    return append(r, &r->v, placed);
}

static int read_vt(reader *r)
{
    const double reach = 1e6; /* beyond it, float has no digits for the place in a texture */
    double p[3] = {0, 0, 0};
    if (!read_numbers(r, "vt", 1, p))
        return 0;
    if (!(fabs(p[0]) <= reach && fabs(p[1]) <= reach))
        return complain_at(r, "a texture coordinate is beyond %g", reach);
    return append(r, &r->vt, vec(p[0], 1 - p[1], 0));
}

static int read_vn(reader *r)
{
    double p[3];
    if (!read_numbers(r, "vn", 3, p))
        return 0;
    const double largest = fmax(fabs(p[0]), fmax(fabs(p[1]), fabs(p[2])));
    const vec3 n = placement_turn(r->where, vec(p[0], p[1], p[2]));
    return append(r, &r->vn, largest > 0 ? unit(scale(n, 1 / largest)) : n);
}

/* ---- faces ---- */

typedef struct corner {
    size_t v, vt, vn; /* from 1; 0: not there */
} corner;

/* Reads an index at *at, which moves behind it; 0 after a complaint. */
static int read_index(reader *r, const char **at, const table *of, size_t *index)
{
    char *end;
    const long long given = strtoll(*at, &end, 10); /* a number too large becomes the largest */
    const long long count = (long long)of->count;
    if (end == *at || end > r->word + r->letters)
        return complain_at(r, "'%.*s' should be v, v/vt, v//vn or v/vt/vn, in numbers", r->quoted, r->word);
    *at = end;
    if (given == 0)
        return complain_at(r, "'%.*s': %s are counted from 1", r->quoted, r->word, of->name);
    if (given > count || given < -count)
        return complain_at(r, "'%.*s': there are %lld %s so far", r->quoted, r->word, count, of->name);
    *index = (size_t)(given > 0 ? given : count + 1 + given);
    return 1;
}

static int read_corner(reader *r, corner *c)
{
    const char *at = r->word, *end = at + r->letters;
    *c = (corner){0, 0, 0};
    if (!read_index(r, &at, &r->v, &c->v))
        return 0;
    if (*at == '/' && *++at != '/' && !read_index(r, &at, &r->vt, &c->vt))
        return 0;
    if (*at == '/') {
        at++;
        if (!read_index(r, &at, &r->vn, &c->vn))
            return 0;
    }
    return at == end ||
           complain_at(r, "'%.*s' should end after '%.*s'", r->quoted, r->word, (int)(at - r->word), r->word);
}

static vec3 row_of(const table *t, size_t index)
{
    const double *row = t->row[index - 1];
    return vec(row[0], row[1], row[2]);
}

static shape triangle_of(const reader *r, const corner *a, const corner *b, const corner *c)
{
    const corner *at[3] = {a, b, c};
    shape t = {.kind = SHAPE_TRIANGLE, .material = r->material, .corner = row_of(&r->v, a->v)};
    t.edge_u = subtract(row_of(&r->v, b->v), t.corner);
    t.edge_v = subtract(row_of(&r->v, c->v), t.corner);
    for (int i = 0; i < 3 && a->vn && b->vn && c->vn; i++) {
        const vec3 n = row_of(&r->vn, at[i]->vn);
        t.normal[i] = (vndf_vec3){(float)n.x, (float)n.y, (float)n.z};
    }
    for (int i = 0; i < 3 && a->vt && b->vt && c->vt; i++) {
        t.u[i] = (float)r->vt.row[at[i]->vt - 1][0];
        t.v[i] = (float)r->vt.row[at[i]->vt - 1][1];
    }
    return t;
}

static int add_triangle(reader *r, const corner c[3])
{
    shape t = triangle_of(r, &c[0], &c[1], &c[2]);
    const vec3 n = cross(t.edge_u, t.edge_v);
    const double least =
        1e-15 * (dot(t.edge_u, t.edge_u) + dot(t.edge_v, t.edge_v)); /* what is left of rounding */
    if (!(length(n) > least))
        return 1;
    double agreement = 0;
    for (int i = 0; i < 3; i++)
        agreement += n.x * (double)t.normal[i].x + n.y * (double)t.normal[i].y + n.z * (double)t.normal[i].z;
    if (agreement < 0)
        t = triangle_of(r, &c[0], &c[2], &c[1]);
    if (r->triangles++ == ITEMS_MAX)
        return complain_at(r, "there are more than %d triangles", ITEMS_MAX);
    return geometry_add(r->g, &t) || complain_at(r, "no memory for its triangles");
}

static int read_f(reader *r)
{
    corner c[3]; /* the first corner, the one before, and this one */
    int count = 0, is_there;
    while ((is_there = next_word(r)) == 1) {
        if (!read_corner(r, &c[count < 2 ? count : 2]))
            return 0;
        if (++count < 3)
            continue;
        if (!add_triangle(r, c))
            return 0;
        c[1] = c[2];
        count = 3;
    }
    if (is_there == 0 && count < 3)
        return complain_at(r, "f has %d corner%s, it should have 3 or more", count, count == 1 ? "" : "s");
    return is_there == 0;
}

/* ---- files ---- */

static int read_line(reader *r)
{
    const int is_there = next_word(r);
    if (is_there != 1)
        return is_there == 0;
    return is_word(r, "v")    ? read_v(r)
           : is_word(r, "f")  ? read_f(r)
           : is_word(r, "vt") ? read_vt(r)
           : is_word(r, "vn") ? read_vn(r)
                              : 1;
}

static int read_all(reader *r, size_t length)
{
    if (memchr(r->at, '\0', length))
        return complain_at(r, "the file has a byte 0: it is no text");
    while (read_line(r)) {
        r->at += strcspn(r->at, "\n");
        if (!*r->at || !r->at[1])
            return r->triangles > 0 || complain_at(r, "the file ends here without a triangle that has an area");
        r->at++;
        r->line++;
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
                .v = {.name = "corners (v)"},
                .vt = {.name = "texture coordinates (vt)"},
                .vn = {.name = "normals (vn)"},
                .where = where,
                .g = g,
                .material = material,
                .message = message,
                .size = size};
    const int is_read = read_all(&r, length);
    if (!is_read)
        g->count = before;
    free(r.v.row);
    free(r.vt.row);
    free(r.vn.row);
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
