/* Beckmann in the unit problem: roughness 1, incident direction (s, 0, c), s >= 0; see sampler/analytic/ggx.h for what
 * that is and what s and c must carry. Uniform numbers lie in [0, 1]. In double, for what beckmann_draw.h does not
 * do in float. Densities: analytic_density.h. */
#ifndef VNDF_SAMPLER_ANALYTIC_BECKMANN_H
#define VNDF_SAMPLER_ANALYTIC_BECKMANN_H

#include "sampler/analytic_density.h"

/* K = c/s. At s = 0 a slope bound of 1e30 stands for infinity: no float tells the difference. */
VNDF_INLINE double vndf_beckmann_bound(float s, float c)
{
    return c / (s > 1e-30f ? (double)s : 1e-30);
}

/* One incident direction: K; (2 sqrt(pi)/s) F(K); and what that has for x > 0 more than for x < 0, 2 sqrt(pi) K.
 * For K < 5/4 the last two are divided by exp(-K^2), so that nothing underflows below the horizon; above that
 * they are not, so that nothing overflows. */
typedef struct vndf_beckmann_law {
    double bound, whole, line;
} vndf_beckmann_law;

vndf_beckmann_law vndf_beckmann_law_at(float s, float c);

/* The part F(x)/F(K) of the law at x = K - d, to 1e-8 of itself, and the slope x at a part u of it, as drawn. */
double vndf_beckmann_part(const vndf_beckmann_law *law, double x, double d);
double vndf_beckmann_slope(const vndf_beckmann_law *law, double u);

/* A visible normal: unit, z >= 0, s x + c z >= 0. Slopes are (-x/z, -y/z): u1 moves the first from -infinity
 * (normals leaning towards the incident direction) up to c/s, u2 moves the second, on its own, from -infinity
 * to infinity. Both are monotone, continuous inversions. The error in u1 is below 1e-7, absolute and
 * relative, for every direction, 180 degrees included; rounding the normal to float comes on top and is worth up
 * to some 1e-7 (1 + (c/s)^2) below the horizon, where all visible slopes crowd at c/s. Numbers below 2^-64
 * count as 2^-64, and 1 as 1 - 2^-26, which bounds slopes that nothing else would. */
vndf_vec3 vndf_beckmann_sample(float s, float c, float u1, float u2);

/* The inversion alone: d = c/s - x for the slope x that u1 stands for, before anything is rounded to float. */
double vndf_beckmann_slope_distance(float s, float c, float u1);

/* The uniform numbers that vndf_beckmann_sample turns into n, of any length. */
void vndf_beckmann_invert(float s, float c, vndf_normal n, float *u1, float *u2);

#endif
