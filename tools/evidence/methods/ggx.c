/* Visible normals of GGX by spherical caps, as published: J. Dupuy, A. Benyoub, "Sampling Visible GGX Normals with
 * Spherical Caps", HPG 2023. wi is stretched to the unit problem w, where mirrored directions are uniform on the cap
 * z > -w.z; the normal is half way between, and stretched back. The density is Dv = wi.wm D/A with A = (wi.z +
 * |stretched wi|)/2. The published code guards nothing: at normal incidence u2 = 1 is a NaN. It is the yardstick:
 * other times are multiples of its time. */
#include "evidence/methods/vector.h"

typedef struct ggx_view {
    vndf_vec3 wi, w;
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

static inline vndf_vec3 draw(const void *view, float u1, float u2, float *pdf)
{
    const ggx_view *v = view;
    float phi = 2 * method_pi * u1, z = (1.0f - u2) * (1.0f + v->w.z) - v->w.z, a = v->alpha;
    float s = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    vndf_vec3 m = method_unit(a * (s * cosf(phi) + v->w.x), a * (s * sinf(phi) + v->w.y), z + v->w.z);
    *pdf = density(v, m);
    return m;
}

static inline vndf_vec3 one(const method *m, const method_input *in, float *pdf)
{
    (void)m;
    ggx_view v = view_from(in->wi, in->alpha);
    return draw(&v, in->u[0], in->u[1], pdf);
}

static void each(const method *m, block *b, size_t first, size_t count)
{
    method_loop(one, m, b, first, count);
}

static void shared(const method *m, block *b, size_t first, size_t count)
{
    (void)m;
    ggx_view v = view_from(b->in[first].wi, b->in[first].alpha);
    method_shared_loop(draw, &v, b, first, count);
}

method method_ggx_caps(void)
{
    return (method){.name = "spherical caps (2023)", .kind = ROW_PUBLISHED, .each = each, .shared = shared};
}
