/* Top-down construction with the surface-area heuristic over bins of centroids (Wald, "On fast construction of
 * SAH-based bounding volume hierarchies", RT 2007).
 *
 *   node      takes the box of its references; becomes a leaf, or splits them in two:
 *   choose    takes the plane between bins, on any axis, with the least  area_left n_left + area_right n_right
 *   sides     moves references to the left of the plane to the front
 *
 * The cost of a node is the cost of walking it plus, for each child, the chance that a ray through the node meets
 * the child (the ratio of their areas) times the number of its references. Where no plane separates centroids -
 * all equal, say - and on paths that are too long, references are halved in their present order, so the depth is
 * bounded. */
#include "render/geometry/bvh.h"

#include <float.h>

enum {
    BINS = 16,
    LEAF_MAX = 8,     /* larger leaves are split at any cost */
    PLANES_DEPTH = 60 /* deeper nodes are halved: 60 + log2(2^32) < BVH_DEPTH_MAX */
};

/* The cost of walking a node, in tests of a shape. */
static const double walk_cost = 1.0;

typedef struct bin {
    box box;
    uint32_t count;
} bin;

typedef struct plane {
    double cost;        /* DBL_MAX: no plane */
    double from, scale; /* bin = (centroid - from) scale */
    int axis, bin;      /* this bin and lower ones are on the left */
} plane;

typedef struct builder {
    struct bvh_node *nodes;
    bvh_reference *references;
    uint32_t count; /* of nodes */
} builder;

static const box empty = {{{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}}};

static void grow(box *to, const box *by)
{
    for (int axis = 0; axis < 3; axis++) {
        to->bound[0][axis] = by->bound[0][axis] < to->bound[0][axis] ? by->bound[0][axis] : to->bound[0][axis];
        to->bound[1][axis] = by->bound[1][axis] > to->bound[1][axis] ? by->bound[1][axis] : to->bound[1][axis];
    }
}

/* Half of the surface, in double, which cannot overflow. */
static double area(const box *b)
{
    const double x = (double)b->bound[1][0] - (double)b->bound[0][0];
    const double y = (double)b->bound[1][1] - (double)b->bound[0][1];
    const double z = (double)b->bound[1][2] - (double)b->bound[0][2];
    return x * y + y * z + z * x;
}

static float centroid(const box *b, int axis)
{
    return 0.5f * b->bound[0][axis] + 0.5f * b->bound[1][axis];
}

static box box_of_centroids(const bvh_reference *references, uint32_t count)
{
    box all = empty;
    for (uint32_t i = 0; i < count; i++) {
        box point;
        for (int axis = 0; axis < 3; axis++)
            point.bound[0][axis] = point.bound[1][axis] = centroid(&references[i].box, axis);
        grow(&all, &point);
    }
    return all;
}

static int bin_of(const box *b, const plane *p)
{
    const int i = (int)(((double)centroid(b, p->axis) - p->from) * p->scale);
    return i < BINS - 1 ? i : BINS - 1;
}

/* The best plane between bins of one axis. */
static void sweep(const bin bins[BINS], plane *p)
{
    double cost_right[BINS];
    box side = empty;
    uint32_t count = 0;
    for (int i = BINS - 1; i > 0; i--) {
        grow(&side, &bins[i].box);
        count += bins[i].count;
        cost_right[i] = count > 0 ? area(&side) * count : -1.0;
    }
    side = empty;
    count = 0;
    for (int i = 0; i < BINS - 1; i++) {
        grow(&side, &bins[i].box);
        count += bins[i].count;
        if (count == 0 || cost_right[i + 1] < 0.0) /* no split: all on one side */
            continue;
        const double cost = area(&side) * count + cost_right[i + 1];
        if (cost < p->cost) {
            p->cost = cost;
            p->bin = i;
        }
    }
}

static plane best_of_axis(const bvh_reference *references, uint32_t count, const box *centroids, int axis)
{
    const double from = (double)centroids->bound[0][axis], extent = (double)centroids->bound[1][axis] - from;
    plane p = {DBL_MAX, from, 0.0, axis, 0};
    if (!(extent > 0.0))
        return p;
    p.scale = BINS / extent;
    bin bins[BINS];
    for (int i = 0; i < BINS; i++)
        bins[i] = (bin){empty, 0};
    for (uint32_t i = 0; i < count; i++) {
        bin *into = &bins[bin_of(&references[i].box, &p)];
        grow(&into->box, &references[i].box);
        into->count++;
    }
    sweep(bins, &p);
    return p;
}

static plane choose(const bvh_reference *references, uint32_t count)
{
    const box centroids = box_of_centroids(references, count);
    plane best = {DBL_MAX, 0.0, 0.0, 0, 0};
    for (int axis = 0; axis < 3; axis++) {
        const plane p = best_of_axis(references, count, &centroids, axis);
        if (p.cost < best.cost)
            best = p;
    }
    return best;
}

/* Moves the references left of the plane to the front; returns how many. */
static uint32_t sides(bvh_reference *references, uint32_t count, const plane *p)
{
    uint32_t left = 0;
    for (uint32_t i = 0; i < count; i++)
        if (bin_of(&references[i].box, p) <= p->bin) {
            const bvh_reference moved = references[i];
            references[i] = references[left];
            references[left++] = moved;
        }
    return left;
}

/* Where to split; 0: make a leaf. */
static uint32_t split(bvh_reference *references, uint32_t count, double node_area, int depth)
{
    if (count == 1)
        return 0;
    const plane p = depth < PLANES_DEPTH ? choose(references, count) : (plane){DBL_MAX, 0.0, 0.0, 0, 0};
    const int is_costly = !(walk_cost * node_area + p.cost < node_area * count);
    if (count <= LEAF_MAX && (is_costly || p.cost == DBL_MAX))
        return 0;
    return p.cost < DBL_MAX ? sides(references, count, &p) : count / 2;
}

/* Recursive: the depth is bounded. */
static void build(builder *b, uint32_t first, uint32_t count, int depth)
{
    struct bvh_node *node = &b->nodes[b->count++];
    bvh_reference *references = b->references + first;
    node->box = references[0].box;
    for (uint32_t i = 1; i < count; i++)
        grow(&node->box, &references[i].box);

    const uint32_t left = split(references, count, area(&node->box), depth);
    node->count = left > 0 ? 0 : count;
    node->at = first;
    if (left == 0)
        return;
    build(b, first, left, depth + 1);
    node->at = b->count;
    build(b, first + left, count - left, depth + 1);
}

uint32_t bvh_build(struct bvh_node *nodes, bvh_reference *references, uint32_t count)
{
    builder b = {nodes, references, 0};
    build(&b, 0, count, 0);
    return b.count;
}
