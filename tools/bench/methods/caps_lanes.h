/* GGX by spherical caps on vectors (lanes.h): the cost of a batch of the best closed form, to compare our batches with.
 * Dupuy & Benyoub 2023 as in caps.c, but
 *
 * - with h = cap point + w the density needs no dot product: mirrored directions are uniform on a cap of 2 pi (1 +
 *   w.z), the half vector's unit density is |h|/(pi (1 + w.z)), and stretching by alpha divides by alpha^2 and
 *   multiplies by (|stretched h|/|h|)^3;
 * - three reciprocal roots and one reciprocal in all, by approximation and a Newton step (lanes.h);
 * - azimuth 2 pi (u1 - 1/2), by polynomials within 5e-8 that need no reduction: with y = 1/4 - |u1 - 1/2| the
 *   cosine is sin(2 pi y), the sine cos(2 pi y) with a sign;
 * - only for incident directions above the horizon. */
#ifndef TOOLS_BENCH_METHODS_CAPS_LANES_H
#define TOOLS_BENCH_METHODS_CAPS_LANES_H

#include "bench/methods/caps_batch.h"
#include "bench/methods/lanes.h"

typedef struct caps_lanes {
    lanes x, y, z;    /* unit, of the unit problem */
    lanes alpha, cap; /* pi alpha^2 (1 + z) */
} caps_lanes;

typedef struct caps_drawn {
    lanes x, y, z, pdf;
} caps_drawn;

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

static inline lanes caps_sine(lanes y)
{
    lanes q = y * y;
    return y * (6.28318528f + q * (-41.3416806f + q * (81.6024764f + q * (-76.5811726f + q * 39.7598271f))));
}

static inline lanes caps_cosine(lanes y)
{
    lanes q = y * y;
    return 0.999999953f + q * (-19.7391712f + q * (64.9345727f + q * (-85.2398703f + q * 56.2387004f)));
}

/* 1e-30: a zero has no reciprocal root. */
static inline caps_drawn caps_draw(const caps_lanes *v, lanes u1, lanes u2)
{
    lanes turn = u1 - 0.5f, y = 0.25f - lanes_abs(turn);
    lanes up = (1.0f - u2) * (1.0f + v->z), z = up - v->z;
    lanes s2 = lanes_max(1.0f - z * z, lanes_all(1e-30f)), s = s2 * lanes_rsqrt(s2);
    lanes hx = s * caps_sine(y) + v->x, hy = s * lanes_signed(caps_cosine(y), turn) + v->y;
    lanes across = hx * hx + hy * hy, hh = across + up * up;
    lanes mm = lanes_max(v->alpha * v->alpha * across + up * up, lanes_all(1e-30f)), per = lanes_rsqrt(mm);
    lanes stretched = v->alpha * per;
    caps_drawn drawn = {hx * stretched, hy * stretched, up * per, mm * mm * per * lanes_reciprocal(hh * v->cap)};
    return drawn;
}

static inline void caps_store(const method_outputs *out, size_t i, const caps_drawn *drawn)
{
    lanes_store(out->x + i, drawn->x);
    lanes_store(out->y + i, drawn->y);
    lanes_store(out->z + i, drawn->z);
    lanes_store(out->pdf + i, drawn->pdf);
}

/* ---- padded copies, for the rest of a count that is no multiple of LANES --------------------------- */

enum { CAPS_IN = 6, CAPS_OUT = 4 };

typedef struct caps_rest {
    float in[CAPS_IN][LANES], out[CAPS_OUT][LANES];
} caps_rest;

static inline method_inputs caps_rest_load(caps_rest *rest, const method_inputs *in, size_t i, size_t shared)
{
    const float *from[CAPS_IN] = {in->alpha, in->wi_x, in->wi_y, in->wi_z, in->u1, in->u2};
    for (size_t k = 0; k < CAPS_IN; k++)
        for (size_t j = 0; j < LANES; j++)
            rest->in[k][j] = from[k][k < shared ? 0 : i + j < in->count ? i + j : i];
    return (method_inputs){LANES,       rest->in[0], rest->in[1], rest->in[2], rest->in[3], rest->in[4],
                           rest->in[5], NULL,        NULL,        NULL,        NULL,        NULL};
}

