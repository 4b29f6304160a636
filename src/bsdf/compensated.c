/* Both ways of compensation wrap the routines of single scattering. vndf_bsdf.h has the formulas.
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

/* Sets the roughness to look up, the root of a determinant, which for two is sqrt(alpha_x alpha_y), and Turquin's
 * gain; returns 1 - E(wi). */
static float look_up(vndf_bsdf *b)
{
    const vndf_affine *s = &b->own.surface;
    b->own.compensation.alpha = (float)sqrt(fabs((double)s->xx * s->yy - (double)s->xy * s->yx));
    float lost = lost_from(b, b->own.rise), kept = lost < 0.999f ? 1.0f - lost : 1e-3f;
    b->own.compensation.gain = has_both(b) ? 1.0f / kept : (1.0f - kept) / kept;
    return lost;
}

/* ---- Turquin ---- */

static void prepare_turquin(vndf_bsdf *b)
{
    look_up(b);
}

static void scale(const vndf_bsdf *b, float *value)
{
    for (int i = 0; i < b->material->is.wavelengths; i++)
        value[i] = vndf_finite(value[i] *
                               (has_both(b) ? b->own.compensation.gain
                                            : 1.0f + b->material->own.reflectance0[i] * b->own.compensation.gain));
}

static void sample_turquin(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    b->material->own.single->sample(b, u, s);
    scale(b, s->weight);
}

static void eval_turquin(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    b->material->own.single->eval(b, wo, seed, value, pdf);
    if (value)
        scale(b, value);
}

const vndf_routines vndf_routines_turquin = {prepare_turquin, sample_turquin, eval_turquin, NULL};

/* ---- Kulla & Conty ---- */

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

static void prepare_kulla_conty(vndf_bsdf *b)
{
    struct vndf_compensation *c = &b->own.compensation;
    float lost = look_up(b), lost_average = average_lost(b, b->own.side);
    c->lost = lost > 0.0f ? lost : 0.0f;
    c->per = per_of(lost_average);
    if (has_both(b))
        part_lobes(b, lost_average);
    else
        colour_reflection(b, lost_average);
    if (!(c->per > 0.0f))
        c->share = c->lost = 0.0f;
    c->near = 0.01f * c->alpha + 1e-4f;
    c->per_log = (float)(1.0 / vndf_log(1.0 + 1.0 / c->near));
}

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

static void sample_added(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    float f[VNDF_WAVELENGTHS], single;
    vndf_vec3 wo = draw_added(b, u);
    float z = b->own.side * wo.z;
    added a = added_towards(b, z);
    vndf_scatter_nothing(s);
    b->material->own.single->eval(b, wo, 0, f, &single);
    float density = density_of(b, single, &a);
    if (!(density > 0.0f))
        return;
    s->wo = wo;
    s->density = density;
    s->lobe = z > 0.0f ? VNDF_LOBE_REFLECTION : VNDF_LOBE_TRANSMISSION;
    for (int i = 0; i < b->material->is.wavelengths; i++)
        s->weight[i] = vndf_finite((f[i] + b->own.compensation.colour[i] * a.value) * (fabsf(wo.z) / density));
}

static void sample_kulla_conty(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    float share = b->own.compensation.share;
    if (u[2] < share) {
        sample_added(b, u, s);
        return;
    }
    const float rest[3] = {u[0], u[1], share > 0.0f ? (u[2] - share) / (1.0f - share) : u[2]};
    b->material->own.single->sample(b, rest, s);
    if (!(b->own.compensation.per > 0.0f)) /* no lobe: single scattering is scaled */
        scale(b, s->weight);
    if (s->lobe == VNDF_LOBE_NONE || !(share > 0.0f))
        return;
    added a = added_towards(b, b->own.side * s->wo.z);
    float single = s->density, density = density_of(b, single, &a), cosine = fabsf(s->wo.z);
    s->density = vndf_finite(vndf_positive(density));
    for (int i = 0; i < b->material->is.wavelengths; i++)
        s->weight[i] = vndf_finite(s->weight[i] * (single / density) +
                                   b->own.compensation.colour[i] * a.value * (cosine / density));
}

static void eval_kulla_conty(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    added a = added_towards(b, vndf_is_near_unit(wo) ? b->own.side * wo.z : 0.0f);
    b->material->own.single->eval(b, wo, seed, value, pdf);
    if (value && !(b->own.compensation.per > 0.0f))
        scale(b, value);
    for (int i = 0; value && i < b->material->is.wavelengths; i++)
        value[i] = vndf_finite(value[i] + b->own.compensation.colour[i] * a.value);
    if (pdf)
        *pdf = vndf_finite(density_of(b, *pdf, &a));
}

const vndf_routines vndf_routines_kulla_conty = {prepare_kulla_conty, sample_kulla_conty, eval_kulla_conty, NULL};
