/* Bins of the lengths of slopes, and how sure their masses are. */
#ifndef TOOLS_MEASURED_SURFACE_SLOPE_BINS_H
#define TOOLS_MEASURED_SURFACE_SLOPE_BINS_H

#include "measured/surface/slopes.h"

enum { BINS_MOST = 96 };

typedef struct slope_bins {
    size_t count;
    double edge[BINS_MOST + 1]; /* edge[count] is infinite */
    double mass[BINS_MOST];
    double middle[BINS_MOST];               /* a row's place */
    double error[BINS_MOST];                /* relative, of the mass: one standard deviation */
    double of_part[SLOPE_PARTS][BINS_MOST]; /* how many slopes of each part */
    double longest;                         /* of all slopes */
    size_t samples;
} slope_bins;

/* Edges at equal parts of the sorted lengths r[], then halving what is left of the tail. */
void slope_bins_edges(slope_bins *b, const double *r, size_t count, double narrowest);

/* The bin in which a length lies. */
size_t slope_bin_of(const slope_bins *b, double r);

/* Masses, and where rows stand: where the mean square of the lengths in a bin is, since for a density that falls evenly
 * in r^2 it has its mean there. The last bin has no end, and a heavy tail no mean square: there it is the mean of the
 * logarithm. */
void slope_bins_masses(slope_bins *b, const double *r, size_t count);

/* The standard deviation of the mass of every bin, over surfaces made of parts drawn again (bootstrap). r[]: the
 * lengths of the slopes, in their order. */
void slope_bins_errors(slope_bins *b, const slope_set *slopes, const double *r);
void slope_bins_note(const slope_bins *b, notes *to);

#endif
