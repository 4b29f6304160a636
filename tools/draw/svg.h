/* The marks of pictures, in pixels from the top left. Colours are classes, so that a page or a file of its own can
 * change them for dark screens: ink, quiet, pen and so on; and of five hues l0 to l4 for lines, f0 to f4 for areas, t0
 * to t4 for texts: blue, orange, green, violet, grey. The palette is that of M. Okabe and K. Ito, "Color Universal
 * Design" (2008), which people with any kind of colour vision tell apart; series differ in mark or dashes as well. */
#pragma once

#include <stddef.h>
#include <stdio.h>

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

/* The index of the palette, 1 to 255, for a density from 0 to 1; 0 is transparent, for outside. */
unsigned char svg_shade(double density);

/* A picture of such indices in a box of this size. 0 if there is no memory. */
int svg_raster(FILE *file, svg_box box, const unsigned char *index, size_t columns, size_t rows);
