/* Rays against shapes, and the hierarchy of boxes about them.
 *
 *   meets      one shape: a sphere by the part of its centre across the ray (small and distant spheres do not cancel),
 *              a parallelogram or half of one by Moeller & Trumbore ("Fast, Minimum Storage Ray/Triangle
 *              Intersection", JGT 1997), with edges that overlap by 1e-13, so that no ray passes between neighbours
 *   build      from the root down, in the middle of the longest side
 *   walk       the nearer child first
 *   describe   the place that was met: computed from the shape, so that it lies on it
 *
 * All of it is in double from coordinates below 1e7: places are exact to some 1e-15 of the coordinates. */
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

/* The nearest so far. */
typedef struct meeting {
    const shape *shape;
    double distance, a, b; /* a and b: along edge_u and edge_v */
} meeting;

static int closer(meeting *m, const shape *s, double distance, double a, double b)
{
    if (!(distance > 0 && distance < m->distance))
        return 0;
    *m = (meeting){s, distance, a, b};
    return 1;
}

static int sphere_meets(const shape *s, const ray *r, meeting *m)
{
    const vec3 from_centre = subtract(r->origin, s->corner);
    const double b = dot(from_centre, r->direction);
    const vec3 across = along(from_centre, -b, r->direction);
    const double rest = s->radius * s->radius - dot(across, across);
    if (!(rest >= 0))
        return 0;
    const double q = -b - copysign(sqrt(rest), b), c = dot(from_centre, from_centre) - s->radius * s->radius;
    const double other = q != 0 ? c / q : q, near = fmin(q, other);
    return closer(m, s, near > 0 ? near : fmax(q, other), 0, 0);
}

static int flat_meets(const shape *s, const ray *r, meeting *m)
{
    const double low = -1e-13, high = 1 - low;
    const vec3 p = cross(r->direction, s->edge_v), from_corner = subtract(r->origin, s->corner);
    const double determinant = dot(s->edge_u, p), a = dot(from_corner, p) / determinant;
    if (!(a >= low && a <= high)) /* NaN: the ray lies in the plane */
        return 0;
    const vec3 q = cross(from_corner, s->edge_u);
    const double b = dot(r->direction, q) / determinant;
    if (!(b >= low && (s->kind == SHAPE_RECTANGLE ? b : a + b) <= high))
        return 0;
    return closer(m, s, dot(s->edge_v, q) / determinant, fmin(fmax(a, 0), 1), fmin(fmax(b, 0), 1));
}

static int meets(const shape *s, const ray *r, meeting *m)
{
    return s->kind == SHAPE_SPHERE ? sphere_meets(s, r, m) : flat_meets(s, r, m);
}

/* ---- boxes ---- */

static const box no_box = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};

static void enclose(box *to, const box *by)
{
    for (int i = 0; i < 3; i++) {
        to->low[i] = fminf(to->low[i], by->low[i]);
        to->high[i] = fmaxf(to->high[i], by->high[i]);
    }
}

/* Rounded outwards, by more than the overlap of edges. */
static void enclose_point(box *to, vec3 p, double margin)
{
    const double at[3] = {p.x, p.y, p.z};
    for (int i = 0; i < 3; i++) {
        to->low[i] = fminf(to->low[i], nextafterf((float)(at[i] - margin), -FLT_MAX));
        to->high[i] = fmaxf(to->high[i], nextafterf((float)(at[i] + margin), FLT_MAX));
    }
}

static box box_of(const shape *s)
{
    box b = no_box;
    enclose_point(&b, s->corner, s->kind == SHAPE_SPHERE ? s->radius : 0);
    if (s->kind == SHAPE_SPHERE)
        return b;
    enclose_point(&b, add(s->corner, s->edge_u), 0);
    enclose_point(&b, add(s->corner, s->edge_v), 0);
    if (s->kind == SHAPE_RECTANGLE)
        enclose_point(&b, add(add(s->corner, s->edge_u), s->edge_v), 0);
    return b;
}

/* ---- building ---- */

enum { LEAF_MAX = 3, DEPTH_MAX = 96, MIDDLES_DEPTH = 60 /* deeper nodes are halved, which bounds them all */ };

static void centre_of(const shape *s, float centre[3])
{
    const box b = box_of(s);
    for (int k = 0; k < 3; k++)
        centre[k] = 0.5f * b.low[k] + 0.5f * b.high[k];
}

