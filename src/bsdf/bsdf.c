/* Hits, and the public calls on one. */
#include "bsdf/bsdf.h"

/* ---- hits: 0 if nothing is scattered from there ---- */

static int nothing(vndf_bsdf *b, const vndf_material *material)
{
    b->material = &vndf_materials_of_nothing[material->is.wavelengths];
    b->view.kind = VNDF_HIT_LEVEL;
    return 0;
}

/* The side of wi and what hangs on it. */
VNDF_INLINE void take_side(vndf_bsdf *b, const vndf_material *material, vndf_vec3 wi, int below)
{
    b->material = material;
    b->side = 1.0f;
    b->eta = b->carried = 1.0;
    if (material->two_sided) {
        b->side = below ? -1.0f : 1.0f;
        b->eta = below ? 1.0 / (double)material->is.eta : (double)material->is.eta;
        b->carried = material->is.effects.transport == VNDF_TRANSPORT_RADIANCE ? 1.0 / (b->eta * b->eta) : 1.0;
    }
    b->wi = vndf_turned(wi, b->side);
}

/* Of a view that is formed; an invalid one has no area. */
VNDF_INLINE int complete(vndf_bsdf *b, const vndf_material *material)
{
    b->tilt = 1.0f;
    if (!(b->rise > 0.0f) || !(b->area > 0.0f))
        return nothing(b, material);
    if (b->view.kind != VNDF_HIT_LEVEL) {
        float x = vndf_hit_cosine(&b->view, vndf_vec3_of(1.0f, 0.0f, 0.0f));
        float y = vndf_hit_cosine(&b->view, vndf_vec3_of(0.0f, 1.0f, 0.0f));
        b->tilt = sqrtf(1.0f + (x * x + y * y));
    }
    if (material->specular->prepare)
        material->specular->prepare(b);
    return 1;
}

static int hit_surface(vndf_bsdf *b, const vndf_material *material, const vndf_affine *surface, vndf_vec3 wi)
{
    if (!vndf_is_near_unit(wi))
        return nothing(b, material);
    b->surface = *surface;
    b->view.kind = surface->mean_x == 0.0f && surface->mean_y == 0.0f ? VNDF_HIT_LEVEL : VNDF_HIT_TILTED;
    take_side(b, material, wi, wi.z < wi.x * surface->mean_x + wi.y * surface->mean_y);
    int aligned = b->view.kind == VNDF_HIT_LEVEL && surface->xy == 0.0f && surface->yx == 0.0f;
    vndf_view_make(&b->view.of.one, &b->surface, b->wi, aligned && surface->xx > 0.0f && surface->yy > 0.0f);
    b->rise = vndf_hit_cosine(&b->view, b->wi);
    b->area = vndf_view_own_area(&b->view.of.one);
    return complete(b, material);
}

/* The view of a mixture says which side wi is on. */
static int hit_mixture(vndf_bsdf *b, const vndf_material *material, const vndf_mixture *mixture, vndf_vec3 wi)
{
    vndf_mixture_view *view = &b->view.of.mixture;
    if (!vndf_is_near_unit(wi))
        return nothing(b, material);
    b->view.kind = VNDF_HIT_MIXTURE;
    *view = vndf_mixture_view_from(mixture, wi);
    if (!view->count)
        return nothing(b, material);
    take_side(b, material, wi, vndf_mixture_view_cosine(view, wi) < 0.0f);
    if (b->side < 0.0f)
        *view = vndf_mixture_view_from(mixture, b->wi);
    b->rise = vndf_mixture_view_cosine(view, b->wi);
    b->area = vndf_mixture_view_area(view, b->wi);
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
                                                            : hit_surface(b, material, &material->surface, wi);
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

void vndf_bsdf_sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    b->material->routines->sample(b, u, s);
}

void vndf_bsdf_eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value)
{
    b->material->routines->eval(b, wo, seed, value, NULL);
}

void vndf_bsdf_eval_pdf(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    b->material->routines->eval(b, wo, seed, value, pdf);
}

float vndf_bsdf_pdf(const vndf_bsdf *b, vndf_vec3 wo)
{
    float pdf;
    b->material->routines->eval(b, wo, 0, NULL, &pdf);
    return pdf;
}

float vndf_bsdf_cosine(const vndf_bsdf *b, vndf_vec3 wo)
{
    if (!vndf_is_near_unit(wo))
        return 0.0f;
    return b->view.kind == VNDF_HIT_LEVEL ? wo.z : vndf_hit_cosine(&b->view, wo) / b->tilt;
}
