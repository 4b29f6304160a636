#include "table/guide.h"

#include <stdlib.h>

enum { GUIDE_ENTRIES_MAX = 4096 };

/* The least width of a bucket, a power of two, at which the guide has no more than four entries a knot. */
static uint32_t shift_for(uint32_t span, uint32_t count)
{
    uint32_t shift = 0, wanted = count < GUIDE_ENTRIES_MAX / 4 ? 4 * count : GUIDE_ENTRIES_MAX;
    while (span >> shift > wanted)
        shift++;
    return shift;
}

/* Whether one step is enough in buckets of that width: no bucket has two knots, unless its entry counts the first,
 * which stands where the bucket begins. The entry of the first bucket never does. */
static int is_single(const vndf_guide *guide, uint32_t shift, const float *knots, uint32_t count)
{
    for (uint32_t j = 2; j + 1 < count; j++) {
        uint32_t from = vndf_float_bits(knots[j - 1]) - guide->low, to = vndf_float_bits(knots[j]) - guide->low;
        int is_counted = from >> shift > 0 && (from >> shift) << shift == from;
        if (from >> shift == to >> shift && !is_counted)
            return 0;
    }
    return 1;
}

/* Where in bucket b the knot after its first stands, in steps of 2^drop, rounded down: so no value is taken for
 * less than it is. Beyond every value if it is in none. */
static uint32_t place_in_bucket(const vndf_guide *guide, uint32_t b)
{
    uint32_t start = guide->low + (b << guide->shift), next = guide->next[guide->entry[b]];
    uint32_t off = next > start ? next - start : 0;
    return off >> guide->shift > 0 ? 1u << (VNDF_GUIDE_SHIFT - 1) : off >> guide->drop;
}

/* From the knots below the buckets. */
static void make_entries(vndf_guide *guide, uint32_t count)
{
    const uint32_t places = VNDF_GUIDE_SHIFT - 1;
    guide->drop = guide->shift > places ? guide->shift - places : 0;
    guide->single = 1;
    for (uint32_t b = 0; b <= guide->last; b++) {
        uint32_t i = guide->entry[b], after = i + 2 < count ? guide->next[i + 1] : UINT32_MAX;
        uint32_t end = b < guide->last ? guide->low + ((b + 1) << guide->shift) : UINT32_MAX;
        guide->entry[b] = i << VNDF_GUIDE_SHIFT | place_in_bucket(guide, b);
        guide->single &= after >= end;
    }
}

int vndf_guide_make(vndf_guide *guide, const float *knots, uint32_t count)
{
    float least = knots[0] > 0.0f ? knots[0] : knots[1]; /* below the first positive knot all is cell 0 */
    uint32_t i = 0, high = vndf_float_bits(knots[count - 2]);
    guide->low = vndf_float_bits(least);
    if (high < guide->low)
        high = guide->low;
    uint32_t span = high - guide->low;
    guide->shift = shift_for(span, count);
    while (span >> guide->shift > 0 && is_single(guide, guide->shift + 1, knots, count))
        guide->shift++; /* as long as one step is enough, fewer entries cost no time */
    guide->last = span >> guide->shift;
    guide->next = malloc(vndf_guide_bytes(guide, count));
    if (!guide->next)
        return 0;
    guide->entry = guide->next + count;
    for (uint32_t j = 0; j < count; j++)
        guide->next[j] = j + 2 < count ? vndf_float_bits(knots[j + 1]) : UINT32_MAX;
    for (uint32_t b = 0; b <= guide->last; b++) {
        uint32_t start = guide->low + (b << guide->shift);
        while (guide->next[i] <= start)
            i++;
        guide->entry[b] = b == 0 ? 0 : i;
    }
    make_entries(guide, count);
    return 1;
}

void vndf_guide_free(vndf_guide *guide)
{
    free(guide->next);
}
