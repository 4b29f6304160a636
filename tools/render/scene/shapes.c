/* Statements of shapes: sphere, rectangle, box, mesh. */
#include "render/scene/reader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The material that a shape names, and whether it is a light. */
static int find_material(scene_reader *r, const clause *c, int *found)
{
    const scene *s = r->made;
    const word *name = &c->values[0];
    const char *near[64];
    size_t count = s->material_count < 64 ? s->material_count : 64;
    for (size_t i = 0; i < s->material_count; i++)
        if (strcmp(s->materials[i].name, name->text) == 0) {
            *found = (int)i;
            r->gives_light |= s->materials[i].kind == MATERIAL_LIGHT;
            return 1;
        }
    for (size_t i = 0; i < count; i++)
        near[i] = s->materials[s->material_count - 1 - i].name;
    if (!count)
        return reader_refuse(r, name, "no material is defined before this, so '%.64s' is none", name->text);
    return reader_unknown(r, name, "material that is defined before this", near, count);
}

static int added(scene_reader *r, const statement *s, int good)
{
    return good || reader_refuse(r, &s->words[0], "there is no memory for this shape");
}

int read_sphere(scene_reader *r, const statement *s)
{
    clause c[] = {{.keyword = "centre", .takes = "X Y Z", .least = 3, .most = 3, .needed = 1},
                  {.keyword = "radius", .takes = "LENGTH", .least = 1, .most = 1, .needed = 1},
                  {.keyword = "material", .takes = "NAME", .least = 1, .most = 1, .needed = 1}};
    sphere made;
    int of;
    if (!reader_clauses(r, s, 1, c, 3) || !reader_vector(r, &c[0], &made.centre) ||
        !reader_number(r, &c[1], 0, SCENE_NEAR, SCENE_FAR, &made.radius) || !find_material(r, &c[2], &of))
        return 0;
    return added(r, s, geometry_add_sphere(&r->made->geometry, made, of));
}

/* The text has few digits, so edges that are meant to be at right angles may be a little off: this corrects the
 * second one. */
static int square_edges(scene_reader *r, const clause c[2], rectangle *made)
{
    for (int i = 0; i < 2; i++) {
        vndf_vec3 edge = i ? made->edge_v : made->edge_u;
        if (!(dot(edge, edge) >= (float)(SCENE_NEAR * SCENE_NEAR)))
            return reader_refuse(r, c[i].at, "'%s' has no length", c[i].keyword);
    }
    float uu = dot(made->edge_u, made->edge_u), vv = dot(made->edge_v, made->edge_v);
    float uv = dot(made->edge_u, made->edge_v), cosine = uv / (sqrtf(uu) * sqrtf(vv));
    if (!(fabsf(cosine) < 2e-3f))
        return reader_refuse(r, c[1].at,
                             "the edges of a rectangle must be at right angles; these are at %.4g degrees",
                             acos((double)fminf(fmaxf(cosine, -1.0f), 1.0f)) * 57.29577951308232);
    made->edge_v = subtract(made->edge_v, scale(made->edge_u, uv / uu));
    return 1;
}

/* A map of heights and what 1 is in it. */
static int add_displaced(scene_reader *r, const statement *s, const clause c[2], rectangle plate, int of)
{
    const image_range height = {"height", 1, -1, 1};
    const image *map;
    float by;
    if (!reader_image(r, &c[0], &map) || !reader_within(r, c[0].values, map, &height) ||
        !reader_number(r, &c[1], 0, -SCENE_FAR, SCENE_FAR, &by))
        return 0;
    r->displaced += (size_t)map->width * (size_t)map->height;
    if (r->displaced > SCENE_DISPLACED_MAX)
        return reader_refuse(r, c[0].values, "these are more than %d pixels of heights to make triangles of",
                             SCENE_DISPLACED_MAX);
    return added(r, s, geometry_add_displaced(&r->made->geometry, plate, map, by, of));
}

