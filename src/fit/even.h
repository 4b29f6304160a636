/* Moves the knots of one table so that all intervals between them err alike. Halving (fit/refine.h) serves every size
 * at once, but in a table of few knots one interval may err by many times what its neighbour does. */
#ifndef VNDF_FIT_EVEN_H
#define VNDF_FIT_EVEN_H

#include "fit/refine.h"

/* The knot at this part of the way from a to b. */
typedef double vndf_interval_place(double a, double b, double part);

/* Moves all of `count` ascending knots but those that `held` lists, in ascending order; the first and the last are held
 * too. Never makes the error larger: the sum of the shares plus the largest alone. 0 if there is no memory. */
int vndf_even_knots(double *knots, size_t count, const double *held, size_t held_count, vndf_interval_place *place,
                    vndf_interval_error *error, void *user);

#endif
