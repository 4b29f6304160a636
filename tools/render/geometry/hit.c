/* Walks through the hierarchy, the nearer child first, and rays that start at hits.
 *
 * A ray enters a node if the largest distance to its near planes does not exceed the least distance to its far
 * planes (Kay & Kajiya, SIGGRAPH 1986). Each distance has three roundings, so far distances are lengthened by
 * twice their bound (Ize, "Robust BVH Ray Traversal", JCGT 2013): the walk misses no box that the ray meets. */
#include "render/geometry/shape.h"

static const float longer = 1.0f + 0x1p-21f;

typedef struct slabs {
    float origin[3], inverse[3];
    int is_back[3]; /* the near plane is the high one */
    float from;
} slabs;

static slabs slabs_from(const ray *r)
{
    const float d[3] = {r->direction.x, r->direction.y, r->direction.z};
    slabs s = {{r->origin.x, r->origin.y, r->origin.z}, {0.0f, 0.0f, 0.0f}, {0, 0, 0}, r->from};
    for (int axis = 0; axis < 3; axis++) {
        s.inverse[axis] =
            1.0f / d[axis]; /* if infinite, the planes are at +-infinity, or at NaN for a ray in them */
        s.is_back[axis] = s.inverse[axis] < 0.0f;
    }
    return s;
}

/* The distance where the box begins; HUGE_VALF if the ray misses it, or if it begins behind `limit`. NaN never
 * wins a comparison. */
static inline float entry(const box *b, const slabs *s, float limit)
{
    float near = s->from, far = limit;
    for (int axis = 0; axis < 3; axis++) {
        const float in = (b->bound[s->is_back[axis]][axis] - s->origin[axis]) * s->inverse[axis];
        const float out = (b->bound[1 - s->is_back[axis]][axis] - s->origin[axis]) * s->inverse[axis];
        near = in > near ? in : near;
        far = out < far ? out : far;
    }
    return near <= far * longer ? near : HUGE_VALF;
}

typedef struct waiting {
    uint32_t node;
    float near;
} waiting;

typedef struct walk {
    waiting stack[BVH_DEPTH_MAX];
    int height;
} walk;

/* Goes to the nearer child of a node and puts the other on the stack. 0 if the ray meets neither. */
static inline int descend(const geometry *g, const slabs *s, float limit, uint32_t *node, walk *w)
{
    uint32_t one = *node + 1, other = g->nodes[*node].at;
    float near_one = entry(&g->nodes[one].box, s, limit), near_other = entry(&g->nodes[other].box, s, limit);
    if (near_other < near_one) {
        const uint32_t node_kept = one;
        const float near_kept = near_one;
        one = other;
        near_one = near_other;
        other = node_kept;
        near_other = near_kept;
    }
    if (near_other < HUGE_VALF)
        w->stack[w->height++] = (waiting){other, near_other};
    *node = one;
    return near_one < HUGE_VALF;
}

/* Takes the next node from the stack that does not begin behind the nearest meeting. */
static inline int take(walk *w, float limit, uint32_t *node)
{
    while (w->height > 0) {
        const waiting next = w->stack[--w->height];
        *node = next.node;
        if (next.near <= limit * longer)
            return 1;
    }
    return 0;
}

static int leaf_meets(const geometry *g, const bvh_node *leaf, const line *l, meeting *m)
{
    int is_met = 0;
    for (uint32_t i = leaf->at; i < leaf->at + leaf->count; i++)
        is_met |= shape_meets(g, g->order[i], l, m);
    return is_met;
}

/* Finds the nearest meeting, or any meeting if that is enough. */
static int meet(const geometry *g, const ray *r, const line *l, int any, meeting *m)
{
    const slabs s = slabs_from(r);
    walk w;
    uint32_t node = 0;
    int is_met = 0;
    w.height = 0;
    if (!(entry(&g->nodes[0].box, &s, r->to) < HUGE_VALF))
        return 0;
    for (;;) {
        if (g->nodes[node].count == 0) {
            if (descend(g, &s, (float)m->distance, &node, &w))
                continue;
        } else if (leaf_meets(g, &g->nodes[node], l, m)) {
            is_met = 1;
            if (any)
                return 1;
        }
        if (!take(&w, (float)m->distance, &node))
            return is_met;
    }
}

int geometry_hit(const geometry *g, const ray *r, hit *h)
{
    line l;
    meeting m = {(double)r->to, 0.0, 0.0, 0};
    if (g->nodes == NULL || !line_from(&l, r) || !meet(g, r, &l, 0, &m))
        return 0;
    shape_describe(g, &l, &m, h);
    return 1;
}

int geometry_blocked(const geometry *g, const ray *r)
{
    line l;
    meeting m = {(double)r->to, 0.0, 0.0, 0};
    return g->nodes != NULL && line_from(&l, r) && meet(g, r, &l, 1, &m);
}

/* A shape that is not nearer hides nothing, nor does the shape itself, met again at the same distance. */
int geometry_hides(const geometry *g, const ray *r, uint32_t at)
{
    line l;
    meeting m = {HUGE_VAL, 0.0, 0.0, 0};
    if (g->nodes == NULL || !line_from(&l, r))
        return 0;
    if (!shape_meets(g, at, &l, &m))
        m.distance = (double)r->to;
    return meet(g, r, &l, 1, &m);
}

/* The place is off its surface by its rounding to float, 2^-24 of each coordinate, and by the error of its
 * computation; the origin is rounded once more. A step of twice the sum along the normal is surely on the other
 * side, and no shape computes otherwise. */
ray ray_from(const hit *h, vndf_vec3 direction)
{
    const wide p = widen(h->place), n = widen(h->normal);
    const double rounding = fabs(n.x * p.x) + fabs(n.y * p.y) + fabs(n.z * p.z);
    const double spread = fabs(n.x) + fabs(n.y) + fabs(n.z);
    const double offset = 4.0 * (0x1p-24 * rounding + (double)h->error * spread);
    const double side = wide_dot(n, widen(direction)) < 0.0 ? -1.0 : 1.0;
    const ray r = {narrow(wide_along(p, side * offset, n)), direction, 0.0f, HUGE_VALF};
    return r;
}
