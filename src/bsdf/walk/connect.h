/* Connects an event of a walk to a given direction: the density of scattering there, per steradian, and the chance to
 * leave.
 *
 * With v the direction to where the ray came from, o the wanted one, turned up, and Dv the visible normals of v,
 *
 *     reflection     F Dv(wm)/(4 v.wm),                                  wm ~ v + o
 *     transmission   (1 - F) Dv(wm) eta^2 (o.wm)/|eta o - v|^2,          wm ~ +-(eta o - v)
 *
 * (Walter et al., EGSR 2007, equations 14 and 17, with o in the frame of its own side: -o in theirs). */
#ifndef VNDF_BSDF_WALK_CONNECT_H
#define VNDF_BSDF_WALK_CONNECT_H

#include "bsdf/walk/path.h"
#include "bsdf/walk/visible.h"

/* The direction in which a walk shall leave. */
typedef struct vndf_walk_target {
    vndf_vec3 wo;  /* turned up */
    double lambda; /* Lambda(wo) */
    int beyond;    /* not on the side where the walk began */
} vndf_walk_target;

/* The microfacet between two directions. */
typedef struct vndf_walk_half {
    vndf_normal wm;
    double cosine, jacobian; /* v.wm; dwm/do */
} vndf_walk_half;

/* Where eta o - v is small an error of a length matters, so both lengths are made 1. */
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

/* The same for one event and one direction. */
typedef struct vndf_walk_scattered {
    double value[VNDF_WAVELENGTHS]; /* of the wavelengths, per steradian; */
    double drawn;                   /* and the density with which it is drawn, before the weight of a table */
} vndf_walk_scattered;

/* From a view to o, on its side or `across`; 0 where no light goes there. */
VNDF_INLINE int vndf_walk_scatter(const vndf_walk *walk, const vndf_view *view, double eta, vndf_vec3 o,
                                  int across, vndf_walk_scattered *s)
{
    vndf_walk_half half;
    if (across ? !vndf_walk_half_refracted(view->wi, o, eta, &half)
               : !vndf_walk_half_reflected(view->wi, o, &half))
        return 0;
    double density = vndf_walk_visible(view, half.wm, half.cosine) * half.jacobian;
    if (!(density > 0.0))
        return 0;
    double f[VNDF_WAVELENGTHS], mean = vndf_walk_reflectances(walk, half.cosine, eta, f);
    for (int i = 0; i < walk->wavelengths; i++)
        s->value[i] = density * (across ? 1.0 - f[i] : f[i]);
    s->drawn = density * (!walk->transmits ? 1.0 : across ? 1.0 - mean : mean);
    return s->drawn > 0.0;
}

/* C1^Lambda, on either side. */
VNDF_INLINE double vndf_walk_leaving(double depth, int across, const vndf_walk_target *target)
{
    return vndf_exp(-(across ? vndf_walk_other_depth(depth) : depth) * target->lambda);
}

#endif
