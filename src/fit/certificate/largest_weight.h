/* The largest weight of a direction, true over drawn mass, leaving out the largest ones that together hold a millionth
 * of the mass. */
#ifndef VNDF_FIT_CERTIFICATE_LARGEST_WEIGHT_H
#define VNDF_FIT_CERTIFICATE_LARGEST_WEIGHT_H

#include <stddef.h>

/* The part of the mass that the largest weight and the error of D leave out. */
#define VNDF_VALIDATION_LEFT_OUT 1e-6

/* Gauss points of a direction: their parts of the true and of the drawn mass. */
typedef struct vndf_points {
    double *reference, *drawn; /* one block */
    size_t count, capacity;
} vndf_points;

/* The weight of a point, and its true mass. */
typedef struct vndf_weight {
    double ratio, mass;
} vndf_weight;

/* Of one direction after the other; begins with zeros. */
typedef struct vndf_weights {
    vndf_weight *that_count; /* may be the largest; to be freed */
    size_t capacity;
    double beyond; /* by how much the last largest weight exceeded 1 */
} vndf_weights;

/* Infinite where nothing is drawn. */
double vndf_weight_ratio(double reference, double drawn);

/* Sets *starved if there is no memory. */
double vndf_largest_weight(vndf_weights *weights, const vndf_points *points, int *starved);

#endif
