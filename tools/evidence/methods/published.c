/* What others published, written from the papers, in float and one by one.
 *
 * - Spherical caps: visible normals of GGX. J. Dupuy, A. Benyoub, "Sampling Visible GGX Normals with Spherical Caps",
 *   HPG 2023. The yardstick: other times are multiples of its time.
 * - All normals, not only the visible ones, of any D: B. Walter et al., "Microfacet Models for Refraction through Rough
 *   Surfaces", EGSR 2007, eq. 28 and 35. */
#include <math.h>
#include <stdlib.h>

#include "evidence/method.h"

static const float pi = 3.14159265f;

static inline vndf_vec3 unit(float x, float y, float z)
{
    float scale = 1.0f / sqrtf(x * x + y * y + z * z);
    return (vndf_vec3){x * scale, y * scale, z * scale};
}

/* wi is stretched to the unit problem w, where mirrored directions are uniform on the cap z > -w.z; the normal is half
 * way between, and stretched back. The density is Dv = wi.wm D/A with A = (wi.z + |stretched wi|)/2. The published code
 * guards nothing: at normal incidence u2 = 1 is a NaN. */
typedef struct ggx_view {
    vndf_vec3 wi, w;
    float alpha, per_area;
} ggx_view;

static inline ggx_view ggx_view_from(vndf_vec3 wi, float alpha)
{
    float x = alpha * wi.x, y = alpha * wi.y, length = sqrtf(x * x + y * y + wi.z * wi.z);
    return (ggx_view){.wi = wi,
                      .w = {x / length, y / length, wi.z / length},
                      .alpha = alpha,
                      .per_area = 2.0f / (wi.z + length)};
}

static inline vndf_vec3 ggx_draw(const ggx_view *v, const float u[3], float *pdf)
{
    float phi = 2 * pi * u[0], z = (1.0f - u[1]) * (1.0f + v->w.z) - v->w.z, a = v->alpha, a2 = a * a;
    float s = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    vndf_vec3 m = unit(a * (s * cosf(phi) + v->w.x), a * (s * sinf(phi) + v->w.y), z + v->w.z);
    float across = (m.x * m.x + m.y * m.y) / a2 + m.z * m.z;
    float facing = fmaxf(0.0f, v->wi.x * m.x + v->wi.y * m.y + v->wi.z * m.z);
    *pdf = facing * v->per_area / (pi * a2 * across * across);
    return m;
}

static inline vndf_vec3 ggx_one(const method *m, const method_input *in, float *pdf)
{
    (void)m;
    ggx_view v = ggx_view_from(in->wi, in->alpha);
    return ggx_draw(&v, in->u, pdf);
}

static void ggx_each(const method *m, block *b)
{
    method_loop(ggx_one, m, b);
}

static void ggx_shared(const method *m, block *b)
{
    (void)m;
    for (size_t first = 0; first < b->count; first += SHARE) {
        ggx_view v = ggx_view_from(b->in[first].wi, b->in[first].alpha);
        for (size_t i = first; i < first + SHARE; i++) {
            const vndf_vec3 wm = ggx_draw(&v, b->in[i].u, &b->pdf[i]);
            b->x[i] = wm.x, b->y[i] = wm.y, b->z[i] = wm.z;
        }
    }
}

method method_ggx_caps(void)
{
    return (method){.name = "spherical caps (2023)",
                    .kind = ROW_PUBLISHED,
                    .each = ggx_each,
                    .shared = ggx_shared,
                    .batch = method_caps_batch};
}

/* The density is D(wm) cos(theta_m), a radial law and an azimuth; no draw reads wi. The radial law is a CDF, so that it
 * serves any D. At the scale where the median slope is 1, y = sin^2(theta_m) has the density pi D(y) in [0, 1]. The CDF
 * has cells of equal mass with a constant D in each, so that the density told is the density drawn and a coarse table
 * only costs variance. Roughness stretches. */
enum { CELLS = 1024 };

typedef struct radial_cdf {
    float y[CELLS + 1]; /* sin^2(theta_m) at masses j/CELLS */
    float scale;
} radial_cdf;

static inline vndf_vec3 normals_one(const method *m, const method_input *in, float *pdf)
{
    const radial_cdf *t = m->state;
    float place = in->u[1] * CELLS, alpha = in->alpha * t->scale, phi = 2 * pi * in->u[0];
    int j = (int)place;
    j = j < CELLS ? j : CELLS - 1;
    float width = t->y[j + 1] - t->y[j], y = fminf(t->y[j] + (place - (float)j) * width, 1 - 0x1p-24f);
    float rest = 1.0f - y, slope = alpha * sqrtf(y / rest), z2 = 1.0f / (1.0f + slope * slope), z = sqrtf(z2);
    *pdf = rest * rest / ((float)CELLS * width) / (pi * alpha * alpha * z2 * z);
    return (vndf_vec3){slope * z * cosf(phi), slope * z * sinf(phi), z};
}

static void normals_each(const method *m, block *b)
{
    method_loop(normals_one, m, b);
}

/* sin^2(theta_m) of the normal that a part `mass` of D cos(theta_m) lies within. From straight above all normals are
 * visible, and u2 is that part; but of Beckmann it moves one of two slopes. */
static double sine2_at(const vndf_surface *surface, double mass)
{
    if (surface->distribution == vndf_beckmann())
        return 1 / (1 + 1 / (-log1p(-mass) * (double)surface->xx * (double)surface->xx));
    vndf_view view = vndf_view_from(surface, (vndf_vec3){0, 0, 1});
    vndf_vec3 wm = vndf_sample(&view, 0.5f, (float)mass, NULL);
    return (double)wm.x * (double)wm.x + (double)wm.y * (double)wm.y;
}

method method_all_normals(const method_reference *reference)
{
    radial_cdf *t = malloc(sizeof *t);
    for (int j = 0; t && j <= CELLS; j++)
        t->y[j] = (float)sine2_at(&reference->canonical, (double)j / CELLS);
    if (t)
        t->scale = reference->scale;
    method m = {.name = "all normals (2007)", .kind = ROW_PUBLISHED, .memory = sizeof *t, .turned = 1};
    m.state = t, m.release = free, m.each = t ? normals_each : NULL;
    return m;
}
