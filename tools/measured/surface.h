/* Surfaces that were measured: heights on a grid, or normals; their slopes, and the law of these. */
#ifndef TOOLS_MEASURED_SURFACE_H
#define TOOLS_MEASURED_SURFACE_H

#include "measured/data.h"

enum { SLOPE_PARTS = 64, SLOPES_LEAST = 1000 };

/* Slopes of points of a surface, and the part of it, 0 to SLOPE_PARTS - 1, where each lies. */
typedef struct slope {
    float x, y;
    int part;
} slope;

typedef struct slope_set {
    slope *at; /* owned; room for as many as were asked for */
    size_t count;
    double quantum; /* the least difference that slopes can have, 0 of floats: no bin is narrower than two */
} slope_set;

/* Room for `room` slopes, none of them there. */
int slopes_make(slope_set *made, size_t room, data_file *file);
void slopes_free(slope_set *freed);
void slopes_add(slope_set *to, double x, double y, int part);

/* Turns the slopes into u, notes what was found, and makes rows of P22 over |u|. Refused are fewer than SLOPES_LEAST
 * slopes, and such as are all alike or lie on a line. */
int slopes_law(slope_set *slopes, data_file *file, profile *rows);

/* The mass of slopes between two lengths, integral P22 2 pi r dr; `to` may be infinite. Of a source as it is given.
 */
double slope_mass(const vndf_source *source, double from, double to);

/* ---- files ---- */

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
