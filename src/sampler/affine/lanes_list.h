/* Lists of lanes, for lanes_axes.c and lanes_mixture.c. */
#ifndef VNDF_SAMPLER_AFFINE_LANES_LIST_H
#define VNDF_SAMPLER_AFFINE_LANES_LIST_H

#include "sampler/affine/lanes_axes.h"
#include "simd/doubles.h"
#include "simd/list.h"

/* The indices of lanes from `first` on. */
VNDF_INLINE doubles_u vndf_list_indices(uint32_t first)
{
    doubles_u at;
    for (uint32_t i = 0; i < VNDF_DOUBLES; i++)
        at[i] = first + i;
    return at;
}

/* Adds the lanes in `m` that are below `end`. No branch depends on `m`. */
VNDF_INLINE void vndf_list_add(vndf_some *to, doubles_m m, doubles_u at, uint32_t end)
{
    m = doubles_both(m, doubles_at_most_u(at, doubles_set_u(end - 1)));
    to->count += doubles_keep_u(to->index + to->count, m, at);
}

/* The same for lanes that are few: most often none. */
VNDF_INLINE void vndf_list_add_few(vndf_some *to, doubles_m m, uint32_t first, uint32_t end)
{
    to->count = vndf_list_bits(to->index, to->count, doubles_mask_bits(m), first, VNDF_DOUBLES, end);
}

#endif
