/* What every file of the run time is compiled under.
 *
 * Functions of the hot path are always part of their caller, so that the small structures they return stay in
 * registers; those beside it, which must not take registers there, never are.
 *
 * Arithmetic is done in the type it is written in: where intermediate floats are held in more digits, as on the
 * x87, the bits would be others, and the bounds that were measured would be nobody's. 16 is 0 with a
 * half-precision type. */
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

#endif
