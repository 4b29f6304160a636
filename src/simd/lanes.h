/* Numbers side by side: what is written once for `lanes_f` is compiled for one float, for 8 (AVX2) and for 16
 * (AVX-512), as VNDF_LANES says, and gives the same bits in each lane. + - * / between lanes are the
 * compiler's own, here is the rest. Bits of a float >= 0 are compared as unsigned integers.
 *
 * Both sides of a choice are computed; what is only right in some lanes is masked, and lanes of no use hold
 * numbers that reach nothing. An index is within its array in every lane. */
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
