/* Guide tables: the cell of a value among ascending knots in a step or two, for knots at any spread of
 * scales. The bits of a positive float are a logarithm of it, so equal steps of the bits are about equal
 * steps of ratio; each entry holds the last knot at or below its bucket. */
#ifndef VNDF_TABLE_GUIDE_H
#define VNDF_TABLE_GUIDE_H

#include <string.h>

#include "math/lanes.h"
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

/* Index i in [0, count - 2] with knots[i] <= value < knots[i+1], the ends extended; value >= 0. One step without a
 * branch to mispredict is enough for nearly every value. */
VNDF_INLINE uint32_t vndf_guide_find(const vndf_guide *guide, float value)
{
    uint32_t bits = vndf_float_bits(value), above = bits > guide->low ? bits - guide->low : 0;
    uint32_t bucket = above >> guide->shift;
    uint32_t i = guide->first[bucket < guide->last ? bucket : guide->last];
    i += bits >= guide->next[i];
    while (bits >= guide->next[i])
        i++;
    return i;
}

/* The same for lanes. */
VNDF_INLINE lanes_u vndf_guide_lanes(const vndf_guide *guide, lanes_f value)
{
    lanes_u bits = lanes_bits(value), above = bits - lanes_limit_u(lanes_set_u(guide->low), bits);
    lanes_u i = lanes_gather_u16(guide->first, lanes_limit_u(above >> guide->shift, lanes_set_u(guide->last)));
    lanes_m more = lanes_at_most_u(lanes_gather_u(guide->next, i), bits);
    i = lanes_count(i, more);
    for (;;) {
        more = lanes_at_most_u(lanes_gather_u(guide->next, i), bits);
        if (!lanes_any(more))
            return i;
        i = lanes_count(i, more);
    }
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
