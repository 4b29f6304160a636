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

#include <stdlib.h>
#include <string.h>

#include "cli/files.h"
#include "render/image.h"

/* Against hostile files: with all of them a mesh takes some 1 GiB, and half of that for its hierarchy. */
enum { BYTES_MAX = 1 << 29, ITEMS_MAX = 1 << 22 };

/* What lines begin with, and how large their numbers may be: beyond 1e6 float has no digits for the place in a
 * texture. */
enum { V, VT, VN, TABLES };
static const char *const table_names[TABLES] = {"v", "vt", "vn"};
static const double reach[TABLES] = {1e7, 1e6, 1e30};

typedef struct reader {
    const char *name, *at; /* at: the rest of the text */
    unsigned long long line;
    const char *word; /* the last one, of so many letters */
    size_t letters;
    struct {
        vec3 *row;
        size_t count, room;
    } of[TABLES];
    geometry *g;
    int material;
    vndf_error *error;
} reader;

#define refuse(r, ...) refuse_at((r)->error, (r)->name, (r)->line, __VA_ARGS__)

/* Reads the next word of the line; 0 where the line has no more. */
static int next_word(reader *r)
{
    r->at += strspn(r->at, " \t\r\v\f");
    r->word = r->at;
    r->letters = *r->at == '#' ? 0 : strcspn(r->at, " \t\r\v\f\n");
    r->at += r->letters;
    return r->letters > 0;
}

/* A word whose first letters go before what is wrong with it. */
static int complain_of(reader *r, const char *what)
{
    return refuse(r, "'%.*s'%s", (int)(r->letters < 40 ? r->letters : 40), r->word, what);
}

/* The numbers of a line, of which the first three count, as an item of one of the tables; 0 after a complaint. */
static int read_item(reader *r, int which)
{
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
        return refuse(r, "there are %d numbers of %d in this line", count, least);
    vec3 at = which == VT ? vec(p[0], 1 - p[1], 0) : vec(p[0], p[1], p[2]);
    const double largest = fmax(fabs(at.x), fmax(fabs(at.y), fabs(at.z)));
    if (!(largest <= reach[which]))
        return refuse(r, "numbers of '%s' lie within %g of 0, and these do not", table_names[which], reach[which]);
    if (which == VN && largest > 0)
        at = unit(scale(at, 1 / largest));
    if (r->of[which].count == r->of[which].room) {
        const size_t room = 64 + 2 * r->of[which].room;
        vec3 *larger = room <= ITEMS_MAX ? realloc(r->of[which].row, room * sizeof *larger) : NULL;
        if (!larger)
            return refuse(r, "there is no memory for more '%s'", table_names[which]);
        r->of[which].row = larger;
        r->of[which].room = room;
    }
    r->of[which].row[r->of[which].count++] = at;
    return 1;
}

/* ---- faces ---- */

/* Of a corner; NULL: not there. */
typedef struct corner {
    const vec3 *of[TABLES];
} corner;

static int read_corner(reader *r, corner *c)
{
    const char *at = r->word, *end = at + r->letters;
    *c = (corner){{NULL, NULL, NULL}};
    for (int i = 0; i < TABLES && (i == V || *at == '/'); i++) {
        char *behind;
        if (i > V && *++at == '/' && i == VT) /* v//vn */
            continue;
        const long long given = strtoll(at, &behind, 10); /* a number too large becomes the largest */
        const long long count = (long long)r->of[i].count;
        if (behind == at || behind > end)
            return complain_of(r, " should be v, v/vt, v//vn or v/vt/vn, in numbers");
        if (given == 0 || given > count || given < -count)
            return refuse_at(r->error, r->name, r->line,
                             "%lld is none of the %lld lines '%s' before this, which are counted from 1", given,
                             count, table_names[i]);
        c->of[i] = r->of[i].row + (given > 0 ? given - 1 : count + given);
        at = behind;
    }
    return at == end || complain_of(r, " should be v, v/vt, v//vn or v/vt/vn, and end there");
}

/* Normals of a mesh win over the order of its corners. */
static int add_triangle(reader *r, const corner *a, const corner *b, const corner *c)
{
    const corner *at[3] = {a, b, c};
    const int has_normals = a->of[VN] && b->of[VN] && c->of[VN], has_places = a->of[VT] && b->of[VT] && c->of[VT];
    shape t = {.kind = SHAPE_TRIANGLE, .material = r->material, .corner = *a->of[V]};
    t.edge_u = subtract(*b->of[V], t.corner);
    t.edge_v = subtract(*c->of[V], t.corner);
    const vec3 across = cross(t.edge_u, t.edge_v);
    double agreement = 0;
    if (!(length(across) > 1e-15 * (dot(t.edge_u, t.edge_u) + dot(t.edge_v, t.edge_v)))) /* no area but rounding */
        return 1;
    for (int i = 0; i < 3; i++) {
        t.normal[i] = has_normals ? narrow(*at[i]->of[VN]) : t.normal[i];
        agreement += has_normals ? dot(across, *at[i]->of[VN]) : 0;
        t.u[i] = has_places ? (float)at[i]->of[VT]->x : 0.0f;
        t.v[i] = has_places ? (float)at[i]->of[VT]->y : 0.0f;
    }
    if (agreement < 0)
        return add_triangle(r, a, c, b);
    if (r->g->count == ITEMS_MAX)
        return refuse(r, "there are more than %d triangles", ITEMS_MAX);
    return geometry_add(r->g, &t) || refuse(r, "no memory for its triangles");
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
    return count >= 3 || refuse(r, "a face has 3 corners or more, this one has %d", count);
}

/* ---- files ---- */

/* Lines that begin with something else are ignored. */
static int read_line(reader *r)
{
    if (!next_word(r))
        return 1;
    if (r->letters == 1 && *r->word == 'f')
        return read_face(r);
    for (int i = 0; i < TABLES; i++)
        if (r->letters == strlen(table_names[i]) && memcmp(r->word, table_names[i], r->letters) == 0)
            return read_item(r, i);
    return 1;
}

int obj_read_text(geometry *g, const char *name, const char *text, size_t length, int material, vndf_error *error)
{
    const size_t before = g->count;
    reader r = {.name = name, .at = text, .line = 1, .g = g, .material = material, .error = error};
    int good = !memchr(text, '\0', length) || refuse_at(error, name, 1, "the file has a byte 0: it is no text");
    while (good && (good = read_line(&r)) && *(r.at += strcspn(r.at, "\n")) && r.at[1]) {
        r.at++;
        r.line++;
    }
    if (good && g->count == before)
        good = refuse_at(error, name, r.line, "the file ends here without a triangle that has an area");
    if (!good)
        g->count = before;
    for (int i = 0; i < TABLES; i++)
        free(r.of[i].row);
    return good;
}

int obj_read(geometry *g, const char *path, int material, vndf_error *error)
{
    char reason[128];
    size_t size;
    char *text = files_read(path, BYTES_MAX, &size, reason, sizeof reason);
    const int good =
        text ? obj_read_text(g, path, text, size, material, error) : refuse_at(error, path, 0, "%s", reason);
    free(text);
    return good;
}
