/* Goniometer tables: reflectances in the plane of incidence, as CSV.
 *
 * A header line names three columns in any order: theta_i, theta_o (degrees) and brdf (f per steradian) or intensity
 * (f cos theta_o); then a row for each measurement, at any scale. theta_o is counted from z towards the side where a
 * mirror would send the light: the mirror direction is theta_o = theta_i, the way back theta_o = -theta_i. Blank
 * lines and lines that begin with # are skipped.
 *
 * The half vector is at theta_h = |theta_o - theta_i|/2, and the model (measured/model.h) solved for D is
 *
 *     D(theta_h) = 4 f (A_i cos_o + A_o cos_i - cos_i cos_o) / F.
 *
 * A follows from D, so this is iterated from A = cos. The scale of D, which has the integral 1, gives F0. Where it is
 * above 1 the data have another scale, and F is taken as constant. */
#ifndef TOOLS_MEASURED_BRDF_GONIO_H
#define TOOLS_MEASURED_BRDF_GONIO_H

#include "measured/profile.h"

enum { GONIO_POINTS_MAX = 1000000 };

typedef struct gonio_point {
    double theta_i, theta_o; /* radians */
    double f;
} gonio_point;

typedef struct gonio_points {
    gonio_point *at; /* owned */
    size_t count;
} gonio_points;

/* Reads the CSV. Returns 1, or 0 and the reason with the line; untrusted bytes are safe. */
int gonio_read(gonio_points *made, const char *name, const char *bytes, size_t size, refusal *why);
void gonio_free(gonio_points *freed);

/* D over theta_h. f0: that of Schlick's F; below 0: found from the scale. Directions beyond 85 degrees are left out.
 * Writes to *to: F0, and the part of the light that the model has elsewhere. 0 and the reason if there is no D. */
int gonio_law(const gonio_points *points, double f0, const char *name, profile *rows, notes *to, refusal *why);

#endif