int read_rectangle(scene_reader *r, const statement *s)
{
    clause c[] = {{.keyword = "edge-u", .takes = "X Y Z", .least = 3, .most = 3, .needed = 1},
                  {.keyword = "edge-v", .takes = "X Y Z", .least = 3, .most = 3, .needed = 1},
                  {.keyword = "corner", .takes = "X Y Z", .least = 3, .most = 3, .needed = 1},
                  {.keyword = "material", .takes = "NAME", .least = 1, .most = 1, .needed = 1},
                  {.keyword = "heights", .takes = "IMAGE", .least = 1, .most = 1},
                  {.keyword = "height", .takes = "LENGTH", .least = 1, .most = 1}};
    rectangle made;
    int of;
    if (!reader_clauses(r, s, 1, c, 6) || !reader_vector(r, &c[0], &made.edge_u) ||
        !reader_vector(r, &c[1], &made.edge_v) || !reader_vector(r, &c[2], &made.corner) ||
        !square_edges(r, c, &made) || !find_material(r, &c[3], &of))
        return 0;
    if (!c[4].at != !c[5].at)
        return reader_refuse(r, c[4].at ? c[4].at : c[5].at, "'heights IMAGE' and 'height LENGTH' go together");
    if (c[4].at)
        return add_displaced(r, s, &c[4], made, of);
    return added(r, s, geometry_add_rectangle(&r->made->geometry, made, of));
}

int read_box(scene_reader *r, const statement *s)
{
    clause c[] = {{.keyword = "from", .takes = "X Y Z", .least = 3, .most = 3, .needed = 1},
                  {.keyword = "to", .takes = "X Y Z", .least = 3, .most = 3, .needed = 1},
                  {.keyword = "material", .takes = "NAME", .least = 1, .most = 1, .needed = 1}};
    vndf_vec3 a, b;
    int of;
    if (!reader_clauses(r, s, 1, c, 3) || !reader_vector(r, &c[0], &a) || !reader_vector(r, &c[1], &b) ||
        !find_material(r, &c[2], &of))
        return 0;
    vndf_vec3 low = vec(fminf(a.x, b.x), fminf(a.y, b.y), fminf(a.z, b.z));
    vndf_vec3 high = vec(fmaxf(a.x, b.x), fmaxf(a.y, b.y), fmaxf(a.z, b.z)), size = subtract(high, low);
    if (!(fminf(size.x, fminf(size.y, size.z)) >= (float)SCENE_NEAR))
        return reader_refuse(r, c[1].at, "the box is flat: 'from' and 'to' must differ in x, y and z");
    return added(r, s, geometry_add_box(&r->made->geometry, low, high, of));
}

int read_mesh(scene_reader *r, const statement *s)
{
    clause c[] = {{.keyword = "file", .takes = "PATH", .least = 1, .most = 1, .needed = 1},
                  {.keyword = "scale", .takes = "FACTOR", .least = 1, .most = 1},
                  {.keyword = "turn", .takes = "DEGREES", .least = 1, .most = 1},
                  {.keyword = "move", .takes = "X Y Z", .least = 3, .most = 3},
                  {.keyword = "material", .takes = "NAME", .least = 1, .most = 1, .needed = 1}};
    placement where = {1.0f, 0.0f, {0.0f, 0.0f, 0.0f}};
    int of;
    char why[512];
    if (!reader_clauses(r, s, 1, c, 5) ||
        (c[1].at && !reader_number(r, &c[1], 0, SCENE_NEAR, SCENE_FAR, &where.scale)) ||
        (c[2].at && !reader_number(r, &c[2], 0, -360, 360, &where.turn)) ||
        (c[3].at && !reader_vector(r, &c[3], &where.move)) || !find_material(r, &c[4], &of))
        return 0;
    char *path = reader_path(r, c[0].values);
    if (!path)
        return 0;
    int good = geometry_add_obj(&r->made->geometry, path, &where, of, why, sizeof why);
    free(path);
    return good || reader_refuse(r, c[0].values, "%s", why);
}
