/* The map from the unit square to a density on it that is bilinear between the points of a grid, as Mitsuba and pbrt
 * read .bsdf files: first y by the sums of rows, then x along the mixture of two rows. */
#ifndef TOOLS_MEASURED_RGL_WARP_H
#define TOOLS_MEASURED_RGL_WARP_H

typedef struct warp {
    int width, height;
    const double *density; /* height rows of width, at i/(width - 1), j/(height - 1); the caller's, >= 0 */
    double *along;         /* owned: the integral of each row up to each point, in units of a cell */
    double *up;            /* owned: the integral of the row sums up to each row */
} warp;

/* 0 if there is no memory, or the density is 0 everywhere. Both sides are 2 at least. */
int warp_make(warp *made, const double *density, int width, int height);
void warp_free(warp *freed);

/* Where the uniform numbers s go. */
void warp_sample(const warp *of, double s_x, double s_y, double *x, double *y);

#endif
