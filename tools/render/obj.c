/* Wavefront OBJ, as far as triangles go:
 *
 *   v x y z ...       a corner; numbers after z are ignored
 *   vn x y z          a normal, of any length
 *   f A B C ...       a convex polygon, cut into triangles (A, B, C), (A, C, D), ...; each corner is v, v/vt,
 *                     v//vn or v/vt/vn: numbers from 1, or from -1 backwards, of items before the line; vt is ignored
 *
 * Blanks separate words, # begins a comment; other lines and triangles without an area are ignored. Where
 * the normals of a triangle contradict the order of its corners, the normals win. */
#include "render/geometry.h"

#include <stdlib.h>
#include <string.h>

#include "render/lines.h"

/* Against hostile files: with all of them a mesh takes some 1 GiB, and half of that for its hierarchy. */
enum { ITEMS_MAX = 1 << 22 };

/* What lines begin with, and how large their numbers may be. */
enum { V, VN, TABLES };
static const char *const table_names[TABLES] = {"v", "vn"};
static const double reach[TABLES] = {1e7, 1e30};

typedef struct reader {
    lines in;
    struct {
        vec3 *row;
        size_t count, room;
    } of[TABLES];
    geometry *g;
    int material;
} reader;

/* The first three numbers of a line as an item of one of the tables; 0 after a complaint. */
static int read_item(reader *r, int which)
{
    double p[3] = {0, 0, 0};
    if (r->in.count < 4)
        return wrong(&r->in, "there are %zu numbers of 3 in this line", r->in.count - 1);
    for (size_t i = 0; i < 3; i++)
        if (!parse_numbers(r->in.place, table_names[which], r->in.word[1 + i], -reach[which], reach[which], 1, 1,
                           &p[i]))
            return 0;
    vec3 at = vec(p[0], p[1], p[2]);
    const double largest = fmax(fabs(at.x), fmax(fabs(at.y), fabs(at.z)));
    if (which == VN && largest > 0)
        at = unit(scale(at, 1 / largest));
    if (r->of[which].count == r->of[which].room) {
        const size_t room = 64 + 2 * r->of[which].room;
        vec3 *larger = room <= ITEMS_MAX ? realloc(r->of[which].row, room * sizeof *larger) : NULL;
        if (!larger)
            return wrong(&r->in, "there is no memory for more '%s'", table_names[which]);
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

static int find_item(reader *r, int which, const char *number, const vec3 **found)
{
    char *behind;
    const long long given = strtoll(number, &behind, 10); /* a number too large becomes the largest */
    const long long count = (long long)r->of[which].count;
    if (behind == number || (*behind && *behind != '/'))
        return wrong(&r->in, "'%.40s' should be v, v/vt, v//vn or v/vt/vn, in numbers", number);
    if (given == 0 || given > count || given < -count)
        return wrong(&r->in, "%lld is none of the %lld lines '%s' before this, which are counted from 1", given,
                     count, table_names[which]);
    *found = r->of[which].row + (given > 0 ? given - 1 : count + given);
    return 1;
}

static int read_corner(reader *r, const char *word, corner *c)
{
    const char *slash = strchr(word, '/'), *normal = slash ? strchr(slash + 1, '/') : NULL;
    c->of[VN] = NULL;
    return find_item(r, V, word, &c->of[V]) && (!normal || find_item(r, VN, normal + 1, &c->of[VN]));
}

/* Normals of a mesh win over the order of its corners. */
static int add_triangle(reader *r, const corner *a, const corner *b, const corner *c)
{
    const corner *at[3] = {a, b, c};
    const int has_normals = a->of[VN] && b->of[VN] && c->of[VN];
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
    }
    if (agreement < 0)
        return add_triangle(r, a, c, b);
    if (r->g->count == ITEMS_MAX)
        return wrong(&r->in, "there are more than %d triangles", ITEMS_MAX);
    return geometry_add(r->g, &t) || wrong(&r->in, "no memory for its triangles");
}

static int read_face(reader *r)
{
    corner c[3]; /* the first corner, the one before, and this one */
    for (size_t i = 1; i < r->in.count; i++) {
        if (!read_corner(r, r->in.word[i], &c[i < 3 ? i - 1 : 2]) ||
            (i >= 3 && !add_triangle(r, &c[0], &c[1], &c[2])))
            return 0;
        c[1] = c[i < 3 ? 1 : 2];
    }
    return r->in.count > 3 || wrong(&r->in, "a face has 3 corners or more, this one has %zu", r->in.count - 1);
}

/* ---- files ---- */

/* Lines that begin with something else are ignored. */
static int read_line(reader *r)
{
    if (strcmp(*r->in.word, "f") == 0)
        return read_face(r);
    for (int i = 0; i < TABLES; i++)
        if (strcmp(*r->in.word, table_names[i]) == 0)
            return read_item(r, i);
    return 1;
}

int obj_read_text(geometry *g, const char *name, char *text, size_t length, int material)
{
    const size_t before = g->count;
    reader r = {.g = g, .material = material};
    int more, good = lines_begin(&r.in, name, text, length);
    while (good && (more = lines_next(&r.in)))
        good = more > 0 && read_line(&r);
    if (good && g->count == before)
        good = wrong(&r.in, "the file ends here without a triangle that has an area");
    if (!good)
        g->count = before;
    for (int i = 0; i < TABLES; i++)
        free(r.of[i].row);
    return good;
}
