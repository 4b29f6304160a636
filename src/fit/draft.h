/* Where the knots of a table stand, and from knots to a table: numbers of all cells, shares below the horizon,
 * areas. */
#ifndef VNDF_FIT_DRAFT_H
#define VNDF_FIT_DRAFT_H

#include "fit/law.h"

/* ---- knots ----
 *
 * They are as far apart as an error of cells allows, which is chosen so that there are as many as wanted (knots.c). */

/* What is known at an edge of a strip. */
typedef struct vndf_rim {
    double z;        /* 1/(1 + R) */
    double s1, s2;   /* integrals of (R - edge) f and of (R - edge)^2 f/R beyond it */
    vndf_area area;  /* from the direction with this rho, s + c = 1, */
    int known, stop; /* if it was asked for; whether a knot has to stand there */
} vndf_rim;

typedef struct vndf_knots {
    const vndf_profile *profile;
    unsigned squarings;
    vndf_strips strips;
    vndf_rim *rim;
    double *xi;                    /* of the edges in the cell at hand */
    size_t first, last, deep;      /* edges: of the least and largest knot; of the largest rho that counts below */
    unsigned least, count;         /* how few knots there can be, how many there are, */
    size_t at[VNDF_CELLS_MAX + 1]; /* and their edges */
} vndf_knots;

/* For up to `most` knots. 0 if there is no memory; free them either way. */
int vndf_knots_from(vndf_knots *knots, const vndf_profile *profile, unsigned most);
void vndf_knots_free(vndf_knots *knots);

/* Places at most `count` knots, but no more than errors are worth. */
void vndf_knots_place(vndf_knots *knots, unsigned count);

/* A knot as a float: what is gathered to one place stays on its side. */
float vndf_knots_slope(const vndf_knots *knots, unsigned i);

/* The areas for rho at an edge. */
const vndf_area *vndf_knots_area(vndf_knots *knots, size_t edge);

/* ---- tables ---- */

/* The table on these knots, complete but for its certificate and texts; 0 if there is no memory. Free it either way. */
int vndf_draft_from(vndf_draft *draft, vndf_knots *knots, unsigned moments);

/* The same of a table that was loaded, beside a profile. */
int vndf_draft_of(vndf_draft *draft, const vndf_distribution *table, const vndf_profile *profile);

void vndf_draft_free(vndf_draft *draft);

/* How good the table is (certificate.c); 0 if there is no memory. */
int vndf_certificate_measure(vndf_certificate *certificate, const vndf_draft *draft, const vndf_profile *profile);

#endif
