/* What each kind of shape answers: its box, whether a line meets it, and everything about the place where it does.
 * */
#ifndef TOOLS_RENDER_GEOMETRY_SHAPE_H
#define TOOLS_RENDER_GEOMETRY_SHAPE_H

#include "render/geometry/bvh.h"
#include "render/geometry/geometry.h"
#include "render/geometry/wide.h"

/* A ray as shapes want it. */
typedef struct line {
    wide origin, direction;
    double from;
    int axis[3];             /* the last is that of the largest component of direction */
    double shear_x, shear_y; /* direction over that component, along the others */
    double depth;            /* 1 over that component */
} line;

/* The nearest so far. */
typedef struct meeting {
    double distance;
    double a, b; /* rectangle: u, v; triangle: weights of corners 1 and 2 */
    uint32_t shape;
} meeting;

/* 0 if the direction is 0 or anything is NaN. */
int line_from(line *l, const ray *r);

/* 1 if the box is finite and not beyond GEOMETRY_REACH. */
int shape_box(const geometry *g, const shape *s, box *b);

/* 1, and the meeting replaced, if the shape is met in (from, distance). */
int shape_meets(const geometry *g, uint32_t at, const line *l, meeting *m);

/* All about a meeting. */
void shape_describe(const geometry *g, const line *l, const meeting *m, hit *h);

#endif
