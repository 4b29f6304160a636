/* Slopes of a map of heights or of normals, and their spread where a pixel of the picture sees many of them at once
 * (LEADR: Dupuy et al., "Linear Efficient Antialiased Displacement and Reflectance Mapping", TOG 32(6), 2013).
 *
 * Slopes are those of the height over the surface: s = (dh/du, dh/dup), where u and up go from 0 to 1 over the image,
 * times a scale. Their first and second moments E s and E s s^T add up, so they are averaged over squares of pixels and
 * interpolated between the middles of squares; the covariance is what is left of the second, E s s^T - E s E s^T. */
#ifndef TOOLS_RENDER_IMAGE_RELIEF_H
#define TOOLS_RENDER_IMAGE_RELIEF_H

#include "render/image/image.h"

typedef struct relief {
    image first;    /* E x, E y, E xx */
    image second;   /* E xy, E yy; empty if nothing is filtered */
    float steepest; /* the largest slope along u or up, before any mean */
} relief;

typedef struct relief_form {
    float scale_x, scale_y;
    int texels; /* the side of the squares, a divisor of both sides of the image; 0: nothing is filtered */
} relief_form;

/* The mean slope, and the covariance: 0 if nothing is filtered. */
typedef struct relief_slopes {
    float mean_x, mean_y, xx, xy, yy;
} relief_slopes;

/* Of heights, the red of the image, at the upper left corners of pixels; it repeats. Between them are two triangles a
 * pixel, cut from the upper left to the lower right: those of geometry_add_displaced. 0 if there is no memory. */
int relief_of_heights(relief *made, const image *heights, const relief_form *form);

/* Of normals: red, green and blue are x, y and z times 1/2, plus 1/2; x is along u, y upwards, blue above 1/2. */
int relief_of_normals(relief *made, const image *normals, const relief_form *form);

void relief_free(relief *freed);

/* u and v are those of image_bilinear. */
void relief_at(const relief *r, float u, float v, relief_slopes *s);

#endif
