/* How good a table is. Given the slope length R all azimuths are drawn as they are seen, so the total variation is
 * that of the laws of R: the drawn one (fit/law.h) against f(R) k(R/rho) |c|/(pi A) of the profile. Slopes that no
 * normal of floats can tell apart count as one (VNDF_GRAIN). */
#ifndef VNDF_FIT_CERTIFICATE_H
#define VNDF_FIT_CERTIFICATE_H

#include "fit/draft.h"

/* 0 if there is no memory. */
int vndf_certificate_measure(vndf_certificate *certificate, const vndf_draft *draft, const vndf_profile *profile);

#endif
