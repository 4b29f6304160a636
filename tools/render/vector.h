/* Vectors of the renderer. Places and rays are in double, so that a ray that leaves a surface does not meet it
 * again; the library takes directions in float, in the frame of a hit. */
#pragma once

#include <math.h>

#include "vndf.h"

#define PI 3.14159265358979323846

typedef struct vec3 {
    double x, y, z;
} vec3;

static inline vec3 vec(double x, double y, double z)
{
    return (vec3){x, y, z};
}

static inline vec3 subtract(vec3 a, vec3 b)
{
    return vec(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline vec3 scale(vec3 a, double by)
{
    return vec(by * a.x, by * a.y, by * a.z);
}

/* a + by b */
static inline vec3 along(vec3 a, double by, vec3 b)
{
    return vec(a.x + by * b.x, a.y + by * b.y, a.z + by * b.z);
}

static inline double dot(vec3 a, vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec3 cross(vec3 a, vec3 b)
{
    return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double length(vec3 a)
{
    return sqrt(dot(a, a));
}

static inline vec3 unit(vec3 a)
{
    return scale(a, 1 / length(a));
}

/* The luminance of linear light (ITU-R BT.709). */
static inline double luminance(const float rgb[3])
{
    return 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
}

/* An orthonormal right-handed frame: z is the normal. */
typedef struct frame {
    vec3 x, y, z;
} frame;

/* The frame about the unit vector z with x towards `to`; any x if `to` has no part across z. */
static inline frame frame_about(vec3 z, vec3 to)
{
    vec3 x = along(to, -dot(to, z), z);
    if (!(dot(x, x) > 1e-12 * dot(to, to)))
        x = fabs(z.x) < 0.6 ? vec(z.y * z.y + z.z * z.z, -z.x * z.y, -z.x * z.z) : vec(-z.y, z.x, 0);
    x = unit(x);
    return (frame){x, cross(z, x), z};
}

/* A vector of the frame, in the frame of the scene. */
static inline vec3 out_of(const frame *f, vec3 w)
{
    return along(along(scale(f->z, w.z), w.y, f->y), w.x, f->x);
}

static inline vec3 widen(vndf_vec3 w)
{
    return vec((double)w.x, (double)w.y, (double)w.z);
}

static inline vndf_vec3 narrow(vec3 w)
{
    return (vndf_vec3){(float)w.x, (float)w.y, (float)w.z};
}
