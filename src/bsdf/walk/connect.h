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

/* For one event and one direction. */
typedef struct vndf_walk_scattered {
    double value[VNDF_WAVELENGTHS]; /* of the wavelengths, per steradian; */
    double drawn;                   /* and the density with which it is drawn, before the weight of a table */
} vndf_walk_scattered;

/* From v and its view to o, on its side or `across`; 0 where no light goes there. */
VNDF_INLINE int vndf_walk_scatter(const vndf_walk *walk, const vndf_view *view, vndf_vec3 v, double eta,
                                  vndf_vec3 o, int across, vndf_walk_scattered *s)
{
    event e = across ? refracting(vndf_direction(v), vndf_direction(o), eta)
                     : reflecting(vndf_direction(v), vndf_direction(o));
    if (!e.met)
        return 0;
    vndf_vec3 wm = vndf_vec3_of((float)e.wm.x, (float)e.wm.y, (float)e.wm.z);
    double density = (double)vndf_visible(view, wm) * e.jacobian;
    if (!(density > 0.0))
        return 0;
    double f[VNDF_WAVELENGTHS], mean = vndf_walk_reflectances(walk, e.facing, eta, f);
    for (int i = 0; i < walk->material->is.wavelengths; i++)
        s->value[i] = density * (across ? 1.0 - f[i] : f[i]);
    s->drawn = density * (!walk->transmits ? 1.0 : across ? 1.0 - mean : mean);
    return s->drawn > 0.0;
}

#endif
