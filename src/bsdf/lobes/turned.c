#include "bsdf/lobes/turned.h"

#include "bsdf/lobes/scatter.h"
#include "math/vector.h"
#include "sampler/affine/principal.h"

static vndf_vec3 to_axes(const vndf_bsdf *b, vndf_vec3 w)
{
    float c = b->cos_rotation, s = b->sin_rotation;
    return vndf_vec3_of(c * w.x + s * w.y, c * w.y - s * w.x, w.z);
}

static vndf_vec3 from_axes(const vndf_bsdf *b, vndf_vec3 w)
{
    float c = b->cos_rotation, s = b->sin_rotation;
    return vndf_vec3_of(c * w.x - s * w.y, c * w.y + s * w.x, w.z);
}

int vndf_turned_roughness(const vndf_distribution *d, const vndf_affine *affine, vndf_roughness *r)
{
    const vndf_slope_map centred = {affine->xx, affine->xy, affine->yx, affine->yy, 0.0, 0.0};
    vndf_principal p = vndf_principal_of(&centred);
    const vndf_surface surface = {d, p.ax, p.ay};
    double ax, ay;
    if (!vndf_surface_scaled(&surface, &ax, &ay))
        return 0;
    r->alpha_x = p.ax;
    r->alpha_y = p.ay;
    r->cos_rotation = (float)p.cosine;
    r->sin_rotation = (float)p.sine;
    return 1;
}

static int prepare(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    b->cos_rotation = r->cos_rotation;
    b->sin_rotation = r->sin_rotation;
    return b->material->unturned->prepare(b, r, to_axes(b, wi));
}

/* Whether the slope of wo is the drawn one (vndf_is_settled), though two turns have rounded wo three times more. */
static int is_settled(const vndf_bsdf *b, const vndf_scattered *s, vndf_vec3 wo)
{
    vndf_half half = vndf_half_reflected(b->view.wi, vndf_mirrored(wo, b->side));
    /* the density of bounded normals jumps in places that this test does not look for */
    return b->material->is.effects.normals != VNDF_NORMALS_BOUNDED && s->lobe == VNDF_LOBE_REFLECTION &&
           vndf_keeps_reflectance(b, half.event.facing_i) &&
           vndf_is_settled(b, (float)half.wm.x, (float)half.wm.y,
                           VNDF_TRUST_ROTATED_GAIN * (float)half.event.facing_i);
}

/* Density and weight of the rounded wo, where both density and f are in the range of float. The weight of a walk does
 * not depend on wo. */
static void evaluate(const vndf_bsdf *b, vndf_vec3 wo, vndf_scattered *s)
{
    const vndf_material *m = b->material;
    float f[VNDF_WAVELENGTHS], density = m->unturned->pdf(b, wo);
    if (!(density > 0.0f)) {
        vndf_scatter_nothing(s);
        return;
    }
    s->density = density;
    if (m->is.effects.scattering == VNDF_SCATTERING_MULTIPLE ||
        !(density > VNDF_TRUST_DIVISOR && density < VNDF_TRUST_VALUE))
        return;
    m->unturned->eval(b, wo, 0, f, NULL);
    for (int i = 0; i < m->is.wavelengths; i++)
        if (f[i] < VNDF_TRUST_VALUE)
            s->weight[i] = vndf_finite(f[i] * fabsf(wo.z) / density);
}

static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    b->material->unturned->sample(b, u, s);
    s->wo = from_axes(b, s->wo);
    s->wm = from_axes(b, s->wm);
    vndf_vec3 wo = to_axes(b, s->wo);
    if ((s->lobe == VNDF_LOBE_REFLECTION || s->lobe == VNDF_LOBE_TRANSMISSION) && !is_settled(b, s, wo))
        evaluate(b, wo, s);
}

static void eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    b->material->unturned->eval(b, to_axes(b, wo), seed, value, pdf);
}

static float pdf_of(const vndf_bsdf *b, vndf_vec3 wo)
{
    return b->material->unturned->pdf(b, to_axes(b, wo));
}

const vndf_routines vndf_routines_turned = {prepare, sample, eval, pdf_of, NULL};
