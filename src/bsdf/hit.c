#include "bsdf/hit.h"

#include "bsdf/material.h"

/* ---- normals ---- */

static vndf_drawn_normal draw_visible(const struct vndf_hit_view *v, float u1, float u2)
{
    vndf_drawn_normal n;
    if (v->kind == VNDF_HIT_MIXTURE) {
        n.wm = vndf_mixture_sample(&v->of.mixture, u1, u2, &n.density, NULL);
        n.weight = n.density > 0.0f ? vndf_mixture_visible(&v->of.mixture, n.wm) / n.density : 0.0f;
    } else
        n.wm = vndf_sample_weight(&v->of.one, u1, u2, &n.density, &n.weight);
    return n;
}

static float pdf_visible(const struct vndf_hit_view *v, vndf_vec3 wm)
{
    return v->kind == VNDF_HIT_MIXTURE ? vndf_mixture_pdf(&v->of.mixture, wm) : vndf_pdf(&v->of.one, wm);
}

static vndf_drawn_normal draw_bounded(const struct vndf_hit_view *v, float u1, float u2)
{
    return vndf_sample_bounded(&v->of.one, u1, u2);
}

static float pdf_bounded(const struct vndf_hit_view *v, vndf_vec3 wm)
{
    return vndf_pdf_bounded(&v->of.one, wm);
}

static vndf_drawn_normal draw_all(const struct vndf_hit_view *v, float u1, float u2)
{
    return vndf_sample_all(&v->of.one, u1, u2);
}

static float pdf_all(const struct vndf_hit_view *v, vndf_vec3 wm)
{
    return vndf_pdf_all(&v->of.one, wm);
}

static vndf_drawn_normal draw_v_cavity(const struct vndf_hit_view *v, float u1, float u2)
{
    return vndf_sample_v_cavity(&v->of.one, u1, u2);
}

static float pdf_v_cavity(const struct vndf_hit_view *v, vndf_vec3 wm)
{
    return vndf_pdf_v_cavity(&v->of.one, wm);
}

const vndf_normals_routine vndf_normals_routines[VNDF_NORMALS_V_CAVITY + 1] = {
    [VNDF_NORMALS_VISIBLE] = {draw_visible, pdf_visible},
    [VNDF_NORMALS_BOUNDED] = {draw_bounded, pdf_bounded},
    [VNDF_NORMALS_ALL] = {draw_all, pdf_all},
    [VNDF_NORMALS_V_CAVITY] = {draw_v_cavity, pdf_v_cavity}};

/* ---- hits ---- */

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
    b->rise = vndf_hit_cosine(&b->view, b->wi);
    b->area = vndf_hit_area(&b->view, b->wi);
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

int vndf_hit_surface(vndf_bsdf *b, const vndf_material *material, const vndf_affine *surface, vndf_vec3 wi)
{
    if (!vndf_is_near_unit(wi))
        return nothing(b, material);
    b->surface = *surface;
    b->view.kind = surface->mean_x == 0.0f && surface->mean_y == 0.0f ? VNDF_HIT_LEVEL : VNDF_HIT_TILTED;
    take_side(b, material, wi, wi.z < wi.x * surface->mean_x + wi.y * surface->mean_y);
    b->view.of.one = vndf_affine_view_from(&b->surface, b->wi);
    return complete(b, material);
}

/* The view of a mixture says which side wi is on. */
int vndf_hit_mixture(vndf_bsdf *b, const vndf_material *material, const vndf_mixture *mixture, vndf_vec3 wi)
{
    if (!vndf_is_near_unit(wi))
        return nothing(b, material);
    b->view.kind = VNDF_HIT_MIXTURE;
    b->view.of.mixture = vndf_mixture_view_from(mixture, wi);
    take_side(b, material, wi, vndf_hit_cosine(&b->view, wi) < 0.0f);
    if (b->side < 0.0f)
        b->view.of.mixture = vndf_mixture_view_from(mixture, b->wi);
    return complete(b, material);
}

int vndf_hit_surface_of(const vndf_material *material, const vndf_roughness *r, vndf_affine *surface)
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
