/* Functions of the hot path: always part of their caller, so that the small structures they return stay in
 * registers. */
#ifndef VNDF_CORE_INLINE_H
#define VNDF_CORE_INLINE_H

#if defined(__GNUC__)
#  define VNDF_INLINE static inline __attribute__((always_inline))
#else
#  define VNDF_INLINE static inline
#endif

#endif
