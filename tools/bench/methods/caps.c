/* Visible normals of GGX by spherical caps: J. Dupuy, A. Benyoub, "Sampling Visible GGX Normals with Spherical
 * Caps", HPG 2023. wi is stretched to the unit problem; mirrored directions are uniform on the cap z > -wi.z; the
 * normal is half way between, and is stretched back.
 *
 * Its density is Dv = wi.wm D/A with A = (wi.z + |stretched wi|)/2. The published code guards nothing: at normal
 * incidence u2 = 1 is a NaN. This method is the yardstick: other times are multiples of its time. */
#include "bench/methods/vector.h"

typedef struct caps_view {
    vndf_vec3 wi, w; /* w: of the unit problem */
    float alpha, per_area;
} caps_view;

static inline caps_view view_from(vndf_vec3 wi, float alpha)
{
    float x = alpha * wi.x, y = alpha * wi.y, length = sqrtf(x * x + y * y + wi.z * wi.z);
    caps_view v = {wi, {x / length, y / length, wi.z / length}, alpha, 2.0f / (wi.z + length)};
    return v;
}

static inline vndf_vec3 draw(const void *view, float u1, float u2, float *pdf)
{
    const caps_view *v = view;
    float phi = 2 * method_pi * u1, z = (1.0f - u2) * (1.0f + v->w.z) - v->w.z, a = v->alpha;
    float s = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    vndf_vec3 m = method_unit(a * (s * cosf(phi) + v->w.x), a * (s * sinf(phi) + v->w.y), z + v->w.z);
    float across = (m.x * m.x + m.y * m.y) / (a * a) + m.z * m.z;
    *pdf = fmaxf(0.0f, method_dot(v->wi, m)) * v->per_area / (method_pi * a * a * across * across);
    return m;
}

static inline vndf_vec3 one(const method *m, const method_input *in, float *pdf)
{
    (void)m;
    caps_view v = view_from(in->wi, in->alpha);
    return draw(&v, in->u1, in->u2, pdf);
}

static void each(const method *m, const method_inputs *in, const method_outputs *out)
{
    method_loop(one, m, in, out);
}

static void shared(const method *m, const method_inputs *in, const method_outputs *out)
{
    (void)m;
    caps_view v = view_from(in->at[0].wi, in->at[0].alpha);
    method_shared_loop(draw, &v, in, out);
}

method method_ggx_caps(void)
{
    return (method){.name = "spherical caps (2023)",
                    .instructions = "scalar",
                    .kind = BENCH_PUBLISHED,
                    .one = one,
                    .each = each,
                    .shared = shared};
}