static inline void caps_rest_store(const caps_rest *rest, const method_outputs *out, size_t i, size_t count)
{
    float *to[CAPS_OUT] = {out->x, out->y, out->z, out->pdf};
    for (size_t k = 0; k < CAPS_OUT; k++)
        memcpy(to[k] + i, rest->out[k], (count - i) * sizeof(float));
}

/* ---- loops ----------------------------------------------------------------------------------------- */

/* Not inlined, so that whole vectors and the rest run the same code and give the same bits. */

__attribute__((noinline)) static void caps_each_whole(const method_inputs *in, const method_outputs *out,
                                                      size_t count)
{
    for (size_t i = 0; i < count; i += LANES) {
        caps_lanes v = caps_view(lanes_load(in->alpha + i), lanes_load(in->wi_x + i), lanes_load(in->wi_y + i),
                                 lanes_load(in->wi_z + i));
        caps_drawn drawn = caps_draw(&v, lanes_load(in->u1 + i), lanes_load(in->u2 + i));
        caps_store(out, i, &drawn);
    }
}

__attribute__((noinline)) static void caps_shared_whole(const method_inputs *in, const method_outputs *out,
                                                        size_t count)
{
    caps_lanes v =
        caps_view(lanes_all(in->alpha[0]), lanes_all(in->wi_x[0]), lanes_all(in->wi_y[0]), lanes_all(in->wi_z[0]));
    for (size_t i = 0; i < count; i += LANES) {
        caps_drawn drawn = caps_draw(&v, lanes_load(in->u1 + i), lanes_load(in->u2 + i));
        caps_store(out, i, &drawn);
    }
}

static void caps_each(const method *m, const method_inputs *in, const method_outputs *out)
{
    size_t whole = in->count / LANES * LANES;
    (void)m;
    caps_each_whole(in, out, whole);
    if (whole < in->count) {
        caps_rest rest;
        method_inputs padded = caps_rest_load(&rest, in, whole, 0);
        caps_each_whole(&padded, &(method_outputs){rest.out[0], rest.out[1], rest.out[2], rest.out[3]}, LANES);
        caps_rest_store(&rest, out, whole, in->count);
    }
}

static void caps_shared(const method *m, const method_inputs *in, const method_outputs *out)
{
    size_t whole = in->count / LANES * LANES;
    (void)m;
    caps_shared_whole(in, out, whole);
    if (whole < in->count) {
        caps_rest rest;
        method_inputs padded = caps_rest_load(&rest, in, whole, 4);
        caps_shared_whole(&padded, &(method_outputs){rest.out[0], rest.out[1], rest.out[2], rest.out[3]}, LANES);
        caps_rest_store(&rest, out, whole, in->count);
    }
}

/* Moves 20 bytes in and 16 out; one addition makes every input needed. */
static void caps_move(const method *m, const method_inputs *in, const method_outputs *out)
{
    size_t whole = in->count / LANES * LANES;
    (void)m;
    for (size_t i = 0; i < whole; i += LANES) {
        caps_drawn moved = {lanes_load(in->wi_x + i), lanes_load(in->wi_y + i), lanes_load(in->wi_z + i),
                            lanes_load(in->u1 + i) + lanes_load(in->u2 + i)};
        caps_store(out, i, &moved);
    }
    for (size_t i = whole; i < in->count; i++) {
        out->x[i] = in->wi_x[i];
        out->y[i] = in->wi_y[i];
        out->z[i] = in->wi_z[i];
        out->pdf[i] = in->u1[i] + in->u2[i];
    }
}

#endif
