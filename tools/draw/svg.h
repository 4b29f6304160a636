/* The tools of the figures: an SVG page and a few marks, in pixels from the top left. The background is
 * painted, so that a page is as legible in a dark viewer as on paper. */
#ifndef TOOLS_DRAW_SVG_H
#define TOOLS_DRAW_SVG_H

#include <stddef.h>
#include <stdio.h>

#include "draw/png.h"

typedef enum svg_anchor { SVG_START, SVG_MIDDLE, SVG_END } svg_anchor;

void svg_begin(FILE *file, double width, double height);
void svg_end(FILE *file);

/* Text for an element or an attribute, of a page too. */
void svg_escape(FILE *file, const char *text);

/* One line of text, escaped; y is its base line. */
void svg_text(FILE *file, double x, double y, double size, svg_anchor anchor, const char *text);

/* The same with a white halo, for labels on top of a picture. */
void svg_text_on_picture(FILE *file, double x, double y, double size, const char *text);

/* Text turned a quarter turn to the left, centred on (x, y). */
void svg_text_upwards(FILE *file, double x, double y, double size, const char *text);

void svg_line(FILE *file, double x1, double y1, double x2, double y2, const char *stroke, double width,
              const char *dashes);
void svg_circle(FILE *file, double x, double y, double radius, const char *fill, const char *stroke, double width);
void svg_frame(FILE *file, double x, double y, double width, double height);

/* The index of the palette, 1 to 255, for a density from 0 to 1; 0 is transparent, for outside. */
unsigned char svg_shade(double density);

/* A picture of such indices, square, `side` pixels on an edge. 0 if there is no memory. */
int svg_raster(FILE *file, double x, double y, double size, const unsigned char *index, size_t side);

/* Draws the ramp as a bar. 0 if there is no memory. */
int svg_ramp(FILE *file, double x, double y, double width, double height);

#endif
