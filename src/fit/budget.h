/* How the parts of a table share one error, and what an error below the horizon counts. */
#ifndef VNDF_FIT_BUDGET_H
#define VNDF_FIT_BUDGET_H

#include <stddef.h>
#include <stdint.h>

typedef struct vndf_budget {
    uint32_t row_cells;         /* at most, in an azimuth row: each takes a few per cent of the bytes */
    double finest;              /* the least error that a table of the size may reach */
    double rows;                /* so many times smaller is the error of rows above the horizon, */
    double radial;              /* that of all radial cells together, */
    double areas, areas_finest; /* and that of areas, but no smaller than this, */
    double promised;            /* and no larger than this */
    double below;               /* weight of errors below the horizon: vndf_side, */
    double fade;
    double below_areas; /* and of the areas there */
    int even_rows;      /* rows of a table that is cut are moved: fit/even.h */
} vndf_budget;

/* For tables of at most this size: for the whole sphere alike, or in a small table above the horizon first. */
vndf_budget vndf_budget_for(size_t max_bytes, int sphere);

/* The error of areas in a table whose parts err by `error`. */
double vndf_budget_areas(const vndf_budget *budget, double error);

#endif
