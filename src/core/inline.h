/* Functions of the hot path: always part of their caller, so that the small structures they return stay in
 * registers. And those beside it, which must not take registers there: never part of their caller. */
#ifndef VNDF_CORE_INLINE_H
#define VNDF_CORE_INLINE_H

#if defined(__GNUC__)
#  define VNDF_INLINE static inline __attribute__((always_inline))
#  define VNDF_RARE static __attribute__((noinline, unused))
#else
#  define VNDF_INLINE static inline
#  define VNDF_RARE static
#endif

#endif
