/* What every reader ends in: rows of D or P22 over the angle or the slope, for vndf_source_rows. */
#ifndef TOOLS_MEASURED_PROFILE_H
#define TOOLS_MEASURED_PROFILE_H

#include <stdio.h>

#include "measured/refusal.h"
#include "vndf_build.h"

typedef struct profile {
    vndf_rows_over over;
    vndf_rows_of of;
    double *x, *value; /* owned; zeroed where they are made */
    size_t count;
    double *error; /* owned: of the values, relative, one standard deviation; NULL where it is not known */
} profile;

/* Room for `count` rows. 0 if there is no memory. */
int profile_make(profile *made, vndf_rows_over over, vndf_rows_of of, size_t count);
void profile_free(profile *freed);

/* Writes the rows as a CSV that `vndf build --csv` reads, with `title` and the errors as comments; 0 if that fails. */
int profile_write(FILE *file, const profile *from, const char *title);

/* The curve through the rows, to be freed; NULL and the reason if they are none: not finite, not ascending. */
vndf_source *profile_source(const profile *from, const char *name, refusal *why);

/* A small table of that curve, for areas and masking; NULL and the reason if there can be none. */
vndf_distribution *profile_table(const profile *from, const char *name, refusal *why);

/* The mass of slopes between two lengths, integral P22 2 pi r dr; `to` may be infinite. Of a source as it is given. */
double profile_mass(const vndf_source *source, double from, double to);

/* Bins of slopes: mass[i] between edge[i] and edge[i + 1]; edge[0] is 0, and edge[count] may be infinite. */
typedef struct profile_bins {
    const double *edge, *mass;
    size_t count;
} profile_bins;

/* Multiplies the values until the source through the rows has the mass of every bin, in a few steps: row i lies in bin
 * i, and rows beyond the last bin are multiplied as the last bin's. Values over the slope of P22 alone. Keeps the best
 * rows that were found; the largest part of the whole by which a bin of these is wrong goes to *left. 0 and the reason
 * if the rows are no curve. */
int profile_match(profile *changed, const profile_bins *bins, const char *name, double *left, refusal *why);

#endif
