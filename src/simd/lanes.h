/* Lanes of floats. Code that uses `lanes_f` is compiled for one float, for 8 (AVX2) and for 16 (AVX-512), as
 * VNDF_LANES says, and gives the same bits in each lane. The compiler provides + - * / between lanes; the headers
 * lanes_*.h provide the rest. Bits of a float >= 0 are compared as unsigned integers.
 *
 * Code computes both sides of a choice and masks a result that is right in some lanes only. Unused lanes hold
 * numbers that reach no result. Every lane keeps its index within the array. */
#ifndef VNDF_SIMD_LANES_H
#define VNDF_SIMD_LANES_H

#include "core/inline.h"

#ifndef VNDF_LANES
#  define VNDF_LANES 1
#endif

#if VNDF_LANES == 1
#  include "simd/lanes_one.h"
#elif VNDF_LANES == 8
#  include "simd/lanes_avx2.h"
#else
#  include "simd/lanes_avx512.h"
#endif

#if VNDF_LANES > 1

VNDF_INLINE int lanes_any(lanes_m m)
{
    return lanes_mask_bits(m) != 0;
}

#endif

/* ---- whatever the width ---- */

/* max(x, 0), 0 for NaN. */
VNDF_INLINE lanes_f lanes_positive(lanes_f x)
{
    return lanes_most(x, lanes_set(0.0f));
}

#endif
