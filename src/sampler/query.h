/* Densities of a normal given in double, such as a half vector: rounded to float it would lie elsewhere in a narrow
 * lobe. It is unit within rounding, and wm.z >= 0. Results may lie beyond float. */
#ifndef VNDF_SAMPLER_QUERY_H
#define VNDF_SAMPLER_QUERY_H

#include "sampler/analytic_density.h"

/* The density with which vndf_sample draws wm, for a valid view and wi.wm > 0. */
double vndf_normal_pdf(const vndf_view *view, vndf_normal wm);

/* D facing/A with facing = wi.wm > 0. */
double vndf_normal_visible(const vndf_view *view, vndf_normal wm, double facing);

/* D, where (ax, ay) is the roughness times the distribution's scale. */
double vndf_normal_ndf(const vndf_distribution *d, double ax, double ay, vndf_normal wm);

#endif
