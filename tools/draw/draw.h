/* The marks of pictures, in pixels from the top left. Colours are classes, so that a page or a file of its own can
 * change them for dark screens: ink, quiet, pen and so on; and of five hues l0 to l4 for lines, f0 to f4 for areas, t0
 * to t4 for texts: blue, orange, green, violet, grey. The palette is that of M. Okabe and K. Ito, "Color Universal
 * Design" (2008), which people with any kind of colour vision tell apart; series differ in mark or dashes as well. */
#pragma once

#include <stddef.h>
#include <stdio.h>

#include "vndf.h"

typedef struct svg_box {
    double x, y, width, height;
} svg_box;

typedef enum svg_anchor { SVG_START, SVG_MIDDLE, SVG_END } svg_anchor;

/* The rules for the classes, for the head of a page. */
void svg_style(FILE *file);

/* Opens an element in a page or a larger one, or, alone, a file with colours and a background; "</svg>" ends it. */
void svg_begin(FILE *file, svg_box box, const char *about, int is_alone);

/* Text for an element or an attribute, of a page too. */
void svg_escape(FILE *file, const char *text);

/* One line of text, escaped; y is its base line. */
void svg_text(FILE *file, const char *kind, svg_anchor anchor, double x, double y, const char *text);

void svg_circle(FILE *file, const char *kind, double x, double y, double radius, double width);

/* A picture in a box of this size, of indices 1 to 255, from pale to dark; 0 is transparent. 0: no memory. */
int svg_raster(FILE *file, svg_box box, const unsigned char *index, size_t columns, size_t rows);

/* Charts: axes with ticks, a key, curves, points with labels beside them that avoid each other. */

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

/* The two kinds of panel of a figure: D against the angle of the normal, and the visible normals from one incident
 * direction on a disc. Boxes hold the labels too. */

enum { PANEL_DOTS = 350 }; /* samples of a disc: two random_float each of random_from(seed), in this order */

/* D(theta_m) on a logarithmic scale, along x and along y where the roughness differs, beside GGX of the same
 * median slope. */
void panel_ndf(FILE *file, svg_box box, const vndf_surface *surface);

/* Visible normals from (theta, azimuth 0): density as colour, samples as dots, on the hemisphere seen from above
 * in the equal-area projection (radius ~ sin(theta_m/2)), so that dots are as dense as the colour says. The rim
 * is the smallest round angle that holds 95% of the samples. 0: no memory. */
int panel_disc(FILE *file, svg_box box, const vndf_surface *surface, double theta, unsigned seed);

/* What colour, dots and marks of the discs mean. 0: no memory. */
int panel_key(FILE *file, double x, double y);
