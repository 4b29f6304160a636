/* vndf_bsdf.h - reflection and refraction on a rough surface of any distribution of normals.
 *
 * A material is a distribution (table, GGX, Beckmann), its roughness, its optics and a set of effects. The set is
 * resolved once, to routines made for it: an effect that is not chosen is not looked at when a ray arrives. At a
 * hit vndf_bsdf_at forms all that depends on the incident direction alone; from it come samples, values and
 * densities.
 *
 *     vndf_material material;
 *     vndf_description glass = {.distribution = vndf_ggx(), .alpha_x = 0.1f, .alpha_y = 0.1f, .eta = 1.5f,
 *         .effects = {.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_DIELECTRIC}};
 *     if (vndf_material_resolve(&glass, &material, &error) != VNDF_OK) ...
 *     vndf_bsdf bsdf;
 *     vndf_scattered s;
 *     vndf_bsdf_at(&bsdf, &material, wi);
 *     vndf_bsdf_sample(&bsdf, u, &s);         weight s.weight, direction s.wo, density s.density
 *
 * Conventions are those of vndf.h: z is the geometric normal, directions are unit and point away from the surface,
 * wi is the known one and wo the chosen one. Unlike there a direction with z < 0 is one on the other side of the
 * surface, in the second medium, and not one below the horizon. Both sides have the same microsurface.
 *
 * The model (Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007; Heitz,
 * "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 2014). With the microfacet normal
 * wm on the side of wi, F = fresnel(wi.wm) and r the index on the side of wo over that on the side of wi,
 *
 *     reflection    f = F G2 D(wm) / (4 |cos_i| |cos_o|),                                  wm ~ wi + wo
 *     transmission  f = (1 - F) G2 D(wm) |wi.wm| |wo.wm| / (|cos_i| |cos_o| (wi.wm + r wo.wm)^2),
 *                                                                                          wm ~ +-(wi + r wo)
 *
 * per steradian. This carries radiance, from wo to wi; importance has the factor r^2 more in transmission.
 * D and Lambda are those of the distribution (vndf_ndf, vndf_lambda), not the ones that a table draws with: the
 * small ratio is in the weight, and estimators are exact for a table of any size.
 *
 * Three wavelengths - red, green and blue, or whatever the caller takes them for - are carried at once; what does
 * not depend on the wavelength is three times the same. Dispersion and absorption belong to the renderer.
 *
 * Errors and invalid input. vndf_material_resolve refuses, by name, what makes no sense: a conductor that
 * transmits, both lobes without a Fresnel term to choose by, bounded normals that transmit, V-cavity normals
 * without that masking, a walk with other masking or normals than its own or with transmission alone. Calls on
 * values cannot fail: NaN, infinity, lengths below 1/2 or above 2 and invalid roughness scatter nothing (lobe 0,
 * weights, values and densities 0); of lengths between these, and of cosine and sine that are not of one angle,
 * nothing is promised but finite numbers. A material has to have been resolved. No state, no NaN, and the same
 * bits everywhere, as vndf.h says.
 *
 * There is no smooth limit: a mirror is the caller's (alpha from 1e-4 on keeps all digits). A description that is
 * zero but for its distribution and roughness is a white mirror, rough: no Fresnel term. */
#ifndef VNDF_BSDF_H
#define VNDF_BSDF_H

#include <stdint.h>

#include "vndf.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { VNDF_WAVELENGTHS = 3 };

/* ---- effects ------------------------------------------------------------------------------------ */

/* What light does at the surface. Of both, one is chosen per sample, reflection with the probability F (the mean of
 * the wavelengths). */
typedef enum vndf_lobes { VNDF_LOBES_REFLECTION, VNDF_LOBES_TRANSMISSION, VNDF_LOBES_BOTH } vndf_lobes;

typedef enum vndf_fresnel {
    VNDF_FRESNEL_NONE, /* F = 1 for reflection, 0 for transmission, but 1 in total reflection: the shape alone */
    VNDF_FRESNEL_SCHLICK,    /* f0 + (1 - f0) (1 - cos)^5; with transmission the cosine in the thinner medium */
    VNDF_FRESNEL_DIELECTRIC, /* unpolarised, index ratio eta */
    VNDF_FRESNEL_CONDUCTOR   /* unpolarised, complex index conductor_eta + i conductor_k; reflection alone */
} vndf_fresnel;

/* G2, masking and shadowing. Smith's are of the distribution's own Lambda. */
typedef enum vndf_masking {
    VNDF_MASKING_HEIGHT_CORRELATED, /* reflection 1/(1 + Lambda_i + Lambda_o), transmission the Beta function of
                                     * 1 + Lambda_i and 1 + Lambda_o (Heitz et al. 2016) */
    VNDF_MASKING_SEPARABLE,         /* G1(wi) G1(wo) */
    VNDF_MASKING_V_CAVITIES,        /* of G1 = min(1, 2 |wm.z w.z|/(w.wm)): the smaller one, and in transmission
                                     * max(0, G1(wi) + G1(wo) - 1) */
    VNDF_MASKING_NONE               /* 1: energy is not conserved */
} vndf_masking;

