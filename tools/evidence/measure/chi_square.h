/* Pearson's test of samples against the density that the sampler states, over the bins of bins.h: it tests the
 * library against itself, without another reference. `vndf check` and the tests share it. */
#ifndef TOOLS_EVIDENCE_MEASURE_CHI_SQUARE_H
#define TOOLS_EVIDENCE_MEASURE_CHI_SQUARE_H

#include <stddef.h>
#include <stdint.h>

#include "vndf.h"

typedef struct chi_square {
    double statistic;     /* sum of (observed - expected)^2 / expected */
    double p;             /* the chance of a larger one if the samples follow the density */
    double mass;          /* the density integrated over the hemisphere; 1 is right, */
    double mass_rounding; /* within this, which rounding of normals may add to it */
    size_t bins;          /* classes after pooling; bins - 1 degrees of freedom */
    size_t pooled;        /* bins of expected count < 5, pooled with their neighbours into some of the classes */
    size_t unclaimed;     /* samples whose density was 0 or not finite; 0 is right */
    int blind;            /* the view sees nothing (every density 0): there is nothing to test, and p is 1 */
} chi_square;

/* Draws `samples` normals, at least 1, with pairs of 24-bit uniform numbers of stream `seed`. wi is a unit vector.
 * Returns 0 if there is no memory, else 1 with the result. */
int chi_square_test(const vndf_surface *surface, vndf_vec3 wi, size_t samples, uint64_t seed, chi_square *result);

#endif
