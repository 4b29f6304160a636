/* Normals drawn without a look at what wi sees (Walter et al., "Microfacet Models for Refraction through Rough
 * Surfaces", EGSR 2007), which is what visible normals are measured against, and those that wi sees in V-cavities
 * (Heitz & d'Eon 2014), which are made of them. Any distribution; ax and ay are roughness times the distribution's
 * own scale, within [1e-18, 1e18] (vndf_surface_scaled); a normal is unit, z > 0. all_normals.c has the
 * mathematics. */
#ifndef VNDF_SAMPLER_ALL_NORMALS_ALL_NORMALS_H
#define VNDF_SAMPLER_ALL_NORMALS_ALL_NORMALS_H

#include "sampler/analytic_density.h"
#include "vndf.h"

/* A normal with the density D cos(theta_m) per steradian, as exact as the table: *pdf, if not NULL, is what was
 * drawn with, to 1e-5 of vndf_pdf_all, within [FLT_MIN, FLT_MAX]. u1 turns the azimuth of the stretched normal,
 * from -x (0) through x (1/2) and round; u2 moves it away from z. Numbers outside [0, 1] are clamped, NaN is 0. */
vndf_vec3 vndf_sample_all(const vndf_distribution *d, double ax, double ay, float u1, float u2, float *pdf);

/* That density, 0 for z < 0; of a table it is what the numbers of the table define, to 1e-5 where it exceeds
 * 1e-30. */
double vndf_pdf_all(const vndf_distribution *d, double ax, double ay, vndf_normal wm);

/* A normal with the density D G1 max(0, wi.wm)/cos_i, G1 = min(1, 2 cos(theta_m) cos_i/(wi.wm)), with the same D.
 * wi.z >= 0. u1 turns the azimuth from behind wi (0) through that of wi (1/2) and round. wi.wm > 0, but where wi.z
 * is 0 and wm at a right angle to it, in corners of the unit square: then *pdf is FLT_MIN. */
vndf_vec3 vndf_sample_v_cavity(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi, float u1, float u2,
                               float *pdf);
double vndf_pdf_v_cavity(const vndf_distribution *d, double ax, double ay, vndf_vec3 wi, vndf_normal wm);

#endif
