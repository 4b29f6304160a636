/* A refraction in double, for one or for lanes (lobes/scatter.h, batch/lanes_scatter.c). */
#ifndef VNDF_BSDF_TERMS_REFRACTION_H
#define VNDF_BSDF_TERMS_REFRACTION_H

#include "bsdf/trust.h"
#include "sampler/analytic_density.h"

VNDF_INLINE vndf_normal vndf_unit_of(vndf_normal w)
{
    doubles per = 1.0 / doubles_root(w.x * w.x + w.y * w.y + w.z * w.z);
    vndf_normal n = {w.x * per, w.y * per, w.z * per};
    return n;
}

/* Where wi meets a microfacet: wm stays the normal of wi and wo only if the cosine is exact. */
typedef struct vndf_meeting {
    vndf_normal wi, wm; /* of unit length */
    doubles facing;
} vndf_meeting;

VNDF_INLINE vndf_meeting vndf_meet(vndf_normal wi, vndf_normal wm)
{
    vndf_normal i = vndf_unit_of(wi), m = vndf_unit_of(wm);
    vndf_meeting at = {i, m, i.x * m.x + i.y * m.y + i.z * m.z};
    return at;
}

/* wi refracted by the index ratio eta, times eta: wo is this much of wm less wi. `beyond` is the cosine to wm on the
 * other side. */
VNDF_INLINE doubles vndf_bend_along(const vndf_meeting *at, doubles beyond, doubles eta)
{
    return at->facing - eta * beyond;
}

VNDF_INLINE vndf_normal vndf_bent(const vndf_meeting *at, doubles along, doubles eta)
{
    doubles per = 1.0 / eta;
    vndf_normal wi = at->wi, wm = at->wm;
    vndf_normal wo = {(along * wm.x - wi.x) * per, (along * wm.y - wi.y) * per, (along * wm.z - wi.z) * per};
    return wo;
}

/* Where the cosines of a refraction may be rounded. */
VNDF_INLINE doubles_m vndf_trusts_refraction(const vndf_meeting *at, doubles beyond)
{
    return doubles_both(doubles_less(doubles_set(VNDF_TRUST_BEYOND), beyond),
                        doubles_less(doubles_set((double)VNDF_TRUST_REFRACTION_FACING), at->facing));
}

/* The density of wo from that of wm. */
VNDF_INLINE doubles vndf_bent_density(const vndf_meeting *at, doubles density, doubles beyond, doubles eta)
{
    doubles rise = eta * eta - 1.0, sum = at->facing + eta * beyond;
    return density * (eta * eta * beyond) * (sum * sum) / (rise * rise);
}

#endif
