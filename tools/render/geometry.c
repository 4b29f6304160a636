/* Rays against shapes, and the hierarchy of boxes about them. A sphere is met by the part of its centre across the
 * ray (small and distant spheres do not cancel), a parallelogram or half of one by Moeller & Trumbore ("Fast,
 * Minimum Storage Ray/Triangle Intersection", JGT 1997), with edges that overlap by 1e-13, so that no ray passes
 * between neighbours. The place that was met is computed from the shape, so that it lies on it. All of it is in
 * double from coordinates below 1e7: places are exact to some 1e-15 of the coordinates. */
#include "render/geometry.h"

#include <float.h>
#include <stdlib.h>

typedef struct box {
    float low[3], high[3];
} box;

/* A leaf has count > 0 shapes from `at` on. The children of another node are the next node and node `at`. */
struct bvh_node {
    box box;
    uint32_t at, count;
};

/* ---- one shape ---- */

/* Notes the shape, the distance and the place along its edges, if that is nearer than h->distance. */
static int meets(const shape *s, const ray *r, hit *h)
{
    const double low = -1e-13, high = 1 - low;
    const vec3 from = subtract(r->origin, s->corner);
    double distance, a = 0, b = 0;
    if (s->kind == SHAPE_SPHERE) {
        const double middle = -dot(from, r->direction), square = s->radius * s->radius;
        const vec3 across = along(from, middle, r->direction);
        const double rest = square - dot(across, across);
        if (!(rest >= 0))
            return 0;
        const double one = middle + copysign(sqrt(rest), middle);
        const double other = one != 0 ? (dot(from, from) - square) / one : one;
        distance = fmin(one, other) > 0 ? fmin(one, other) : fmax(one, other);
    } else {
        const vec3 p = cross(r->direction, s->edge_v), q = cross(from, s->edge_u);
        const double determinant = dot(s->edge_u, p);
        a = dot(from, p) / determinant;
        b = dot(r->direction, q) / determinant;
        if (!(a >= low && a <= high && b >= low)) /* NaN: the ray lies in the plane */
            return 0;
        if (!((s->kind == SHAPE_RECTANGLE ? b : a + b) <= high))
            return 0;
        distance = dot(s->edge_v, q) / determinant;
    }
    if (!(distance > 0 && distance < h->distance))
        return 0;
    *h = (hit){.shape = s, .distance = distance, .u = fmin(fmax(a, 0), 1), .v = fmin(fmax(b, 0), 1)};
    return 1;
}

/* ---- boxes ---- */

static const box no_box = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};

/* Rounded outwards, by more than the overlap of edges. */
static void enclose(box *to, vec3 p, double margin)
{
    const double at[3] = {p.x, p.y, p.z};
    for (int i = 0; i < 3; i++) {
        to->low[i] = fminf(to->low[i], nextafterf((float)(at[i] - margin), -FLT_MAX));
        to->high[i] = fmaxf(to->high[i], nextafterf((float)(at[i] + margin), FLT_MAX));
    }
}

static void enclose_shape(box *to, const shape *s)
{
    const vec3 right = along(s->corner, 1, s->edge_u);
    enclose(to, s->corner, s->radius);
    enclose(to, right, 0);
    enclose(to, along(s->corner, 1, s->edge_v), 0);
    if (s->kind == SHAPE_RECTANGLE)
        enclose(to, along(right, 1, s->edge_v), 0);
}

/* ---- building ---- */

enum { LEAF_MAX = 3, MIDDLES_DEPTH = 60 /* deeper nodes are halved, which bounds the depth */ };

static vec3 middle_of(const shape *s)
{
    return along(s->corner, 0.5, along(s->edge_u, 1, s->edge_v));
}

/* Moves the shapes before the middle of the longest side of all their middles to the front; how many they are. */
static uint32_t split(shape *shapes, uint32_t count, int depth)
{
    box b = no_box;
    uint32_t left = 0;
    int axis = 0;
    for (uint32_t i = 0; i < count; i++)
        enclose(&b, middle_of(&shapes[i]), 0);
    for (int k = 1; k < 3; k++)
        axis = b.high[k] - b.low[k] > b.high[axis] - b.low[axis] ? k : axis;
    const double half = 0.5 * (double)b.low[axis] + 0.5 * (double)b.high[axis];
    for (uint32_t i = 0; i < count && depth < MIDDLES_DEPTH; i++) {
        const vec3 at = middle_of(&shapes[i]);
        if ((axis == 0 ? at.x : axis == 1 ? at.y : at.z) < half) {
            const shape moved = shapes[i];
            shapes[i] = shapes[left];
            shapes[left++] = moved;
        }
    }
    return left > 0 && left < count ? left : count / 2;
}

/* A node over some of the shapes, and those below it. */
static void build(geometry *g, uint32_t first, uint32_t count, int depth)
{
    bvh_node *node = &g->nodes[g->node_count++];
    *node = (bvh_node){no_box, first, count};
    for (uint32_t i = first; i < first + count; i++)
        enclose_shape(&node->box, &g->shapes[i]);
    if (count <= LEAF_MAX)
        return;
    const uint32_t left = split(g->shapes + first, count, depth);
    build(g, first, left, depth + 1);
    node->at = g->node_count;
    node->count = 0;
    build(g, first + left, count - left, depth + 1);
}

int geometry_build(geometry *g)
{
    if (!g->count)
        return 1;
    g->nodes = malloc((2 * g->count - 1) * sizeof *g->nodes);
    if (!g->nodes)
        return 0;
    build(g, 0, (uint32_t)g->count, 0);
    return 1;
}

