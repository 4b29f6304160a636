/* The two kinds of panel of a figure: D against the angle of the normal, and the visible normals from one incident
 * direction on a disc. Boxes hold the labels too. */
#pragma once

#include "draw/svg.h"
#include "vndf.h"

enum { PANEL_DOTS = 350 }; /* samples of a disc: two random_float each of random_from(seed), in this order */

/* D(theta_m) on a logarithmic scale, along x and along y where the roughness differs, beside GGX of the same
 * median slope. */
void panel_ndf(FILE *file, svg_box box, const vndf_surface *surface);

/* Visible normals from (theta, azimuth 0): density as colour, samples as dots, on the hemisphere seen from above
 * in the equal-area projection (radius ~ sin(theta_m/2)), so that dots are as dense as the colour says. The rim
 * is the smallest round angle that holds 95% of the samples. 0: no memory. */
int panel_disc(FILE *file, svg_box box, const vndf_surface *surface, double theta, unsigned seed);

/* What colour, dots and marks of the discs mean. 0: no memory. */
int panel_key(FILE *file, double x, double y);
