/* Vectors of the renderer: vndf_vec3, in float; and colours. */
#ifndef RENDER_VECTOR_H
#define RENDER_VECTOR_H

#include <math.h>

#include "vndf.h"

static inline vndf_vec3 vec(float x, float y, float z)
{
    vndf_vec3 v = {x, y, z};
    return v;
}

static inline vndf_vec3 add(vndf_vec3 a, vndf_vec3 b)
{
    return vec(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline vndf_vec3 subtract(vndf_vec3 a, vndf_vec3 b)
{
    return vec(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline vndf_vec3 scale(vndf_vec3 a, float by)
{
    return vec(by * a.x, by * a.y, by * a.z);
}

static inline float dot(vndf_vec3 a, vndf_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vndf_vec3 cross(vndf_vec3 a, vndf_vec3 b)
{
    return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline vndf_vec3 unit(vndf_vec3 a)
{
    return scale(a, 1.0f / sqrtf(dot(a, a)));
}

/* The luminance of linear light (ITU-R BT.709). */
static inline double luminance(const float rgb[3])
{
    return 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
}

/* An orthonormal right-handed frame, z the normal: the directions of a material are in it. */
typedef struct frame {
    vndf_vec3 x, y, z;
} frame;

static inline vndf_vec3 to_frame(const frame *f, vndf_vec3 w)
{
    return vec(dot(f->x, w), dot(f->y, w), dot(f->z, w));
}

static inline vndf_vec3 from_frame(const frame *f, vndf_vec3 w)
{
    return add(add(scale(f->x, w.x), scale(f->y, w.y)), scale(f->z, w.z));
}

#endif
