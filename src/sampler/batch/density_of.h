/* A density as a float, for lanes. */
#ifndef VNDF_SAMPLER_BATCH_DENSITY_OF_H
#define VNDF_SAMPLER_BATCH_DENSITY_OF_H

#include <float.h>

#include "simd/doubles.h"

/* vndf_density_from. */
VNDF_INLINE doubles_f vndf_density_of(doubles density)
{
    return doubles_narrow(doubles_between(doubles_positive(density), 0.0, FLT_MAX));
}

/* vndf_positive of it. */
VNDF_INLINE doubles_f vndf_positive_of(doubles density)
{
    const doubles least = doubles_set(FLT_MIN);
    doubles rounded = doubles_widen(vndf_density_of(density));
    return doubles_narrow(doubles_pick(doubles_less(least, rounded), rounded, least));
}

#endif
