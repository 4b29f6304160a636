/* Files of reflectances, and the model that their readers and writers take for granted: light that facets mirror
 * once, masked as Smith says with heights correlated,
 *
 *     f cos_o = F D(m) G2 / (4 cos_i) = F R D(m) / (4 A_i),    R = A_i cos_o / (A_i cos_o + A_o cos_i - cos_i cos_o),
 *
 * where m is half way between wi and wo, A the projected area and R = G2/G1(wi): what is left of light that left the
 * facets which wi sees. F = F0 + (F90 - F0) (1 - wi.m)^5 (Schlick). R is finite at grazing incidence. */
#ifndef TOOLS_MEASURED_BRDF_H
#define TOOLS_MEASURED_BRDF_H

#include "measured/data.h"
#include "render/vector.h"
#include "vndf.h"

/* At theta from z and phi from x, radians. */
vec3 direction_at(double theta, double phi);

/* w mirrored at m. */
vec3 direction_mirrored(vec3 w, vec3 m);

/* R; 0 where wo is below the horizon. */
double model_masked(double area_i, double cos_i, double area_o, double cos_o);

/* (1 - cosine)^5 */
double model_schlick(double cosine);

/* D and A of an isotropic surface that the library knows, at an angle from z. */
double model_ndf(const vndf_surface *surface, double theta);
double model_area(const vndf_surface *surface, double theta);

/* ---- D that was measured ------------------------------------------------------------------------- */

enum { LAW_ANGLES = 256, LAW_AREAS = 181 };

/* D at angles theta[i], the middles of bins from 0 to 90 degrees that are even in sqrt(theta), as MERL files have
 * them; their solid angles are 2 pi share[i]. Its projected area every half degree. 400 KB. */
typedef struct law {
    int count; /* at most LAW_ANGLES */
    double theta[LAW_ANGLES], share[LAW_ANGLES], ndf[LAW_ANGLES], area[LAW_AREAS];
    double both_sides[LAW_AREAS][LAW_ANGLES]; /* what a bin with D = 1 adds to the integral of |w.m| D(m) dm */
} law;

/* The bins, with D = 0. */
void law_even(law *made, int count);

/* Scales D to the integral 1 over the projected hemisphere and finds its areas; returns what the integral was. */
double law_normalise(law *changed);

/* D of a curve, normalised; returns what its integral was. */
double law_of_source(law *made, const vndf_source *source);

/* Between the middles of bins: of D logarithms, where they can be. */
double law_ndf(const law *of, double theta);
double law_area(const law *of, double theta);

/* ---- F that was measured ------------------------------------------------------------------------- */

/* Light that was found, and what the model has there with F = 1 - rise and with F = rise; how much the light weighs,
 * and how much the square of what is left. */
typedef struct probe {
    double found, low, high, light, weight;
} probe;

typedef struct reflectance {
    double f0, f90;  /* nearest by least squares */
    double residual; /* half of |found - model| over what was found */
} reflectance;

/* 0 if the probes do not tell. */
int model_reflectance(const probe *probes, size_t count, reflectance *found);

/* ---- files; rgl.c and merl.c say what they hold ---- */

#define RGL_ANISOTROPY_MOST 0.05

/* D over theta, the mean of `ndf` over azimuths, smoothed within its noise. A material whose D strays from that mean
 * by more than RGL_ANISOTROPY_MOST is refused with the measure. Noted is how well that D explains what else the file
 * holds: the F0 and F90 of the mean of all channels whose model is nearest, and the part of the
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

/* Writes single scattering of the distribution to an open file; 0 if there is no memory, or that
 * fails. Some 3 MiB for three channels. */
int rgl_write(FILE *file, const vndf_distribution *distribution, const rgl_form *form);

typedef enum merl_channel { MERL_RED, MERL_GREEN, MERL_BLUE, MERL_LUMINANCE } merl_channel;

/* D over theta of one channel, by the light that goes back less a constant, the diffuse part, chosen so that D
 * explains all of the file best. Noted are that part (pi f, an albedo), F0 and F90 of Schlick's F, the part of the
 * light that the model has elsewhere, and F0 of each channel by itself, diffuse light counted in. */
int merl_read(data_file *file, merl_channel channel, profile *rows);

#endif
