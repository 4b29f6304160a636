/* Surfaces that were measured: heights on a grid, or normals, and their slopes. */
#ifndef TOOLS_MEASURED_SURFACE_H
#define TOOLS_MEASURED_SURFACE_H

#include "measured/slopes.h"

enum { SURFACE_SIDE_MAX = 16384, SURFACE_MAX = 1 << 24, CUTOFF_MAX = 256 };

/* Heights over places (x step_x, y step_y), all in one unit; a row after the other. NaN: there is none. */
typedef struct height_field {
    int width, height;
    double step_x, step_y;
    double quantum; /* the least difference that heights can have; 0 if they are floats */
    float *z;       /* owned */
} height_field;

/* Room, and steps of 1. 0 and the reason if the sides are out of range or there is no memory. */
int heights_make(height_field *made, int width, int height, data_file *file);
void heights_free(height_field *freed);

/* Reads PFM (its first channel), PGM of 8 or 16 bits (0 to 1), or numbers between blanks, a line for each row. */
int heights_read(data_file *file, height_field *made);

/* Takes away what is shorter than `cutoff` samples, 2 to CUTOFF_MAX: the Gaussian filter of ISO 16610-21, which
 * halves waves of that length. 0 if there is no memory. */
int heights_smooth(height_field *changed, int cutoff);

/* Slopes by central differences; those whose neighbours are not there are left out, as are `margin` samples along the
 * rim. */
int heights_slopes(const height_field *of, int margin, slope_set *made, data_file *file);

/* Slopes of a normal map, a PPM (P6) or a colour PFM. A normal n has the slope (-n.x/n.z, -n.y/n.z). Numbers of 8 or
 * 16 bits are n/2 + 1/2, and so are those of a PFM without negative ones; a PFM with negative numbers holds n itself.
 * Lengths need not be 1: normals shorter than a half, longer than 3/2 or without z above 0 are left out, and more
 * than half of them are a reason to refuse. */
int normals_slopes(data_file *file, slope_set *made);

#endif
