/* Functions on grids over the unit square, at i/(width - 1), j/(height - 1), bilinear between these. */
#ifndef TOOLS_MEASURED_GRID_H
#define TOOLS_MEASURED_GRID_H

/* The map from the unit square to a density on it, as Mitsuba and pbrt read .bsdf files: first y by the sums of rows,
 * then x along the mixture of two rows. */
typedef struct warp {
    int width, height;
    const double *density; /* height rows of width; the caller's, >= 0 */
    double *along;         /* owned: the integral of each row up to each point, in units of a cell */
    double *up;            /* owned: the integral of the row sums up to each row */
} warp;

/* 0 if there is no memory, or the density is 0 everywhere. Both sides are 2 at least. */
int warp_make(warp *made, const double *density, int width, int height);
void warp_free(warp *freed);

/* Where the uniform numbers s go. */
void warp_sample(const warp *of, double s_x, double s_y, double *x, double *y);

enum { FIT_SIDE_MAX = 64 };

/* The function on a grid of side^2 numbers that is near `value` in the middles of points x points parts of each cell,
 * ((side - 1) points)^2 numbers. The first step gives each point of the grid the mean of the parts around it, weighed
 * by its hat; more steps add the means of what is left, which comes to least squares in the limit. After any step the
 * grid has the integral of `value`. Parts where is_known (NULL: everywhere) is 0 do not count: where a function ends,
 * interpolation between points would halve it in the cells of its end; here it goes on beyond as it likes. */
void grid_fit(const float *value, const float *is_known, int side, int points, int steps, double *grid);

#endif
