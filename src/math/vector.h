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

/* The same of one that an inline function hands on to one that is not. */
VNDF_INLINE vndf_vec3 vndf_packed(vndf_vec3 v)
{
    return vndf_vec3_of(v.x, v.y, v.z);
}

VNDF_INLINE float vndf_dot(vndf_vec3 a, vndf_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* a . b where it may cancel: whether a normal faces a direction, and by how much. Products of floats are exact in
 * double, and Knuth's TwoSum gives the rounding of the first sum exactly: one rounding is left, however much
 * cancels. */
VNDF_INLINE double vndf_exact_dot(vndf_vec3 a, vndf_vec3 b)
{
    double x = (double)a.x * b.x, y = (double)a.y * b.y, z = (double)a.z * b.z, level = x + y, back = level - x;
    double lost = (x - (level - back)) + (y - back);
    return (level + z) + lost;
}

VNDF_INLINE vndf_vec3 vndf_scale(vndf_vec3 v, float factor)
{
    vndf_vec3 r = {v.x * factor, v.y * factor, v.z * factor};
    return r;
}

VNDF_INLINE float vndf_max_abs(vndf_vec3 v)
{
    float x = fabsf(v.x), y = fabsf(v.y), z = fabsf(v.z);
    float m = x > y ? x : y;
    return m > z ? m : z;
}

/* Squares between these neither overflow nor lose digits when they are added. */
VNDF_INLINE int vndf_is_safe_square(float square)
{
    return square > 1e-30f && square < 1e30f;
}

/* v / |v| for a finite v that is not zero. Where squares overflow or vanish, v is scaled first: the reciprocal of
 * a denormal is infinite, and the reciprocal of a number near FLT_MAX is a denormal, which may count as 0. */
VNDF_INLINE vndf_vec3 vndf_normalize(vndf_vec3 v)
{
    float square = vndf_dot(v, v);
    if (!vndf_is_safe_square(square)) {
        float largest = vndf_max_abs(v);
        v = largest < 1e-30f ? vndf_scale(v, 0x1p100f) : largest > 1e30f ? vndf_scale(v, 0x1p-100f) : v;
        v = vndf_scale(v, 1.0f / vndf_max_abs(v));
        square = vndf_dot(v, v);
    }
    return vndf_scale(v, 1.0f / sqrtf(square));
}

/* sqrt(x^2 + y^2) without overflow or loss for any finite x, y. */
VNDF_INLINE float vndf_length2(float x, float y)
{
    float square = x * x + y * y, ax = fabsf(x), ay = fabsf(y);
    if (vndf_is_safe_square(square))
        return sqrtf(square);
    float big = ax > ay ? ax : ay;
    if (!(big < HUGE_VALF))
        return big;
    float ratio = (ax > ay ? ay : ax) / big;
    return big > 0.0f ? big * sqrtf(1.0f + ratio * ratio) : 0.0f;
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

/* u in [0, 1]; NaN becomes 0. */
VNDF_INLINE float vndf_clamp_unit(float u)
{
    return u > 0.0f ? (u < 1.0f ? u : 1.0f) : 0.0f;
}

#endif
