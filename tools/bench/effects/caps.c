/* The shortest bare reflection of GGX, without the library: spherical caps as published (J. Dupuy, A. Benyoub,
 * "Sampling Visible GGX Normals with Spherical Caps", HPG 2023; NaN at normal incidence with u2 = 1), wi mirrored at
 * the normal, and G2/G1 of height-correlated masking. With l = |stretched wi| and A = (cos_i + l)/2, the density of the
 * normal is (wi.wm) D/A, and
 *
 *     weight = A(wi) cos_o/(cos_o A(wi) + cos_i (A(wo) - cos_o)).
 *
 * It is compiled without vector loops, as method_*.c are. */
#include "bench/methods/vector.h"

#include "bench/effects/effects.h"

typedef struct caps_hit {
    vndf_vec3 wi, w;           /* w: stretched, of unit length */
    float ax, ay, area, scale; /* scale: 1/(pi ax ay) */
} caps_hit;

static inline float stretched(float ax, float ay, vndf_vec3 w)
{
    float x = ax * w.x, y = ay * w.y;
    return sqrtf(x * x + y * y + w.z * w.z);
}

static inline caps_hit hit_from(const vndf_surface *s, vndf_vec3 wi)
{
    float ax = s->alpha_x, ay = s->alpha_y, length = stretched(ax, ay, wi), per = 1.0f / length;
    caps_hit hit = {wi,
                    {ax * wi.x * per, ay * wi.y * per, wi.z * per},
                    ax,
                    ay,
                    0.5f * (wi.z + length),
                    1.0f / (method_pi * ax * ay)};
    return hit;
}

static inline float ndf(const caps_hit *hit, vndf_vec3 wm)
{
    float x = wm.x / hit->ax, y = wm.y / hit->ay, across = x * x + y * y + wm.z * wm.z;
    return hit->scale / (across * across);
}

/* G2/(cos_i cos_o). */
static inline float masking(const caps_hit *hit, vndf_vec3 wo)
{
    float area = 0.5f * (wo.z + stretched(hit->ax, hit->ay, wo));
    return 1.0f / (wo.z * hit->area + hit->wi.z * (area - wo.z));
}

static inline vndf_vec3 draw(const caps_hit *hit, float u1, float u2)
{
    float phi = 2.0f * method_pi * u1, z = (1.0f - u2) * (1.0f + hit->w.z) - hit->w.z;
    float s = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    return method_unit(hit->ax * (s * cosf(phi) + hit->w.x), hit->ay * (s * sinf(phi) + hit->w.y), z + hit->w.z);
}

static inline void sample(const caps_hit *hit, const float u[3], vndf_scattered *out)
{
    vndf_vec3 wi = hit->wi, wm = draw(hit, u[0], u[1]);
    float twice = 2.0f * method_dot(wi, wm);
    vndf_vec3 wo = {twice * wm.x - wi.x, twice * wm.y - wi.y, twice * wm.z - wi.z};
    if (!(wo.z > 0.0f)) {
        *out = (vndf_scattered){.wo = {0, 0, 1}};
        return;
    }
    float weight = hit->area * wo.z * masking(hit, wo);
    float density = ndf(hit, wm) / (4.0f * hit->area);
    *out = (vndf_scattered){wo, {weight, weight, weight}, density, VNDF_LOBE_REFLECTION, wm};
}

static inline vndf_vec3 half_of(vndf_vec3 wi, vndf_vec3 wo)
{
    return method_unit(wi.x + wo.x, wi.y + wo.y, wi.z + wo.z);
}

/* ---- loops -------------------------------------------------------------------------------------- */

static void each(const effects_job *job)
{
    for (size_t i = 0; i < job->count; i++) {
        caps_hit hit = hit_from(&job->of->surface, job->in[i].wi);
        sample(&hit, job->in[i].u, &job->out[i]);
    }
}

static void shared(const effects_job *job)
{
    caps_hit hit = hit_from(&job->of->surface, job->in[0].wi);
    for (size_t i = 0; i < job->count; i++)
        sample(&hit, job->in[i].u, &job->out[i]);
}

static void eval(const effects_job *job)
{
    caps_hit hit = hit_from(&job->of->surface, job->in[0].wi);
    for (size_t i = 0; i < job->count; i++) {
        vndf_vec3 wo = job->in[i].wo;
        float f = 0.25f * ndf(&hit, half_of(hit.wi, wo)) * masking(&hit, wo);
        for (int k = 0; k < 3; k++)
            job->out[i].weight[k] = f;
    }
}

static void pdf(const effects_job *job)
{
    caps_hit hit = hit_from(&job->of->surface, job->in[0].wi);
    float scale = 0.25f / hit.area;
    for (size_t i = 0; i < job->count; i++)
        job->out[i].density = ndf(&hit, half_of(hit.wi, job->in[i].wo)) * scale;
}

const effects_loops effects_loops_by_caps = {each, shared, eval, pdf};
