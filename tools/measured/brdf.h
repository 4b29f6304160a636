/* Files of reflectances, by the model of measured/model.h: each reader makes rows of D over theta. */
#ifndef TOOLS_MEASURED_BRDF_H
#define TOOLS_MEASURED_BRDF_H

#include "measured/model.h"

/* ---- RGL ----------------------------------------------------------------------------------------- */

/* The .bsdf files of EPFL's realistic graphics lab (J. Dupuy, W. Jakob, "An Adaptive Parameterization for Efficient
 * Material Acquisition and Rendering", TOG 37(6), 2018): tensor files that Mitsuba 3 (plugin `measured`) and pbrt-v4
 * render.
 *
 * An angle theta from z stands at u = sqrt(2 theta/pi), an azimuth phi at (phi + pi)/(2 pi); of an isotropic material
 * azimuths of normals are counted from wi. The fields are
 *
 *     theta_i [n], phi_i [1]     incident directions, radians
 *     ndf [2][.]                 D over u: the material's own, at any scale
 *     sigma [2][.]               projected area A over u of wi, at the same scale
 *     vndf [1][n][phi][theta]    density of visible normals over the unit square of (u, v)
 *     luminance, rgb or spectra  [1][n](channels)[y][x]: what is reflected over what single scattering without masking
 *                                of wo would, f cos_o 4 A / D, at the normal where the vndf's warp sends (x, y)
 *     wavelengths                of spectra, nm
 *     jacobian [1] = 1           rgb and spectra are still to be multiplied by D/(4 A) */

#define RGL_ANISOTROPY_MOST 0.05

/* D over theta, the mean of `ndf` over azimuths, smoothed within its noise. A material whose D strays from that mean
 * by more than RGL_ANISOTROPY_MOST is refused with the measure. Noted is how well that D explains what else the file
 * holds: the F0 and F90 of the mean of all channels whose model (measured/model.h) is nearest, and the part of the
 * light that it has elsewhere. */
int rgl_read(data_file *file, profile *rows);

enum { RGL_CHANNELS = 16 };

typedef struct rgl_form {
    float alpha;                    /* roughness, isotropic */
    int channels;                   /* 3 of rgb, or as many as there are wavelengths */
    double f0[RGL_CHANNELS];        /* reflectance at normal incidence; F is Schlick's */
    int is_spectral;                /* spectra and wavelengths, for spectral hosts, in the place of rgb */
    float wavelength[RGL_CHANNELS]; /* ascending */
    const char *description;
} rgl_form;

/* Writes single scattering of the distribution (measured/model.h) to an open file; 0 if there is no memory, or that
 * fails. Some 3 MiB for three channels. */
int rgl_write(FILE *file, const vndf_distribution *distribution, const rgl_form *form);

/* ---- MERL ---------------------------------------------------------------------------------------- */

/* MERL files (W. Matusik, H. Pfister, M. Brand, L. McMillan, "A Data-Driven Reflectance Model", SIGGRAPH 2003): three
 * numbers of 32 bits, 90 90 180 (or 360), then red, green and blue, each 90 x 90 x 180 doubles, the azimuth fastest;
 * all with the least byte first. f is a number times 1/1500, 1.15/1500 and 1.66/1500. Its bins, counted from the half
 * vector h: theta_h even in its square root from 0 to 90 degrees, theta_d even, phi_d even over half a turn. A number
 * is taken as f in the middle of its bin, and masked with heights correlated.
 *
 * D comes from what the surface sends back to where the light came from, by power iteration (J. Dupuy, E. Heitz,
 * J.-C. Iehl, P. Poulin, V. Ostromoukhov, "Extracting Microfacet-based BRDF Parameters from Arbitrary Materials with
 * Power Iterations", EGSR 2015). There m = wi = wo, and the model (measured/model.h) has f = F0 D(w) / (4 cos (2 A(w)
 * - cos)). Now 2 A(w) - cos is the integral of |w.m| D(m) dm, so that
 *
 *     F0 D(w) = 4 cos f(w) integral |w.m| D(m) dm:
 *
 * D is an eigenvector, and F0 its eigenvalue, where D has the integral 1 over the projected hemisphere. (The paper
 * has the positive part of w.m in the place of |w.m|: it takes masking along the way in and along the same way out as
 * one event. Which of the two holds is a property of the surface; this is the one that the model of all files here
 * has.) */

typedef enum merl_channel { MERL_RED, MERL_GREEN, MERL_BLUE, MERL_LUMINANCE } merl_channel;

/* D over theta of one channel, by the light that goes back less a constant, the diffuse part, chosen so that D
 * explains all of the file best. Noted are that part (pi f, an albedo), F0 and F90 of Schlick's F, the part of the
 * light that the model has elsewhere, and F0 of each channel by itself, diffuse light counted in. */
int merl_read(data_file *file, merl_channel channel, profile *rows);

/* The fixed point for f[] at the bins of *l, from any D there, and its F0; negative where nothing is known: D is that
 * of the bin before. 0 if there is no light. */
int merl_iterate(law *l, const double *f, double *f0);

#endif
