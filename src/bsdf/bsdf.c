/* The public calls on a hit: each calls a routine of the material. */
#include "bsdf/lobes/mixture.h"
#include "bsdf/lobes/turned.h"
#include "bsdf/material.h"
#include "math/vector.h"

/* The side of wi and what hangs on it. */
VNDF_INLINE void take_side(vndf_bsdf *b, const vndf_material *material, int below)
{
    b->material = material;
    b->side = 1.0f;
    b->eta = b->carried = 1.0;
    if (material->two_sided) {
        b->side = below ? -1.0f : 1.0f;
        b->eta = below ? 1.0 / material->is.eta : material->is.eta;
        b->carried = material->is.effects.transport == VNDF_TRANSPORT_RADIANCE ? 1.0 / (b->eta * b->eta) : 1.0;
    }
}

static int nothing(vndf_bsdf *b, const vndf_material *material)
{
    b->material = &vndf_materials_of_nothing[material->is.wavelengths];
    return 0;
}

int vndf_bsdf_hit(vndf_bsdf *b, const vndf_material *material, const vndf_roughness *r, vndf_vec3 wi)
{
    take_side(b, material, wi.z < 0.0f);
    if (material->two_sided)
        wi.z = fabsf(wi.z);
    if (vndf_is_near_unit(wi) && wi.z > 0.0f && material->routines->prepare(b, r, wi))
        return 1;
    return nothing(b, material);
}

/* The mean plane says which side wi is on, and the view where that is. */
static int hit_mixture(vndf_bsdf *b, const vndf_material *material, const vndf_mixture *mixture, vndf_vec3 wi)
{
    vndf_vec3 turned = {-wi.x, -wi.y, -wi.z};
    if (!vndf_is_near_unit(wi) || !vndf_mixture_see(b, mixture, wi))
        return nothing(b, material);
    take_side(b, material, vndf_mixture_rise(b, wi) < 0.0);
    if (b->side < 0.0f && !vndf_mixture_see(b, mixture, turned))
        return nothing(b, material);
    return vndf_mixture_rise(b, b->view.wi) > 0.0 ? 1 : nothing(b, material);
}

int vndf_bsdf_mixture(vndf_bsdf *b, const vndf_material *material, const vndf_mixture *mixture, vndf_vec3 wi)
{
    mixture = mixture ? mixture : material->is.mixture;
    if (material->is.effects.shape != VNDF_SHAPE_MIXTURE || !mixture)
        return nothing(b, material);
    return hit_mixture(b, material, mixture, wi);
}

int vndf_bsdf_affine(vndf_bsdf *b, const vndf_material *material, const vndf_affine *affine, vndf_vec3 wi)
{
    vndf_mixture one;
    vndf_roughness roughness;
    affine = affine ? affine : &material->is.affine;
    switch (material->is.effects.shape) {
    case VNDF_SHAPE_ALIGNED:
    case VNDF_SHAPE_ROTATED:
    case VNDF_SHAPE_MIXTURE: return nothing(b, material);
    case VNDF_SHAPE_MATRIX:
        return vndf_turned_roughness(material->is.distribution, affine, &roughness)
                   ? vndf_bsdf_hit(b, material, &roughness, wi)
                   : nothing(b, material);
    case VNDF_SHAPE_AFFINE: break;
    }
    one.count = 1;
    one.lobe[0] = (vndf_mixture_lobe){*affine, 1.0f};
    one.lobe[0].surface.distribution = material->is.distribution;
    return hit_mixture(b, material, &one, wi);
}

int vndf_bsdf_at(vndf_bsdf *b, const vndf_material *material, vndf_vec3 wi)
{
    switch (material->is.effects.shape) {
    case VNDF_SHAPE_ALIGNED:
    case VNDF_SHAPE_ROTATED:
    case VNDF_SHAPE_MATRIX: break;
    case VNDF_SHAPE_AFFINE: return vndf_bsdf_affine(b, material, NULL, wi);
    case VNDF_SHAPE_MIXTURE: return vndf_bsdf_mixture(b, material, NULL, wi);
    }
    return vndf_bsdf_hit(b, material, &material->roughness, wi);
}

int vndf_bsdf_rough(vndf_bsdf *b, const vndf_material *material, const vndf_roughness *roughness, vndf_vec3 wi)
{
    if (!roughness)
        return vndf_bsdf_at(b, material, wi);
    return material->is.effects.shape <= VNDF_SHAPE_ROTATED ? vndf_bsdf_hit(b, material, roughness, wi)
                                                            : nothing(b, material);
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
    return b->material->routines->pdf(b, wo);
}

float vndf_bsdf_cosine(const vndf_bsdf *b, vndf_vec3 wo)
{
    if (!vndf_is_near_unit(wo))
        return 0.0f;
    return b->material->is.effects.shape < VNDF_SHAPE_AFFINE ? wo.z : (float)vndf_mixture_cosine(b, wo);
}
