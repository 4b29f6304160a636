/* Places knots along a family so that the distances between them are about the same, and the largest is small. */
#ifndef VNDF_FIT_FAMILY_KNOTS_H
#define VNDF_FIT_FAMILY_KNOTS_H

#include "fit/family/distance.h"

/* What is known of the family while knots are placed: P22 on slopes that are even in log r, where all but a part of
 * 1e-9 of the mass lies. Sums over them are good to a few percent, and cost a hundredth of a profile; vndf_distance_at
 * has the last word. */
typedef struct vndf_knots_plan {
    const char *pattern;
    double low, high;
    int reciprocal; /* mixtures are linear in 1/p */
    size_t slopes;
    double first, step; /* log r */
    double *scratch;    /* three times `slopes` */
} vndf_knots_plan;

/* Of a family between two members and one in their midst. 0 if there is no memory; free it either way. */
int vndf_knots_plan_from(vndf_knots_plan *plan, const char *pattern, const vndf_member *low,
                         const vndf_member *middle, const vndf_member *high);
void vndf_knots_plan_free(vndf_knots_plan *plan);

/* Places `count` knots, at least 2, and writes the largest distance between them to *worst. */
vndf_status vndf_knots_spread(const vndf_knots_plan *plan, size_t count, double *knot, double *worst,
                              vndf_error *error);

/* The parameter at which the weight of the upper of two knots is t. */
double vndf_knots_between(double low, double high, double t, int reciprocal);

#endif
