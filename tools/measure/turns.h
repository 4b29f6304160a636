/* Whatever is timed takes turns: in a turn each candidate runs once, so that all of them meet the machine in the same
 * mood, and the median over the turns counts. A difference or a ratio of two candidates is taken within a turn. */
#ifndef TOOLS_MEASURE_TURNS_H
#define TOOLS_MEASURE_TURNS_H

#include <stddef.h>

#include "vndf.h"

/* Takes turn `turn` and fills the numbers of its series; NaN (which they hold before) where there is none. 0 stops. */
typedef int turns_take(void *user, size_t turn, double *number);

typedef struct turns_plan {
    size_t series;      /* how many numbers a turn gives */
    size_t least, most; /* turns, 1 <= least <= most */
    double seconds;     /* between the two, no further turn begins after that many */
    turns_take *take;
    void *user;
} turns_plan;

typedef struct turns_quartiles {
    double low, median, high;
} turns_quartiles;

/* The quartiles of each series. The first turn warms up the machine and is not counted: turn 0 is taken twice.
 * VNDF_ERROR_ARGUMENT: a turn stopped it. */
vndf_status turns_run(const turns_plan *plan, turns_quartiles *found);

/* Seconds of a run. The first run, which is not counted, brings inputs and tables into the cache; then it runs once
 * against the clock, so that the branch predictor does not learn the inputs by heart, or more often where a single run
 * is too short for the clock. */
double turns_seconds(void (*run)(void *user), void *user);

#endif
