/* Fresnel's equations for unpolarised light, in double and without differences of nearly equal numbers: relative
 * error below 1e-12 at any cosine and any ratio of indices, 1 excluded, where F is 0. */
#ifndef VNDF_BSDF_TERMS_FRESNEL_H
#define VNDF_BSDF_TERMS_FRESNEL_H

#include "bsdf/routines.h"

/* Squared cosine of the refracted direction, eta the index beyond over the one before; <= 0 in total reflection.
 * Near grazing incidence 1 - sin^2/eta^2 keeps its digits, also where eta is 1 or near it. */
VNDF_INLINE double vndf_refracted_square(double cosine, double eta)
{
    return ((eta - 1.0) * (eta + 1.0) + cosine * cosine) / (eta * eta);
}

/* With c, t the cosines before and beyond, r_s = (c - eta t)/(c + eta t) and r_p = (eta c - t)/(eta c + t), and
 *
 *     eta^2 t^2 - c^2 = eta^2 - 1,    eta^2 (eta^2 c^2 - t^2) = (eta^2 - 1) ((eta^2 + 1) c^2 - 1). */
VNDF_INLINE double vndf_dielectric_at(double c, double t, double eta)
{
    double square = eta * eta, rise = square - 1.0, s = c + eta * t, p = eta * (eta * c + t);
    double rs = rise / (s * s), rp = rise * ((square + 1.0) * (c * c) - 1.0) / (p * p);
    return 0.5 * (rs * rs + rp * rp);
}

VNDF_INLINE double vndf_dielectric(double cosine, double eta)
{
    double c = cosine < 1.0 ? cosine : 1.0, square = vndf_refracted_square(c, eta);
    return square > 0.0 ? vndf_dielectric_at(c, sqrt(square), eta) : 1.0;
}

extern const vndf_fresnel_routine vndf_fresnel_of_schlick, vndf_fresnel_of_schlick_thin,
    vndf_fresnel_of_dielectric, vndf_fresnel_of_conductor, vndf_fresnel_of_total, vndf_fresnel_of_nothing;

#endif
