/* GGX by spherical caps in a batch: the cost of the best closed form, to compare our batches with. Dupuy & Benyoub
 * 2023 as in published.c, in loops that the compiler makes vectors of, for three instruction sets in turn: this file is
 * compiled with -O3 -ffast-math (CMakeLists.txt), hence with the machine's approximate reciprocals and roots, each
 * with a Newton step, within 3 ulps of 2^-24. But
 *
 * - the stretched direction w is left as long as it is, and the cap is as large, so that no root is divided by;
 * - with h = cap point + w the density needs no dot product: mirrored directions are uniform on a cap of 2 pi (|w|
 *   + w.z)/|w|, the half vector's unit density is |h|/(pi (|w| + w.z)), and stretching by alpha divides by alpha^2
 *   and multiplies by (|stretched h|/|h|)^3;
 * - azimuth 2 pi (u1 - 1/2), by polynomials within 5e-8 that need no reduction: with y = 1/4 - |u1 - 1/2| the
 *   cosine is sin(2 pi y), the sine cos(2 pi y) with a sign;
 * - only for incident directions above the horizon. */
#include <math.h>

#include "evidence/method.h"

#if defined(__GNUC__)
#  define INLINED static inline __attribute__((always_inline))
#else
#  define INLINED static inline
#endif

INLINED void caps_draw(block *b, size_t i)
{
    /* the direction in the unit problem, and pi alpha^2 (|w| + w.z) */
    float alpha = b->alpha[i], wx = alpha * b->wi[0][i], wy = alpha * b->wi[1][i], wz = b->wi[2][i];
    float length2 = wx * wx + wy * wy + wz * wz, top = wz + sqrtf(length2),
          cap = 3.14159265f * alpha * alpha * top;
    float turn = b->u[0][i] - 0.5f, y = 0.25f - fabsf(turn), q = y * y;
    float sine = y * (6.28318528f + q * (-41.3416806f + q * (81.6024764f + q * (-76.5811726f + q * 39.7598271f))));
    float cosine = 0.999999953f + q * (-19.7391712f + q * (64.9345727f + q * (-85.2398703f + q * 56.2387004f)));
    float up = (1.0f - b->u[1][i]) * top, z = up - wz, s = sqrtf(fmaxf(length2 - z * z, 1e-30f));
    float hx = s * sine + wx, hy = s * copysignf(cosine, turn) + wy, across = hx * hx + hy * hy;
    float mm = fmaxf(alpha * alpha * across + up * up, 1e-30f), area = (across + up * up) * cap;
    float share = 1.0f / (sqrtf(mm) * area), per = share * area; /* one reciprocal for both */
    b->x[i] = hx * alpha * per;
    b->y[i] = hy * alpha * per;
    b->z[i] = up * per;
    b->pdf[i] = mm * mm * share;
}

INLINED void caps_each(block *b)
{
    for (size_t i = 0; i < b->count; i++)
        caps_draw(b, i);
}

#if (defined(__x86_64__) || defined(__i386__)) && defined(__clang__)
#  define FOR_AVX2 __attribute__((target("avx2,fma")))
#  define FOR_AVX512 __attribute__((target("avx512f,avx512dq,avx512vl,fma"), min_vector_width(512)))
#elif (defined(__x86_64__) || defined(__i386__)) && defined(__GNUC__)
#  define FOR_AVX2 __attribute__((target("avx2,fma")))
#  define FOR_AVX512 __attribute__((target("avx512f,avx512dq,avx512vl,fma,prefer-vector-width=512")))
#else
#  define FOR_AVX2
#  define FOR_AVX512
#endif

static void run_portable(block *b)
{
    caps_each(b);
}

FOR_AVX2 static void run_avx2(block *b)
{
    caps_each(b);
}

FOR_AVX512 static void run_avx512(block *b)
{
    caps_each(b);
}

void method_caps_batch(const method *m, block *b)
{
    (void)m;
    (b->limit == VNDF_INSTRUCTIONS_AVX512 ? run_avx512
     : b->limit == VNDF_INSTRUCTIONS_AVX2 ? run_avx2
                                          : run_portable)(b);
}
