/* Rough materials: the routines of the library, with the given sampler of normals and the roughness of the
 * material or of a map; those with lobes (lobes.c); or perfect sampling (perfect.h), prepared once for all
 * materials with the same BSDF. */
#include "render/path/parts.h"

#include <stdio.h>
#include <stdlib.h>

#include "cli/clock.h"

/* ---- a hit ---- */

static int rough_begin(path_point *p)
{
    return vndf_bsdf_at(&p->bsdf, &p->material->bsdf, p->wi);
}

float path_textured(const textured *t, const hit *h)
{
    float rgb[3];
    if (!t->map)
        return t->value;
    image_bilinear(t->map, h->u, h->v, rgb);
    return t->value * rgb[0];
}

static int textured_begin(path_point *p)
{
    vndf_roughness roughness = p->material->roughness;
    roughness.alpha_x = path_textured(&p->material->is->alpha_x, p->hit);
    roughness.alpha_y = path_textured(&p->material->is->alpha_y, p->hit);
    return vndf_bsdf_rough(&p->bsdf, &p->material->bsdf, &roughness, p->wi);
}

static float carried(const path_point *p)
{
    float eta = p->wi.z > 0.0f ? p->material->is->is.eta : 1.0f / p->material->is->is.eta;
    return 1.0f / (eta * eta);
}

/* Turns a sample of the library into a bounce; 0: nothing was scattered. */
static int bounce_of(const path_point *p, const vndf_scattered *s, bounce *b)
{
    if (s->lobe == VNDF_LOBE_NONE)
        return 0;
    b->wo = s->wo;
    b->density = s->lobe == VNDF_LOBE_STRAIGHT ? 0.0f : s->density;
    b->carried = s->lobe == VNDF_LOBE_TRANSMISSION ? carried(p) : 1.0f;
    for (int i = 0; i < 3; i++)
        b->weight[i] = s->weight[i] * p->colour[i];
    return 1;
}

int path_rough_sample(const path_point *p, const float u[3], bounce *b)
{
    vndf_scattered s;
    vndf_bsdf_sample(&p->bsdf, u, &s);
    return bounce_of(p, &s, b);
}

float path_rough_eval(const path_point *p, vndf_vec3 wo, uint64_t seed, float value[3])
{
    vndf_bsdf_eval(&p->bsdf, wo, seed, value);
    for (int i = 0; i < 3; i++)
        value[i] *= p->colour[i];
    return wo.z;
}

static float rough_pdf(const path_point *p, vndf_vec3 wo)
{
    return vndf_bsdf_pdf(&p->bsdf, wo);
}

/* ---- a hit, perfectly sampled ---- */

static int perfect_begin(path_point *p)
{
    return path_perfect_begin(&p->perfect, p->material->perfect, &p->material->roughness, p->wi);
}

static int perfect_sample(const path_point *p, const float u[3], bounce *b)
{
    vndf_scattered s;
    path_perfect_sample(&p->perfect, u, &s);
    return bounce_of(p, &s, b);
}

static float perfect_eval(const path_point *p, vndf_vec3 wo, uint64_t seed, float value[3])
{
    (void)seed;
    path_perfect_eval(&p->perfect, wo, value);
    for (int i = 0; i < 3; i++)
        value[i] *= p->colour[i];
    return wo.z;
}

static float perfect_pdf(const path_point *p, vndf_vec3 wo)
{
    return path_perfect_pdf(&p->perfect, wo);
}

/* ---- samplers, shared ---- */

/* The perfect sampler of this BSDF; makes it if there is none yet. */
static const path_perfect *share_perfect(path_perfects *all, const vndf_description *is, vndf_error *error)
{
    double start = clock_seconds();
    for (size_t i = 0; i < all->count; i++)
        if (path_perfect_is_of(all->list[i], is))
            return all->list[i];
    path_perfect **list = realloc(all->list, (all->count + 1) * sizeof *list);
    if (!list) {
        *error = (vndf_error){VNDF_ERROR_MEMORY, "no memory for perfect sampling"};
        return NULL;
    }
    all->list = list;
    path_perfect *made = path_perfect_make(is, error);
    if (made)
        list[all->count++] = made;
    all->seconds += clock_seconds() - start;
    return made;
}

void path_perfects_free(path_perfects *all)
{
    for (size_t i = 0; i < all->count; i++)
        path_perfect_free(all->list[i]);
    free(all->list);
}

/* ---- preparing ---- */

static int refuse(const path_material *m, const char *why, char *message, size_t size)
{
    char said[512];
    scene_wording(why, said, sizeof said);
    snprintf(message, size, "material '%s': %s", m->is->name ? m->is->name : "", said);
    return 0;
}

static void choose_normals(vndf_effects *e, path_sampler sampler)
{
    if (sampler == SAMPLER_ALL)
        e->normals = VNDF_NORMALS_ALL;
    if (sampler == SAMPLER_VISIBLE || sampler == SAMPLER_PERFECT)
        e->normals = VNDF_NORMALS_VISIBLE;
    if (sampler == SAMPLER_BOUNDED)
        e->normals = VNDF_NORMALS_BOUNDED;
}

static vndf_description describe(path_material *m, const path_choice *choice)
{
    vndf_description is = m->is->is;
    choose_normals(&is.effects, choice->sampler);
    if (choice->without & (path_material_effects(m->is) & (EFFECT_MULTIPLE | EFFECT_COMPENSATION)))
        is.effects.scattering = VNDF_SCATTERING_SINGLE;
    if (choice->without & EFFECT_ROTATED_AXES)
        is.effects.shape = VNDF_SHAPE_ALIGNED;
    if (choice->without & EFFECT_RETROREFLECTION)
        is.effects.reflection = VNDF_REFLECTION_SPECULAR;
    if (m->is->lobe_count)
        path_lobes_describe(m, choice->without, &is);
    return is;
}

static int make_perfect(path_material *m, const vndf_description *is, path_perfects *all, char *message,
                        size_t size)
{
    vndf_error error = {VNDF_OK, ""};
    const char *why = path_perfect_refuses(is);
    if (m->run.begin == textured_begin)
        why = "perfect sampling is precomputed for one roughness, this one has a map";
    if (why)
        return refuse(m, why, message, size);
    m->perfect = share_perfect(all, is, &error);
    if (!m->perfect)
        return refuse(m, error.message, message, size);
    m->run = (path_routines){perfect_begin, NULL, perfect_sample, perfect_eval, perfect_pdf};
    return 1;
}

int path_rough_make(path_material *m, const path_choice *choice, char *message, size_t size)
{
    vndf_description is = describe(m, choice);
    vndf_error error = {VNDF_OK, ""};
    int maps = m->is->is_textured && !(choice->without & EFFECT_TEXTURED_ALPHA);
    float angle = is.effects.shape == VNDF_SHAPE_ROTATED ? is.rotation : 0.0f;
    if (vndf_material_resolve(&is, &m->bsdf, &error) != VNDF_OK)
        return refuse(m, error.message, message, size);
    m->roughness = (vndf_roughness){is.alpha_x, is.alpha_y, cosf(angle), sinf(angle)};
    m->run =
        (path_routines){maps ? textured_begin : rough_begin, NULL, path_rough_sample, path_rough_eval, rough_pdf};
    if (m->lobe_count)
        path_lobes_make(m);
    return choice->sampler != SAMPLER_PERFECT || make_perfect(m, &is, choice->perfects, message, size);
}
