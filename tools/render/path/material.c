/* A material as routines for its kind. Lambert's and smooth materials are here, rough ones in rough.c. To time the
 * same scene without microfacets, rough dielectrics become glass, and all other rough materials become mirrors of
 * their reflectance at normal incidence.
 *
 * Frames: a ray may come from the front of the shading normal and the back of the geometric one, or the other way
 * round; the geometric frame is taken then. path.c drops directions about whose side the two normals disagree,
 * drawn from lights or from materials alike. */
#include "render/path/parts.h"

static const float pi = 3.14159265f;

/* ---- matte ---- */

static int matte_begin(path_point *p)
{
    return p->wi.z > 0.0f;
}

static int matte_sample(const path_point *p, const float u[3], bounce *b)
{
    float radius = sqrtf(u[0]), turn = 2.0f * pi * u[1];
    b->wo = vec(radius * cosf(turn), radius * sinf(turn), sqrtf(1.0f - u[0]));
    b->density = b->wo.z / pi;
    b->carried = 1.0f;
    for (int i = 0; i < 3; i++)
        b->weight[i] = p->colour[i];
    return b->wo.z > 0.0f;
}

static float matte_eval(const path_point *p, vndf_vec3 wo, uint64_t seed, float value[3])
{
    (void)seed;
    for (int i = 0; i < 3; i++)
        value[i] = wo.z > 0.0f ? p->colour[i] / pi : 0.0f;
    return wo.z;
}

static float matte_pdf(const path_point *p, vndf_vec3 wo)
{
    (void)p;
    return fmaxf(wo.z, 0.0f) / pi;
}

/* ---- smooth ---- */

static int mirror_sample(const path_point *p, const float u[3], bounce *b)
{
    (void)u;
    b->wo = vec(-p->wi.x, -p->wi.y, p->wi.z);
    b->density = 0.0f;
    b->carried = 1.0f;
    for (int i = 0; i < 3; i++)
        b->weight[i] = p->colour[i];
    return 1;
}

static int glass_begin(path_point *p)
{
    return p->wi.z != 0.0f;
}

static void refract(const path_point *p, float eta, bounce *b)
{
    float cosine = sqrtf(fmaxf(1.0f - (1.0f - p->wi.z * p->wi.z) / (eta * eta), 0.0f));
    b->wo = unit(vec(-p->wi.x / eta, -p->wi.y / eta, -copysignf(cosine, p->wi.z)));
    b->carried = 1.0f / (eta * eta);
}

/* Reflects with the probability F; refraction multiplies radiance by 1/eta^2. */
static int glass_sample(const path_point *p, const float u[3], bounce *b)
{
    float eta = p->wi.z > 0.0f ? p->material->eta : 1.0f / p->material->eta;
    mirror_sample(p, u, b);
    if (!(u[2] < vndf_fresnel_dielectric(fabsf(p->wi.z), eta)))
        refract(p, eta, b);
    for (int i = 0; i < 3; i++)
        b->weight[i] = b->carried * p->colour[i];
    return 1;
}

/* ---- colours of maps ---- */

static int mapped_begin(path_point *p)
{
    const path_material *m = p->material;
    image_bilinear(m->is->colour_map, p->hit->u, p->hit->v, p->mapped);
    for (int i = 0; i < 3; i++)
        p->mapped[i] *= m->colour[i];
    p->colour = p->mapped;
    return m->run.begin_plain(p);
}

/* ---- what a material calls for ---- */

static int transmits(const material *is)
{
    return is->kind == MATERIAL_GLASS ||
           (is->kind == MATERIAL_MICROFACET && is->is.effects.lobes != VNDF_LOBES_REFLECTION);
}

static int has_absorption(const material *is)
{
    return transmits(is) && (is->absorb[0] > 0.0f || is->absorb[1] > 0.0f || is->absorb[2] > 0.0f);
}

