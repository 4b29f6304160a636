/* From fits to a table: the builder refines the fits once, then cuts a table of any size from them. */
#ifndef VNDF_FIT_ASSEMBLE_H
#define VNDF_FIT_ASSEMBLE_H

#include "fit/budget.h"
#include "fit/radial_fit.h"
#include "fit/refine.h"
#include "fit/wedge_fit.h"
#include "table/layout.h"

typedef struct vndf_plan {
    const vndf_profile *profile;
    vndf_radial_fit radial_fit;
    vndf_wedge_fit above_fit, below_fit;
    vndf_refinement radial, above_rows, below_rows, above_area, below_area;
    vndf_budget budget;
    double finest; /* the least error of which sizes are asked: that of the budget */
} vndf_plan;

/* Begins all fits, for the whole sphere alike or, in a small table, above the horizon first. 0 if there is no memory or
 * the guard of the profile stopped the build. */
int vndf_plan_make(vndf_plan *plan, const vndf_profile *profile, size_t max_bytes, int sphere);
void vndf_plan_free(vndf_plan *plan);

/* The counts of the table whose parts each err by less than `error`, which is no less than `finest`. Refines the fits
 * that far. */
vndf_table_size vndf_plan_size(vndf_plan *plan, double error);

/* The table of this size, complete but for its certificate and texts; NULL if there is no memory. */
vndf_distribution *vndf_plan_assemble(vndf_plan *plan, vndf_table_size size);

#endif
