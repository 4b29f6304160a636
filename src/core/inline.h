/* Two rules for every file of the run time, and the range of uniform numbers.
 *
 * Inlining. Functions of the hot path are always inlined into their caller, so that the small structures they
 * return stay in registers. Rare functions are never inlined, so that they take no registers from it.
 *
 * Arithmetic happens in the type it is written in. A machine that holds intermediate floats in more digits, as the
 * x87 does, would give other bits, for which no bound was measured. (FLT_EVAL_METHOD 16 is 0 with a half-precision
 * type.) */
#ifndef VNDF_CORE_INLINE_H
#define VNDF_CORE_INLINE_H

#include <float.h>

#if FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16
#  error "vndf needs FLT_EVAL_METHOD 0: -msse2 -mfpmath=sse on x86, -fexcess-precision=fast on s390x"
#endif

#if defined(__GNUC__)
#  define VNDF_INLINE static inline __attribute__((always_inline))
#  define VNDF_RARE static __attribute__((noinline, unused))
#else
#  define VNDF_INLINE static inline
#  define VNDF_RARE static
#endif

/* u in [0, 1]; NaN becomes 0. */
VNDF_INLINE float vndf_clamp_unit(float u)
{
    return u > 0.0f ? (u < 1.0f ? u : 1.0f) : 0.0f;
}

#endif
