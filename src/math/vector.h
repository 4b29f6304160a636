/* Vectors, and the few scalar operations that every room of the run time needs. All are inline, and use only
 * + - * / sqrt and comparisons, so that bits are the same everywhere. */
#ifndef VNDF_MATH_VECTOR_H
#define VNDF_MATH_VECTOR_H

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/inline.h"

#include "vndf.h"

/* A vector to pass or return. gcc 12 would write x and y apart and read both at once, which defeats store
 * forwarding; here they are put together in a register. */
VNDF_INLINE vndf_vec3 vndf_vec3_of(float x, float y, float z)
{
    vndf_vec3 v = {x, y, z};
#if defined(__GNUC__) && defined(__SSE2__)
    typedef float pair __attribute__((vector_size(8)));
    pair xy = {x, y};
    memcpy(&v, &xy, sizeof xy);
#endif
    return v;
}

VNDF_INLINE float vndf_dot(vndf_vec3 a, vndf_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* A finite density: the largest float for infinity, 0 for the NaN of 0/0 or 0 times infinity. */
VNDF_INLINE float vndf_finite(float x)
{
    return x < 3.402823466e38f ? x : (x > 0.0f ? 3.402823466e38f : 0.0f);
}

/* The density of a drawn normal: as above, but at least FLT_MIN, so that no sample has density 0 and no quotient
 * by it is infinite. Smaller densities occur on the rim of a lobe, or where single precision loses them. */
VNDF_INLINE float vndf_positive(float x)
{
    return x > 1.17549435e-38f ? vndf_finite(x) : 1.17549435e-38f;
}

/* A density as a float: a larger one becomes FLT_MAX, NaN becomes 0. */
VNDF_INLINE float vndf_density_from(double density)
{
    return density > 0.0 ? (density < (double)FLT_MAX ? (float)density : FLT_MAX) : 0.0f;
}

#endif
