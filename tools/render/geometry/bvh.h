/* A bounding-volume hierarchy over boxes: the nodes in the order of a walk that goes to the first child first. */
#ifndef TOOLS_RENDER_GEOMETRY_BVH_H
#define TOOLS_RENDER_GEOMETRY_BVH_H

#include <stddef.h>
#include <stdint.h>

/* Low and high corner. */
typedef struct box {
    float bound[2][3];
} box;

/* 32 bytes, two to a cache line. A leaf has count > 0 entries of `order` from `at` on; else the children are the
 * next node and node `at`. */
struct bvh_node {
    box box;
    uint32_t at, count;
};

typedef struct bvh_reference {
    box box;
    uint32_t shape;
} bvh_reference;

/* Nodes from the root to a leaf at most: what a walk's stack must hold. */
enum { BVH_DEPTH_MAX = 96 };

/* Hierarchy of `count` > 0 finite boxes, which change places so that leaves have theirs side by side. Up to 2
 * count - 1 nodes are written; returns how many. */
uint32_t bvh_build(struct bvh_node *nodes, bvh_reference *references, uint32_t count);

#endif
