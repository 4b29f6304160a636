/* The measure f dR of a profile at points in a cell, and the cell's numbers. */
#ifndef VNDF_FIT_CELLS_H
#define VNDF_FIT_CELLS_H

#include "fit/law.h"
#include "fit/profile/profile.h"

/* Slopes nearer than this part of themselves count as one: normals of floats hardly tell them apart. No cell that is
 * wider has to stay whole (fit/knots.c). */
#define VNDF_GRAIN 0x1p-21

/* f dR = mass; the part of its cell that the point stands for, by xi. */
typedef struct vndf_point {
    double r, mass, xi, width;
} vndf_point;

typedef struct vndf_points {
    vndf_point *at;
    size_t count, capacity;
    int starved; /* there was no memory for some */
} vndf_points;

/* The cell from a slope to another, which may be infinite, and its numbers by its points. These replace those of
 * *points from `first` on: ten for each panel or part of one, but one for panels that together are narrower than the
 * grain, or hold next to nothing. Where less than floats can hold is in a cell, it gets a little that is even. */
vndf_cell vndf_cell_measure(const vndf_profile *profile, double from, double end, unsigned squarings,
                            vndf_points *points, size_t first);

#endif