/* How wm is drawn. */
typedef enum vndf_normals_drawn {
    /* Those that wi sees: weights are F G2/G1; with both lobes, and a Fresnel term that depends on the wavelength,
     * times F over its mean. */
    VNDF_NORMALS_VISIBLE,
    /* Those of them that reflect wi to above the horizon: no sample is lost. Weights are those of visible normals
     * times the part of them that is left where wm is drawn; for GGX of anisotropic roughness up to 1.7 of that. */
    VNDF_NORMALS_BOUNDED,
    VNDF_NORMALS_ALL,     /* D cos(theta_m), as before visible normals were used: weights are unbounded */
    VNDF_NORMALS_V_CAVITY /* those that wi sees in V-cavities; for that masking only */
} vndf_normals_drawn;

typedef enum vndf_scattering {
    VNDF_SCATTERING_SINGLE,
    VNDF_SCATTERING_MULTIPLE /* Smith's random walk (Heitz et al., "Multiple-Scattering Microfacet BSDFs with the
                              * Smith Model", SIGGRAPH 2016): no energy is lost between the microfacets, but
                              * with walks longer than order_limit */
} vndf_scattering;

/* What is carried along wi. */
typedef enum vndf_transport {
    VNDF_TRANSPORT_RADIANCE,  /* paths from the eye */
    VNDF_TRANSPORT_IMPORTANCE /* paths from the light */
} vndf_transport;

typedef enum vndf_axes {
    VNDF_AXES_FIXED,  /* alpha_x is along x */
    VNDF_AXES_ROTATED /* at the angle of each hit */
} vndf_axes;

/* All zero: bare reflection with height-correlated masking. */
typedef struct vndf_effects {
    vndf_lobes lobes;
    vndf_fresnel fresnel;
    vndf_masking masking;
    vndf_normals_drawn normals;
    vndf_scattering scattering;
    vndf_transport transport;
    vndf_axes axes;
} vndf_effects;

/* ---- materials ---------------------------------------------------------------------------------- */

/* What a material is made of. What the effects do not ask for is not read. */
typedef struct vndf_description {
    const vndf_distribution *distribution; /* not owned; must outlive the material */
    vndf_effects effects;
    float alpha_x, alpha_y;                /* roughness where a hit brings none, > 0 */
    float rotation;                        /* angle from x to the axis of alpha_x, radians, within 1e4 */
    float eta;                             /* index on the side of -z over that on the side of z, 0.01 to 100 */
    float f0[VNDF_WAVELENGTHS];            /* Schlick: reflectance at right angles, 0 to 1 */
    float conductor_eta[VNDF_WAVELENGTHS]; /* over the index on the side of z, 0 to 1000, */
    float conductor_k[VNDF_WAVELENGTHS];   /* and its imaginary part, the same; one of them > 0 */
    /* Scattering events in a walk at most; 0: 64. Walks that have not left by then are lost: of GGX none in 40000
     * up to alpha 10, but 1% of a heavy-tailed table there, 0.7% of eta 1.001 at grazing, and all at alpha 1000. */
    unsigned order_limit;
} vndf_description;

/* The roughness of one hit, as from a texture. The cosine and sine of the rotation are read where axes are rotated;
 * they are unit within rounding. */
typedef struct vndf_roughness {
    float alpha_x, alpha_y;
    float cos_rotation, sin_rotation;
} vndf_roughness;

/* A material, resolved: a plain value, valid while its distribution lives. Its members are private. */
typedef struct vndf_material {
    vndf_description is;
    const struct vndf_routines *routines;  /* made for its effects, */
    const struct vndf_routines *unrotated; /* and in the frame of the roughness */
    const struct vndf_fresnel_routine *fresnel;
    const struct vndf_masking_routine *masking;
    vndf_roughness roughness;
    int two_sided;
    int steep; /* F changes faster than directions are rounded */
} vndf_material;

/* VNDF_OK, or VNDF_ERROR_ARGUMENT with the combination or number that is refused; *material is then unusable but
 * safe: it scatters nothing. */
VNDF_API vndf_status vndf_material_resolve(const vndf_description *description, vndf_material *material,
                                           vndf_error *error);

/* ---- one hit ------------------------------------------------------------------------------------ */

/* Everything that depends on the material and wi alone; a plain value, valid while the material lives and is not
 * moved. Its members are private. */
typedef struct vndf_bsdf {
    const vndf_material *material;
    vndf_view view; /* of wi in the frame of the roughness, turned up */
    double eta;     /* index on the other side over that on the side of wi */
    double carried; /* what transmission has more than for importance: 1/eta^2 for radiance */
    float side;     /* -1 where wi is on the side of -z, 1 else */
    float area;     /* projected area along wi */
    float cos_rotation, sin_rotation;
    vndf_bounds bounds; /* of bounded normals */
} vndf_bsdf;

