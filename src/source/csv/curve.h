/* A smooth curve through points that never leaves the range of its neighbours.
 *
 * Piecewise cubic with the slopes of M. Steffen, "A simple method for monotonic interpolation in one
 * dimension", Astronomy and Astrophysics 239 (1990): continuous first derivative, monotone between any two
 * points (so no overshoot, and no negative value), exact for straight lines, third order except at maxima. */
#ifndef VNDF_SOURCE_CSV_CURVE_H
#define VNDF_SOURCE_CSV_CURVE_H

#include <stddef.h>

typedef struct vndf_curve {
    double *x, *y, *slope; /* one block, owned through x: points with x ascending, and dy/dx there */
    size_t count;          /* >= 2 */
} vndf_curve;

/* Room for count points; 0 if there is no memory. The caller fills x and y and calls vndf_curve_fit. */
int vndf_curve_allocate(vndf_curve *curve, size_t count);
void vndf_curve_fit(vndf_curve *curve);

/* The value at x; outside the points, the value of the nearest end. */
double vndf_curve_value(const vndf_curve *curve, double x);

/* The value at the distance d before the last point, in the last piece, whose last value is 0. The values near it keep
 * all their digits, which those of vndf_curve_value lose with x. */
double vndf_curve_before_end(const vndf_curve *curve, double d);

void vndf_curve_free(vndf_curve *curve);

#endif
