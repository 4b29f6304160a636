/* The microfacet that takes wi to wo, in double, for one or for lanes (lobes/scatter.h, batch/lanes_look.c). */
#ifndef VNDF_BSDF_TERMS_FACET_H
#define VNDF_BSDF_TERMS_FACET_H

#include "bsdf/terms/refraction.h"

/* facing_i <= 0 if there is none. */
typedef struct vndf_facet {
    vndf_normal wm;
    doubles cos_i, cos_o, facing_i, facing_o; /* sizes of cosines to the surface's normal, and to wm */
    doubles jacobian;                         /* dwm/dwo */
} vndf_facet;

VNDF_INLINE doubles vndf_normals_dot(vndf_normal a, vndf_normal b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

VNDF_INLINE vndf_normal vndf_halfway(vndf_normal i, vndf_normal o)
{
    doubles x = i.x + o.x, y = i.y + o.y, z = i.z + o.z, per = 1.0 / doubles_root(x * x + y * y + z * z);
    vndf_normal wm = {x * per, y * per, z * per};
    return wm;
}

VNDF_INLINE vndf_normal vndf_picked_normal(doubles_m m, vndf_normal yes, vndf_normal no)
{
    vndf_normal n = {doubles_pick(m, yes.x, no.x), doubles_pick(m, yes.y, no.y), doubles_pick(m, yes.z, no.z)};
    return n;
}

/* wi and wo keep their lengths: for a sampled wo the half vector is then wm, rounding included. Where both graze, wi.wm
 * is as small as the errors of these lengths and might be 0 or less, so they are made 1. There exact.c evaluates all
 * samples. */
VNDF_INLINE vndf_facet vndf_facet_reflecting(vndf_normal wi, vndf_normal wo)
{
    vndf_normal wm = vndf_halfway(wi, wo);
    doubles facing = vndf_normals_dot(wi, wm);
    doubles_m grazes = doubles_less(facing, doubles_set(VNDF_TRUST_LENGTHS));
    if (doubles_any(grazes)) {
        vndf_normal i = vndf_unit_of(wi), unit = vndf_halfway(i, vndf_unit_of(wo));
        wm = vndf_picked_normal(grazes, unit, wm);
        facing = doubles_pick(grazes, vndf_normals_dot(i, unit), facing);
    }
    vndf_facet f = {wm, wi.z, wo.z, facing, facing, 0.25 / facing};
    return f;
}

/* Where wi + r wo is small an error of a length matters, so both lengths are made 1. */
VNDF_INLINE vndf_facet vndf_facet_refracting(vndf_normal wi, vndf_normal wo, doubles eta)
{
    vndf_normal i = vndf_unit_of(wi), o = vndf_unit_of(wo);
    doubles rise = eta - 1.0, x = rise * o.x + (i.x + o.x), y = rise * o.y + (i.y + o.y),
            z = rise * o.z + (i.z + o.z);
    doubles square = x * x + y * y + z * z, per = doubles_sign(1.0 / doubles_root(square), z);
    vndf_normal wm = {x * per, y * per, z * per};
    doubles facing_i = vndf_normals_dot(i, wm), facing_o = -vndf_normals_dot(o, wm);
    vndf_facet f = {wm, i.z, -o.z, facing_i, facing_o, eta * eta * facing_o / square};
    return f;
}

#endif