int geometry_add(geometry *g, const shape *s)
{
    if (g->count == g->room) {
        const size_t room = 16 + g->room + g->room / 2;
        shape *larger = realloc(g->shapes, room * sizeof *larger);
        if (!larger)
            return 0;
        g->shapes = larger;
        g->room = room;
    }
    g->shapes[g->count++] = *s;
    return 1;
}

void geometry_place(geometry *g, size_t first, double size, double radians, vec3 move)
{
    const frame turned = {{cos(radians), 0, -sin(radians)}, {0, 1, 0}, {sin(radians), 0, cos(radians)}};
    for (size_t k = first; k < g->count; k++) {
        shape *s = &g->shapes[k];
        s->corner = along(move, size, out_of(&turned, s->corner));
        s->edge_u = scale(out_of(&turned, s->edge_u), size);
        s->edge_v = scale(out_of(&turned, s->edge_v), size);
        for (int i = 0; i < 3; i++)
            s->normal[i] = narrow(out_of(&turned, widen(s->normal[i])));
    }
}

void geometry_free(geometry *g)
{
    free(g->shapes);
    free(g->nodes);
    *g = (geometry){0};
}

/* ---- the walk ---- */

typedef struct slabs {
    double origin[3], inverse[3];
} slabs;

/* The distance at which the ray enters the box; infinite if it misses it before `limit` (Kay & Kajiya, SIGGRAPH
 * 1986). 0 times infinity, for a ray in a side of the box, is NaN, which wins no comparison. */
static inline double entry(const box *b, const slabs *s, double limit)
{
    double near = 0, far = limit;
    for (int i = 0; i < 3; i++) {
        const double one = ((double)b->low[i] - s->origin[i]) * s->inverse[i];
        const double other = ((double)b->high[i] - s->origin[i]) * s->inverse[i];
        const double in = one < other ? one : other, out = one < other ? other : one;
        near = in > near ? in : near;
        far = out < far ? out : far;
    }
    return near <= far ? near : HUGE_VAL;
}

/* Meets the shapes of a node that begins at `near`, and of those below it, the nearer child first. */
static int visit(const geometry *g, uint32_t at, double near, const slabs *s, const ray *r, hit *h)
{
    const bvh_node *n = &g->nodes[at];
    int is_met = 0;
    if (!(near < h->distance))
        return 0;
    for (uint32_t i = 0; i < n->count; i++)
        is_met |= meets(&g->shapes[n->at + i], r, h);
    if (n->count)
        return is_met;
    const double one = entry(&n[1].box, s, h->distance), other = entry(&g->nodes[n->at].box, s, h->distance);
    const uint32_t nearer = one <= other ? at + 1 : n->at, farther = one <= other ? n->at : at + 1;
    is_met = visit(g, nearer, fmin(one, other), s, r, h);
    return visit(g, farther, fmax(one, other), s, r, h) || is_met;
}

static int walk(const geometry *g, const ray *r, hit *h)
{
    const slabs s = {{r->origin.x, r->origin.y, r->origin.z},
                     {1 / r->direction.x, 1 / r->direction.y, 1 / r->direction.z}};
    h->distance = r->to;
    return g->nodes && visit(g, 0, 0, &s, r, h);
}

int geometry_blocked(const geometry *g, const ray *r)
{
    hit h;
    return walk(g, r, &h);
}

/* ---- what was met ---- */

int geometry_hit(const geometry *g, const ray *r, hit *h)
{
    if (!walk(g, r, h))
        return 0;
    const shape *s = h->shape;
    vec3 n = h->normal = unit(cross(s->edge_u, s->edge_v)), to = s->edge_u;
    h->place = along(along(s->corner, h->u, s->edge_u), h->v, s->edge_v);
    if (s->kind == SHAPE_SPHERE) {
        n = h->normal = unit(subtract(along(r->origin, h->distance, r->direction), s->corner));
        const double longitude = atan2(n.x, n.z) / (2 * PI);
        h->place = along(s->corner, s->radius, n);
        h->u = longitude < 0 ? longitude + 1 : longitude;
        h->v = atan2(hypot(n.x, n.z), n.y) / PI;
        to = vec(n.z, 0, -n.x);
    } else if (s->kind == SHAPE_RECTANGLE) { /* at 1 the image would begin again */
        h->u = fmin(h->u, 1 - DBL_EPSILON);
        h->v = fmin(1 - h->v, 1 - DBL_EPSILON);
    } else { /* an interpolated normal can turn below the surface */
        const vec3 first = scale(widen(s->normal[0]), 1 - h->u - h->v);
        const vec3 mean = along(along(first, h->u, widen(s->normal[1])), h->v, widen(s->normal[2]));
        n = dot(mean, h->normal) > 0 ? unit(mean) : h->normal;
        to = vec(0, 0, 0);
        h->u = h->v = 0;
    }
    h->shading = frame_about(n, to);
    return 1;
}

/* The place is off its surface by some roundings of the shape's coordinates, 1e-15 of them; a step of 1e-12 along
 * the normal is surely on the other side. */
ray ray_from(const hit *h, vec3 direction)
{
    const shape *s = h->shape;
    const double extent = fabs(s->corner.x) + fabs(s->corner.y) + fabs(s->corner.z) + s->radius +
                          length(s->edge_u) + length(s->edge_v) + length(h->place);
    const double side = dot(h->normal, direction) < 0 ? -1 : 1;
    return (ray){along(h->place, side * 1e-12 * extent, h->normal), direction, HUGE_VAL};
}
