/* Beckmann in the unit problem: roughness 1, incident direction (s, 0, c), s >= 0; see sampler/ggx.h for what
 * that is and what s and c must carry. Uniform numbers lie in [0, 1]. Densities: closed.h. */
#ifndef VNDF_SAMPLER_BECKMANN_H
#define VNDF_SAMPLER_BECKMANN_H

#include "sampler/closed.h"

/* One incident direction: K, and F(K) with a factor that beckmann.c says, and what F(x) for x > 0 has more than
 * F for x < 0. */
typedef struct vndf_beckmann_law {
    double bound, whole, line;
} vndf_beckmann_law;

vndf_beckmann_law vndf_beckmann_law_at(float s, float c);

/* vndf_beckmann_area, with less to do for s < c. */
float vndf_beckmann_area_of(const vndf_beckmann_law *law, float s, float c);

/* K = c/s. At s = 0 a slope bound of 1e30 stands for infinity: no float tells the difference. */
VNDF_INLINE double vndf_beckmann_bound(float s, float c)
{
    return c / (s > 1e-30f ? (double)s : 1e-30);
}

/* The slopes that vndf_beckmann_sample makes its normal of, and d = K - x. */
typedef struct vndf_beckmann_slopes {
    double x, y, d;
} vndf_beckmann_slopes;

/* The part F(x)/F(K) of the law at x = K - d, to 1e-8 of itself, and the slope x at a part u of it, as drawn. */
double vndf_beckmann_part(const vndf_beckmann_law *law, double x, double d);
double vndf_beckmann_slope(const vndf_beckmann_law *law, double u);

vndf_beckmann_slopes vndf_beckmann_draw(const vndf_beckmann_law *law, float u1, float u2);

/* A1 = c (1 + erf(c/s))/2 + s exp(-(c/s)^2)/(2 sqrt(pi)), relative error below 2e-7 on the whole sphere as
 * long as the result is a normal float; it underflows to 0 beyond c/s = -9 (174 degrees). */
float vndf_beckmann_area(float s, float c);

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
