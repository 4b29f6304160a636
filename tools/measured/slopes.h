/* The law of slopes of a surface that was measured: P22 over the slope length, whether it is isotropic, and how sure
 * all that is.
 *
 * The mean slope is taken off. The shape of the rest is Tyler's: the matrix V of determinant 1 with V = (2/n) sum s
 * s^T / (s^T V^-1 s), which exists where the second moment does not (D. Tyler, "A Distribution-Free M-Estimator of
 * Multivariate Scatter", Annals of Statistics 15, 1987). If V is the identity within its error, the slopes are taken
 * as isotropic. If not, s = M u with M = V^1/2, and the rows are of u: the surface is the affine one with this
 * matrix.
 *
 * Bins of |u| hold equal parts of the slopes, and finer ones of the tail; the rows are multiplied until the curve
 * through them has the mass of every bin. After the last row a tail follows, unless it had too much mass beyond the
 * longest slope: then slopes end abruptly, and the curve ends with 0 there. Errors come from the spread between 64
 * parts of the surface: neighbouring slopes are not independent, parts nearly are. */
#ifndef TOOLS_MEASURED_SLOPES_H
#define TOOLS_MEASURED_SLOPES_H

#include "measured/data.h"

enum { SLOPE_PARTS = 64, SLOPES_LEAST = 1000 };

/* Slopes of points of a surface, and the part of it, 0 to SLOPE_PARTS - 1, where each lies. */
typedef struct slope {
    float x, y;
    int part;
} slope;

typedef struct slope_set {
    slope *at; /* owned; room for as many as were asked for */
    size_t count;
    double quantum; /* the least difference that slopes can have, 0 of floats: no bin is narrower than two */
} slope_set;

/* Room for `room` slopes, none of them there. */
int slopes_make(slope_set *made, size_t room, data_file *file);
void slopes_free(slope_set *freed);
void slopes_add(slope_set *to, double x, double y, int part);

/* Turns the slopes into u, notes what was found, and makes rows of P22 over |u|. Refused are fewer than SLOPES_LEAST
 * slopes, and such as are all alike or lie on a line. */
int slopes_law(slope_set *slopes, data_file *file, profile *rows);

/* The mass of slopes between two lengths, integral P22 2 pi r dr; `to` may be infinite. Of a source as it is given.
 */
double slope_mass(const vndf_source *source, double from, double to);

#endif
