/* Both ways of compensation scale what single scattering gives by a number for each wavelength, and the second, of
 * reflection alone, adds a lobe. vndf_bsdf.h has the formulas. */
#include "bsdf/bsdf.h"
#include "math/turn.h"

static const float INVERSE_PI = 0.318309886f;

/* A smaller 1 - E_avg is within the error of the table: Turquin's factor stands for the lobe. */
static const float LEAST_LOSS = 1e-5f;

/* ---- a material ---- */

/* F_avg = 2 integral_0^1 F mu dmu, by midpoints. */
void vndf_compensation_resolve(vndf_material *m)
{
    enum { NODES = 512 };
    double f[VNDF_WAVELENGTHS], sum[VNDF_WAVELENGTHS] = {0.0};
    for (int n = 0; n < NODES; n++) {
        double mu = (n + 0.5) / NODES;
        vndf_reflectances(m, (seen_cosine){mu, 1.0 - mu}, m->is.eta, f);
        for (int i = 0; i < m->is.wavelengths; i++)
            sum[i] += 2.0 * mu * f[i] / NODES;
    }
    vndf_reflectances(m, (seen_cosine){1.0, 0.0}, m->is.eta, f);
    for (int i = 0; i < m->is.wavelengths; i++) {
        m->own.reflectance0[i] = (float)f[i];
        m->own.reflectance[i] = (float)sum[i];
    }
}

/* ---- a hit ---- */

/* 1 - E of a direction, its z that of the frame of the hit. */
static float lost_from(const vndf_bsdf *b, float z)
{
    return 1.0f - vndf_albedo_directional(b->material->is.albedo, b->own.side * z, b->own.compensation.alpha);
}

/* The lobe of Kulla & Conty: F_ms, and the share of the samples, which is the light that the lobe sends over all light
 * that is sent; 0 where next to nothing is lost. */
static int prepare_lobe(vndf_bsdf *b, float lost)
{
    const vndf_material *m = b->material;
    struct vndf_compensation *c = &b->own.compensation;
    float lost_average = 1.0f - vndf_albedo_average(m->is.albedo, c->alpha), sum = 0.0f, single = 0.0f;
    if (!(lost_average > LEAST_LOSS))
        return 0;
    c->lost = lost > 0.0f ? lost : 0.0f;
    c->per = INVERSE_PI / lost_average;
    for (int i = 0; i < m->is.wavelengths; i++) {
        float f = m->own.reflectance[i];
        c->colour[i] = f * f * (1.0f - lost_average) / (1.0f - f * lost_average);
        sum += c->lost * c->colour[i];
        single += (1.0f - c->lost) * f;
    }
    c->share = sum > 0.0f ? sum / (sum + single) : 0.0f;
    c->near = 0.01f * c->alpha + 1e-4f;
    c->per_log = (float)(1.0 / vndf_log(1.0 + 1.0 / c->near));
    return 1;
}

/* The roughness to look up is the root of a determinant, which of alpha_x and alpha_y is sqrt(alpha_x alpha_y). */
void vndf_compensation_prepare(vndf_bsdf *b)
{
    const vndf_material *m = b->material;
    const vndf_surface *s = &b->own.surface;
    struct vndf_compensation *c = &b->own.compensation;
    double determinant = fabs((double)s->xx * s->yy - (double)s->xy * s->yx);
    *c = (struct vndf_compensation){.alpha = (float)sqrt(determinant)};
    float lost = lost_from(b, b->own.rise), kept = lost < 0.999f ? 1.0f - lost : 1e-3f;
    int has_lobe = m->is.effects.scattering == VNDF_SCATTERING_KULLA_CONTY && prepare_lobe(b, lost);
    for (int i = 0; i < m->is.wavelengths; i++)
        c->gain[i] = has_lobe ? 1.0f
                     : m->is.effects.lobes == VNDF_LOBES_BOTH
                         ? 1.0f / kept
                         : 1.0f + m->own.reflectance0[i] * ((1.0f - kept) / kept);
}

