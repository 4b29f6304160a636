/* The few vector operations that methods from publications share, in float and without guards, and their loops. */
#ifndef TOOLS_EVIDENCE_METHODS_VECTOR_H
#define TOOLS_EVIDENCE_METHODS_VECTOR_H

#include <math.h>

#include "evidence/method.h"

static const float method_pi = 3.14159265f;

static inline float method_dot(vndf_vec3 a, vndf_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vndf_vec3 method_unit(float x, float y, float z)
{
    float scale = 1.0f / sqrtf(x * x + y * y + z * z);
    return (vndf_vec3){x * scale, y * scale, z * scale};
}

/* The loop of a scalar method's `each`. `one` is a constant there, so that the compiler inlines it. */
static inline void method_loop(method_one *one, const method *m, block *b, size_t first, size_t count)
{
    for (size_t i = first; i < first + count; i++) {
        const vndf_vec3 wm = one(m, &b->in[i], &b->pdf[i]);
        b->x[i] = wm.x, b->y[i] = wm.y, b->z[i] = wm.z;
    }
}

/* The loop of a scalar method's `shared`: one view of the method's own type draws all samples. */
static inline void method_shared_loop(vndf_vec3 (*draw)(const void *view, float u1, float u2, float *pdf),
                                      const void *view, block *b, size_t first, size_t count)
{
    for (size_t i = first; i < first + count; i++) {
        const vndf_vec3 wm = draw(view, b->in[i].u[0], b->in[i].u[1], &b->pdf[i]);
        b->x[i] = wm.x, b->y[i] = wm.y, b->z[i] = wm.z;
    }
}

#endif
