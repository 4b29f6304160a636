/* The public calls on a hit. */
#include "bsdf/hit.h"
#include "bsdf/material.h"

static int nothing(vndf_bsdf *b, const vndf_material *material)
{
    static const vndf_affine none;
    return vndf_hit_surface(b, material, &none, vndf_vec3_of(0.0f, 0.0f, 0.0f));
}

int vndf_bsdf_at(vndf_bsdf *b, const vndf_material *material, vndf_vec3 wi)
{
    return material->is.effects.shape == VNDF_SHAPE_MIXTURE
               ? vndf_bsdf_mixture(b, material, NULL, wi)
               : vndf_hit_surface(b, material, &material->surface, wi);
}

int vndf_bsdf_rough(vndf_bsdf *b, const vndf_material *material, const vndf_roughness *roughness, vndf_vec3 wi)
{
    vndf_affine surface;
    if (!roughness)
        return vndf_bsdf_at(b, material, wi);
    if (material->is.effects.shape > VNDF_SHAPE_ROTATED || !vndf_hit_surface_of(material, roughness, &surface))
        return nothing(b, material);
    return vndf_hit_surface(b, material, &surface, wi);
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
    return vndf_hit_surface(b, material, &surface, wi);
}

int vndf_bsdf_mixture(vndf_bsdf *b, const vndf_material *material, const vndf_mixture *mixture, vndf_vec3 wi)
{
    mixture = mixture ? mixture : material->is.mixture;
    if (material->is.effects.shape != VNDF_SHAPE_MIXTURE || !mixture)
        return nothing(b, material);
    return vndf_hit_mixture(b, material, mixture, wi);
}

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