/* With the roughness of the material. wi is unit within 2e-6. Materials that do not transmit and have no Fresnel
 * term for a dielectric are seen from z > 0 only; others from both sides. 0 if nothing is scattered from there. (By
 * a pointer: what is returned would be copied, and waited for.) */
VNDF_API int vndf_bsdf_at(vndf_bsdf *bsdf, const vndf_material *material, vndf_vec3 wi);

/* With the roughness of the hit; NULL: that of the material. */
VNDF_API int vndf_bsdf_rough(vndf_bsdf *bsdf, const vndf_material *material, const vndf_roughness *roughness,
                             vndf_vec3 wi);

/* Which way light went. */
typedef enum vndf_lobe {
    VNDF_LOBE_NONE, /* nowhere: the sample is lost, its weight is 0 */
    VNDF_LOBE_REFLECTION,
    VNDF_LOBE_TRANSMISSION,
    /* eta = 1: on along -wi, unbent, with the weight of masking (1 for walks). A Dirac, towards which there is
     * nothing else to sample: density is 1, vndf_bsdf_eval and _pdf 0. */
    VNDF_LOBE_STRAIGHT
} vndf_lobe;

typedef struct vndf_scattered {
    vndf_vec3 wo;                   /* unit within 10 ulps of 2^-23 */
    float weight[VNDF_WAVELENGTHS]; /* f |cos_o| / density, to 1e-5; through V-cavities to 2e-5 of 1 */
    float density;                  /* per steradian; what vndf_bsdf_pdf gives for wo, to 1e-5; at least FLT_MIN */
    vndf_lobe lobe;
} vndf_scattered;

/* A direction from three uniform numbers in [0, 1]: two for the normal, the third for the lobe. A random walk takes
 * the numbers after them from a hash of all three, so points that are well spread are so in its first event
 * alone; its weight is the throughput of the walk and its density an estimate (vndf_bsdf_pdf). */
VNDF_API void vndf_bsdf_sample(const vndf_bsdf *bsdf, const float u[3], vndf_scattered *scattered);

/* f of the wavelengths, without the cosine; 0 where wo.z = 0. `seed` is for random walks, whose f is a random
 * number with the right mean; no others read it. */
VNDF_API void vndf_bsdf_eval(const vndf_bsdf *bsdf, vndf_vec3 wo, uint64_t seed, float value[VNDF_WAVELENGTHS]);

/* The density per steradian with which vndf_bsdf_sample draws wo. For random walks a density near it, positive
 * wherever f is, of integral 1 over the directions above the horizon: fit for multiple importance sampling. */
VNDF_API float vndf_bsdf_pdf(const vndf_bsdf *bsdf, vndf_vec3 wo);

/* ---- many at once ------------------------------------------------------------------------------- */

/* `count` hits of one material, structure of arrays; `shared` and `limit` as in vndf_batch. alpha_x and alpha_y may
 * be NULL, both: the roughness of the material. cos_rotation and sin_rotation are read where axes are rotated and
 * go with VNDF_SHARED_ALPHA; NULL, both: the rotation of the material. */
typedef struct vndf_bsdf_batch {
    const vndf_material *material;
    size_t count;
    unsigned shared;
    vndf_instructions limit;
    const float *alpha_x, *alpha_y;
    const float *cos_rotation, *sin_rotation;
    const float *wi_x, *wi_y, *wi_z;
} vndf_bsdf_batch;

/* Results of sampling, `count` each. */
typedef struct vndf_scattered_n {
    vndf_normals wo;
    float *weight[VNDF_WAVELENGTHS];
    float *density;
    uint8_t *lobe; /* vndf_lobe */
} vndf_scattered_n;

/* Element i is to the bit what the call of one gives. No array of results may overlap one that is read. `seed` may
 * be NULL where the material is no random walk. */
VNDF_API void vndf_bsdf_sample_n(const vndf_bsdf_batch *batch, const float *const u[3],
                                 vndf_scattered_n scattered);
VNDF_API void vndf_bsdf_eval_n(const vndf_bsdf_batch *batch, vndf_normals wo, const uint64_t *seed,
                               float *const value[VNDF_WAVELENGTHS]);
VNDF_API void vndf_bsdf_pdf_n(const vndf_bsdf_batch *batch, vndf_normals wo, float *pdf);

/* ---- Fresnel ------------------------------------------------------------------------------------ */

/* Reflectance of unpolarised light at a smooth interface, in [0, 1]; `cosine` is |cos| of the angle of incidence.
 * eta: index beyond the interface over that before it; 1 in total reflection. Relative error below 1e-6. */
VNDF_API float vndf_fresnel_dielectric(float cosine, float eta);
VNDF_API float vndf_fresnel_conductor(float cosine, float eta, float k);
VNDF_API float vndf_fresnel_schlick(float cosine, float f0);

#ifdef __cplusplus
}
#endif
#endif
