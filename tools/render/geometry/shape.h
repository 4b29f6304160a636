/* The questions that each kind of shape answers: its box, whether a line meets it, and the place where it does. */
#ifndef TOOLS_RENDER_GEOMETRY_SHAPE_H
#define TOOLS_RENDER_GEOMETRY_SHAPE_H

#include "render/geometry/bvh.h"
#include "render/geometry/geometry.h"
#include "render/geometry/wide.h"

/* A ray, prepared for shapes. */
typedef struct line {
    wide origin, direction;
    double from;
    int axis[3];             /* the last axis has the largest component of direction */
    double shear_x, shear_y; /* the other components over that one */
    double depth;            /* 1 over that component */
} line;

/* The nearest so far. */
typedef struct meeting {
    double distance;
    double a, b; /* rectangle: u, v; triangle: weights of corners 1 and 2 */
    uint32_t shape;
} meeting;

/* Returns 0 if the direction is 0 or a number is NaN. */
int line_from(line *l, const ray *r);

/* Returns 1 if the box is finite and within GEOMETRY_REACH. */
int shape_box(const geometry *g, const shape *s, box *b);

/* Returns 1, and replaces the meeting, if the line meets the shape in (from, distance). */
int shape_meets(const geometry *g, uint32_t at, const line *l, meeting *m);

/* All about a meeting. */
void shape_describe(const geometry *g, const line *l, const meeting *m, hit *h);

#endif
