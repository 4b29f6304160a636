/* Directions to look at a random walk in, with their density: half of them as one event scatters, half by
 * cosines; with transmission half of each on either lobe or side. Written apart from src/bsdf. */
#ifndef TESTS_BSDF_WALK_WALK_PROPOSAL_H
#define TESTS_BSDF_WALK_WALK_PROPOSAL_H

#include "bsdf/walk/walk_case.h"

static inline double walk_reflected_density(const walk_hit *h, vndf_vec3 wo)
{
    vndf_vec3 wi = h->wi, sum = {wi.x + wo.x, wi.y + wo.y, wi.z + wo.z};
    double length = sqrt((double)sum.x * sum.x + (double)sum.y * sum.y + (double)sum.z * sum.z);
    vndf_vec3 wm = {walk_rounded(sum.x / length), walk_rounded(sum.y / length), walk_rounded(sum.z / length)};
    return (double)vndf_pdf(&h->view, wm) / (2.0 * length);
}

static inline double walk_refracted_density(const walk_hit *h, vndf_vec3 wo)
{
    vndf_vec3 wi = h->wi;
    double eta = (double)h->is.eta;
    double x = wi.x + eta * wo.x, y = wi.y + eta * wo.y, z = wi.z + eta * wo.z, square = x * x + y * y + z * z;
    double per = copysign(1.0 / sqrt(square), 1.0 - eta);
    vndf_vec3 wm = {walk_rounded(x * per), walk_rounded(y * per), walk_rounded(z * per)};
    double facing_o = -(wo.x * x + wo.y * y + wo.z * z) * per;
    return facing_o > 0.0 ? (double)vndf_pdf(&h->view, wm) * eta * eta * facing_o / square : 0.0;
}

/* Reflection alone is mirrored at the horizon. */
static inline double walk_proposal_density(const walk_hit *h, vndf_vec3 wo)
{
    vndf_vec3 mirrored = {wo.x, wo.y, -wo.z};
    double cosine = fabs((double)wo.z) / PI, event = walk_reflected_density(h, wo);
    if (!walk_transmits(&h->is))
        return 0.5 * (event + walk_reflected_density(h, mirrored) + cosine);
    return 0.25 * (event + walk_refracted_density(h, wo) + cosine);
}

static inline vndf_vec3 walk_propose_cosine(int below, double u1, double u2)
{
    return walk_direction((below ? -1.0 : 1.0) * sqrt(u1), 2.0 * PI * u2);
}

/* Mirrored in wm, or refracted there (NaN in total reflection). */
static inline vndf_vec3 walk_scattered_once(const walk_hit *h, int refracted, vndf_vec3 wm)
{
    vndf_vec3 v = h->wi;
    double eta = (double)h->is.eta, c = (double)v.x * wm.x + (double)v.y * wm.y + (double)v.z * wm.z,
           t2 = eta * eta - 1.0 + c * c;
    double along = !refracted ? 2.0 * c : t2 > 0.0 ? (c - sqrt(t2)) / eta : NAN;
    double per = refracted ? 1.0 / eta : 1.0;
    vndf_vec3 wo = {walk_rounded(along * wm.x - per * v.x), walk_rounded(along * wm.y - per * v.y),
                    walk_rounded(along * wm.z - per * v.z)};
    return wo;
}

static inline vndf_vec3 walk_propose_event(const walk_hit *h, int refracted, float u1, float u2)
{
    vndf_vec3 wo = walk_scattered_once(h, refracted, vndf_sample(&h->view, u1, u2, NULL));
    wo.z = walk_transmits(&h->is) ? wo.z : fabsf(wo.z);
    return wo;
}

#endif
