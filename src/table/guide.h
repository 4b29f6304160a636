/* Guide tables: the cell of a value among ascending knots in a step or two, for knots at any spread of
 * scales. The bits of a positive float are a logarithm of it, so equal steps of the bits are about equal
 * steps of ratio; each entry holds the last knot at or below its bucket. */
#ifndef VNDF_TABLE_GUIDE_H
#define VNDF_TABLE_GUIDE_H

#include <string.h>

#include "simd/doubles.h"
#include "table/table.h"

/* The bits of a float >= 0 grow with it. */
VNDF_INLINE uint32_t vndf_float_bits(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* Makes the guide of knots[0..count), ascending, knots[0] >= 0. 0 if there is no memory. */
int vndf_guide_make(vndf_guide *guide, const float *knots, uint32_t count);
void vndf_guide_free(vndf_guide *guide);

/* The bytes that the guide of so many knots takes. */
static inline size_t vndf_guide_bytes(const vndf_guide *guide, uint32_t count)
{
    return ((size_t)count + guide->last + 1) * sizeof *guide->next;
}

/* Index i in [0, count - 2] with knots[i] <= value < knots[i+1], the ends extended; value >= 0. One step without a
 * branch to mispredict is enough for nearly every value. */
VNDF_INLINE uint32_t vndf_guide_find(const vndf_guide *guide, float value)
{
    uint32_t bits = vndf_float_bits(value), above = bits > guide->low ? bits - guide->low : 0;
    uint32_t bucket = above >> guide->shift;
    uint32_t i = guide->entry[bucket < guide->last ? bucket : guide->last] >> VNDF_GUIDE_SHIFT;
    i += bits >= guide->next[i];
    while (bits >= guide->next[i])
        i++;
    return i;
}

/* The same for lanes. */
VNDF_INLINE lanes_u vndf_guide_lanes(const vndf_guide *guide, lanes_f value)
{
    lanes_u bits = lanes_bits(value), above = bits - lanes_limit_u(lanes_set_u(guide->low), bits);
    lanes_u bucket = lanes_limit_u(above >> guide->shift, lanes_set_u(guide->last));
    lanes_u i = lanes_gather_u(guide->entry, bucket) >> VNDF_GUIDE_SHIFT;
    lanes_m more = lanes_at_most_u(lanes_gather_u(guide->next, i), bits);
    i = lanes_count(i, more);
    for (;;) {
        more = lanes_at_most_u(lanes_gather_u(guide->next, i), bits);
        if (!lanes_any(more))
            return i;
        i = lanes_count(i, more);
    }
}

/* The same beside doubles, or an index somewhat too large: entries are rounded, and what is below all knots counts
 * as the second; it may be too small unless the guide is `single`. Callers look themselves. */
VNDF_INLINE doubles_u vndf_guide_about(const vndf_guide *guide, doubles_f value)
{
#if VNDF_DOUBLES == 1
    return vndf_guide_find(guide, value);
#else
    const uint32_t places = (1u << VNDF_GUIDE_SHIFT) - 1, most = (1u << guide->shift) - 1;
    doubles_u low = doubles_set_u(guide->low), above = doubles_most_u(doubles_bits(value), low) - low;
    doubles_u bucket = doubles_least_u(above >> guide->shift, doubles_set_u(guide->last));
    doubles_u entry = doubles_gather_u(guide->entry, bucket);
    doubles_u off = doubles_least_u(above - (bucket << guide->shift), doubles_set_u(most)) >> guide->drop;
    return (entry >> VNDF_GUIDE_SHIFT) +
           doubles_pick_u(doubles_at_most_u(entry & places, off), doubles_set_u(1), doubles_set_u(0));
#endif
}

/* ... but never too small. */
VNDF_INLINE doubles_u vndf_guide_doubles(const vndf_guide *guide, doubles_f value)
{
    doubles_u i = vndf_guide_about(guide, value), bits = doubles_bits(value);
    while (!guide->single) {
        doubles_m more = doubles_at_most_u(doubles_gather_u(guide->next, i), bits);
        if (!doubles_any(more))
            return i;
        i += doubles_pick_u(more, doubles_set_u(1), doubles_set_u(0));
    }
    return i;
}

/* The same for lanes where knots are few: all are looked at, no step of which waits for another. */
VNDF_INLINE lanes_u vndf_guide_count(const float *knots, uint32_t count, lanes_f value)
{
    lanes_u i = lanes_set_u(0);
    for (uint32_t n = 1; n + 1 < count; n++)
        i = lanes_count(i, lanes_at_most(lanes_set(knots[n]), value));
    return i;
}

#endif
