/* Do sample, pdf and invert agree? Measured at random views - incident directions over the whole
 * sphere, roughness from 1e-3 to 1 along each axis - and random numbers. */
#ifndef TOOLS_CONSISTENCY_H
#define TOOLS_CONSISTENCY_H

#include <stddef.h>
#include <stdint.h>

#include "vndf.h"

typedef struct consistency {
    double worst_pdf;    /* largest |pdf(sample) - density returned| / density returned */
    double worst_invert; /* largest distance between a normal and sample(invert(normal)); a normal whose u's
                            come back within 4 steps of 2^-24 counts as returned, since near the ends of
                            heavy tails one such step moves the normal by more than any tolerance */
    size_t invalid;      /* normals not unit, below the surface or facing away; densities not finite or <= 0 */
    size_t points, blind; /* blind: views that see nothing, not tested */
} consistency;

consistency consistency_measure(const vndf_distribution *distribution, size_t points, uint64_t seed);

#endif
