/* Reflection and refraction on a rough surface once more, in double, from the published formulas alone and
 * sharing no code with src/: Walter et al. 2007 (half vectors equations 13 and 16, Jacobians 14 and 17, f 20 and
 * 21), Heitz 2014 (Smith's G1 and G2, equations 43, 98, 99), Heitz et al. 2016 (transmission), Cook & Torrance's
 * V-cavities; D and areas of oracle.h, summed over the lobes of a mixture, with the mean plane in the place
 * of z = 0. Fresnel's equations by complex arithmetic in long double. Lambda is kept as the projected area
 * A = cos (1 + Lambda), which stays finite; the formulas divide as they are printed. */
#pragma once

#include "oracle/oracle.h"
#include "vndf_bsdf.h"

typedef struct oracle_ndf {
    oracle slopes;
    const char *name;
    const vndf_distribution *distribution;
    vndf_distribution *owned; /* a table's */
    oracle_table table;
} oracle_ndf;

/* "ggx", "beckmann", the name of a shipped table without its ending, or a family like "student-t:1.6", which is
 * built; 0 after printing why there is none. It must not move. */
int oracle_ndf_open(oracle_ndf *ndf, const char *name);
void oracle_ndf_close(oracle_ndf *ndf);

/* Unpolarised reflectance for the index n + ik beyond over that before, n + k > 0. */
long double oracle_fresnel(long double cosine, long double n, long double k);

/* ---- materials ---- */

enum { ORACLE_LOBES = 3 };

typedef struct oracle_bsdf {
    vndf_description is;
    oracle_surface lobe[ORACLE_LOBES];
    double weight[ORACLE_LOBES], mean[2]; /* the weights sum to 1 */
    int count;
    int lengths; /* directions are taken with the lengths that they have, else they are made unit */
} oracle_bsdf;

/* Of a single scattering; ndf[i] is that of lobe i of a mixture, ndf[0] that of other shapes. */
oracle_bsdf oracle_bsdf_from(const vndf_description *is, const oracle_ndf *const ndf[]);

typedef struct oracle_value {
    double f[VNDF_WAVELENGTHS];
    double pdf; /* negative for bounded normals: their law is the library's own */
} oracle_value;

oracle_value oracle_bsdf_eval(const oracle_bsdf *o, const double wi[3], const double wo[3]);

/* The projection of w on the mean plane, and the cosine of its angle to the normal of that. */
double oracle_bsdf_rise(const oracle_bsdf *o, const double w[3]);
double oracle_bsdf_cosine(const oracle_bsdf *o, const double w[3]);

int oracle_bsdf_two_sided(const vndf_effects *effects);

/* All of them but compensation, sensible or not, numbered from 0. */
enum { ORACLE_EFFECT_SETS = 3 * 4 * 4 * 4 * 2 * 3 * 2 * 2 };
vndf_effects oracle_effects(size_t index);

/* By what vndf_bsdf.h says of each effect. */
int oracle_effects_sensible(const vndf_effects *effects);

void oracle_from_vec3(vndf_vec3 w, double out[3]);

/* At cosine z (of either sign) and azimuth phi, radians; unit within rounding to float. */
vndf_vec3 oracle_toward(double z, double phi);
