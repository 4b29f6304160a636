/* Azimuth rows of one side of the horizon, for a profile. The coordinate y in [0, 1] is the one of vndf_wedge. */
#ifndef VNDF_FIT_WEDGE_FIT_H
#define VNDF_FIT_WEDGE_FIT_H

#include "fit/area_fit.h"
#include "fit/profile/strip.h"
#include "fit/refine.h"
#include "table/table.h"

typedef struct vndf_row_cache vndf_row_cache;

typedef struct vndf_wedge_fit {
    vndf_side side;
    double least;                         /* vndf_side_least */
    vndf_refinement q;                    /* where cells of q begin, in order of need */
    uint32_t cells;                       /* of a row, now */
    float node[VNDF_WEDGE_CELLS_MAX + 1]; /* their ends in q */
    vndf_row_cache *cache;                /* rows made so far */
    vndf_strip *strip;                    /* E or S: densities of azimuths */
} vndf_wedge_fit;

/* One row: aspect, and mass and density of its cells, total mass 1. */
typedef struct vndf_row {
    double y, p, r;
    float mass[VNDF_WEDGE_CELLS_MAX], density[VNDF_WEDGE_CELLS_MAX + 1];
} vndf_row;

/* Also places the cells of q: as many as it takes to miss at most `enough` of the mass in any row, but at most
 * most_cells; and uses them all. 0 if there is no memory. */
int vndf_wedge_fit_from(vndf_wedge_fit *fit, vndf_side side, uint32_t most_cells, double enough);

/* How many cells it takes to miss at most `error`. */
uint32_t vndf_wedge_fit_cells(const vndf_wedge_fit *fit, double error);

/* From now on rows have the first `cells` cells that were placed. Rows made before are gone. */
void vndf_wedge_fit_use(vndf_wedge_fit *fit, uint32_t cells);
void vndf_wedge_fit_free(vndf_wedge_fit *fit);

/* The row at y; NULL if there is no memory. Belongs to the fit. */
const vndf_row *vndf_wedge_fit_row(vndf_wedge_fit *fit, double y);

/* The middle row that makes two others a quadratic Bezier curve, which is exact halfway. */
void vndf_wedge_fit_middle(const vndf_wedge_fit *fit, const vndf_row *a, const vndf_row *b, vndf_row *middle);

/* Largest total variation of azimuth between the rows at a and b, times the share of the visible mass that the
 * wedge has there. A vndf_interval_error with a vndf_wedge_fit. */
vndf_interval_miss vndf_wedge_row_error(double a, double b, void *fit);

#endif
