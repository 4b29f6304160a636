/* Chi-square over all normals that face a direction, for any density of normals. The frame is an affine image of the
 * slopes, in polar form (R, a) about the direction: where R is given the normals that are seen are those with
 * |a| < A(R), and a over A runs from -1 to 1, so that no border cuts a bin. */
#ifndef TESTS_STATISTICS_SLOPES_H
#define TESTS_STATISTICS_SLOPES_H

#include <stddef.h>

#include "vndf.h"

typedef struct slope_frame {
    double xx, xy, yx, yy, mean_x, mean_y, det; /* slope = M (R cos, R sin) + mean */
    double s, c, x, y;                          /* the direction in it: (s, 0, c) after a turn by (x, y) */
} slope_frame;

/* Of the matrix of `shape` times its distribution's median slope, its mean slope, and wi. */
slope_frame slope_frame_from(const vndf_affine *shape, vndf_vec3 wi);

/* The normal where its slopes are over the matrix, unit, turned to wi: (slope cos, slope sin) ~ (x, y)/z. */
void slope_over(const slope_frame *f, vndf_vec3 wm, double n[3]);

/* A function per steradian at the unit normal wm. */
typedef double slope_function(const double wm[3], const void *of);

/* A sampler, and its density. */
typedef vndf_vec3 slope_draw(const void *of, float u1, float u2, float *pdf);

typedef struct slope_test {
    double p;      /* of the chi-square; 0 if it has few classes */
    double mass;   /* integral of the density */
    size_t unseen; /* samples that do not face the direction, or whose density is not a positive float */
    size_t classes;
} slope_test;
slope_test slope_chi_square(const slope_frame *frame, slope_draw *draw, slope_function *pdf, const void *of,
                            size_t samples, unsigned long long seed);

#endif
