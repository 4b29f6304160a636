/* Microfacet normals as the effects want them drawn: with their density, and with what a weight takes of both. */
#ifndef VNDF_BSDF_NORMALS_H
#define VNDF_BSDF_NORMALS_H

#include "bsdf/masking.h"
#include "math/vector.h"
#include "sampler/given.h"
#include "sampler/surface.h"

/* A drawn normal: facing = wi.wm, quotient = D(wm) facing/density. */
typedef struct vndf_bsdf_normal {
    vndf_vec3 wm;
    float density, facing, quotient;
} vndf_bsdf_normal;

VNDF_INLINE double vndf_bsdf_ndf(const vndf_bsdf *b, vndf_normal wm)
{
    return vndf_ndf_of(b->view.distribution, b->view.alpha_x, b->view.alpha_y, wm);
}

/* ---- what a direction needs ---- */

VNDF_INLINE int vndf_prepare_visible(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    const vndf_surface surface = {b->material->is.distribution, r->alpha_x, r->alpha_y};
    vndf_view_set(&b->view, &surface, wi);
    if (!b->view.distribution)
        return 0;
    float x = b->view.ax * wi.x, y = b->view.ay * wi.y, across2 = x * x + y * y;
    float length = b->view.distribution->kind == VNDF_KIND_TABLE ? sqrtf(across2) + wi.z
                                                                 : sqrtf(across2 + wi.z * wi.z);
    b->area = b->view.area * length;
    return 1;
}

VNDF_INLINE int vndf_prepare_bounded(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    return vndf_prepare_visible(b, r, wi);
}

VNDF_INLINE int vndf_prepare_all(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    return vndf_prepare_visible(b, r, wi);
}

/* ---- drawing ---- */

VNDF_INLINE vndf_bsdf_normal vndf_bsdf_visible(const vndf_bsdf *b, vndf_vec3 wm, float density)
{
    vndf_bsdf_normal n = {wm, density, vndf_dot(b->view.wi, wm), b->area};
    if (b->view.distribution->kind == VNDF_KIND_TABLE)
        n.quotient = (float)(vndf_bsdf_ndf(b, vndf_normal_of(wm)) * (n.facing / density));
    return n;
}

VNDF_INLINE vndf_bsdf_normal vndf_bsdf_draw_visible(const vndf_bsdf *b, float u1, float u2)
{
    float density;
    vndf_vec3 wm = vndf_sample(&b->view, u1, u2, &density);
    return vndf_bsdf_visible(b, wm, density);
}

/* `normals` is a constant. */
VNDF_INLINE vndf_bsdf_normal vndf_bsdf_draw(const vndf_bsdf *b, float u1, float u2, vndf_normals_drawn normals)
{
    (void)normals;
    return vndf_bsdf_draw_visible(b, u1, u2);
}

/* The density with which wm is drawn, unit but for rounding, facing = wi.wm > 0. */
VNDF_INLINE double vndf_bsdf_density(const vndf_bsdf *b, vndf_normal wm, double facing, vndf_normals_drawn normals)
{
    (void)normals;
    return vndf_pdf_of(&b->view, wm, facing);
}

#endif
