/* The public calls on a hit: each calls a routine of the material. */
#include "bsdf/material.h"
#include "math/vector.h"

int vndf_bsdf_hit(vndf_bsdf *b, const vndf_material *material, const vndf_roughness *r, vndf_vec3 wi)
{
    b->material = material;
    b->side = 1.0f;
    b->eta = b->carried = 1.0;
    if (material->two_sided) {
        b->side = wi.z < 0.0f ? -1.0f : 1.0f;
        b->eta = wi.z < 0.0f ? 1.0 / material->is.eta : material->is.eta;
        b->carried = material->is.effects.transport == VNDF_TRANSPORT_RADIANCE ? 1.0 / (b->eta * b->eta) : 1.0;
        wi.z = fabsf(wi.z);
    }
    if (vndf_is_near_unit(wi) && wi.z > 0.0f && material->routines->prepare(b, r, wi))
        return 1;
    b->material = &vndf_material_of_nothing;
    return 0;
}

int vndf_bsdf_at(vndf_bsdf *b, const vndf_material *material, vndf_vec3 wi)
{
    return vndf_bsdf_hit(b, material, &material->roughness, wi);
}

int vndf_bsdf_rough(vndf_bsdf *b, const vndf_material *material, const vndf_roughness *roughness, vndf_vec3 wi)
{
    return vndf_bsdf_hit(b, material, roughness ? roughness : &material->roughness, wi);
}

void vndf_bsdf_sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    b->material->routines->sample(b, u, s);
}

void vndf_bsdf_eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float value[VNDF_WAVELENGTHS])
{
    b->material->routines->eval(b, wo, seed, value);
}

float vndf_bsdf_pdf(const vndf_bsdf *b, vndf_vec3 wo)
{
    return b->material->routines->pdf(b, wo);
}
