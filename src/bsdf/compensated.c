/* Both ways of compensation scale what single scattering gives by a number for each wavelength, and the second adds a
 * lobe. vndf_bsdf.h has the formulas.
 *
 * Kulla & Conty's lobe of both lobes. Of what is lost on side A, 1 - E_A(wi), the part b_A goes to the other side, with
 * f = b_A (1 - E_A(wi)) (1 - E_B(wo))/(pi (1 - E_avg,B)). Energy asks for a part of 1 - b_A that stays, reciprocity for
 * b_A (1 - E_avg,A) n_A^2 = b_B (1 - E_avg,B) n_B^2. Since (1 - F_avg) n^2 is the same seen from both sides, b =
 * (1 - F_avg) min/(1 - E_avg) is such a part, and at most 1. */
#include "bsdf/bsdf.h"
#include "math/turn.h"

static const float INVERSE_PI = 0.318309886f;

/* A smaller 1 - E_avg is within the error of the table: Turquin's factor stands for the lobe. */
static const float LEAST_LOSS = 1e-5f;

static int has_both(const vndf_bsdf *b)
{
    return b->material->is.effects.lobes == VNDF_LOBES_BOTH;
}

/* ---- a material ---- */

/* F_avg = 2 integral_0^1 F mu dmu, by midpoints. */
enum { NODES = 512 };

void vndf_compensation_resolve(vndf_material *m)
{
    double f[VNDF_WAVELENGTHS], sum[VNDF_WAVELENGTHS] = {0.0};
    vndf_reflectances(m, (seen_cosine){1.0, 0.0}, m->is.eta, f);
    for (int i = 0; i < m->is.wavelengths; i++)
        m->own.reflectance0[i] = (float)f[i];
    for (int n = 0; n < NODES; n++) {
        double mu = (n + 0.5) / NODES;
        vndf_reflectances(m, (seen_cosine){mu, 1.0 - mu}, m->is.eta, f);
        for (int i = 0; i < m->is.wavelengths; i++)
            sum[i] += 2.0 * mu * f[i] / NODES;
    }
    for (int i = 0; i < m->is.wavelengths; i++)
        m->own.reflectance[i] = (float)sum[i];
}

/* ---- a hit ---- */

/* 1 - E of a direction, its z that of the frame of the hit. */
static float lost_from(const vndf_bsdf *b, float z)
{
    return 1.0f - vndf_albedo_directional(b->material->is.albedo, b->own.side * z, b->own.compensation.alpha);
}

static float average_lost(const vndf_bsdf *b, float side)
{
    return 1.0f - vndf_albedo_average(b->material->is.albedo, b->own.compensation.alpha, (int)side);
}

static float per_of(float lost)
{
    return lost > LEAST_LOSS ? INVERSE_PI / lost : 0.0f;
}

/* Sets F_ms, and the share of the samples: the light that the lobe sends over all light that is sent. */
static void colour_reflection(vndf_bsdf *b, float lost_average)
{
    const vndf_material *m = b->material;
    struct vndf_compensation *c = &b->own.compensation;
    float sum = 0.0f, single = 0.0f;
    for (int i = 0; i < m->is.wavelengths; i++) {
        float f = m->own.reflectance[i];
        c->colour[i] = f * f * (1.0f - lost_average) / (1.0f - f * lost_average);
        sum += c->lost * c->colour[i];
        single += (1.0f - c->lost) * f;
    }
    c->share = sum > 0.0f ? sum / (sum + single) : 0.0f;
    c->reflected = 1.0f;
    c->beyond = 0.0f;
}

/* Sets what stays and what passes. 1 - F_avg of the other side follows from that of the side of z, since times n^2 both
 * are the same. */
static void part_lobes(vndf_bsdf *b, float lost_average)
{
    struct vndf_compensation *c = &b->own.compensation;
    float through = 1.0f - b->material->own.reflectance[0], lost_beyond = average_lost(b, -b->own.side);
    if (b->own.side < 0.0f)
        through *= (float)(b->own.eta * b->own.eta);
    float least = lost_beyond < lost_average ? lost_beyond : lost_average;
    float part = lost_average > LEAST_LOSS && lost_beyond > LEAST_LOSS ? through * (least / lost_average) : 0.0f;
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        c->colour[i] = 1.0f;
    c->reflected = 1.0f - (part < 1.0f ? part : 1.0f);
    c->beyond = per_of(lost_beyond);
    c->share = c->lost;
}

