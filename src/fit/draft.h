/* From knots to a table: numbers of all cells, shares below the horizon, areas. */
#ifndef VNDF_FIT_DRAFT_H
#define VNDF_FIT_DRAFT_H

#include "fit/knots.h"

/* How many strips laws are compared in. */
#define VNDF_STRIPS(cells) (6 * (size_t)(cells) + 360)

/* A table, its laws, and the profile in strips that end at its knots: those of cell i from first[i] to first[i + 1]. */
typedef struct vndf_draft {
    vndf_table_draft table;
    vndf_laws laws;
    vndf_strips strips;
    size_t *first;
} vndf_draft;

/* The table on these knots, complete but for its certificate and texts; 0 if there is no memory. Free it either way. */
int vndf_draft_from(vndf_draft *draft, vndf_knots *knots, unsigned moments);

/* The same of a table that was loaded, beside a profile. */
int vndf_draft_of(vndf_draft *draft, const vndf_distribution *table, const vndf_profile *profile);

void vndf_draft_free(vndf_draft *draft);

/* How good the table is (certificate.c); 0 if there is no memory. */
int vndf_certificate_measure(vndf_certificate *certificate, const vndf_draft *draft, const vndf_profile *profile);

#endif
