/* Do sample, pdf and invert agree? Measured at random views - incident directions over the whole
 * sphere, roughness from 1e-3 to 1 along each axis - and random numbers. */
#ifndef TOOLS_MEASURE_CONSISTENCY_H
#define TOOLS_MEASURE_CONSISTENCY_H

#include <stddef.h>
#include <stdint.h>

#include "vndf.h"

/* One of the points, enough to look at it again. */
typedef struct consistency_point {
    double theta, phi; /* incident direction, degrees */
    float alpha_x, alpha_y, u1, u2;
} consistency_point;

typedef struct consistency {
    size_t points, blind; /* blind: views that see nothing, not tested */
    size_t measured;      /* views whose projected area is above 1e-12: those of worst_pdf and worst_invert */
    size_t invalid;       /* normals not unit, below the surface or facing away; densities not finite or <= 0 */
    double worst_pdf;     /* largest |pdf(sample) - density returned| / density returned */
    double worst_invert;  /* largest distance between a normal and sample(invert(normal)); a normal whose u's
                             come back within 4 steps of 2^-24 counts as returned, since near the ends of
                             heavy tails one such step moves the normal by more than any tolerance */
    consistency_point invalid_at, pdf_at, invert_at; /* the last invalid one; the worst ones */
} consistency;

consistency consistency_measure(const vndf_distribution *distribution, size_t points, uint64_t seed);

#endif
