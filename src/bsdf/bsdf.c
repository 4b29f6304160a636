/* Hits, and the public calls on one. */
#include "bsdf/bsdf.h"

/* ---- hits: 0 if nothing is scattered from there ---- */

static int nothing(vndf_bsdf *b, const vndf_material *material)
{
    b->material = material;
    b->own.view.kind = VNDF_HIT_LEVEL;
    b->own.area = 0.0f;
    return 0;
}

/* A refused material has no routines. */
static int may_scatter(const vndf_material *material, vndf_vec3 wi)
{
    return material->own.routines && vndf_is_near_unit(wi);
}

/* The side of wi and what hangs on it. */
VNDF_INLINE void take_side(vndf_bsdf *b, const vndf_material *material, vndf_vec3 wi, int below)
{
    b->material = material;
    b->own.side = 1.0f;
    b->own.eta = b->own.carried = 1.0;
    if (material->own.two_sided) {
        b->own.side = below ? -1.0f : 1.0f;
        b->own.eta = below ? 1.0 / (double)material->is.eta : (double)material->is.eta;
        b->own.carried =
            material->is.effects.transport == VNDF_TRANSPORT_RADIANCE ? 1.0 / (b->own.eta * b->own.eta) : 1.0;
    }
    b->own.wi = vndf_turned(wi, b->own.side);
}

/* Of a view that is formed; an invalid one has no area. */
VNDF_INLINE int complete(vndf_bsdf *b, const vndf_material *material)
{
    b->own.tilt = 1.0f;
    if (!(b->own.rise > 0.0f) || !(b->own.area > 0.0f))
        return nothing(b, material);
    if (b->own.view.kind != VNDF_HIT_LEVEL) {
        float x = vndf_hit_cosine(&b->own.view, vndf_vec3_of(1.0f, 0.0f, 0.0f));
        float y = vndf_hit_cosine(&b->own.view, vndf_vec3_of(0.0f, 1.0f, 0.0f));
        b->own.tilt = sqrtf(1.0f + (x * x + y * y));
    }
    if (vndf_compensates(&material->is.effects))
        vndf_compensation_prepare(b);
    return 1;
}

static int hit_surface(vndf_bsdf *b, const vndf_material *material, const vndf_affine *surface, vndf_vec3 wi)
{
    if (!may_scatter(material, wi))
        return nothing(b, material);
    b->own.surface = *surface;
    b->own.view.kind = surface->mean_x == 0.0f && surface->mean_y == 0.0f ? VNDF_HIT_LEVEL : VNDF_HIT_TILTED;
    take_side(b, material, wi, wi.z < wi.x * surface->mean_x + wi.y * surface->mean_y);
    int aligned = b->own.view.kind == VNDF_HIT_LEVEL && surface->xy == 0.0f && surface->yx == 0.0f;
    vndf_view_make(&b->own.view.of.one, &b->own.surface, b->own.wi,
                   aligned && surface->xx > 0.0f && surface->yy > 0.0f);
    b->own.rise = vndf_hit_cosine(&b->own.view, b->own.wi);
    b->own.area = vndf_view_own_area(&b->own.view.of.one);
    return complete(b, material);
}

/* The view of a mixture says which side wi is on. */
static int hit_mixture(vndf_bsdf *b, const vndf_material *material, const vndf_mixture *mixture, vndf_vec3 wi)
{
    vndf_mixture_view *view = &b->own.view.of.mixture;
    if (!may_scatter(material, wi))
        return nothing(b, material);
    b->own.view.kind = VNDF_HIT_MIXTURE;
    *view = vndf_mixture_view_from(mixture, wi);
    if (!view->count)
        return nothing(b, material);
    take_side(b, material, wi, vndf_mixture_view_cosine(view, wi) < 0.0f);
    if (b->own.side < 0.0f)
        *view = vndf_mixture_view_from(mixture, b->own.wi);
    b->own.rise = vndf_mixture_view_cosine(view, b->own.wi);
    b->own.area = vndf_mixture_view_area(view, b->own.wi);
    return complete(b, material);
}

