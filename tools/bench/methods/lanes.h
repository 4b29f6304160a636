/* Vectors of floats, as wide as the compiler may make them: 16 lanes with AVX-512, 8 with AVX2, else 4. Square roots
 * and reciprocals are the machine's approximations with one Newton step, within 3 ulps of 2^-24. */
#ifndef TOOLS_BENCH_METHODS_LANES_H
#define TOOLS_BENCH_METHODS_LANES_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#  include <immintrin.h>
enum { LANES = 16 };
#elif defined(__AVX2__) && defined(__FMA__)
#  include <immintrin.h>
enum { LANES = 8 };
#else
enum { LANES = 4 };
#endif

typedef float lanes __attribute__((vector_size(LANES * 4)));
typedef int32_t lane_bits __attribute__((vector_size(LANES * 4)));

static inline lanes lanes_all(float x)
{
    lanes zero = {0};
    return zero + x;
}

static inline lanes lanes_load(const float *x)
{
    lanes v;
    memcpy(&v, x, sizeof v);
    return v;
}

static inline void lanes_store(float *x, lanes v)
{
    memcpy(x, &v, sizeof v);
}

#if defined(__AVX512F__) && defined(__AVX512DQ__)

static inline lanes lanes_rough_rsqrt(lanes x)
{
    return (lanes)_mm512_rsqrt14_ps((__m512)x);
}

static inline lanes lanes_rough_reciprocal(lanes x)
{
    return (lanes)_mm512_rcp14_ps((__m512)x);
}

static inline lanes lanes_max(lanes a, lanes b)
{
    return (lanes)_mm512_max_ps((__m512)a, (__m512)b);
}

#elif defined(__AVX2__) && defined(__FMA__)

static inline lanes lanes_rough_rsqrt(lanes x)
{
    return (lanes)_mm256_rsqrt_ps((__m256)x);
}

static inline lanes lanes_rough_reciprocal(lanes x)
{
    return (lanes)_mm256_rcp_ps((__m256)x);
}

static inline lanes lanes_max(lanes a, lanes b)
{
    return (lanes)_mm256_max_ps((__m256)a, (__m256)b);
}

#elif defined(__SSE2__)

#  include <xmmintrin.h>

static inline lanes lanes_rough_rsqrt(lanes x)
{
    return (lanes)_mm_rsqrt_ps((__m128)x);
}

static inline lanes lanes_rough_reciprocal(lanes x)
{
    return (lanes)_mm_rcp_ps((__m128)x);
}

static inline lanes lanes_max(lanes a, lanes b)
{
    return (lanes)_mm_max_ps((__m128)a, (__m128)b);
}

#else

static inline lanes lanes_rough_rsqrt(lanes x)
{
    lanes root;
    for (int i = 0; i < LANES; i++)
        root[i] = 1.0f / sqrtf(x[i]);
    return root;
}

static inline lanes lanes_rough_reciprocal(lanes x)
{
    return 1.0f / x;
}

static inline lanes lanes_max(lanes a, lanes b)
{
    lane_bits first = a > b;
    return (lanes)((first & (lane_bits)a) | (~first & (lane_bits)b));
}

#endif

/* 1/sqrt(x), x > 0. */
static inline lanes lanes_rsqrt(lanes x)
{
    lanes y = lanes_rough_rsqrt(x);
    return y * (1.5f - (0.5f * x) * y * y);
}

static inline lanes lanes_reciprocal(lanes x)
{
    lanes y = lanes_rough_reciprocal(x);
    return y + y * (1.0f - x * y);
}

/* |x| with the sign of `sign`; x >= 0. */
static inline lanes lanes_signed(lanes x, lanes sign)
{
    return (lanes)((lane_bits)x | ((lane_bits)sign & INT32_MIN));
}

static inline lanes lanes_abs(lanes x)
{
    return (lanes)((lane_bits)x & INT32_MAX);
}

#endif
