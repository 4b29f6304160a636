/* GGX by spherical caps on vectors: the cost of a batch of the best closed form, to compare our batches with.
 * Vectors are as wide as the compiler may make them, 16 floats with AVX-512, 8 with AVX2, else 4; a count is a
 * multiple of them. Dupuy & Benyoub 2023 as in ggx.c, but
 *
 * - with h = cap point + w the density needs no dot product: mirrored directions are uniform on a cap of 2 pi (1 +
 *   w.z), the half vector's unit density is |h|/(pi (1 + w.z)), and stretching by alpha divides by alpha^2 and
 *   multiplies by (|stretched h|/|h|)^3;
 * - three reciprocal roots and one reciprocal in all, the machine's approximations and a Newton step, within 3 ulps of
 *   2^-24;
 * - azimuth 2 pi (u1 - 1/2), by polynomials within 5e-8 that need no reduction: with y = 1/4 - |u1 - 1/2| the
 *   cosine is sin(2 pi y), the sine cos(2 pi y) with a sign;
 * - only for incident directions above the horizon. */
#ifndef TOOLS_EVIDENCE_METHODS_CAPS_LANES_H
#define TOOLS_EVIDENCE_METHODS_CAPS_LANES_H

#include <math.h>
#include <string.h>

#include "evidence/methods/caps_batch.h"

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#  include <immintrin.h>
enum { LANES = 16 };
#elif defined(__AVX2__) && defined(__FMA__)
#  include <immintrin.h>
enum { LANES = 8 };
#else
#  ifdef __SSE2__
#    include <xmmintrin.h>
#  endif
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

/* 1/sqrt(x), x > 0. */
static inline lanes lanes_rsqrt(lanes x)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    lanes y = (lanes)_mm512_rsqrt14_ps((__m512)x);
#elif defined(__AVX2__) && defined(__FMA__)
    lanes y = (lanes)_mm256_rsqrt_ps((__m256)x);
#elif defined(__SSE2__)
    lanes y = (lanes)_mm_rsqrt_ps((__m128)x);
#else
    lanes y;
    for (int i = 0; i < LANES; i++)
        y[i] = 1.0f / sqrtf(x[i]);
#endif
    return y * (1.5f - (0.5f * x) * y * y);
}

static inline lanes lanes_reciprocal(lanes x)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    lanes y = (lanes)_mm512_rcp14_ps((__m512)x);
#elif defined(__AVX2__) && defined(__FMA__)
    lanes y = (lanes)_mm256_rcp_ps((__m256)x);
#elif defined(__SSE2__)
    lanes y = (lanes)_mm_rcp_ps((__m128)x);
#else
    lanes y = 1.0f / x;
#endif
    return y + y * (1.0f - x * y);
}

/* At least 1e-30: a zero has no reciprocal root. */
static inline lanes lanes_positive(lanes x)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    return (lanes)_mm512_max_ps((__m512)x, (__m512)lanes_all(1e-30f));
#elif defined(__AVX2__) && defined(__FMA__)
    return (lanes)_mm256_max_ps((__m256)x, (__m256)lanes_all(1e-30f));
#elif defined(__SSE2__)
    return (lanes)_mm_max_ps((__m128)x, (__m128)lanes_all(1e-30f));
#else
    lanes least = lanes_all(1e-30f);
    lane_bits is_more = x > least;
    return (lanes)((is_more & (lane_bits)x) | (~is_more & (lane_bits)least));
#endif
}

/* ---- one vector ---------------------------------------------------------------------------------- */

typedef struct caps_lanes {
    lanes x, y, z;    /* unit, of the unit problem */
    lanes alpha, cap; /* pi alpha^2 (1 + z) */
} caps_lanes;

static inline caps_lanes caps_view(lanes alpha, lanes x, lanes y, lanes z)
{
    caps_lanes v = {alpha * x, alpha * y, z, alpha, z};
    lanes per_length = lanes_rsqrt(v.x * v.x + v.y * v.y + z * z);
    v.x *= per_length;
    v.y *= per_length;
    v.z *= per_length;
    v.cap = 3.14159265f * alpha * alpha * (1.0f + v.z);
    return v;
}

static inline void caps_store(block *b, size_t i, lanes x, lanes y, lanes z, lanes pdf)
{
    memcpy(b->x + i, &x, sizeof x);
    memcpy(b->y + i, &y, sizeof y);
    memcpy(b->z + i, &z, sizeof z);
    memcpy(b->pdf + i, &pdf, sizeof pdf);
}

static inline void caps_draw(const caps_lanes *v, block *b, size_t i)
{
    lanes turn = lanes_load(b->u[0] + i) - 0.5f, y = 0.25f - (lanes)((lane_bits)turn & INT32_MAX), q = y * y;
    lanes sine = y * (6.28318528f + q * (-41.3416806f + q * (81.6024764f + q * (-76.5811726f + q * 39.7598271f))));
    lanes cosine = 0.999999953f + q * (-19.7391712f + q * (64.9345727f + q * (-85.2398703f + q * 56.2387004f)));
    lanes up = (1.0f - lanes_load(b->u[1] + i)) * (1.0f + v->z), z = up - v->z;
    lanes s2 = lanes_positive(1.0f - z * z), s = s2 * lanes_rsqrt(s2);
    lanes across_turn = (lanes)((lane_bits)cosine | ((lane_bits)turn & INT32_MIN));
    lanes hx = s * sine + v->x, hy = s * across_turn + v->y, across = hx * hx + hy * hy, hh = across + up * up;
    lanes mm = lanes_positive(v->alpha * v->alpha * across + up * up), per = lanes_rsqrt(mm);
    lanes stretched = v->alpha * per;
    caps_store(b, i, hx * stretched, hy * stretched, up * per, mm * mm * per * lanes_reciprocal(hh * v->cap));
}

/* ---- loops --------------------------------------------------------------------------------------- */

static void caps_each(const method *m, block *b, size_t first, size_t count)
{
    (void)m;
    for (size_t i = first; i < first + count; i += LANES) {
        caps_lanes v = caps_view(lanes_load(b->alpha + i), lanes_load(b->wi[0] + i), lanes_load(b->wi[1] + i),
                                 lanes_load(b->wi[2] + i));
        caps_draw(&v, b, i);
    }
}

static void caps_shared(const method *m, block *b, size_t first, size_t count)
{
    (void)m;
    caps_lanes v = caps_view(lanes_all(b->alpha[first]), lanes_all(b->wi[0][first]), lanes_all(b->wi[1][first]),
                             lanes_all(b->wi[2][first]));
    for (size_t i = first; i < first + count; i += LANES)
        caps_draw(&v, b, i);
}

/* Moves 20 bytes in and 16 out; one addition makes every input needed. */
static void caps_move(const method *m, block *b, size_t first, size_t count)
{
    (void)m;
    for (size_t i = first; i < first + count; i += LANES)
        caps_store(b, i, lanes_load(b->wi[0] + i), lanes_load(b->wi[1] + i), lanes_load(b->wi[2] + i),
                   lanes_load(b->u[0] + i) + lanes_load(b->u[1] + i));
}

#endif
