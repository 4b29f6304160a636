/* Visible normals of GGX as published: by spherical caps (J. Dupuy, A. Benyoub, "Sampling Visible GGX Normals
 * with Spherical Caps", HPG 2023), and by the squeezed disc before them (E. Heitz, "Sampling the GGX
 * Distribution of Visible Normals", JCGT 7(4), 2018). Both stretch wi to the unit problem w, find a half vector
 * or a point of the hemisphere, and stretch it back. The density is Dv = wi.wm D/A with A = (wi.z + |stretched
 * wi|)/2.
 *
 * Caps: mirrored directions are uniform on the cap z > -w.z; the normal is half way between. The published code
 * guards nothing: at normal incidence u2 = 1 is a NaN. It is the yardstick: other times are multiples of its
 * time. Disc: wi sees the hemisphere as a disc with one half squeezed by (1 + w.z)/2; a point of the disc is
 * squeezed, then lifted. Departure: the tangent frame comes from the azimuth, with a guard for a wi without
 * one. */
#include "evidence/methods/vector.h"

typedef struct ggx_view {
    vndf_vec3 wi, w, t1, t2; /* t1, t2: across w, of the disc */
    float alpha, per_area;
} ggx_view;

static inline ggx_view view_from(vndf_vec3 wi, float alpha)
{
    float x = alpha * wi.x, y = alpha * wi.y, length = sqrtf(x * x + y * y + wi.z * wi.z);
    return (ggx_view){.wi = wi,
                      .w = {x / length, y / length, wi.z / length},
                      .alpha = alpha,
                      .per_area = 2.0f / (wi.z + length)};
}

static inline float density(const ggx_view *v, vndf_vec3 m)
{
    float a2 = v->alpha * v->alpha, across = (m.x * m.x + m.y * m.y) / a2 + m.z * m.z;
    return fmaxf(0.0f, method_dot(v->wi, m)) * v->per_area / (method_pi * a2 * across * across);
}

/* ---- spherical caps ------------------------------------------------------------------------------ */

static inline vndf_vec3 draw_cap(const void *view, float u1, float u2, float *pdf)
{
    const ggx_view *v = view;
    float phi = 2 * method_pi * u1, z = (1.0f - u2) * (1.0f + v->w.z) - v->w.z, a = v->alpha;
    float s = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    vndf_vec3 m = method_unit(a * (s * cosf(phi) + v->w.x), a * (s * sinf(phi) + v->w.y), z + v->w.z);
    *pdf = density(v, m);
    return m;
}

static inline vndf_vec3 one_cap(const method *m, const method_input *in, float *pdf)
{
    (void)m;
    ggx_view v = view_from(in->wi, in->alpha);
    return draw_cap(&v, in->u[0], in->u[1], pdf);
}

static void each_cap(const method *m, block *b, size_t first, size_t count)
{
    method_loop(one_cap, m, b, first, count);
}

static void shared_caps(const method *m, block *b, size_t first, size_t count)
{
    (void)m;
    ggx_view v = view_from(b->in[first].wi, b->in[first].alpha);
    method_shared_loop(draw_cap, &v, b, first, count);
}

method method_ggx_caps(void)
{
    return (method){.name = "spherical caps (2023)",
                    .instructions = "scalar",
                    .kind = ROW_PUBLISHED,
                    .one = one_cap,
                    .each = each_cap,
                    .shared = shared_caps};
}

/* ---- disc ---------------------------------------------------------------------------------------- */

static inline ggx_view disc_from(vndf_vec3 wi, float alpha)
{
    ggx_view v = view_from(wi, alpha);
    float across = v.w.x * v.w.x + v.w.y * v.w.y;
    v.t1 = (vndf_vec3){1, 0, 0};
    v.t2 = (vndf_vec3){0, 1, 0};
    if (across > 0) {
        float per_across = 1.0f / sqrtf(across);
        v.t1 = (vndf_vec3){-v.w.y * per_across, v.w.x * per_across, 0};
        v.t2 = (vndf_vec3){-v.w.z * v.t1.y, v.w.z * v.t1.x, v.w.x * v.t1.y - v.w.y * v.t1.x};
    }
    return v;
}

static inline vndf_vec3 draw_disc(const void *view, float u1, float u2, float *pdf)
{
    const ggx_view *v = view;
    float r = sqrtf(u1), phi = 2 * method_pi * u2, a = v->alpha, squeeze = 0.5f * (1.0f + v->w.z);
    float p = r * cosf(phi), rest = 1.0f - p * p;
    float q = (1.0f - squeeze) * sqrtf(rest) + squeeze * r * sinf(phi);
    float up = sqrtf(fmaxf(0.0f, rest - q * q));
    vndf_vec3 h = {p * v->t1.x + q * v->t2.x + up * v->w.x, p * v->t1.y + q * v->t2.y + up * v->w.y,
                   q * v->t2.z + up * v->w.z};
    vndf_vec3 m = method_unit(a * h.x, a * h.y, fmaxf(0.0f, h.z));
    *pdf = density(v, m);
    return m;
}

static inline vndf_vec3 one_disc(const method *m, const method_input *in, float *pdf)
{
    (void)m;
    ggx_view v = disc_from(in->wi, in->alpha);
    return draw_disc(&v, in->u[0], in->u[1], pdf);
}

static void each_disc(const method *m, block *b, size_t first, size_t count)
{
    method_loop(one_disc, m, b, first, count);
}

static void shared_disc(const method *m, block *b, size_t first, size_t count)
{
    (void)m;
    ggx_view v = disc_from(b->in[first].wi, b->in[first].alpha);
    method_shared_loop(draw_disc, &v, b, first, count);
}

method method_ggx_2018(void)
{
    return (method){.name = "GGX disc (2018)",
                    .instructions = "scalar",
                    .kind = ROW_PUBLISHED,
                    .one = one_disc,
                    .each = each_disc,
                    .shared = shared_disc};
}
