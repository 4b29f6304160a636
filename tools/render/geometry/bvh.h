/* A bounding-volume hierarchy over boxes: nodes stand in the order of a walk that goes to the first child
 * first. */
#ifndef TOOLS_RENDER_GEOMETRY_BVH_H
#define TOOLS_RENDER_GEOMETRY_BVH_H

#include <stddef.h>
#include <stdint.h>

/* Low and high corner. */
typedef struct box {
    float bound[2][3];
} box;

/* 32 bytes, two to a cache line. A leaf has count > 0 entries of `order` from `at` on. The children of any other
 * node are the next node and node `at`. */
struct bvh_node {
    box box;
    uint32_t at, count;
};

typedef struct bvh_reference {
    box box;
    uint32_t shape;
} bvh_reference;

/* The most nodes from the root to a leaf: the stack of a walk must hold as many. */
enum { BVH_DEPTH_MAX = 96 };

/* The hierarchy of `count` > 0 finite boxes. Boxes change places until the boxes of each leaf stand side by side.
 * Writes at most 2 count - 1 nodes; returns how many. */
uint32_t bvh_build(struct bvh_node *nodes, bvh_reference *references, uint32_t count);

#endif
