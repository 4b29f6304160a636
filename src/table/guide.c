#include "table/guide.h"

#include <stdlib.h>

enum { GUIDE_ENTRIES_MAX = 4096 };

/* Largest resolution, in powers of two, at which the guide has no more than four entries a knot. */
static uint32_t shift_for(uint32_t span, uint32_t count)
{
    uint32_t shift = 0, wanted = count < GUIDE_ENTRIES_MAX / 4 ? 4 * count : GUIDE_ENTRIES_MAX;
    while (span >> shift > wanted)
        shift++;
    return shift;
}

int vndf_guide_make(vndf_guide *guide, const float *knots, uint32_t count)
{
    float least = knots[0] > 0.0f ? knots[0] : knots[1]; /* below the first positive knot all is cell 0 */
    uint32_t i = 0, high = vndf_float_bits(knots[count - 2]);
    guide->low = vndf_float_bits(least);
    if (high < guide->low)
        high = guide->low;
    guide->shift = shift_for(high - guide->low, count);
    guide->last = (high - guide->low) >> guide->shift;
    guide->next = malloc(count * sizeof *guide->next + (guide->last + 2) * sizeof *guide->first);
    if (!guide->next)
        return 0;
    guide->first = (uint16_t *)(guide->next + count);
    for (uint32_t j = 0; j < count; j++)
        guide->next[j] = j + 2 < count ? vndf_float_bits(knots[j + 1]) : UINT32_MAX;
    for (uint32_t b = 0; b <= guide->last; b++) {
        uint32_t start = guide->low + (b << guide->shift);
        while (guide->next[i] <= start)
            i++;
        guide->first[b] = (uint16_t)(b == 0 ? 0 : i);
    }
    return 1;
}

void vndf_guide_free(vndf_guide *guide)
{
    free(guide->next);
}
