/* D from what a surface sends back to where the light came from, by power iteration (J. Dupuy, E. Heitz, J.-C. Iehl,
 * P. Poulin, V. Ostromoukhov, "Extracting Microfacet-based BRDF Parameters from Arbitrary Materials with Power
 * Iterations", EGSR 2015).
 *
 * There m = wi = wo, and the model (measured/model.h) has f = F0 D(w) / (4 cos (2 A(w) - cos)). Now 2 A(w) - cos is the
 * integral of |w.m| D(m) dm, so that
 *
 *     F0 D(w) = 4 cos f(w) integral |w.m| D(m) dm:
 *
 * D is an eigenvector, and F0 its eigenvalue, where D has the integral 1 over the projected hemisphere. (The paper has
 * the positive part of w.m in the place of |w.m|: it takes masking along the way in and along the same way out as one
 * event. Which of the two holds is a property of the surface; this is the one that the model of all files here has.)
 *
 * Where masking is the product of G1 on both ways instead, as in many programs, f = F0 D(w) / (4 A(w)^2), and D is the
 * fixed point of 4 f A^2 with A of that D. */
#ifndef TOOLS_MEASURED_BRDF_POWER_H
#define TOOLS_MEASURED_BRDF_POWER_H

enum { POWER_ANGLES = 256 };

/* Angles theta[i], the middles of bins from 0 to 90 degrees with the solid angles 2 pi share[i]. */
typedef struct power_bins {
    int count; /* at most POWER_ANGLES */
    double theta[POWER_ANGLES], share[POWER_ANGLES];
} power_bins;

/* Bins that are even in sqrt(theta), as MERL files have them; theta stands `place` of the way through its bin: 1/2 in
 * the middle, 0 at the lower end. */
void power_even(power_bins *made, int count, double place);

typedef enum power_masking { POWER_CORRELATED, POWER_SEPARABLE } power_masking;

/* Replaces ndf[], a first guess or zeros, by the eigenvector (or fixed point) for f[], and *f0 by the eigenvalue.
 * Where f is negative nothing is known: there D is that of the bin before. 0 if there is no light. */
int power_iterate(const power_bins *bins, power_masking masking, const double *f, double *ndf, double *f0);

/* Scales D to the integral 1 over the projected hemisphere; returns what it was. */
double power_normalise(const power_bins *bins, double *ndf);

/* The projected area at an angle, and D between the bins (logarithms where they can be, on theta). */
double power_area(const power_bins *bins, const double *ndf, double theta);
double power_ndf(const power_bins *bins, const double *ndf, double theta);

#endif
