/* GGX (Trowbridge-Reitz): its densities, and its sampler in the unit problem: roughness 1, incident direction
 * (s, 0, c), s >= 0.
 *
 * The unit problem is what remains of any roughness and direction after the stretch and the rotation about z
 * (design: w = (alpha_x wi.x, alpha_y wi.y, wi.z) / length). s and c are sine and cosine within rounding,
 * c of either sign; each must carry its own relative precision, which is where the precision near
 * c = 0 and c = -1 comes from. Uniform numbers lie in [0, 1]. */
#ifndef VNDF_SAMPLER_GGX_H
#define VNDF_SAMPLER_GGX_H

#include "sampler/closed.h"

/* A1 = c (1 + Lambda) = (1 + c)/2, relative error below 3e-7 wherever s*s does not underflow. */
float vndf_ggx_area(float s, float c);

/* P22 = 1/(pi (1 + r2)^2) at squared slope length r2 in [0, inf). */
double vndf_ggx_p22(double r2);

/* D(wm) for a unit wm, wm.z >= 0, and alpha within [1e-18, 1e18]: at roughness 1 the constant 1/pi. Relative
 * error below 1e-14. May be larger than the largest float. */
double vndf_ggx_ndf(double alpha_x, double alpha_y, vndf_normal wm);

/* Dv(wm) where facing = wi . wm > 0; relative error below 5e-7, that of the view, at every angle. 0 where s is
 * 0 and c negative; may be larger than the largest float. */
double vndf_ggx_visible(const vndf_view *view, vndf_normal wm, double facing);

/* A visible normal, its length from 1e-15 to 3: z >= 0, s x + c z >= 0. u2 lowers and u1 turns, once about z from azimuth -pi to pi,
 * the direction that mirrors (s, 0, c) in the normal; the map is continuous, and u1 = 0 and 1 coincide. */
vndf_vec3 vndf_ggx_sample(float s, float c, float u1, float u2);

/* The uniform numbers that vndf_ggx_sample turns into n, of any length. */
void vndf_ggx_invert(float s, float c, vndf_normal n, float *u1, float *u2);

#endif
