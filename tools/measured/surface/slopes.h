/* The law of slopes of a surface that was measured: P22 over the slope length, whether it is isotropic, and how sure
 * all that is.
 *
 * The mean slope is taken off. The shape of the rest is Tyler's: the matrix V of determinant 1 with V = (2/n) sum s s^T
 * / (s^T V^-1 s), which exists where the second moment does not (D. Tyler, "A Distribution-Free M-Estimator of
 * Multivariate Scatter", Annals of Statistics 15, 1987). If V is the identity within its error, the slopes are taken as
 * isotropic. If not, s = M u with M = V^1/2, and the rows are of u: the surface is the affine one with this matrix.
 *
 * Bins of |u| hold equal parts of the slopes, and finer ones of the tail; the rows are multiplied until the curve
 * through them has the mass of every bin. After the last row a tail follows, unless it would have too much mass beyond
 * the longest slope: then slopes end abruptly, and the curve ends with 0 there. Errors come from 64 parts of the
 * surface, drawn again 200 times (bootstrap): neighbouring slopes are not independent, parts nearly are. */
#ifndef TOOLS_MEASURED_SURFACE_SLOPES_H
#define TOOLS_MEASURED_SURFACE_SLOPES_H

#include "measured/profile.h"

enum { SLOPE_PARTS = 64, SLOPES_LEAST = 1000 };

/* Slopes of points of a surface, and the part of it, 0 to SLOPE_PARTS - 1, where each lies. */
typedef struct slope_set {
    float *x, *y;        /* owned */
    unsigned char *part; /* owned */
    size_t count, room;
    double
        quantum; /* the least difference that slopes can have, 0 if they are floats: no bin is narrower than two */
} slope_set;

/* Room for `room` slopes, none of them there. 0 if there is no memory. */
int slopes_make(slope_set *made, size_t room);
void slopes_free(slope_set *freed);
void slopes_add(slope_set *to, double x, double y, int part);

/* What was found. The matrix is M = {xx, xy, yy}, and 1, 0, 1 where the slopes are isotropic. */
typedef struct slope_law {
    profile rows; /* owned: P22 over |u| */
    double tilt_x, tilt_y;
    double rms;                          /* of the slope along one axis: sqrt(mean |s|^2 / 2) */
    double anisotropy, anisotropy_error; /* the larger axis of V^1/2 over the smaller */
    double matrix[3];
    int is_anisotropic;
    double residual; /* the part of all slopes that would have to turn about z to make u isotropic */
    double noise;    /* the residual that chance alone makes of so many independent parts */
} slope_law;

/* Moves the slopes to mean 0. Writes what was found to *to. 0 and the reason if there is no law: fewer than
 * SLOPES_LEAST slopes, all of them 0, all on a line. */
int slopes_law(slope_set *slopes, const char *name, slope_law *law, notes *to, refusal *why);

#endif
