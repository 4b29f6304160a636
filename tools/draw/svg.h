/* The marks of pictures, in pixels from the top left; colours are the classes of chart.h. */
#ifndef TOOLS_DRAW_SVG_H
#define TOOLS_DRAW_SVG_H

#include <stddef.h>
#include <stdio.h>

typedef enum svg_anchor { SVG_START, SVG_MIDDLE, SVG_END } svg_anchor;

/* Text for an element or an attribute, of a page too. */
void svg_escape(FILE *file, const char *text);

/* One line of text, escaped; y is its base line. */
void svg_text(FILE *file, const char *kind, svg_anchor anchor, double x, double y, const char *text);

void svg_circle(FILE *file, const char *kind, double x, double y, double radius, double width);

/* The index of the palette, 1 to 255, for a density from 0 to 1; 0 is transparent, for outside. */
unsigned char svg_shade(double density);

/* A picture of such indices in a box of this size. 0 if there is no memory. */
int svg_raster(FILE *file, double x, double y, double width, double height, const unsigned char *index,
               size_t columns, size_t rows);

#endif