/* Moves the shapes before the middle of the longest side of all centres to the front; how many they are. */
static uint32_t split(shape *shapes, uint32_t count, int depth)
{
    float low[3] = {FLT_MAX, FLT_MAX, FLT_MAX}, high[3] = {-FLT_MAX, -FLT_MAX, -FLT_MAX}, centre[3];
    uint32_t left = 0;
    int axis = 0;
    for (uint32_t i = 0; i < count; i++) {
        centre_of(&shapes[i], centre);
        for (int k = 0; k < 3; k++) {
            low[k] = fminf(low[k], centre[k]);
            high[k] = fmaxf(high[k], centre[k]);
        }
    }
    for (int k = 1; k < 3; k++)
        axis = high[k] - low[k] > high[axis] - low[axis] ? k : axis;
    const float middle = 0.5f * low[axis] + 0.5f * high[axis];
    for (uint32_t i = 0; i < count && depth < MIDDLES_DEPTH; i++) {
        centre_of(&shapes[i], centre);
        if (centre[axis] < middle) {
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
    for (uint32_t i = first; i < first + count; i++) {
        const box b = box_of(&g->shapes[i]);
        enclose(&node->box, &b);
    }
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

/* The nearest meeting, or any meeting if that is enough. */
static int walk(const geometry *g, const ray *r, int any, meeting *m)
{
    const slabs s = {{r->origin.x, r->origin.y, r->origin.z},
                     {1 / r->direction.x, 1 / r->direction.y, 1 / r->direction.z}};
    struct {
        uint32_t node;
        double near;
    } stack[DEPTH_MAX];
    int height = 0, is_met = 0;
    *m = (meeting){NULL, r->to, 0, 0};
    if (!g->nodes)
        return 0;
    stack[height].near = entry(&g->nodes[0].box, &s, m->distance);
    stack[height++].node = 0;
    while (height) {
        uint32_t at = stack[--height].node;
        double near = stack[height].near;
        while (near < m->distance && !g->nodes[at].count) { /* goes down to a leaf, the nearer child first */
            uint32_t one = at + 1, other = g->nodes[at].at;
            double to_one = entry(&g->nodes[one].box, &s, m->distance);
            double to_other = entry(&g->nodes[other].box, &s, m->distance);
            at = to_one <= to_other ? one : other;
            near = fmin(to_one, to_other);
            stack[height].node = to_one <= to_other ? other : one;
            stack[height].near = fmax(to_one, to_other);
            height += stack[height].near < HUGE_VAL;
        }
        for (uint32_t i = 0; near < m->distance && i < g->nodes[at].count; i++)
            is_met |= meets(&g->shapes[g->nodes[at].at + i], r, m);
        if (is_met && any)
            return 1;
    }
    return is_met;
}

int geometry_blocked(const geometry *g, const ray *r)
{
    meeting m;
    return walk(g, r, 1, &m);
}

/* ---- what was met ---- */

static void describe_sphere(const ray *r, const meeting *m, hit *h)
{
    const shape *s = m->shape;
    const vec3 n = unit(subtract(along(r->origin, m->distance, r->direction), s->corner));
    const double longitude = atan2(n.x, n.z) / (2 * PI);
    h->normal = n;
    h->place = along(s->corner, s->radius, n);
    h->shading = frame_about(n, vec(n.z, 0, -n.x));
    h->u = longitude < 0 ? longitude + 1 : longitude;
    h->v = atan2(hypot(n.x, n.z), n.y) / PI;
}

/* With texture coordinates (u, v) at its corners, edge_u = du1 dp/du + dv1 dp/dv, and edge_v likewise; hence dp/du
 * ~ dv2 edge_u - dv1 edge_v, with the sign of the determinant. */
static void describe_mesh(const meeting *m, hit *h)
{
    const shape *s = m->shape;
    const double weight[3] = {1 - m->a - m->b, m->a, m->b};
    vec3 n = {0, 0, 0};
    h->u = h->v = 0;
    for (int i = 0; i < 3; i++) {
        n = along(n, weight[i], vec((double)s->normal[i].x, (double)s->normal[i].y, (double)s->normal[i].z));
        h->u += weight[i] * (double)s->u[i];
        h->v += weight[i] * (double)s->v[i];
    }
    const double dv1 = (double)(s->v[1] - s->v[0]), dv2 = (double)(s->v[2] - s->v[0]);
    const double determinant = (double)(s->u[1] - s->u[0]) * dv2 - (double)(s->u[2] - s->u[0]) * dv1;
    const vec3 to = along(scale(s->edge_u, dv2), -dv1, s->edge_v);
    /* an interpolated normal can turn below the surface */
    h->shading = frame_about(dot(n, h->normal) > 0 ? unit(n) : h->normal, scale(to, copysign(1, determinant)));
}

int geometry_hit(const geometry *g, const ray *r, hit *h)
{
    meeting m;
    if (!walk(g, r, 0, &m))
        return 0;
    const shape *s = m.shape;
    h->shape = s;
    h->distance = m.distance;
    if (s->kind == SHAPE_SPHERE) {
        describe_sphere(r, &m, h);
        return 1;
    }
    h->normal = unit(cross(s->edge_u, s->edge_v));
    h->place = along(along(s->corner, m.a, s->edge_u), m.b, s->edge_v);
    if (s->kind == SHAPE_TRIANGLE) {
        describe_mesh(&m, h);
        return 1;
    }
    h->shading = frame_about(h->normal, s->edge_u);
    h->u = fmin(m.a, 1 - DBL_EPSILON); /* at 1 the image would begin again */
    h->v = fmin(1 - m.b, 1 - DBL_EPSILON);
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
    const ray r = {along(h->place, side * 1e-12 * extent, h->normal), direction, HUGE_VAL};
    return r;
}
