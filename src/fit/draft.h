/* From knots to a table: numbers of all cells, shares below the horizon, areas. */
#ifndef VNDF_FIT_DRAFT_H
#define VNDF_FIT_DRAFT_H

#include "fit/radial.h"

/* The points of all cells of a table. */
typedef struct vndf_sight {
    vndf_points points;
    size_t *first; /* of a cell; first[cells + 1] is the end */
} vndf_sight;

/* 0 if there is no memory; free it either way. */
int vndf_sight_from(vndf_sight *sight, const vndf_profile *profile, const vndf_laws *laws);
void vndf_sight_free(vndf_sight *sight);

/* A table and what it was made from. */
typedef struct vndf_draft {
    vndf_table_draft table;
    vndf_laws laws;
    vndf_sight sight;
} vndf_draft;

/* The table on the first `count` knots, complete but for its certificate and texts; 0 if there is no memory. Free it
 * either way. */
int vndf_draft_from(vndf_draft *draft, const vndf_radial *radial, unsigned count, unsigned moments);
void vndf_draft_free(vndf_draft *draft);

#endif
