/* GGX (Trowbridge-Reitz) in the unit problem: roughness 1, incident direction (s, 0, c), s >= 0.
 *
 * The unit problem is what remains of any roughness and direction after the stretch and the rotation about z
 * (design: w = (alpha_x wi.x, alpha_y wi.y, wi.z) / length). s and c are sine and cosine within rounding,
 * c of either sign; each must carry its own relative precision, which is where the precision near
 * c = 0 and c = -1 comes from. Uniform numbers lie in [0, 1]. */
#ifndef VNDF_SAMPLER_GGX_H
#define VNDF_SAMPLER_GGX_H

#include "vndf.h"

/* A1 = c (1 + Lambda) = (1 + c)/2, relative error below 3e-7 wherever s*s does not underflow. */
float vndf_ggx_area(float s, float c);

/* P22 = 1/(pi (1 + r2)^2) at squared slope length r2 in [0, inf]. */
float vndf_ggx_p22(float r2);

/* D at roughness 1: 1/pi on the whole hemisphere, its rim included; 0 for n.z < 0. */
float vndf_ggx_ndf(vndf_vec3 n);

/* A visible normal: unit, z >= 0, s x + c z >= 0. u2 lowers and u1 turns, once about z from azimuth -pi to pi,
 * the direction that mirrors (s, 0, c) in the normal; the map is continuous, and u1 = 0 and 1 coincide. */
vndf_vec3 vndf_ggx_sample(float s, float c, float u1, float u2);

/* The uniform numbers that vndf_ggx_sample turns into wm. */
void vndf_ggx_invert(float s, float c, vndf_vec3 wm, float *u1, float *u2);

#endif
