/* E(rho) or S(rho) of a profile (profile.h) at very many places. In a panel that is often asked, polynomials through
 * values of vndf_profile_e or vndf_profile_s take their place: they are as smooth as the sums that they replace, and
 * agree to 1e-14 wherever they are used. A polynomial takes some twenty multiplications, a sum ten values of P22. */
#ifndef VNDF_FIT_PROFILE_STRIP_H
#define VNDF_FIT_PROFILE_STRIP_H

#include "fit/profile/profile.h"

typedef struct vndf_strip vndf_strip;

/* Of E, or of S if `beyond`. NULL if there is no memory. The profile must live as long. */
vndf_strip *vndf_strip_from(const vndf_profile *profile, int beyond);
void vndf_strip_free(vndf_strip *strip);

double vndf_strip_at(vndf_strip *strip, double rho);

#endif
