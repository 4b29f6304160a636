/* Vectors, and the few scalar operations that every room of the run time needs. All inline, all exact in
 * the sense of the promise: + - * / sqrt and comparisons only. */
#ifndef VNDF_MATH_VECTOR_H
#define VNDF_MATH_VECTOR_H

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/inline.h"

#include "vndf.h"

/* A vector to be passed or returned: gcc 12 writes x and y apart and reads both at once, which waits for the
 * stores, unless they are put together in a register. */
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
 * double, and so is what the first sum loses (Knuth's TwoSum): one rounding is left, however much cancels. */
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
VNDF_INLINE int vndf_is_plain(float square)
{
    return square > 1e-30f && square < 1e30f;
}

/* v / |v| for a finite v that is not zero; scaled first where squares overflow or vanish: the reciprocal of a
 * denormal is infinite, and that of what is near FLT_MAX is a denormal, which may count as 0. */
VNDF_INLINE vndf_vec3 vndf_normalize(vndf_vec3 v)
{
    float square = vndf_dot(v, v);
    if (!vndf_is_plain(square)) {
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
    if (vndf_is_plain(square))
        return sqrtf(square);
    float big = ax > ay ? ax : ay;
    if (!(big < HUGE_VALF))
        return big;
    float ratio = (ax > ay ? ay : ax) / big;
    return big > 0.0f ? big * sqrtf(1.0f + ratio * ratio) : 0.0f;
}

/* A density that is a number: the largest float for infinity, 0 for the NaN of 0/0 or 0 times infinity. */
VNDF_INLINE float vndf_finite(float x)
{
    return x < 3.402823466e38f ? x : (x > 0.0f ? 3.402823466e38f : 0.0f);
}

/* The density of a normal that is drawn: as above, but at least the least normal float, so that no sample comes
 * with density 0 and no quotient by it is infinite. What is smaller is the rim of a lobe, or lost to single
 * precision. */
VNDF_INLINE float vndf_positive(float x)
{
    return x > 1.17549435e-38f ? vndf_finite(x) : 1.17549435e-38f;
}

/* A density as a float: the largest one for what is larger, 0 for NaN. */
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
