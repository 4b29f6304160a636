/* Do sample, pdf and invert agree? Measured at random views - incident directions over the whole sphere,
 * roughness from 0.02 to 1 of the median slope along each axis - and random numbers. */
#ifndef TOOLS_EVIDENCE_MEASURE_CONSISTENCY_H
#define TOOLS_EVIDENCE_MEASURE_CONSISTENCY_H

#include <stddef.h>
#include <stdint.h>

#include "vndf.h"

/* One of the points, enough to look at it again. */
typedef struct consistency_point {
    double theta, phi; /* incident direction, degrees */
    float alpha_x, alpha_y, u1, u2;
} consistency_point;

/* What 99.9% and 99.99% of the differences do not exceed. */
typedef struct consistency_quantiles {
    size_t measured;
    double usual, rare;
} consistency_quantiles;

/* Measured are samples where the projected area is above 1e-12. */
typedef struct consistency {
    size_t points, blind; /* blind: views that see nothing, not tested */
    size_t invalid;       /* normals not unit, below the surface or facing away; densities not finite or <= 0 */
    consistency_point invalid_at; /* the last one */
    /* |pdf(sample) / density returned - 1| from above the horizon and from below, where D is no steeper than a
     * lobe a tenth of its slope wide */
    consistency_quantiles above, below;
    /* distance of unit normals, slopes over alpha, between a normal and sample(invert(normal)); 0 if the u's
     * come back within 8 steps of 2^-24: near the ends of heavy tails one such step moves the normal farther */
    consistency_quantiles inverted;
} consistency;

/* Returns 0 if there is no memory. */
int consistency_measure(const vndf_distribution *distribution, size_t points, uint64_t seed, consistency *found);

#endif
