/* Where the knots of a table stand. The worst cell is cut, again and again, so that the first so many knots are those
 * of a table of any size. */
#ifndef VNDF_FIT_KNOTS_H
#define VNDF_FIT_KNOTS_H

#include "fit/cells.h"

/* A knot, and the areas for rho there, s + c = 1 (profile.h). */
typedef struct vndf_knot {
    float r;
    vndf_area area;
} vndf_knot;

/* Between two knots; the error of what is drawn there, and where it would be cut. */
typedef struct vndf_interval {
    vndf_knot from, to; /* to: infinite in the tail cell */
    double error;
    float cut; /* 0: it cannot be cut */
} vndf_interval;

typedef struct vndf_knots {
    const vndf_profile *profile;
    unsigned squarings;
    double last;                        /* the largest rho from which what is seen below the horizon counts */
    vndf_knot knot[VNDF_CELLS_MAX + 1]; /* `start` ascending, from 0; then as they were added */
    unsigned start, count;
    vndf_interval interval[VNDF_CELLS_MAX + 1];
    vndf_points points; /* of the cell at hand */
} vndf_knots;

/* 0 if there is no memory; free knots->points.at either way. */
int vndf_knots_from(vndf_knots *knots, const vndf_profile *profile);

/* Adds knots until there are `count`, or no cell can be cut; returns how many there are. */
unsigned vndf_knots_refine(vndf_knots *knots, unsigned count);

#endif
