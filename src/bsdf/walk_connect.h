/* From an event of a walk straight to where it is wanted: the density of scattering there, per steradian, and the
 * chance to leave.
 *
 * With v the direction to where the ray came from, o the wanted one, turned up, and Dv the visible normals of v,
 *
 *     reflection     F Dv(wm)/(4 v.wm),                                  wm ~ v + o
 *     transmission   (1 - F) Dv(wm) eta^2 (o.wm)/|eta o - v|^2,          wm ~ +-(eta o - v)
 *
 * (Walter et al., EGSR 2007, equations 14 and 17, with o in the frame of its own side: -o in theirs). */
#ifndef VNDF_BSDF_WALK_CONNECT_H
#define VNDF_BSDF_WALK_CONNECT_H

#include "bsdf/beta.h"
#include "bsdf/walk_path.h"
#include "bsdf/walk_visible.h"

typedef struct vndf_walk_target {
    vndf_vec3 wo;  /* turned up */
    int beyond;    /* it is on the other side than wi */
    double lambda; /* Lambda(wo) */
} vndf_walk_target;

/* The microfacet between two directions. */
typedef struct vndf_walk_half {
    vndf_normal wm;
    double cosine, jacobian; /* v.wm; dwm/do */
} vndf_walk_half;

/* Lengths that are 1 but for rounding count where eta o - v is small, so they are made 1. */
VNDF_INLINE vndf_normal vndf_walk_exact_unit(vndf_vec3 w)
{
    double per = 1.0 / sqrt(vndf_exact_dot(w, w));
    vndf_normal unit = {w.x * per, w.y * per, w.z * per};
    return unit;
}

VNDF_INLINE double vndf_walk_dot(vndf_normal a, vndf_normal b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* 0 if v and o are opposite. */
VNDF_INLINE int vndf_walk_half_reflected(vndf_vec3 v, vndf_vec3 o, vndf_walk_half *half)
{
    vndf_normal i = vndf_walk_exact_unit(v), u = vndf_walk_exact_unit(o), sum = {i.x + u.x, i.y + u.y, i.z + u.z};
    double length = sqrt(vndf_walk_dot(sum, sum)), per = length > 0.0 ? 1.0 / length : 0.0;
    vndf_normal wm = {sum.x * per, sum.y * per, sum.z * per};
    vndf_walk_half found = {wm, 0.5 * length, 0.5 * per};
    *half = found;
    return length > 0.0;
}

/* 0 if no microfacet refracts v to o. eta o - v is summed so that it keeps its digits where eta is near 1. */
VNDF_INLINE int vndf_walk_half_refracted(vndf_vec3 v, vndf_vec3 o, double eta, vndf_walk_half *half)
{
    vndf_normal i = vndf_walk_exact_unit(v), u = vndf_walk_exact_unit(o);
    double rise = eta - 1.0;
    vndf_normal sum = {rise * u.x + (u.x - i.x), rise * u.y + (u.y - i.y), rise * u.z + (u.z - i.z)};
    double square = vndf_walk_dot(sum, sum), per = square > 0.0 ? copysign(1.0 / sqrt(square), rise) : 0.0;
    vndf_normal wm = {sum.x * per, sum.y * per, sum.z * per};
    double beyond = vndf_walk_dot(u, wm);
    vndf_walk_half found = {wm, vndf_walk_dot(i, wm), eta * eta * beyond * (per * per)};
    *half = found;
    return found.cosine > 0.0 && beyond > 0.0;
}

/* Of the wavelengths, lobe included; 0 where there is none. */
VNDF_INLINE int vndf_walk_scattered(const vndf_walk *walk, const vndf_walk_path *path,
                                    const vndf_walk_target *target, double scattered[VNDF_WAVELENGTHS])
{
    vndf_walk_half half;
    int across = path->turned != target->beyond;
    if (across ? !vndf_walk_half_refracted(path->view.wi, target->wo, path->eta, &half)
               : !vndf_walk_half_reflected(path->view.wi, target->wo, &half))
        return 0;
    double density = vndf_walk_visible(&path->view, half.wm, half.cosine) * half.jacobian;
    if (!(density > 0.0))
        return 0;
    vndf_walk_reflectances(walk, half.cosine, path->eta, scattered);
    for (int i = 0; i < VNDF_WAVELENGTHS; i++)
        scattered[i] = density * (across ? 1.0 - scattered[i] : scattered[i]);
    return 1;
}

/* C1^Lambda, on either side. */
VNDF_INLINE double vndf_walk_leaving(const vndf_walk_path *path, const vndf_walk_target *target)
{
    double depth = path->turned != target->beyond ? vndf_walk_other_depth(path->depth) : path->depth;
    return vndf_exp(-depth * target->lambda);
}

/* Its mean at the first event, where C1 = U^(1/a), a = 1 + Lambda(wi): a/(a + Lambda(wo)), and on the other side
 * a Beta(a, 1 + Lambda(wo)). */
VNDF_INLINE double vndf_walk_leaving_once(const vndf_view *view, const vndf_walk_target *target)
{
    double a = vndf_walk_slant(view, view->wi);
    return target->beyond ? a * vndf_beta(a, 1.0 + target->lambda) : a / (a + target->lambda);
}

#endif
