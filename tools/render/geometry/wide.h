/* Vectors in double: shapes compute with them, so that a place is exact until it is rounded to float. */
#ifndef TOOLS_RENDER_GEOMETRY_WIDE_H
#define TOOLS_RENDER_GEOMETRY_WIDE_H

#include <math.h>

#include "vndf.h"

typedef struct wide {
    double x, y, z;
} wide;

static inline wide widen(vndf_vec3 a)
{
    const wide w = {(double)a.x, (double)a.y, (double)a.z};
    return w;
}

static inline vndf_vec3 narrow(wide a)
{
    const vndf_vec3 v = {(float)a.x, (float)a.y, (float)a.z};
    return v;
}

static inline wide wide_add(wide a, wide b)
{
    const wide w = {a.x + b.x, a.y + b.y, a.z + b.z};
    return w;
}

static inline wide wide_subtract(wide a, wide b)
{
    const wide w = {a.x - b.x, a.y - b.y, a.z - b.z};
    return w;
}

static inline wide wide_scale(wide a, double by)
{
    const wide w = {by * a.x, by * a.y, by * a.z};
    return w;
}

/* a + by b */
static inline wide wide_along(wide a, double by, wide b)
{
    return wide_add(a, wide_scale(b, by));
}

static inline double wide_dot(wide a, wide b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline wide wide_cross(wide a, wide b)
{
    const wide w = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    return w;
}

static inline double wide_length(wide a)
{
    return sqrt(wide_dot(a, a));
}

#endif
