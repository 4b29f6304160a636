/* The elements of a batch, and loops over them. */
#ifndef VNDF_SAMPLER_BATCH_BATCH_H
#define VNDF_SAMPLER_BATCH_BATCH_H

#include <stdint.h>

#include "math/vector.h"
#include "vndf.h"

/* Number i of an array; a missing array holds zeros. */
VNDF_INLINE float vndf_batch_number(const float *from, size_t i)
{
    return from ? from[i] : 0.0f;
}

/* Element i of a batch. */
VNDF_INLINE vndf_surface vndf_batch_surface(const vndf_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_ALPHA ? 0 : i;
    vndf_surface surface = {b->distribution, b->alpha_x[at], b->alpha_y[at]};
    return surface;
}

VNDF_INLINE vndf_vec3 vndf_batch_wi(const vndf_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_WI ? 0 : i;
    return vndf_vec3_of(b->wi_x[at], b->wi_y[at], b->wi_z[at]);
}

VNDF_INLINE vndf_vec3 vndf_batch_normal(vndf_normals wm, size_t i)
{
    return vndf_vec3_of(wm.x[i], wm.y[i], wm.z[i]);
}

/* Whether all elements share one view. */
VNDF_INLINE int vndf_batch_is_one_view(const vndf_batch *b)
{
    return (b->shared & VNDF_SHARED_ALPHA) && (b->shared & VNDF_SHARED_WI) && b->count > 0;
}

/* Whether the batch is drawn in lanes; a build without lanes has only VNDF_INSTRUCTIONS_PORTABLE. */
VNDF_INLINE int vndf_batch_has_lanes(const vndf_batch *b)
{
    return b->count > 1 && b->distribution && vndf_instructions_used(b->limit) != VNDF_INSTRUCTIONS_PORTABLE;
}

VNDF_INLINE vndf_view vndf_batch_view(const vndf_batch *b, size_t i)
{
    vndf_surface surface = vndf_batch_surface(b, i);
    return vndf_view_from(&surface, vndf_batch_wi(b, i));
}

/* An array of `block` elements from `first` on, of which `count` are there: in place, or copied where lanes cannot read
 * it there, as a number that all elements share, and the last block of a batch, whose last group would read past the
 * end. A shared number is copied for the first block alone: `copy` is kept. */
VNDF_INLINE const float *vndf_batch_input(const float *from, int is_shared, size_t first, uint32_t count,
                                          uint32_t block, float *copy)
{
    if (!is_shared && count == block)
        return from + first;
    for (uint32_t i = 0; i < block && !(is_shared && first > 0); i++)
        copy[i] = is_shared ? from[0] : i < count ? from[first + i] : 0.0f;
    return copy;
}

/* The arrays of a call: normals, two arrays to read and two to write. */
typedef struct vndf_batch_call {
    vndf_normals wm;
    const float *from1, *from2;
    float *to1, *to2;
} vndf_batch_call;

/* Calls `one` with each element's view. (An assigned view would be copied, and waited for.) */
VNDF_INLINE void vndf_batch_for_each_view(const vndf_batch *b, const vndf_batch_call *c,
                                          void (*one)(const vndf_view *view, const vndf_batch_call *c, size_t i))
{
    if (vndf_batch_is_one_view(b)) {
        vndf_view view = vndf_batch_view(b, 0);
        for (size_t i = 0; i < b->count; i++)
            one(&view, c, i);
        return;
    }
    for (size_t i = 0; i < b->count; i++) {
        vndf_view view = vndf_batch_view(b, i);
        one(&view, c, i);
    }
}

#endif
