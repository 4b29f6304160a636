/* How far a table is from its source, measured from outside: vndf_pdf, vndf_p22 and vndf_projected_area beside
 * vndf_source_p22, with none of the library's own integrals, so that a fault of a certificate is seen.
 *
 * Given the slope length R a table draws the azimuth exactly, so the density of one normal at R tells the drawn law of
 * R. Both laws are added up over points of R that are as close as D varies, from directions where D says that something
 * happens and many more. */
#pragma once

#include "vndf_build.h"

/* Members of vndf_certificate. */
enum { LAWS_TV, LAWS_TV_ABOVE, LAWS_MAX_WEIGHT, LAWS_AREA_ERROR, LAWS_CONSISTENCY, LAWS_NDF_ERROR, LAWS_FIGURES };

typedef struct laws_figure {
    const char *name;
    double stored, measured, theta; /* the worst, and where it was found, degrees; NaN for ndf_error */
    int good;                       /* it is at most a tenth, or 2e-5, worse than stored */
} laws_figure;

/* `per_octave` directions in each octave of cot(theta), on both sides of the horizon, and some hundred more: 4 are
 * within a few percent. What rounding of directions and normals explains is taken off. 0: no memory, or `progress`,
 * which may be NULL, said to stop. */
int laws_measure(const vndf_distribution *table, const vndf_source *source, int per_octave,
                 vndf_progress *progress, void *user, laws_figure found[LAWS_FIGURES]);
