/* Tyler's shape of slopes: slopes.h says what it is. */
#ifndef TOOLS_MEASURED_SURFACE_SHAPE_H
#define TOOLS_MEASURED_SURFACE_SHAPE_H

#include "measured/surface/slopes.h"

/* Symmetric matrices as xx, xy, yy. */
typedef struct slope_shape {
    double matrix[3], inverse[3]; /* V^1/2 and its inverse, of determinant 1 */
    double ratio, error;          /* of the axes of V^1/2, and one standard deviation of it */
} slope_shape;

/* Of slopes with mean 0. 0 and the reason if they lie on a line. */
int shape_of(const slope_set *slopes, const char *name, slope_shape *shape, refusal *why);

#endif
