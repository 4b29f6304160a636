/* Uniform cubic B-splines that meet given values in their nodes; the third derivative is continuous where the first
 * and the last piece end (not-a-knot). */
#ifndef VNDF_BSDF_ALBEDO_SPLINE_H
#define VNDF_BSDF_ALBEDO_SPLINE_H

#include "bsdf/albedo/albedo.h"

/* The coefficients are `matrix` times the values: nodes + 2 rows of `nodes` numbers. */
typedef struct vndf_spline {
    uint32_t nodes;
    double *matrix; /* owned */
} vndf_spline;

/* nodes >= 5; 0 if there is no memory. */
int vndf_spline_of(vndf_spline *spline, uint32_t nodes);
void vndf_spline_free(vndf_spline *spline);

/* Coefficients of the values value[0], value[stride], ...; coefficients stand `pitch` apart. */
void vndf_spline_fit(const vndf_spline *spline, const double *value, size_t stride, double *coefficient,
                     size_t pitch);

#endif