/* The lobe of Kulla & Conty; 0 where next to nothing is lost. */
static int prepare_lobe(vndf_bsdf *b, float lost)
{
    struct vndf_compensation *c = &b->own.compensation;
    float lost_average = average_lost(b, b->own.side);
    c->per = per_of(lost_average);
    if (!(c->per > 0.0f))
        return 0;
    c->lost = lost > 0.0f ? lost : 0.0f;
    if (has_both(b))
        part_lobes(b, lost_average);
    else
        colour_reflection(b, lost_average);
    c->near = 0.01f * c->alpha + 1e-4f;
    c->per_log = (float)(1.0 / vndf_log(1.0 + 1.0 / c->near));
    return 1;
}

/* The roughness to look up is the root of a determinant, which of alpha_x and alpha_y is sqrt(alpha_x alpha_y). */
void vndf_compensation_prepare(vndf_bsdf *b)
{
    const vndf_material *m = b->material;
    const vndf_affine *s = &b->own.surface;
    struct vndf_compensation *c = &b->own.compensation;
    c->alpha = (float)sqrt(fabs((double)s->xx * s->yy - (double)s->xy * s->yx));
    *c = (struct vndf_compensation){.alpha = c->alpha};
    float lost = lost_from(b, b->own.rise), kept = lost < 0.999f ? 1.0f - lost : 1e-3f;
    int has_lobe = m->is.effects.scattering == VNDF_SCATTERING_KULLA_CONTY && prepare_lobe(b, lost);
    for (int i = 0; i < m->is.wavelengths; i++)
        c->gain[i] = has_lobe      ? 1.0f
                     : has_both(b) ? 1.0f / kept
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
    added none = {0.0f, 0.0f};
    int stays = z > 0.0f;
    float part = stays ? c->reflected : 1.0f - c->reflected;
    if (!(c->share > 0.0f) || !(part > 0.0f) || !(z != 0.0f))
        return none;
    float lost = lost_from(b, z), per = stays ? c->per : c->beyond * (float)b->own.carried;
    float cosine = fabsf(z), density = cosine + 0.5f * c->per_log / (cosine + c->near);
    added a = {part * c->lost * (lost > 0.0f ? lost : 0.0f) * per, part * density * (0.5f * INVERSE_PI)};
    return a;
}

static float density_of(const vndf_bsdf *b, float single, const added *a)
{
    return (1.0f - b->own.compensation.share) * single + b->own.compensation.share * a->density;
}

/* On the side that is drawn: half of u[0] draws the cosine even in its square, half even in its logarithm. */
static vndf_vec3 draw_added(const vndf_bsdf *b, const float u[3])
{
    const struct vndf_compensation *c = &b->own.compensation;
    float u1 = vndf_clamp_unit(u[0]), side = u[2] < c->share * c->reflected ? b->own.side : -b->own.side;
    float up = u1 < 0.5f ? sqrtf(2.0f * u1) : c->near * (float)(vndf_exp((2.0 * u1 - 1.0) / c->per_log) - 1.0);
    up = up < 1.0f ? up : 1.0f;
    float across = sqrtf((1.0f - up) * (1.0f + up));
    double cosine, sine;
    vndf_turn_of(vndf_clamp_unit(u[1]), &cosine, &sine);
    return vndf_vec3_of(across * (float)cosine, across * (float)sine, side * up);
}

static int sample_added(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    float f[VNDF_WAVELENGTHS] = {0.0f}, single = 0.0f;
    vndf_vec3 wo = draw_added(b, u);
    float z = b->own.side * wo.z;
    added a = added_towards(b, z);
    vndf_routines_single.eval(b, wo, 0, f, &single);
    float density = density_of(b, single, &a);
    s->wo = wo;
    s->density = density;
    s->lobe = z > 0.0f ? VNDF_LOBE_REFLECTION : VNDF_LOBE_TRANSMISSION;
    s->wm = vndf_vec3_of(0.0f, 0.0f, 0.0f);
    for (int i = 0; i < b->material->is.wavelengths; i++)
        s->weight[i] = vndf_finite((f[i] + b->own.compensation.colour[i] * a.value) * (fabsf(wo.z) / density));
    return density > 0.0f;
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
