/* Beckmann: its densities, and its sampler in the unit problem: roughness 1, incident direction (s, 0, c), s >= 0;
 * see sampler/ggx.h for what that is and what s and c must carry. Uniform numbers lie in [0, 1]. */
#ifndef VNDF_SAMPLER_BECKMANN_H
#define VNDF_SAMPLER_BECKMANN_H

#include "sampler/closed.h"

/* A1 = c (1 + erf(c/s))/2 + s exp(-(c/s)^2)/(2 sqrt(pi)), relative error below 2e-7 on the whole sphere as
 * long as the result is a normal float; it underflows to 0 beyond c/s = -9 (174 degrees). */
float vndf_beckmann_area(float s, float c);

/* P22 = exp(-r2)/pi at squared slope length r2 in [0, inf). */
double vndf_beckmann_p22(double r2);

/* D(wm) for a unit wm, wm.z >= 0, and alpha within [1e-18, 1e18]: exp(-tan^2)/(pi cos^4) at roughness 1; 0 at the
 * horizon. Relative error below 1e-15 (1 + R^2), R the length of the slope over alpha. */
double vndf_beckmann_ndf(double alpha_x, double alpha_y, vndf_normal wm);

/* Dv(wm) where facing = wi . wm > 0, in double; right where D and the projected area underflow, down to 180 degrees
 * (there 0). Below the horizon Dv falls by exp(-1) within some 1/(2 (c/s)^2) of wm: it is the density of wm as it
 * is rounded to float, 0 if that is a hundred such lengths away. May be larger than the largest float. */
double vndf_beckmann_visible(const vndf_view *view, vndf_normal wm, double facing);

/* A visible normal: unit, z >= 0, s x + c z >= 0. Slopes are (-x/z, -y/z): u1 moves the first from -infinity
 * (normals leaning towards the incident direction) up to c/s, u2 moves the second, on its own, from -infinity
 * to infinity. Both are monotone, continuous inversions. The error in u1 is below 1e-7, absolute and
 * relative, for every direction, 180 degrees included; rounding the normal to float comes on top and is worth up to
 * some 1e-7 (1 + (c/s)^2) below the horizon, where all visible slopes crowd at c/s. Numbers below 2^-64
 * count as 2^-64, and 1 as 1 - 2^-26, which bounds slopes that nothing else would. */
vndf_vec3 vndf_beckmann_sample(float s, float c, float u1, float u2);

/* The inversion alone: d = c/s - x for the slope x that u1 stands for, before anything is rounded to float. */
double vndf_beckmann_slope_distance(float s, float c, float u1);

/* The uniform numbers that vndf_beckmann_sample turns into n, of any length. */
void vndf_beckmann_invert(float s, float c, vndf_normal n, float *u1, float *u2);

#endif
