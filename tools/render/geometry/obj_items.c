/* Lines v, vt and vn of an OBJ file, scaled, turned and moved. The file counts v of texture coordinates from the
 * bottom, the renderer from the top. */
#include "render/geometry/obj_items.h"

#include <stdlib.h>
#include <string.h>

static int append(obj_reader *r, obj_table *t, const float *row)
{
    if (t->count == OBJ_ITEMS_MAX)
        return obj_complain(&r->text, "there are more than %d %s", OBJ_ITEMS_MAX, t->name);
    if (t->count == t->room) {
        const size_t room = t->room < 64 ? 64 : 2 * t->room;
        float *larger = realloc(t->data, room * t->width * sizeof *larger);
        if (!larger)
            return obj_complain(&r->text, "no memory for %zu %s", room, t->name);
        t->data = larger;
        t->room = room;
    }
    memcpy(t->data + t->count++ * t->width, row, t->width * sizeof *row);
    return 1;
}

/* Reads `least` to `most` numbers, up to the end of the line; 0 after a complaint. */
static int read_numbers(obj_reader *r, const char *what, int least, int most, double *values)
{
    double value;
    int count = 0, is_there;
    while ((is_there = obj_number(&r->text, &value)) == 1) {
        if (count == most)
            return obj_complain(&r->text, "%s has more than %d numbers", what, most);
        values[count++] = value;
    }
    if (is_there == 0 && count < least)
        return obj_complain(&r->text, "%s has %d number%s, it should have %d", what, count, count == 1 ? "" : "s",
                            least);
    return is_there == 0;
}

static wide turned(const obj_reader *r, wide p)
{
    const wide t = {r->cosine * p.x + r->sine * p.z, p.y, r->cosine * p.z - r->sine * p.x};
    return t;
}

int obj_read_v(obj_reader *r)
{
    double p[7];
    if (!read_numbers(r, "v", 3, 7, p))
        return 0;
    const wide given = {p[0], p[1], p[2]};
    const wide placed = wide_add(turned(r, wide_scale(given, r->scale)), r->move);
    const double at[3] = {placed.x, placed.y, placed.z}, reach = (double)GEOMETRY_REACH;
    float row[3];
    for (int axis = 0; axis < 3; axis++) {
        if (!(fabs(at[axis]) <= reach))
            return obj_complain(&r->text, "this corner lies farther than %g from the origin", reach);
        row[axis] = (float)at[axis];
    }
    return append(r, &r->v, row);
}

int obj_read_vt(obj_reader *r)
{
    double p[3] = {0.0, 0.0, 0.0};
    if (!read_numbers(r, "vt", 1, 3, p))
        return 0;
    const double reach = 1e6; /* beyond it, float has no digits for the place in a texture */
    if (!(fabs(p[0]) <= reach && fabs(p[1]) <= reach))
        return obj_complain(&r->text, "a texture coordinate is beyond %g", reach);
    const float row[2] = {(float)p[0], (float)(1.0 - p[1])};
    return append(r, &r->vt, row);
}

int obj_read_vn(obj_reader *r)
{
    double p[3];
    if (!read_numbers(r, "vn", 3, 3, p))
        return 0;
    const double largest = fmax(fabs(p[0]), fmax(fabs(p[1]), fabs(p[2])));
    const double by = largest > 0.0 ? 1.0 / largest : 0.0; /* so that squares are in range */
    const wide given = {p[0] * by, p[1] * by, p[2] * by}, n = turned(r, given);
    const double length = wide_length(n), side = r->scale < 0.0 ? -1.0 : 1.0; /* a mirrored mesh mirrors normals */
    const vndf_vec3 made = narrow(wide_scale(n, length > 0.0 ? side / length : 0.0));
    const float row[3] = {made.x, made.y, made.z};
    return append(r, &r->vn, row);
}
