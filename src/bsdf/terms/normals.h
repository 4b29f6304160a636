/* Microfacet normals, drawn as the effects ask, with their density and their part of a weight. */
#ifndef VNDF_BSDF_TERMS_NORMALS_H
#define VNDF_BSDF_TERMS_NORMALS_H

#include "bsdf/terms/event.h"
#include "bsdf/terms/masking.h"
#include "math/vector.h"
#include "sampler/all_normals/all_normals.h"
#include "sampler/bounded/bounded.h"
#include "sampler/query.h"
#include "sampler/surface.h"

VNDF_INLINE vndf_incident vndf_incident_of(const vndf_bsdf *b)
{
    const vndf_view *v = &b->view;
    vndf_incident at = {v->distribution, v->wi, v->ax, v->ay, b->area, b->material->turn, v->trusted};
    return at;
}

VNDF_INLINE double vndf_bsdf_ndf(const vndf_bsdf *b, vndf_normal wm)
{
    return vndf_normal_ndf(b->view.distribution, b->view.alpha_x, b->view.alpha_y, wm);
}

/* ---- preparing a direction ---- */

VNDF_INLINE int vndf_prepare_visible(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    const vndf_surface surface = {b->material->is.distribution, r->alpha_x, r->alpha_y};
    vndf_view_set(&b->view, &surface, wi);
    if (!b->view.distribution)
        return 0;
    b->area = vndf_bsdf_view_area(b);
    return 1;
}

VNDF_INLINE int vndf_prepare_bounded(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    if (!vndf_prepare_visible(b, r, wi))
        return 0;
    vndf_bounds_of(&b->view, &b->bounds);
    return 1;
}

/* No view: roughness and direction, and the area for masking. */
VNDF_INLINE int vndf_prepare_all(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 wi)
{
    const vndf_surface surface = {b->material->is.distribution, r->alpha_x, r->alpha_y};
    vndf_view *view = &b->view;
    view->distribution = surface.distribution;
    view->wi.x = wi.x;
    view->wi.y = wi.y;
    view->wi.z = wi.z;
    if (!vndf_surface_scaled(&surface, &view->alpha_x, &view->alpha_y) || !(vndf_dot(wi, wi) < HUGE_VALF))
        return 0;
    view->ax = (float)view->alpha_x;
    view->ay = (float)view->alpha_y;
    b->area = vndf_bsdf_area(b, wi);
    return 1;
}

/* ---- drawing ---- */

/* A table does not draw exactly with D. */
VNDF_INLINE float vndf_bsdf_quotient(const vndf_bsdf *b, vndf_vec3 wm, float facing, float density)
{
    return (float)(vndf_bsdf_ndf(b, vndf_normal_of(wm)) * (facing / density));
}

/* `weight` is the visible density over `density`. */
VNDF_INLINE vndf_bsdf_normal vndf_bsdf_visible(const vndf_bsdf *b, vndf_vec3 wm, float density, float weight,
                                               float u2)
{
    vndf_bsdf_normal n = {wm, density, vndf_dot(b->view.wi, wm), b->area * weight, u2};
    return n;
}

VNDF_INLINE vndf_bsdf_normal vndf_bsdf_draw_visible(const vndf_bsdf *b, float u1, float u2)
{
    float density, weight = 1.0f;
    vndf_vec3 wm = vndf_law_is_exact(b->view.distribution)
                       ? vndf_sample(&b->view, u1, u2, &density)
                       : vndf_sample_weight(&b->view, u1, u2, &density, &weight);
    return vndf_bsdf_visible(b, wm, density, weight, u2);
}

VNDF_INLINE vndf_bsdf_normal vndf_bsdf_draw_bounded(const vndf_bsdf *b, float u1, float u2)
{
    vndf_bounded drawn = vndf_sample_bounded(&b->view, &b->bounds, u1, u2);
    vndf_bsdf_normal n = {drawn.wm, drawn.density, vndf_dot(b->view.wi, drawn.wm), b->area * drawn.inside_mass,
                          u2};
    if (drawn.weight > 0.0f)
        n.quotient *= drawn.weight;
    else if (!vndf_law_is_exact(b->view.distribution))
        n.quotient = vndf_bsdf_quotient(b, n.wm, n.facing, n.density);
    return n;
}

VNDF_INLINE vndf_bsdf_normal vndf_bsdf_draw_all(const vndf_bsdf *b, float u1, float u2)
{
    const vndf_view *v = &b->view;
    vndf_bsdf_normal n;
    n.u2 = u2;
    n.wm = vndf_sample_all(v->distribution, v->alpha_x, v->alpha_y, u1, u2, &n.density);
    n.facing = vndf_dot(v->wi, n.wm);
    n.quotient =
        vndf_law_is_exact(v->distribution) ? n.facing / n.wm.z : vndf_bsdf_quotient(b, n.wm, n.facing, n.density);
    return n;
}

VNDF_INLINE vndf_bsdf_normal vndf_bsdf_draw_v_cavity(const vndf_bsdf *b, float u1, float u2)
{
    const vndf_view *v = &b->view;
    vndf_bsdf_normal n;
    n.u2 = u2;
    n.wm = vndf_sample_v_cavity(v->distribution, v->alpha_x, v->alpha_y, v->wi, u1, u2, &n.density);
    n.facing = vndf_dot(v->wi, n.wm);
    n.quotient = vndf_bsdf_quotient(b, n.wm, n.facing, n.density);
    return n;
}

/* `normals` is a constant. */
VNDF_INLINE vndf_bsdf_normal vndf_bsdf_draw(const vndf_bsdf *b, float u1, float u2, vndf_normals_drawn normals)
{
    if (normals == VNDF_NORMALS_BOUNDED)
        return vndf_bsdf_draw_bounded(b, u1, u2);
    if (normals == VNDF_NORMALS_ALL)
        return vndf_bsdf_draw_all(b, u1, u2);
    if (normals == VNDF_NORMALS_V_CAVITY)
        return vndf_bsdf_draw_v_cavity(b, u1, u2);
    return vndf_bsdf_draw_visible(b, u1, u2);
}

/* The density with which wm is drawn, unit but for rounding, wi.wm > 0. */
VNDF_INLINE double vndf_bsdf_density(const vndf_bsdf *b, vndf_normal wm, vndf_normals_drawn normals)
{
    const vndf_view *v = &b->view;
    if (normals == VNDF_NORMALS_BOUNDED)
        return vndf_pdf_bounded(v, &b->bounds, wm);
    if (normals == VNDF_NORMALS_ALL)
        return vndf_pdf_all(v->distribution, v->alpha_x, v->alpha_y, wm);
    if (normals == VNDF_NORMALS_V_CAVITY)
        return vndf_pdf_v_cavity(v->distribution, v->alpha_x, v->alpha_y, v->wi, wm);
    return vndf_normal_pdf(v, wm);
}

#endif
