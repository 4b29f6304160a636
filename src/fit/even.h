/* Moves the knots of one table so that all intervals between them err alike. Halving (fit/refine.h) serves every size
 * at once, but in a table of few knots one interval may err by many times what its neighbour does. */
#ifndef VNDF_FIT_EVEN_H
#define VNDF_FIT_EVEN_H

#include "fit/refine.h"

/* How knots may be moved. */
typedef struct vndf_even {
    const double *held; /* ascending: knots that stay where they are, as the first and the last do */
    size_t held_count;
    int rounds;                 /* each looks at the errors of all intervals once; two do most of it */
    vndf_interval_error *error; /* infinite where an interval is too narrow: then all knots stay, or go back */
    void *user;                 /* of the error */
} vndf_even;

/* Moves `count` ascending knots. Never makes the error larger: the sum of the shares plus the largest alone. 0 if there
 * is no memory. */
int vndf_even_knots(double *knots, size_t count, const vndf_even *how);

#endif
