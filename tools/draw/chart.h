/* Charts: axes with ticks, a key, curves, points with labels beside them that avoid each other. */
#pragma once

#include "draw/svg.h"

/* Logarithmic, and fits all points that are positive and finite by whole decades, of y at most 7; or with a step
 * between its ticks linear, from 0 to `high`. */
typedef struct chart_axis {
    const char *label; /* with its unit */
    double step, high;
} chart_axis;

typedef enum chart_mark { CHART_NO_MARK, CHART_DOT, CHART_RING, CHART_SQUARE, CHART_TRIANGLE } chart_mark;

typedef enum chart_line { CHART_NO_LINE, CHART_SOLID, CHART_DASHED, CHART_DOTTED } chart_line;

/* What is not finite, or outside, interrupts the curve. */
typedef struct chart_point {
    double x, y;
    char label[48]; /* beside it; "" is none */
} chart_point;

typedef struct chart_series {
    const char *name; /* in the key below the title; NULL: not there. Without points it is there alone */
    unsigned colour;  /* of svg.h, 0 to 4; in the key a stroke shows it where there is neither mark nor line */
    chart_mark mark;
    chart_line line;
    const chart_point *point;
    size_t count;
} chart_series;

typedef struct chart {
    const char *title; /* above the frame */
    svg_box box;       /* of all */
    chart_axis x, y;
    const char *zero; /* NULL, or the name of a band below the frame for y = 0 on a logarithmic axis */
    const chart_series *series;
    size_t count;
} chart;

/* As an element, or as a file of its own. */
void chart_draw(FILE *file, const chart *c, int is_alone);
