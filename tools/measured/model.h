/* What every reader and writer of reflectances takes for granted: light that facets mirror once, masked as Smith says
 * with heights correlated,
 *
 *     f cos_o = F D(m) G2 / (4 cos_i) = F R D(m) / (4 A_i),    R = A_i cos_o / (A_i cos_o + A_o cos_i - cos_i cos_o),
 *
 * where m is half way between wi and wo, A the projected area and R = G2/G1(wi): what is left of light that left the
 * facets which wi sees. F = F0 + (F90 - F0) (1 - wi.m)^5 (Schlick). R is finite at grazing incidence. */
#ifndef TOOLS_MEASURED_MODEL_H
#define TOOLS_MEASURED_MODEL_H

#include "vndf.h"

typedef struct direction {
    double x, y, z;
} direction;

/* At theta from z and phi from x, radians. */
direction direction_at(double theta, double phi);

double direction_dot(direction a, direction b);

/* w mirrored at m. */
direction direction_mirrored(direction w, direction m);

/* Half way between two directions, unit. */
direction direction_between(direction a, direction b);

/* D and A of an isotropic surface at an angle from z. */
double model_ndf(const vndf_surface *surface, double theta);
double model_area(const vndf_surface *surface, direction w);

/* R; 0 where wo is below the horizon. */
double model_masked(double area_i, double cos_i, double area_o, double cos_o);

/* (1 - cosine)^5 */
double model_schlick(double cosine);

/* D R / (4 A_i), f cos_o where F is 1; 0 below the horizon. */
double model_reflected(const vndf_surface *surface, direction wi, direction wo);

#endif
