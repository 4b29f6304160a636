/* Connects an event of a walk to a given direction: the density of scattering there, per steradian.
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

/* The microfacet between two directions. */
typedef struct vndf_walk_half {
    vndf_vec3 wm;
    double cosine, jacobian; /* v.wm; dwm/do */
} vndf_walk_half;

/* v + o, or eta o - v, which is summed so that it keeps its digits where eta is near 1: there an error of a length
 * matters, so both lengths are made 1. 0 if no microfacet sends v to o. */
VNDF_INLINE int vndf_walk_half_of(vndf_vec3 v, vndf_vec3 o, double eta, int across, vndf_walk_half *half)
{
    double iv = 1.0 / sqrt(vndf_walk_dot(v, v)), io = 1.0 / sqrt(vndf_walk_dot(o, o)),
           rise = across ? eta - 1.0 : 0.0;
    double side = across ? -1.0 : 1.0, vx = v.x * iv, vy = v.y * iv, vz = v.z * iv;
    double ox = o.x * io, oy = o.y * io, oz = o.z * io;
    double x = rise * ox + (ox + side * vx), y = rise * oy + (oy + side * vy), z = rise * oz + (oz + side * vz);
    double square = x * x + y * y + z * z,
           per = square > 0.0 ? copysign(1.0 / sqrt(square), across ? rise : 1.0) : 0.0;
    double cosine = (vx * x + vy * y + vz * z) * per, beyond = (ox * x + oy * y + oz * z) * per;
    half->wm = vndf_vec3_of((float)(x * per), (float)(y * per), (float)(z * per));
    half->cosine = cosine;
    half->jacobian = across ? eta * eta * beyond * (per * per) : 0.25 / cosine;
    return cosine > 0.0 && beyond > 0.0;
}

/* For one event and one direction. */
typedef struct vndf_walk_scattered {
    double value[VNDF_WAVELENGTHS]; /* of the wavelengths, per steradian; */
    double drawn;                   /* and the density with which it is drawn, before the weight of a table */
} vndf_walk_scattered;

/* From v and its view to o, on its side or `across`; 0 where no light goes there. */
VNDF_INLINE int vndf_walk_scatter(const vndf_walk *walk, const vndf_view *view, vndf_vec3 v, double eta,
                                  vndf_vec3 o, int across, vndf_walk_scattered *s)
{
    vndf_walk_half half;
    if (!vndf_walk_half_of(v, o, eta, across, &half))
        return 0;
    double density = (double)vndf_visible(view, half.wm) * half.jacobian;
    if (!(density > 0.0))
        return 0;
    double f[VNDF_WAVELENGTHS], mean = vndf_walk_reflectances(walk, half.cosine, eta, f);
    for (int i = 0; i < walk->material->is.wavelengths; i++)
        s->value[i] = density * (across ? 1.0 - f[i] : f[i]);
    s->drawn = density * (!walk->transmits ? 1.0 : across ? 1.0 - mean : mean);
    return s->drawn > 0.0;
}

#endif
