/* Densities of a normal that is given in double, as a half vector is: rounded to float it would lie elsewhere in a
 * narrow lobe. Unit within rounding, wm.z >= 0; results are not yet held to the range of float. */
#ifndef VNDF_SAMPLER_GIVEN_H
#define VNDF_SAMPLER_GIVEN_H

#include "sampler/closed.h"

/* With which vndf_sample draws wm; facing = wi.wm > 0, the view is valid. */
double vndf_pdf_of(const vndf_view *view, vndf_normal wm, double facing);

/* D, (ax, ay) the roughness times the distribution's scale. */
double vndf_ndf_of(const vndf_distribution *d, double ax, double ay, vndf_normal wm);

#endif