/* ---- samples, values and densities ---- */

/* Of the lobe towards wo, in the frame of the hit: f where F_ms is 1, and density. Smooth surfaces lose along the
 * surface alone, so half of the samples are even in the logarithm of the cosine, the others in its square: the largest
 * weight that was measured is 12. */
typedef struct added {
    float value, density;
} added;

static added added_towards(const vndf_bsdf *b, float z)
{
    const struct vndf_compensation *c = &b->own.compensation;
    added a = {0.0f, 0.0f};
    if (!(c->share > 0.0f) || !(z > 0.0f))
        return a;
    float lost = lost_from(b, z);
    a.value = c->lost * (lost > 0.0f ? lost : 0.0f) * c->per;
    a.density = (z + 0.5f * c->per_log / (z + c->near)) * (0.5f * INVERSE_PI);
    return a;
}

static float density_of(const vndf_bsdf *b, float single, const added *a)
{
    return (1.0f - b->own.compensation.share) * single + b->own.compensation.share * a->density;
}

/* Half of u[0] draws the cosine even in its square, half even in its logarithm. */
static int sample_added(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    const struct vndf_compensation *c = &b->own.compensation;
    float f[VNDF_WAVELENGTHS] = {0.0f}, single = 0.0f, u1 = vndf_clamp_unit(u[0]);
    float up = u1 < 0.5f ? sqrtf(2.0f * u1) : c->near * (float)(vndf_exp((2.0 * u1 - 1.0) / c->per_log) - 1.0);
    up = up < 1.0f ? up : 1.0f;
    float across = sqrtf((1.0f - up) * (1.0f + up));
    double cosine, sine;
    vndf_turn_of(vndf_clamp_unit(u[1]), &cosine, &sine);
    *s = (vndf_scattered){.wo = {across * (float)cosine, across * (float)sine, b->own.side * up},
                          .lobe = VNDF_LOBE_REFLECTION};
    added a = added_towards(b, up);
    vndf_routines_single.eval(b, s->wo, 0, f, &single);
    s->density = density_of(b, single, &a);
    for (int i = 0; i < b->material->is.wavelengths; i++)
        s->weight[i] = vndf_finite((f[i] + c->colour[i] * a.value) * (up / s->density));
    return s->density > 0.0f;
}

static int sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    const struct vndf_compensation *c = &b->own.compensation;
    if (u[2] < c->share)
        return sample_added(b, u, s);
    const float rest[3] = {u[0], u[1], c->share > 0.0f ? (u[2] - c->share) / (1.0f - c->share) : u[2]};
    if (!vndf_routines_single.sample(b, rest, s))
        return 0;
    added a = added_towards(b, b->own.side * s->wo.z);
    float density = density_of(b, s->density, &a), part = s->density / density, cosine = fabsf(s->wo.z);
    for (int i = 0; i < b->material->is.wavelengths; i++)
        s->weight[i] = vndf_finite(s->weight[i] * c->gain[i] * part + c->colour[i] * a.value * (cosine / density));
    s->density = vndf_finite(vndf_positive(density));
    return 1;
}

static int eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    const struct vndf_compensation *c = &b->own.compensation;
    float f[VNDF_WAVELENGTHS] = {0.0f}, single = 0.0f;
    added a = added_towards(b, b->own.side * wo.z);
    vndf_routines_single.eval(b, wo, seed, value ? f : NULL, pdf ? &single : NULL);
    for (int i = 0; value && i < b->material->is.wavelengths; i++)
        value[i] = vndf_finite(f[i] * c->gain[i] + c->colour[i] * a.value);
    if (pdf)
        *pdf = vndf_finite(density_of(b, single, &a));
    return 1;
}

const vndf_routines vndf_routines_compensated = {sample, eval};
