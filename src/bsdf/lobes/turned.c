#include "bsdf/lobes/turned.h"

#include "bsdf/lobes/scatter.h"
#include "math/vector.h"
#include "sampler/affine/principal.h"

static const vndf_choice turned = {VNDF_NORMALS_VISIBLE, 0, 1};

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

int vndf_axes_of(const vndf_roughness *r, struct vndf_axes *axes)
{
    double c = r->cos_rotation, s = r->sin_rotation, off = c * c + s * s - 1.0, per = 1.0 - 0.5 * off;
    axes->cosine = c * per; /* unit, where they are nearly so */
    axes->sine = s * per;
    axes->near_cosine = (float)axes->cosine;
    axes->near_sine = (float)axes->sine;
    return fabs(off) < 1e-3;
}

int vndf_prepare_turned_visible(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    return vndf_turn_hit(b, r, &wi) && vndf_prepare_visible(b, r, wi);
}

int vndf_prepare_turned_bounded(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    return vndf_turn_hit(b, r, &wi) && vndf_prepare_bounded(b, r, wi);
}

int vndf_prepare_turned_all(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    return vndf_turn_hit(b, r, &wi) && vndf_prepare_all(b, r, wi);
}

/* ---- walks ---- */

static vndf_vec3 rounded_to_axes(const vndf_bsdf *b, vndf_vec3 w)
{
    return vndf_vec3_from(vndf_to_axes(b, w, turned));
}

/* Whether the slope of wo is the drawn one (vndf_is_settled), though it is rounded twice more. A walk has no normal,
 * and takes the half vector. */
static int is_settled(const vndf_bsdf *b, const vndf_scattered *s, float u2)
{
    if (s->lobe != VNDF_LOBE_REFLECTION)
        return 0;
    vndf_normal wo = vndf_normal_of(vndf_mirrored(s->wo, b->side));
    vndf_vec3 wm = vndf_vec3_from(vndf_half_reflected(b->view.wi, wo).wm);
    vndf_bsdf_normal n = {wm, s->density, vndf_dot(b->view.wi, wm), 0.0f, u2};
    vndf_incident at = vndf_incident_of(b);
    float gain = VNDF_TRUST_WALK_GAIN * n.facing;
    return gain > VNDF_TRUST_REFLECTION_FACING && vndf_keeps_reflectance(b, n.facing) &&
           vndf_is_settled(&at, &n, gain);
}

/* The density is that of the rounded wo; the weight of a walk does not depend on it. */
static void sample(const vndf_bsdf *b, const float u[3], vndf_scattered *s)
{
    b->material->unturned->sample(b, u, s);
    int drawn = s->lobe == VNDF_LOBE_REFLECTION || s->lobe == VNDF_LOBE_TRANSMISSION;
    int settled = drawn && is_settled(b, s, u[1]);
    s->wo = vndf_from_axes(b, vndf_normal_of(s->wo), turned);
    if (!drawn || settled)
        return;
    s->density = b->material->unturned->pdf(b, rounded_to_axes(b, s->wo));
    if (!(s->density > 0.0f))
        vndf_scatter_nothing(s);
}

static void eval(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
{
    b->material->unturned->eval(b, rounded_to_axes(b, wo), seed, value, pdf);
}

static float pdf_of(const vndf_bsdf *b, vndf_vec3 wo)
{
    return b->material->unturned->pdf(b, rounded_to_axes(b, wo));
}

const vndf_routines vndf_routines_turned_walk = {
    vndf_prepare_turned_visible, sample, eval, pdf_of, NULL, VNDF_BLOCK_NONE};
