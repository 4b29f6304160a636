/* Puts knots where the error is: halves intervals one at a time, the worst first, and records the error after each
 * step. The order is nested, so one run serves every size of table: a table with n knots takes the first n of the
 * list. The list grows when it is asked for a smaller error, so that nobody pays for knots that no table takes. */
#ifndef VNDF_FIT_REFINE_H
#define VNDF_FIT_REFINE_H

#include <stddef.h>
#include <stdint.h>

/* The error of a table between neighbouring knots a < b. */
typedef struct vndf_interval_miss {
    double share; /* adds to the shares of the other intervals */
    double alone; /* occurs without the others */
} vndf_interval_miss;
typedef vndf_interval_miss vndf_interval_error(double a, double b, void *user);

/* Where an interval is halved; NULL stands for (a + b)/2. */
typedef double vndf_interval_middle(double a, double b);

typedef struct vndf_refinement {
    size_t start;  /* knots given at the start, ascending */
    size_t count;  /* and points added after them, in order of need */
    double *knot;  /* start + count */
    double *error; /* count + 1: sum of the shares plus the largest alone, after n added points */
    struct vndf_tournament *tournament; /* the intervals now, */
    size_t limit;                       /* and what it takes to go on */
    vndf_interval_middle *middle;
    vndf_interval_error *measure;
    void *user;
} vndf_refinement;

/* Begins with the given knots; at most `limit` points will be added. 0 if there is no memory; free it either way. */
int vndf_refine_begin(vndf_refinement *refinement, const double *start, size_t start_count, size_t limit,
                      vndf_interval_middle *middle, vndf_interval_error *error, void *user);

/* Adds points until the limit or until the error is at most `enough`. */
void vndf_refine_to(vndf_refinement *refinement, double enough);

/* Whether the recorded error is at most `enough` already. */
int vndf_refinement_reaches(const vndf_refinement *refinement, double enough);

/* How many knots, with the given ones, bring the recorded error below `error`; all if no number does. */
uint32_t vndf_refinement_needed(const vndf_refinement *refinement, double error);

/* The first `count` knots, ascending, into knots[count]; count is no less than `start`. */
void vndf_refinement_knots(const vndf_refinement *refinement, size_t count, double *knots);

void vndf_refinement_free(vndf_refinement *refinement);

#endif
