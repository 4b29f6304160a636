/* Visible normals of GGX as before spherical caps: E. Heitz, "Sampling the GGX Distribution of Visible Normals",
 * JCGT 7(4), 2018. In the unit problem wi sees the hemisphere as a disc with one half squeezed by (1 + wi.z)/2: a point
 * of the disc is squeezed, then lifted onto the hemisphere.
 *
 * Departure: the tangent frame comes from the azimuth, with a guard for a wi without one. */
#include "bench/methods/vector.h"

typedef struct disc_view {
    vndf_vec3 wi, w, t1, t2;
    float alpha, per_area, squeeze;
} disc_view;

static inline disc_view view_from(vndf_vec3 wi, float alpha)
{
    float x = alpha * wi.x, y = alpha * wi.y, length = sqrtf(x * x + y * y + wi.z * wi.z);
    disc_view v = {.wi = wi, .w = {x / length, y / length, wi.z / length}, .t1 = {1, 0, 0}, .t2 = {0, 1, 0}};
    float across = v.w.x * v.w.x + v.w.y * v.w.y;
    v.alpha = alpha;
    v.per_area = 2.0f / (wi.z + length);
    v.squeeze = 0.5f * (1.0f + v.w.z);
    if (across > 0) {
        float per_across = 1.0f / sqrtf(across);
        v.t1 = (vndf_vec3){-v.w.y * per_across, v.w.x * per_across, 0};
        v.t2 = (vndf_vec3){-v.w.z * v.t1.y, v.w.z * v.t1.x, v.w.x * v.t1.y - v.w.y * v.t1.x};
    }
    return v;
}

static inline vndf_vec3 draw(const void *view, float u1, float u2, float *pdf)
{
    const disc_view *v = view;
    float r = sqrtf(u1), phi = 2 * method_pi * u2, a = v->alpha;
    float p = r * cosf(phi), rest = 1.0f - p * p;
    float q = (1.0f - v->squeeze) * sqrtf(rest) + v->squeeze * r * sinf(phi);
    float up = sqrtf(fmaxf(0.0f, rest - q * q));
    vndf_vec3 h = {p * v->t1.x + q * v->t2.x + up * v->w.x, p * v->t1.y + q * v->t2.y + up * v->w.y,
                   q * v->t2.z + up * v->w.z};
    vndf_vec3 m = method_unit(a * h.x, a * h.y, fmaxf(0.0f, h.z));
    float across = (m.x * m.x + m.y * m.y) / (a * a) + m.z * m.z;
    *pdf = fmaxf(0.0f, method_dot(v->wi, m)) * v->per_area / (method_pi * a * a * across * across);
    return m;
}

static inline vndf_vec3 one(const method *m, const method_input *in, float *pdf)
{
    (void)m;
    disc_view v = view_from(in->wi, in->alpha);
    return draw(&v, in->u1, in->u2, pdf);
}

static void each(const method *m, const method_inputs *in, const method_outputs *out)
{
    method_loop(one, m, in, out);
}

static void shared(const method *m, const method_inputs *in, const method_outputs *out)
{
    (void)m;
    disc_view v = view_from(in->at[0].wi, in->at[0].alpha);
    method_shared_loop(draw, &v, in, out);
}

method method_ggx_2018(void)
{
    return (method){.name = "GGX disc (2018)",
                    .instructions = "scalar",
                    .kind = BENCH_PUBLISHED,
                    .one = one,
                    .each = each,
                    .shared = shared};
}
