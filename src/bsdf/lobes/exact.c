/* Samples of surfaces that are smooth or hardly bend light. There the rounding of wo moves its slope by so much of the
 * roughness that the density changes. Density and weight are those of the rounded wo. */
#include "bsdf/lobes/scatter.h"

static int evaluate(const vndf_bsdf *b, const vndf_half *half, double value, vndf_outcome *out)
{
    double facing = half->event.facing_i;
    double density = vndf_bsdf_density(b, half->wm, b->material->is.effects.normals);
    if (!(density > 0.0))
        return 0;
    out->facing = facing;
    out->density = vndf_density_from(density * half->jacobian);
    out->weight = (float)(value * half->event.cos_o * facing * (vndf_bsdf_ndf(b, half->wm) / density));
    out->settled = 0;
    return 1;
}

int vndf_reflect_exactly(const vndf_bsdf *b, const vndf_normal *wo, vndf_outcome *out)
{
    vndf_half half = vndf_half_reflected(b->view.wi, *wo);
    return half.event.facing_i > 0.0 && evaluate(b, &half, b->material->masking->reflection(b, &half.event), out);
}

int vndf_refract_exactly(const vndf_bsdf *b, const vndf_normal *wo, vndf_outcome *out)
{
    vndf_half half = vndf_half_refracted(b->view.wi, *wo, b->eta);
    return vndf_is_refraction(&half) &&
           evaluate(b, &half, b->material->masking->transmission(b, &half.event), out);
}
