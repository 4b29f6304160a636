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
#ifndef TOOLS_MEASURED_RGL_RGL_H
#define TOOLS_MEASURED_RGL_RGL_H

#include <stdio.h>

#include "measured/profile.h"

/* ---- in ---- */

/* D over theta, the mean of `ndf` over azimuths. A material whose D strays from that mean by more than
 * RGL_ANISOTROPY_MOST is refused with the measure. Returns 1, or 0 and the reason; untrusted bytes are safe. */
#define RGL_ANISOTROPY_MOST 0.05
int rgl_read(profile *rows, const char *name, const unsigned char *bytes, size_t size, notes *to, refusal *why);

/* The same of an anisotropic material, as an isotropic D under a matrix: slopes are drawn evenly from `ndf`, and
 * their law is that of measured/surface/slopes.h, whose lines go to *to, the matrix among them. */
int rgl_fit(profile *rows, const char *name, const unsigned char *bytes, size_t size, notes *to, refusal *why);

/* How well a surface with that D explains the rest of the file: how far `sigma` is from its area, at most, up to 85
 * degrees; the F0 and F90 of the mean of all channels whose model (measured/model.h) is nearest, and the part of the
 * light that it has elsewhere. What the file does not hold is left out. */
void rgl_residuals(const vndf_surface *surface, const char *name, const unsigned char *bytes, size_t size,
                   notes *to);

/* ---- out ---- */

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

#endif
