/* Reflection and refraction on a rough surface once more, in double, from the published formulas alone and
 * sharing no code with src/: Walter et al. 2007 (half vectors equations 13 and 16, Jacobians 14 and 17, f 20 and
 * 21), Heitz 2014 (Smith's G1 and G2, equations 43, 98, 99), Heitz et al. 2016 (transmission), Cook & Torrance's
 * V-cavities; D and Lambda of GGX and Beckmann in closed form, those of a table from the bytes of its file
 * (oracle_table.h). Fresnel's equations by complex arithmetic in long double. Lambda is kept as the projected
 * area A = cos (1 + Lambda), which stays finite; the formulas divide as they are printed. */
#ifndef TESTS_ORACLE_ORACLE_BSDF_H
#define TESTS_ORACLE_ORACLE_BSDF_H

#include <stddef.h>

#include "oracle/oracle_surface.h"
#include "vndf_bsdf.h"

/* ---- distributions ---- */

typedef struct oracle_ndf {
    oracle_kind kind;
    const char *name;
    const vndf_distribution *distribution;
    vndf_distribution *owned; /* a table's */
    oracle_table table;
} oracle_ndf;

/* "ggx", "beckmann" or the name of a shipped table without its ending; 0 after printing why there is none. */
int oracle_ndf_open(oracle_ndf *ndf, const char *name);
void oracle_ndf_close(oracle_ndf *ndf);

/* wm and w of any length, in the frame of the roughness. */
double oracle_ndf_density(const oracle_ndf *ndf, const double alpha[2], const double wm[3]);
double oracle_ndf_area(const oracle_ndf *ndf, const double alpha[2], const double w[3]);

/* The density with which visible normals are drawn: max(0, wi.wm) D/A, or what the table has for it; unit
 * vectors. */
double oracle_ndf_visible(const oracle_ndf *ndf, const double alpha[2], const double wi[3], const double wm[3]);

/* The density with which all normals are drawn: D cos(theta_m), or what the table has for it. */
double oracle_ndf_all(const oracle_ndf *ndf, const double alpha[2], const double wm[3]);

/* ---- optics ---- */

/* Unpolarised reflectance for the index n + ik beyond over that before, n + k > 0. */
long double oracle_fresnel(long double cosine, long double n, long double k);

/* ---- materials ---- */

/* `lengths`: directions are taken with the lengths that they have, else they are made unit. */
typedef struct oracle_bsdf {
    const oracle_ndf *ndf;
    vndf_description is;
    int lengths;
} oracle_bsdf;

typedef struct oracle_value {
    double f[VNDF_WAVELENGTHS];
    double pdf; /* negative for bounded normals: their law is the library's own */
    double fresnel[VNDF_WAVELENGTHS];
} oracle_value;

oracle_value oracle_bsdf_eval(const oracle_bsdf *o, const double wi[3], const double wo[3]);

/* Index beyond over that on the side of wi. */
double oracle_bsdf_ratio(const oracle_bsdf *o, const double wi[3]);
int oracle_bsdf_two_sided(const vndf_effects *effects);

/* Reflectances at a microfacet. */
void oracle_bsdf_fresnel(const oracle_bsdf *o, double cosine, double ratio, double f[VNDF_WAVELENGTHS]);

/* ---- effect sets ---- */

/* All of them, sensible or not, numbered from 0. */
enum { ORACLE_EFFECT_SETS = 3 * 4 * 4 * 4 * 2 * 2 * 2 };
vndf_effects oracle_effects(size_t index);

/* By what vndf_bsdf.h says of each effect. */
int oracle_effects_sensible(const vndf_effects *effects);

/* "both dielectric separable visible radiance rotated"; text has room for it. */
enum { ORACLE_EFFECTS_TEXT = 128 };
void oracle_effects_name(const vndf_effects *effects, char text[ORACLE_EFFECTS_TEXT]);

/* ---- directions ---- */

void oracle_from_vec3(vndf_vec3 w, double out[3]);

/* At cosine z (of either sign) and azimuth phi, radians; unit within rounding to float. */
vndf_vec3 oracle_toward(double z, double phi);

#endif
