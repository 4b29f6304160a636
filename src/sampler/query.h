/* Densities of a normal that is given in double, as a half vector is: rounded to float it would lie elsewhere in a
 * narrow lobe. Unit within rounding, wm.z >= 0; results are not yet held to the range of float. */
#ifndef VNDF_SAMPLER_QUERY_H
#define VNDF_SAMPLER_QUERY_H

#include "sampler/analytic_density.h"

/* With which vndf_sample draws wm, wi.wm > 0, the view is valid. */
double vndf_normal_pdf(const vndf_view *view, vndf_normal wm);

/* D facing/A, facing = wi.wm > 0. */
double vndf_normal_visible(const vndf_view *view, vndf_normal wm, double facing);

/* D, (ax, ay) the roughness times the distribution's scale. */
double vndf_normal_ndf(const vndf_distribution *d, double ax, double ay, vndf_normal wm);

#endif
