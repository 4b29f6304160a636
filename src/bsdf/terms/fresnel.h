/* Fresnel's equations for unpolarised light, in double and without differences of nearly equal numbers: relative
 * error below 1e-12 at any cosine and any ratio of indices, 1 excluded, where F is 0. */
#ifndef VNDF_BSDF_TERMS_FRESNEL_H
#define VNDF_BSDF_TERMS_FRESNEL_H

#include "bsdf/routines.h"
#include "bsdf/trust.h"

/* Squared cosine of the refracted direction, eta the index beyond over the one before; <= 0 in total reflection.
 * Near grazing incidence 1 - sin^2/eta^2 keeps its digits, also where eta is 1 or near it. */
VNDF_INLINE doubles vndf_refracted_square(doubles cosine, doubles eta)
{
    return ((eta - 1.0) * (eta + 1.0) + cosine * cosine) / (eta * eta);
}

/* Whether F loses its digits when `cosine` is rounded: beside total reflection F changes without bound. */
VNDF_INLINE doubles_m vndf_loses_reflectance(doubles cosine, doubles eta)
{
    doubles_m kept =
        doubles_less(doubles_set(VNDF_TRUST_REFRACTED), doubles_abs(vndf_refracted_square(cosine, eta)));
    return doubles_without(doubles_less(eta, doubles_set(1.0)), kept);
}

/* With c, t the cosines before and beyond, r_s = (c - eta t)/(c + eta t) and r_p = (eta c - t)/(eta c + t), and
 *
 *     eta^2 t^2 - c^2 = eta^2 - 1,    eta^2 (eta^2 c^2 - t^2) = (eta^2 - 1) ((eta^2 + 1) c^2 - 1). */
VNDF_INLINE doubles vndf_dielectric_at(doubles c, doubles t, doubles eta)
{
    doubles square = eta * eta, rise = square - 1.0, s = c + eta * t, p = eta * (eta * c + t);
    doubles rs = rise / (s * s), rp = rise * ((square + 1.0) * (c * c) - 1.0) / (p * p);
    return 0.5 * (rs * rs + rp * rp);
}

VNDF_INLINE doubles vndf_dielectric(doubles cosine, doubles eta)
{
    const doubles one = doubles_set(1.0);
    doubles c = doubles_pick(doubles_less(cosine, one), cosine, one), square = vndf_refracted_square(c, eta);
    doubles_m passes = doubles_less(doubles_set(0.0), square);
    return doubles_pick(passes, vndf_dielectric_at(c, doubles_root(square), eta), one);
}

VNDF_INLINE doubles vndf_schlick(doubles cosine, double f0)
{
    doubles rest = doubles_pick(doubles_less(cosine, doubles_set(1.0)), 1.0 - cosine, doubles_set(0.0));
    doubles square = rest * rest;
    return f0 + (1.0 - f0) * (square * square * rest);
}

/* (n + ik)^2 - sin^2 = (a + ib)^2, hence a^2 - b^2 = t = n^2 - k^2 - sin^2 and a b = n k (Born & Wolf,
 * "Principles of Optics", 14.2). The smaller of a^2 and b^2 comes from the larger, and a - c from a^2 - c^2 = n^2
 * - k^2 - 1 + b^2, which is `apart`. Both polarisations share a division:
 *
 *     s = ((a - c)^2 + b^2)/((a + c)^2 + b^2),    p = s ((a c - sin^2)^2 + b^2 c^2)/((a c + sin^2)^2 + b^2 c^2). */
VNDF_INLINE doubles vndf_conductor(doubles cosine, double n, double k)
{
    const doubles one = doubles_set(1.0), nothing = doubles_set(0.0);
    doubles c = doubles_pick(doubles_less(cosine, one), cosine, one), c2 = c * c, s2 = 1.0 - c2;
    double nk = n * k;
    doubles t = (n * n - k * k) - s2, root = doubles_root(t * t + 4.0 * nk * nk);
    doubles larger = 0.5 * (root + doubles_abs(t));
    doubles smaller = doubles_pick(doubles_less(nothing, larger), nk * nk / larger, nothing);
    doubles_m first = doubles_less(nothing, t);
    doubles a2 = doubles_pick(first, larger, smaller), b2 = doubles_pick(first, smaller, larger);
    doubles a = doubles_root(a2), sum = a + c;
    doubles apart = (n - 1.0) * (n + 1.0) - k * k + b2, less = a * c - s2, more = a * c + s2;
    doubles square = sum * sum, over = less * less + b2 * c2, under = more * more + b2 * c2;
    doubles below = square * (square + b2) * under;
    doubles mean = 0.5 * (apart * apart + b2 * square) * (under + over) / below;
    /* at right angles to the normal it is 0/0 */
    return doubles_pick(doubles_both(doubles_less(nothing, below), doubles_less(mean, one)), mean, one);
}

#if VNDF_LANES > 1

/* vndf_fresnel_routine, one wavelength of it, in lanes. */
VNDF_INLINE doubles vndf_reflectance_lanes(const vndf_material *m, int i, doubles cosine, doubles eta)
{
    const vndf_description *is = &m->is;
    switch (is->effects.fresnel) {
    case VNDF_FRESNEL_SCHLICK: return vndf_schlick(cosine, (double)is->f0[i]);
    case VNDF_FRESNEL_DIELECTRIC: return vndf_dielectric(cosine, eta);
    case VNDF_FRESNEL_CONDUCTOR:
        return vndf_conductor(cosine, (double)is->conductor_eta[i], (double)is->conductor_k[i]);
    case VNDF_FRESNEL_NONE: break;
    }
    return doubles_set(1.0);
}

#endif

extern const vndf_fresnel_routine vndf_fresnel_of_schlick, vndf_fresnel_of_schlick_thin,
    vndf_fresnel_of_dielectric, vndf_fresnel_of_conductor, vndf_fresnel_of_total, vndf_fresnel_of_nothing;

#endif