int vndf_surface_of(const vndf_material *material, const vndf_roughness *r, vndf_affine *surface)
{
    float c = 1.0f, s = 0.0f;
    if (material->is.effects.shape == VNDF_SHAPE_ROTATED) {
        float off = r->cos_rotation * r->cos_rotation + r->sin_rotation * r->sin_rotation - 1.0f;
        c = r->cos_rotation * (1.0f - 0.5f * off); /* unit, where they are nearly so */
        s = r->sin_rotation * (1.0f - 0.5f * off);
        if (!(fabsf(off) < 1e-3f))
            return 0;
    }
    *surface =
        (vndf_affine){.distribution = material->is.distribution, .xx = c * r->alpha_x, .yx = s * r->alpha_x};
    surface->xy = 0.0f - s * r->alpha_y; /* not -0 */
    surface->yy = c * r->alpha_y;
    return r->alpha_x > 0.0f && r->alpha_y > 0.0f;
}

int vndf_bsdf_at(vndf_bsdf *b, const vndf_material *material, vndf_vec3 wi)
{
    return material->is.effects.shape == VNDF_SHAPE_MIXTURE ? vndf_bsdf_mixture(b, material, NULL, wi)
                                                            : hit_surface(b, material, &material->own.surface, wi);
}

int vndf_bsdf_rough(vndf_bsdf *b, const vndf_material *material, const vndf_roughness *roughness, vndf_vec3 wi)
{
    vndf_affine surface;
    if (!roughness)
        return vndf_bsdf_at(b, material, wi);
    if (material->is.effects.shape > VNDF_SHAPE_ROTATED || !vndf_surface_of(material, roughness, &surface))
        return nothing(b, material);
    return hit_surface(b, material, &surface, wi);
}

int vndf_bsdf_affine(vndf_bsdf *b, const vndf_material *material, const vndf_affine *affine, vndf_vec3 wi)
{
    vndf_shape shape = material->is.effects.shape;
    if (shape != VNDF_SHAPE_MATRIX && shape != VNDF_SHAPE_AFFINE)
        return nothing(b, material);
    if (!affine)
        return vndf_bsdf_at(b, material, wi);
    vndf_affine surface = *affine;
    surface.distribution = material->is.distribution;
    if (shape == VNDF_SHAPE_MATRIX)
        surface.mean_x = surface.mean_y = 0.0f;
    return hit_surface(b, material, &surface, wi);
}

int vndf_bsdf_mixture(vndf_bsdf *b, const vndf_material *material, const vndf_mixture *mixture, vndf_vec3 wi)
{
    mixture = mixture ? mixture : material->is.mixture;
    if (material->is.effects.shape != VNDF_SHAPE_MIXTURE || !mixture)
        return nothing(b, material);
    return hit_mixture(b, material, mixture, wi);
}

/* ---- calls on a hit ---- */

/* Retroreflection: samples, values and densities are those without it, with wo turned by half a turn about z where it
 * is on the side of wi. That turn changes no length and no angle, so all integrals and reciprocity stay. */
static vndf_vec3 turned_about(const vndf_bsdf *b, vndf_vec3 wo)
{
    int turns = b->material->is.effects.reflection == VNDF_REFLECTION_RETRO && wo.z * b->own.side > 0.0f;
    float by = turns ? -1.0f : 1.0f;
    return vndf_vec3_of(by * wo.x, by * wo.y, wo.z);
}

const vndf_scattered vndf_scattered_nothing = {.wo = {0.0f, 0.0f, 1.0f}};

void vndf_bsdf_sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    if (!(b->own.area > 0.0f) || !b->material->own.routines->sample(b, u, s))
        *s = vndf_scattered_nothing;
    if (s->lobe == VNDF_LOBE_REFLECTION)
        s->wo = turned_about(b, s->wo);
}

void vndf_bsdf_look(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    if (b->own.area > 0.0f && vndf_is_near_unit(wo) &&
        b->material->own.routines->eval(b, turned_about(b, wo), seed, value, pdf))
        return;
    for (int i = 0; value && i < b->material->is.wavelengths; i++)
        value[i] = 0.0f;
    if (pdf)
        *pdf = 0.0f;
}

void vndf_bsdf_eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value)
{
    vndf_bsdf_look(b, wo, seed, value, NULL);
}

void vndf_bsdf_eval_pdf(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    vndf_bsdf_look(b, wo, seed, value, pdf);
}

float vndf_bsdf_pdf(const vndf_bsdf *b, vndf_vec3 wo)
{
    float pdf;
    vndf_bsdf_look(b, wo, 0, NULL, &pdf);
    return pdf;
}

float vndf_bsdf_cosine(const vndf_bsdf *b, vndf_vec3 wo)
{
    if (!vndf_is_near_unit(wo))
        return 0.0f;
    return b->own.view.kind == VNDF_HIT_LEVEL ? wo.z : vndf_hit_cosine(&b->own.view, wo) / b->own.tilt;
}
