/* vndf_albedo.h - how much light single scattering sends on, for any distribution: the data behind energy
 * compensation.
 *
 * A BSDF of one scattering event loses the light that meets the surface twice. The directional albedo
 *
 *     E(wi) = integral f(wi, wo) |cos_o| dwo
 *
 * says how much it keeps. Kulla & Conty ("Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017
 * course) give the rest back by a lobe (1 - E(wi)) (1 - E(wo))/(pi (1 - E_avg)), E_avg = 2 integral_0^1 E mu dmu;
 * Turquin
 * ("Practical multiple scattering compensation for microfacet models", 2019) divides f by E. Both need E for the
 * distribution at hand and for every roughness. vndf_albedo_build computes it by quadrature, without random
 * numbers, and keeps it as a small table; the calls that look it up need some nanoseconds.
 *
 * E belongs to the effects that vndf_bsdf.h calls height-correlated masking and single scattering, with
 * VNDF_FRESNEL_NONE for a mirror, and with both lobes, VNDF_FRESNEL_DIELECTRIC and VNDF_TRANSPORT_IMPORTANCE for a
 * dielectric (radiance changes with the index; energy does not). Roughness is isotropic: alpha_x = alpha_y =
 * alpha.
 *
 * The conventions of vndf.h hold: errors, threads, and the same bits everywhere, of what is built as of what is
 * looked up. */
#ifndef VNDF_ALBEDO_H
#define VNDF_ALBEDO_H

#include "vndf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- building ----------------------------------------------------------------------------------- */

/* A table of E over cosine and roughness. It is immutable; threads may share it. The distribution need not outlive
 * it. */
typedef struct vndf_albedo vndf_albedo;

/* The largest roughness of a table; above it E is that at this roughness. The least is 0, the limit of fine
 * roughness. */
#define VNDF_ALBEDO_ALPHA_MAX 4.0f

enum {
    VNDF_ALBEDO_GRID_MIN = 8, /* columns or rows */
    VNDF_ALBEDO_GRID_MAX = 128,
    VNDF_LIMIT_ALBEDO_BYTES = 1 << 20 /* a larger file is no table of albedos */
};

/* Called with the part that is done, in [0, 1], some hundred times. Return 0 to go on, any other value to stop the
 * build (VNDF_ERROR_ARGUMENT, "interrupted"). A vndf_progress of vndf_build.h is one. */
typedef int vndf_albedo_progress(double done, const char *what, void *user);

/* Zeroed options are the defaults. */
typedef struct vndf_albedo_options {
    float eta; /* 0: a mirror, F = 1. Else a dielectric, index beyond the surface over index on the side of z: 0.01
                * to 100, farther than 1e-3 from 1 */
    int columns;                    /* of the grid, over cosines: 8 to 128, 0: 24, for a dielectric 48 */
    int rows;                       /* over roughness: 8 to 128, 0: 20, for a dielectric 24 */
    vndf_albedo_progress *progress; /* may be NULL */
    void *progress_user;
} vndf_albedo_options;

/* Builds a table; options may be NULL. Free it with vndf_albedo_free. A mirror takes a second or two, a dielectric
 * some ten. */
VNDF_API vndf_albedo *vndf_albedo_build(const vndf_distribution *distribution, const vndf_albedo_options *options,
                                        vndf_error *error);

/* Does nothing for NULL. */
VNDF_API void vndf_albedo_free(vndf_albedo *albedo);

/* ---- looking up --------------------------------------------------------------------------------- */

/* E of light from a direction with this cosine, in [0, 1]: for a mirror what is reflected, for a dielectric what
 * is reflected and transmitted together. A dielectric is seen from the side of z for cosine >= 0, from the other
 * side for cosine < 0; a mirror looks the same from both. |cosine| above 1 counts as 1, alpha is clamped to [0,
 * VNDF_ALBEDO_ALPHA_MAX], and NaN counts as 0. For NULL E is 1, as if nothing were lost.
 *
 * At cosine 0 a mirror has E = 1. What a dielectric transmits tends to 0 there, but as a power of the cosine that
 * may be as low as 0.001, which no grid resolves: below a cosine of 5e-5 times the median slope, E is that at this
 * cosine.
 */
VNDF_API float vndf_albedo_directional(const vndf_albedo *albedo, float cosine, float alpha);

/* The two parts of E, for a mirror E and 0; their sum is vndf_albedo_directional within rounding. */
typedef struct vndf_albedo_parts {
    float reflected, transmitted;
} vndf_albedo_parts;
VNDF_API vndf_albedo_parts vndf_albedo_split(const vndf_albedo *albedo, float cosine, float alpha);

/* E_avg = 2 integral_0^1 E mu dmu of the E that vndf_albedo_directional returns, so that lobes made of both keep
 * the energy, within `average_error` of vndf_albedo_info. `side` >= 0: the side of z; < 0: the other one. */
VNDF_API float vndf_albedo_average(const vndf_albedo *albedo, float alpha, int side);
VNDF_API vndf_albedo_parts vndf_albedo_average_split(const vndf_albedo *albedo, float alpha, int side);

/* ---- what it is --------------------------------------------------------------------------------- */

/* Errors are absolute, as they were found between the points of the grid, for all cosines (of a dielectric: above
 * 5e-5 times the median slope). */
typedef struct vndf_albedo_properties {
    const char *source; /* of the distribution, as vndf_info has it; the texts belong to the albedo */
    const char *tool;   /* version that made the distribution */
    float eta;          /* 0: a mirror */
    float scale;        /* median slope of the distribution at alpha = 1 */
    int columns, rows;
    size_t values;      /* floats in the table */
    size_t bytes;       /* of the file */
    float error;        /* largest |vndf_albedo_directional - E|, alpha from 0 to VNDF_ALBEDO_ALPHA_MAX, */
    float error_cosine; /* and where it was found; cosine < 0: from the other side */
    float error_alpha;
    float error_usual;   /* the same, alpha from 0.05 to 1 */
    float split_error;   /* largest error of a part in vndf_albedo_split: F of a smooth surface is a step at the */
    float split_usual;   /* critical angle, which E is not. For all alpha, and from 0.05 to 1 */
    float average_error; /* largest |vndf_albedo_average - the integral that it stands for| */
    float quadrature_error; /* largest change of the quadrature by twice as many nodes */
} vndf_albedo_properties;

/* For NULL: empty texts and zeros. */
VNDF_API vndf_albedo_properties vndf_albedo_info(const vndf_albedo *albedo);

/* ---- files -------------------------------------------------------------------------------------- */

/* Reads a table of albedos from a file or from memory, whose bytes are copied, as vndf_load does. Free the result
 * with vndf_albedo_free. */
VNDF_API vndf_albedo *vndf_albedo_load(const char *path, vndf_error *error);
VNDF_API vndf_albedo *vndf_albedo_load_memory(const void *bytes, size_t size, vndf_error *error);

/* Write it as vndf_save and vndf_save_memory do; vndf_albedo_info says its bytes. */
VNDF_API vndf_status vndf_albedo_save(const vndf_albedo *albedo, const char *path, vndf_error *error);
VNDF_API vndf_status vndf_albedo_save_memory(const vndf_albedo *albedo, void *bytes, size_t size,
                                             vndf_error *error);

#ifdef __cplusplus
}
#endif
#endif
