#include "bsdf/lobes/turned.h"

#include "bsdf/lobes/scatter.h"
#include "math/vector.h"
#include "sampler/affine/principal.h"

/* By the angle of (c, s), in double: one rounding, of the result. */
VNDF_INLINE vndf_vec3 turned_by(double c, double s, vndf_vec3 w)
{
    return vndf_vec3_of((float)(c * w.x - s * w.y), (float)(c * w.y + s * w.x), w.z);
}

VNDF_INLINE vndf_vec3 to_axes(const vndf_bsdf *b, vndf_vec3 w)
{
    return turned_by(b->cosine, -b->sine, w);
}

VNDF_INLINE vndf_vec3 from_axes(const vndf_bsdf *b, vndf_vec3 w)
{
    return turned_by(b->cosine, b->sine, w);
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
    double c = r->cos_rotation, s = r->sin_rotation, off = c * c + s * s - 1.0, per = 1.0 - 0.5 * off;
    b->cosine = c * per; /* unit, where they are nearly so */
    b->sine = s * per;
    return fabs(off) < 1e-3 && b->material->unturned->prepare(b, r, to_axes(b, wi));
}

/* The normal of a sample in its axes, turned up; a walk has none, and takes the half vector. */
static vndf_bsdf_normal normal_of(const vndf_bsdf *b, const vndf_scattered *s, float u2)
{
    vndf_vec3 wm = vndf_mirrored(s->wm, b->side);
    if (b->material->is.effects.scattering == VNDF_SCATTERING_MULTIPLE)
        wm = vndf_vec3_from(vndf_half_reflected(b->view.wi, vndf_mirrored(s->wo, b->side)).wm);
    vndf_bsdf_normal n = {wm, s->density, vndf_dot(b->view.wi, wm), 0.0f, u2};
    return n;
}

/* Whether the slope of wo is the drawn one (vndf_is_settled), though it is rounded twice more. */
static int is_settled(const vndf_bsdf *b, const vndf_scattered *s, float u2)
{
    /* the density of bounded normals jumps in places that this test does not look for */
    if (b->material->is.effects.normals == VNDF_NORMALS_BOUNDED || s->lobe != VNDF_LOBE_REFLECTION)
        return 0;
    vndf_bsdf_normal n = normal_of(b, s, u2);
    vndf_incident at = vndf_incident_of(b);
    float gain = VNDF_TRUST_ROTATED_GAIN * n.facing;
    return gain > VNDF_TRUST_REFLECTION_FACING && vndf_keeps_reflectance(b, n.facing) &&
           vndf_is_settled(&at, &n, gain);
}

/* Density and weight of the rounded wo, where both density and f are in the range of float. The weight of a walk does
 * not depend on wo. */
static void evaluate(const vndf_bsdf *b, vndf_vec3 wo, vndf_scattered *s)
{
    const vndf_material *m = b->material;
    int walks = m->is.effects.scattering == VNDF_SCATTERING_MULTIPLE;
    float f[VNDF_WAVELENGTHS], density;
    if (walks)
        density = m->unturned->pdf(b, wo);
    else
        m->unturned->eval(b, wo, 0, f, &density);
    if (!(density > 0.0f)) {
        vndf_scatter_nothing(s);
        return;
    }
    s->density = density;
    if (walks || !(density > VNDF_TRUST_DIVISOR && density < VNDF_TRUST_VALUE))
        return;
    for (int i = 0; i < m->is.wavelengths; i++)
        if (f[i] < VNDF_TRUST_VALUE)
            s->weight[i] = vndf_finite(f[i] * fabsf(wo.z) / density);
}

static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    b->material->unturned->sample(b, u, s);
    int drawn = s->lobe == VNDF_LOBE_REFLECTION || s->lobe == VNDF_LOBE_TRANSMISSION;
    int settled = drawn && is_settled(b, s, u[1]);
    s->wo = from_axes(b, s->wo);
    s->wm = from_axes(b, s->wm);
    if (drawn && !settled)
        evaluate(b, to_axes(b, s->wo), s);
}

static void eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    b->material->unturned->eval(b, to_axes(b, wo), seed, value, pdf);
}

static float pdf_of(const vndf_bsdf *b, vndf_vec3 wo)
{
    return b->material->unturned->pdf(b, to_axes(b, wo));
}

const vndf_routines vndf_routines_turned = {prepare, sample, eval, pdf_of, NULL, VNDF_BLOCK_NONE};
