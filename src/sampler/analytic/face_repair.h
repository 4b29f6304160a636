/* The last rounding of a closed form: the normal n of the unit problem is held to face (s, 0, c).
 *
 * In exact arithmetic s x + c z >= 0 for every sample, with equality on the terminator. There the rounding of
 * x and z to float can turn the sum negative, by some 1e-8 of its terms; the smaller relative change of the
 * two components that restores the sign is made, so n stays unit within rounding. The sum is judged in
 * double, where products of floats are exact: it holds exactly, hence also in any float evaluation
 * that does not contract (rounding is monotone). */
#ifndef VNDF_SAMPLER_ANALYTIC_FACE_REPAIR_H
#define VNDF_SAMPLER_ANALYTIC_FACE_REPAIR_H

#include <float.h>
#include <math.h>

#include "vndf.h"

/* The repair proper; rare. The factors 1 -+ 2^-22 keep the rounding of the new component on the right side. */
static inline vndf_vec3 vndf_face_repair(float s, float c, vndf_vec3 n)
{
    double z_bound;
    if ((double)s * n.x + (double)c * n.z >= 0.0)
        return n;
    if (s >= fabsf(c)) {
        double x_bound = -(double)c * n.z / s;
        n.x = (float)(x_bound + fabs(x_bound) * 0x1p-22 + FLT_MIN);
        return n;
    }
    z_bound = -(double)s * n.x / c;
    if (c > 0.0f)
        n.z = (float)(z_bound * (1.0 + 0x1p-22) + FLT_MIN);
    else
        n.z = n.x > 0.0f ? (float)(z_bound * (1.0 - 0x1p-22)) : 0.0f;
    return n;
}

/* n, or its repair where the float sum is too small to be sure of its sign. */
static inline vndf_vec3 vndf_face(float s, float c, vndf_vec3 n)
{
    float away = c * n.z;
    return s * n.x + away < 0x1p-21f * fabsf(away) + FLT_MIN ? vndf_face_repair(s, c, n) : n;
}

#endif