unsigned path_material_effects(const material *is)
{
    unsigned effects = (transmits(is) ? EFFECT_REFRACTION : 0u) | (has_absorption(is) ? EFFECT_ABSORPTION : 0u) |
                       (is->colour_map && is->kind != MATERIAL_LIGHT ? EFFECT_COLOUR_MAPS : 0u);
    if (is->kind == MATERIAL_MATTE)
        effects |= EFFECT_MATTE;
    if (is->kind == MATERIAL_MIRROR || is->kind == MATERIAL_GLASS)
        effects |= EFFECT_SPECULAR;
    if (is->kind == MATERIAL_MICROFACET)
        effects |= EFFECT_MICROFACETS | (is->is_textured ? EFFECT_TEXTURED_ALPHA : 0u) |
                   (is->is.effects.scattering == VNDF_SCATTERING_MULTIPLE ? EFFECT_MULTIPLE : 0u) |
                   (is->is.effects.scattering > VNDF_SCATTERING_MULTIPLE ? EFFECT_COMPENSATION : 0u) |
                   (is->is.effects.shape == VNDF_SHAPE_ROTATED ? EFFECT_ROTATED_AXES : 0u) |
                   (is->is.effects.reflection == VNDF_REFLECTION_RETRO ? EFFECT_RETROREFLECTION : 0u) |
                   path_lobes_effects(is);
    return effects;
}

/* ---- preparing ---- */

static void make_matte(path_material *m)
{
    m->run.begin = matte_begin;
    m->run.sample = matte_sample;
    m->run.eval = matte_eval;
    m->run.pdf = matte_pdf;
}

static void make_mirror(path_material *m)
{
    m->run.begin = matte_begin;
    m->run.sample = mirror_sample;
}

static void make_glass(path_material *m)
{
    m->run.begin = glass_begin;
    m->run.sample = glass_sample;
    m->eta = m->is->is.eta;
}

/* At normal incidence. */
static float reflectance(const vndf_description *is, int i)
{
    switch (is->effects.fresnel) {
    case VNDF_FRESNEL_SCHLICK: return is->f0[i];
    case VNDF_FRESNEL_DIELECTRIC: return vndf_fresnel_dielectric(1.0f, is->eta);
    case VNDF_FRESNEL_CONDUCTOR: return vndf_fresnel_conductor(1.0f, is->conductor_eta[i], is->conductor_k[i]);
    case VNDF_FRESNEL_NONE: break;
    }
    return 1.0f;
}

static void make_smooth(path_material *m)
{
    if (transmits(m->is)) {
        make_glass(m);
        return;
    }
    make_mirror(m);
    for (int i = 0; i < 3; i++)
        m->colour[i] *= reflectance(&m->is->is, i);
}

static int make_kind(path_material *m, const path_choice *choice, char *message, size_t size)
{
    int smooth = (choice->without & EFFECT_MICROFACETS) != 0;
    switch (m->is->kind) {
    case MATERIAL_MICROFACET:
        if (!smooth)
            return path_rough_make(m, choice, message, size);
        make_smooth(m);
        break;
    case MATERIAL_MATTE: make_matte(m); break;
    case MATERIAL_MIRROR: make_mirror(m); break;
    case MATERIAL_GLASS: make_glass(m); break;
    case MATERIAL_LIGHT: m->emits = 1; break;
    }
    return 1;
}

int path_material_prepare(path_material *made, const material *is, const path_choice *choice, char *message,
                          size_t size)
{
    *made = (path_material){.is = is, .absorbs = has_absorption(is)};
    for (int i = 0; i < 3; i++) /* glass has none */
        made->colour[i] = is->kind == MATERIAL_GLASS ? 1.0f : is->colour[i];
    if (!make_kind(made, choice, message, size))
        return 0;
    made->run.begin_plain = made->run.begin;
    if (is->colour_map && made->run.begin && is->kind != MATERIAL_GLASS && !(choice->without & EFFECT_COLOUR_MAPS))
        made->run.begin = mapped_begin;
    return 1;
}
