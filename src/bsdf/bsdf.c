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

/* Of a mixture, or of a surface where that is NULL. A refused material has no routines, an invalid view no area. */
VNDF_INLINE int hit(vndf_bsdf *b, const vndf_material *m, const vndf_surface *surface, const vndf_mixture *mixture,
                    vndf_vec3 wi)
{
    struct vndf_hit_view *view = &b->own.view;
    int below;
    if (!m->own.routines || !vndf_is_near_unit(wi))
        return nothing(b, m);
    b->material = m;
    if (mixture) {
        view->kind = VNDF_HIT_MIXTURE;
        view->of.mixture = vndf_mixture_view_from(mixture, wi); /* which says which side wi is on */
        below = vndf_mixture_view_cosine(&view->of.mixture, wi) < 0.0f;
    } else {
        b->own.surface = *surface;
        view->kind = surface->mean_x == 0.0f && surface->mean_y == 0.0f ? VNDF_HIT_LEVEL : VNDF_HIT_TILTED;
        below = wi.z < wi.x * surface->mean_x + wi.y * surface->mean_y;
    }
    b->own.side = below && m->own.two_sided ? -1.0f : 1.0f;
    b->own.eta = !m->own.two_sided ? 1.0 : below ? 1.0 / (double)m->is.eta : (double)m->is.eta;
    b->own.carried = m->own.two_sided && m->is.effects.transport == VNDF_TRANSPORT_RADIANCE
                         ? 1.0 / (b->own.eta * b->own.eta)
                         : 1.0;
    b->own.wi = vndf_turned(wi, b->own.side);
    if (!mixture)
        vndf_view_make(&view->of.one, &b->own.surface, b->own.wi);
    else if (b->own.side < 0.0f)
        view->of.mixture = vndf_mixture_view_from(mixture, b->own.wi);
    b->own.rise = vndf_hit_cosine(view, b->own.wi);
    b->own.area =
        mixture ? vndf_mixture_view_area(&view->of.mixture, b->own.wi) : vndf_view_own_area(&view->of.one);
    if (!(b->own.rise > 0.0f) || !(b->own.area > 0.0f))
        return nothing(b, m);
    b->own.tilt = 1.0f;
    if (view->kind != VNDF_HIT_LEVEL) {
        float x = vndf_hit_cosine(view, vndf_vec3_of(1.0f, 0.0f, 0.0f));
        float y = vndf_hit_cosine(view, vndf_vec3_of(0.0f, 1.0f, 0.0f));
        b->own.tilt = sqrtf(1.0f + (x * x + y * y));
    }
    if (vndf_compensates(&m->is.effects))
        vndf_compensation_prepare(b);
    return 1;
}

int vndf_bsdf_at(vndf_bsdf *b, const vndf_material *material, vndf_vec3 wi)
{
    return material->is.effects.shape == VNDF_SHAPE_MIXTURE ? vndf_bsdf_mixture(b, material, NULL, wi)
                                                            : hit(b, material, &material->own.surface, NULL, wi);
}

int vndf_bsdf_on(vndf_bsdf *b, const vndf_material *material, const vndf_surface *given, vndf_vec3 wi)
{
    vndf_shape shape = material->is.effects.shape;
    vndf_surface surface = given ? *given : material->own.surface;
    if (shape == VNDF_SHAPE_MIXTURE)
        return nothing(b, material);
    surface.distribution = material->is.surface.distribution;
    if (shape == VNDF_SHAPE_LEVEL)
        surface.mean_x = surface.mean_y = 0.0f;
    return hit(b, material, &surface, NULL, wi);
}

int vndf_bsdf_mixture(vndf_bsdf *b, const vndf_material *material, const vndf_mixture *mixture, vndf_vec3 wi)
{
    mixture = mixture ? mixture : material->is.mixture;
    if (material->is.effects.shape != VNDF_SHAPE_MIXTURE || !mixture)
        return nothing(b, material);
    return hit(b, material, NULL, mixture, wi);
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

void vndf_bsdf_eval_pdf(const vndf_bsdf *b, vndf_vec3 wo, uint64_t seed, float *value, float *pdf)
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
    vndf_bsdf_eval_pdf(b, wo, seed, value, NULL);
}

float vndf_bsdf_pdf(const vndf_bsdf *b, vndf_vec3 wo)
{
    float pdf;
    vndf_bsdf_eval_pdf(b, wo, 0, NULL, &pdf);
    return pdf;
}

float vndf_bsdf_cosine(const vndf_bsdf *b, vndf_vec3 wo)
{
    if (!vndf_is_near_unit(wo))
        return 0.0f;
    return b->own.view.kind == VNDF_HIT_LEVEL ? wo.z : vndf_hit_cosine(&b->own.view, wo) / b->own.tilt;
}
