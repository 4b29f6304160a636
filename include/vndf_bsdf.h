/* vndf_bsdf.h - reflection and refraction on a rough surface of any distribution of normals.
 *
 * A material is a surface (vndf.h: distribution, roughness or matrix), its optics and a set of effects, which is
 * resolved once: an effect that is not chosen costs nothing when a ray arrives. At a hit vndf_bsdf_at forms everything
 * that depends on the incident direction alone; samples, values and densities start from that.
 *
 *     vndf_material_resolve(&description, &material, &error);
 *     vndf_bsdf_at(&bsdf, &material, wi);
 *     vndf_bsdf_sample(&bsdf, u, &s);
 *
 * gives a direction s.wo with the density s.density and the weight s.weight; README.md has the whole example.
 *
 * The conventions of vndf.h hold: z is the geometric normal, directions are unit and point away from the surface,
 * wi is the known direction and wo the chosen one. Unlike there, a direction with z < 0 (below the mean plane,
 * where there is one: see "Mean slopes") is on the other side of the surface, in the second medium; it is not
 * below the horizon. Both sides have the same microsurface.
 *
 * The model (Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007; Heitz,
 * "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 2014). With the microfacet normal
 * wm on the side of wi, F = fresnel(wi.wm) and r the index on the side of wo over that on the side of wi,
 *
 *     reflection    f = F G2 D(wm) / (4 |cos_i| |cos_o|),                                  wm ~ wi + wo
 *     transmission  f = (1 - F) G2 D(wm) |wi.wm| |wo.wm| / (|cos_i| |cos_o| (wi.wm + r wo.wm)^2),
 *                                                                                          wm ~ +-(wi + r wo)
 *
 * per steradian. This carries radiance, from wo to wi; in transmission importance has another factor r^2. D and
 * Lambda belong to the given distribution (vndf_ndf, vndf_lambda), not to the density that a table draws with: the
 * weight holds the small ratio, so estimators are exact for a table of any size.
 *
 * A call carries one to four wavelengths at once, as the material says: three unless it says another number.
 * Dispersion and absorption belong to the renderer.
 *
 * Mean slopes (VNDF_SHAPE_TILTED, VNDF_SHAPE_MIXTURE). The mean plane of the surface takes the place of the plane
 * z = 0, as it does in masking (vndf.h): it divides reflection from transmission, and with its unit normal n all
 * cosines above are those to n, cos_i = n.wi, cos_o = n.wo; f has D n.z, the density per area of that plane. So f
 * is reciprocal, and f |n.wo| is what a renderer sums; vndf_bsdf_cosine returns n.wo. Without mean slopes n is z.
 * A renderer that has |wo.z| in the place of vndf_bsdf_cosine gets it wrong. A reflected direction may point below
 * z = 0, into the geometry, and is then lost to a ray.
 *
 * Errors and invalid input. vndf_material_resolve refuses sets of effects that make no sense, and says which must be
 * what. Calls on values cannot fail: NaN, infinity, lengths below 1/2 or above 2 and invalid roughness scatter nothing
 * (lobe 0; weights, values and densities 0). Other lengths, and a cosine and a sine that belong to no angle, give
 * finite numbers. The library keeps no state, and gives the same bits everywhere, as vndf.h says.
 *
 * Accuracy. At roughness 1e-3 and above, 99.9% of the samples have the density, to 1e-5, of a direction within one
 * rounding (2^-23 in each coordinate) of the one returned, and the weight f |cos_o| over that density; with visible
 * normals of a closed form the weight is within 5e-6 of that. A rounding of wo turns the facet by 2^-23/(2 wi.wm) in
 * reflection and by 2^-23 r/|r - 1| in transmission: most on smooth surfaces, at grazing light and for r near 1. f is
 * reciprocal to 1e-4. Of tables whose tail is heavier than r^-3.6 more samples are off, far out in that tail: 1% where
 * it is r^-3.2. If that rounding exceeds the z of a transmission facet, z is set to 2^-23 (1 + r) of |wi + r wo|:
 * with a tail of r^-3.2 and alpha 0.05, 0.4, 1 those are 0.4%, 2% and 3% of all samples, whose vndf_bsdf_pdf is
 * too small, but not 0.
 *
 * There is no smooth limit: the caller handles mirrors (alpha from 1e-4 on keeps all digits). A description with
 * nothing set but its surface is a rough white mirror: it has no Fresnel term. */
#ifndef VNDF_BSDF_H
#define VNDF_BSDF_H

#include <stdint.h>

#include "vndf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The most wavelengths of a material. */
enum { VNDF_WAVELENGTHS = 4 };

/* ---- albedos ------------------------------------------------------------------------------------- */

/* How much of the light from wi one scattering event keeps,
 *
 *     E(wi) = integral f(wi, wo) |cos_o| dwo,
 *
 * with height-correlated masking and alpha_x = alpha_y = alpha, over cosine and roughness: what energy compensation
 * gives back is 1 - E. A table of some 7 KB, made without random numbers. It is immutable; threads may share
 * it, and the distribution need not outlive it. */
typedef struct vndf_albedo vndf_albedo;

/* Above this roughness E is that at it. */
#define VNDF_ALBEDO_ALPHA_MAX 4.0f

/* Of a mirror (eta 0: F = 1) or of both lobes of a dielectric: eta is the index beyond the surface over that on the
 * side of z, 0.01 to 100 and farther than 1e-3 from 1. Takes a tenth of a second to one. NULL and an error for other
 * eta, and a distribution whose median slope is outside [1e-6, 1e6]. */
VNDF_API vndf_albedo *vndf_albedo_build(const vndf_distribution *distribution, float eta, vndf_error *error);

/* Does nothing for NULL. */
VNDF_API void vndf_albedo_free(vndf_albedo *albedo);

/* E, in [0, 1], of light from a direction with this cosine: of a dielectric from the side of z for cosine >= 0, from
 * the other side for cosine < 0; a mirror looks the same from both. |cosine| above 1 counts as 1, alpha is clamped to
 * [0, VNDF_ALBEDO_ALPHA_MAX], and NaN counts as 0. For NULL E is 1, as if nothing were lost. Within 1e-3 for a mirror;
 * for a dielectric of alpha from 0.01 on within 1.5e-2 where eta is a tenth or more from 1, 2e-2 where it is 1.05, and
 * nearer to 1, where light from the denser side is reflected totally at grazing angles alone, 7e-2. (What a dielectric
 * transmits tends to 0 at cosine 0, but as a power of the cosine that may be as low as 0.001, which no grid resolves:
 * below a cosine of 5e-5 times the median slope, E is that at this cosine.) */
VNDF_API float vndf_albedo_directional(const vndf_albedo *albedo, float cosine, float alpha);

/* E_avg = 2 integral_0^1 E mu dmu of the E that vndf_albedo_directional returns for the side of z, so that lobes made
 * of both keep the energy, within 1e-4. */
VNDF_API float vndf_albedo_average(const vndf_albedo *albedo, float alpha);

/* ---- effects ------------------------------------------------------------------------------------ */

/* What light does at the surface. With both, a sample chooses reflection with the probability F, the mean over the
 * wavelengths. (The lobes of a mixture in vndf.h are parts of its normals; each of them reflects and transmits.)
 */
typedef enum vndf_lobes { VNDF_LOBES_REFLECTION, VNDF_LOBES_TRANSMISSION, VNDF_LOBES_BOTH } vndf_lobes;

typedef enum vndf_fresnel {
    VNDF_FRESNEL_NONE, /* the shape alone: F = 1 for reflection, 0 for transmission, but 1 in total reflection */
    VNDF_FRESNEL_SCHLICK,    /* f0 + (1 - f0) (1 - cos)^5; with transmission cos is taken in the thinner medium */
    VNDF_FRESNEL_DIELECTRIC, /* unpolarised, index ratio eta */
    VNDF_FRESNEL_CONDUCTOR   /* unpolarised, complex index conductor_eta + i conductor_k; reflection alone */
} vndf_fresnel;

/* G2, masking and shadowing. Smith's models use the Lambda of the distribution. */
typedef enum vndf_masking {
    VNDF_MASKING_HEIGHT_CORRELATED, /* reflection 1/(1 + Lambda_i + Lambda_o), transmission the Beta function of
                                     * 1 + Lambda_i and 1 + Lambda_o (Heitz et al. 2016) */
    VNDF_MASKING_SEPARABLE,         /* G1(wi) G1(wo) */
    VNDF_MASKING_V_CAVITIES,        /* with G1 = min(1, 2 |wm.z w.z|/(w.wm)): the smaller G1, in transmission
                                     * max(0, G1(wi) + G1(wo) - 1) */
    VNDF_MASKING_NONE               /* 1: does not conserve energy */
} vndf_masking;

/* How wm is drawn. */
typedef enum vndf_normals_drawn {
    /* Normals that wi sees: weights are F G2/G1; with both lobes, and a Fresnel term that depends on the
     * wavelength, times F over its mean. */
    VNDF_NORMALS_VISIBLE,
    /* Visible normals, of which fewer reflect wi to below the horizon, where samples are lost: none of a table of
     * equal roughness, few of GGX and Beckmann. The weight is that of a visible normal times the part of the
     * visible normals that is kept. Tables of unequal roughness draw visible normals instead. */
    VNDF_NORMALS_BOUNDED,
    VNDF_NORMALS_ALL,     /* D cos(theta_m), the way before visible normals: weights are unbounded */
    VNDF_NORMALS_V_CAVITY /* normals that wi sees in V-cavities; for V-cavity masking only */
} vndf_normals_drawn;

typedef enum vndf_scattering {
    VNDF_SCATTERING_SINGLE,
    VNDF_SCATTERING_MULTIPLE, /* Smith's random walk (Heitz et al., "Multiple-Scattering Microfacet BSDFs with the
                               * Smith Model", SIGGRAPH 2016): only walks longer than order_limit lose energy
                               * between the microfacets */
    /* Single scattering, and the energy that it loses given back from a table of albedos ("Albedos" below). With
     * E(wi) the part that is kept, and F0 the reflectance at normal incidence, f of reflection is scaled by 1 + F0
     * (1 - E)/E, f of both lobes by 1/E (Turquin 2019). Not reciprocal: E is that of wi. */
    VNDF_SCATTERING_TURQUIN,
    /* The same for reflection alone by another lobe, F_ms (1 - E(wi)) (1 - E(wo))/(pi (1 - E_avg)) with F_ms = F_avg^2
     * E_avg/(1 - F_avg (1 - E_avg)) (Kulla & Conty 2017). f is reciprocal. A sample takes this lobe as often as light
     * does; wm is then 0. Where 1 - E_avg is below 1e-5, on smooth surfaces, Turquin's factor takes its place. */
    VNDF_SCATTERING_KULLA_CONTY
} vndf_scattering;

/* What a path carries along wi. */
typedef enum vndf_transport {
    VNDF_TRANSPORT_RADIANCE,  /* paths from the eye */
    VNDF_TRANSPORT_IMPORTANCE /* paths from the light */
} vndf_transport;

/* What the surface of a hit is. */
typedef enum vndf_shape {
    VNDF_SHAPE_LEVEL,  /* one surface, of which the mean slope is not read */
    VNDF_SHAPE_TILTED, /* one with its mean slope, as filtered normal maps have it */
    VNDF_SHAPE_MIXTURE /* several lobes, each with its distribution and matrix: vndf_bsdf_mixture */
} vndf_shape;

/* Where reflected light goes. */
typedef enum vndf_reflection {
    VNDF_REFLECTION_SPECULAR, /* to where facets mirror it */
    /* Back to where it came from: f of wi and (-wo.x, -wo.y, wo.z), samples and densities likewise (Portsmouth et
     * al., JCGT 15(1), 2026). Transmission is not changed. */
    VNDF_REFLECTION_RETRO
} vndf_reflection;

/* All zero: bare reflection with height-correlated masking. */
typedef struct vndf_effects {
    vndf_lobes lobes;
    vndf_fresnel fresnel;
    vndf_masking masking;
    vndf_normals_drawn normals;
    vndf_scattering scattering;
    vndf_transport transport;
    vndf_shape shape;
    vndf_reflection reflection;
} vndf_effects;

/* ---- materials ---------------------------------------------------------------------------------- */

/* The parts of a material. A member that the effects do not need is not read. What it points to must outlive the
 * material. */
typedef struct vndf_description {
    vndf_surface surface; /* of hits by vndf_bsdf_at; not read for mixtures, whose lobes have their own */
    vndf_effects effects;
    const vndf_mixture *mixture; /* of hits by vndf_bsdf_at; may be NULL if every hit has its own */
    int wavelengths;             /* 1 to VNDF_WAVELENGTHS; 0: 3 */
    /* For Turquin and Kulla & Conty: of this distribution, for a mirror where the material only reflects, else for
     * its eta. It knows isotropic roughness: the root of the determinant takes the place of a matrix. */
    const vndf_albedo *albedo;
    float eta;                             /* index on the side of -z over that on the side of z, 0.01 to 100 */
    float f0[VNDF_WAVELENGTHS];            /* Schlick: reflectance at normal incidence, 0 to 1 */
    float conductor_eta[VNDF_WAVELENGTHS]; /* index over that on the side of z: real part, 0 to 1000, */
    float conductor_k[VNDF_WAVELENGTHS];   /* and imaginary part, 0 to 1000; one of the two > 0 */
    /* The most scattering events of a walk; 0: 64. Longer walks are lost: none of 40000 on GGX up to alpha 10, 1%
     * on a heavy-tailed table at alpha 10, 0.7% with eta 1.001 at grazing incidence, all at alpha 1000. */
    unsigned order_limit;
} vndf_description;

/* A resolved material: a plain value, valid while its distribution lives. */
typedef struct vndf_material {
    vndf_description is; /* as it was given, but for the numbers that stand for a default */
    struct {
        const struct vndf_routines *routines; /* of its scattering */
        vndf_surface surface;                 /* of hits that bring none */
        double per_wavelength;                /* one over their number */
        float reflectance0[VNDF_WAVELENGTHS]; /* F at normal incidence, */
        float reflectance[VNDF_WAVELENGTHS];  /* and its mean over the hemisphere */
        int two_sided;
    } own; /* private */
} vndf_material;

/* Returns VNDF_OK, or VNDF_ERROR_ARGUMENT and an error that names the refused combination or number; *material
 * then scatters nothing. */
VNDF_API vndf_status vndf_material_resolve(const vndf_description *description, vndf_material *material,
                                           vndf_error *error);

/* ---- one hit ------------------------------------------------------------------------------------ */

/* What compensation takes of a hit; private. */
struct vndf_compensation {
    float alpha;
    float gain[VNDF_WAVELENGTHS];   /* of single scattering */
    float lost, per;                /* Kulla & Conty: 1 - E(wi), 1/(pi (1 - E_avg)), */
    float share;                    /* the part of the samples, */
    float near, per_log;            /* how its cosines are drawn, */
    float colour[VNDF_WAVELENGTHS]; /* F_ms */
};

/* The view of one surface or of a mixture, which makes it large; private. */
struct vndf_hit_view {
    int kind;
    union {
        vndf_view one;
        vndf_mixture_view mixture; /* never touched by other shapes */
    } of;
};

/* Everything that depends on the material and wi alone: a plain value, valid while the material lives. It points
 * to the material, which must not move. */
typedef struct vndf_bsdf {
    const vndf_material *material;
    struct {
        double eta;       /* index on the other side over that on the side of wi */
        double carried;   /* extra factor of transmission: 1/eta^2 for radiance, 1 for importance */
        float side;       /* -1 where wi is below the mean plane, 1 else; the frame of the hit is turned by it, */
        vndf_vec3 wi;     /* so that this is above */
        float rise, area; /* of wi: its projection on the mean plane, and the projected area */
        float tilt;       /* length of (mean slope, 1) */
        vndf_surface surface; /* not of a mixture */
        struct vndf_compensation compensation;
        struct vndf_hit_view view; /* of wi */
    } own;                         /* private */
} vndf_bsdf;

/* Prepares a hit with the surface or mixture of the material. wi is unit within 2e-6. A material that does
 * not transmit and has no Fresnel term for a dielectric is seen from z > 0 only (from above the mean plane), any other
 * from both sides. Returns 0 if the material scatters nothing from there, or has no mixture where it needs one. */
VNDF_API int vndf_bsdf_at(vndf_bsdf *bsdf, const vndf_material *material, vndf_vec3 wi);

/* The same with the surface, or the mixture, of the hit, from a texture, say; neither is kept, and the distribution of
 * the surface is not read: it is the material's. NULL: those of the material. Returns 0, and scatters nothing, for an
 * invalid surface or mixture, and for another shape than the material's. */
VNDF_API int vndf_bsdf_on(vndf_bsdf *bsdf, const vndf_material *material, const vndf_surface *surface,
                          vndf_vec3 wi);
VNDF_API int vndf_bsdf_mixture(vndf_bsdf *bsdf, const vndf_material *material, const vndf_mixture *mixture,
                               vndf_vec3 wi);

/* Which way the light went. */
typedef enum vndf_lobe {
    VNDF_LOBE_NONE, /* nowhere: the sample is lost, its weight is 0 */
    VNDF_LOBE_REFLECTION,
    VNDF_LOBE_TRANSMISSION,
    /* eta = 1: straight on along -wi, with the weight of masking (1 for walks). This is a Dirac, the only
     * direction to sample: density is 1, vndf_bsdf_eval and vndf_bsdf_pdf are 0. */
    VNDF_LOBE_STRAIGHT
} vndf_lobe;

typedef struct vndf_scattered {
    vndf_vec3 wo;                   /* unit within 10 ulps of 2^-23, of transmission 2 max(eta, 1/eta) more */
    float weight[VNDF_WAVELENGTHS]; /* f |cos_o| / density ("Accuracy" above); through V-cavities to 2e-5 of 1 */
    float density; /* per steradian, at least FLT_MIN; vndf_bsdf_pdf of wo, but for its rounding */
    vndf_lobe lobe;
    vndf_vec3 wm; /* the facet that was met, on the side of wi; 0 where there is none, or a walk met many */
} vndf_scattered;

/* Draws a direction from three uniform numbers in [0, 1]: two for the normal, the third for the lobe. A random walk
 * takes further numbers from a hash of the three; its weight is its throughput, its density that of vndf_bsdf_pdf. */
VNDF_API void vndf_bsdf_sample(const vndf_bsdf *bsdf, const float u[3], vndf_scattered *scattered);

/* value[i] = f of wavelength i of the material, without the cosine. f of a random walk is a random number with the
 * right mean, made from `seed`, which nothing else reads. */
VNDF_API void vndf_bsdf_eval(const vndf_bsdf *bsdf, vndf_vec3 wo, uint64_t seed, float *value);

/* The density per steradian with which vndf_bsdf_sample draws wo. For random walks it is an estimate for multiple
 * importance sampling: positive wherever f is, with integral 1 over the directions above the horizon. */
VNDF_API float vndf_bsdf_pdf(const vndf_bsdf *bsdf, vndf_vec3 wo);

/* Both at once, with the same bits; either of value and pdf may be NULL. */
VNDF_API void vndf_bsdf_eval_pdf(const vndf_bsdf *bsdf, vndf_vec3 wo, uint64_t seed, float *value, float *pdf);

/* The cosine of wo that f is multiplied by: wo.z, or n.wo where mean slopes tilt the surface. */
VNDF_API float vndf_bsdf_cosine(const vndf_bsdf *bsdf, vndf_vec3 wo);

/* ---- many at once ------------------------------------------------------------------------------- */

/* `count` hits of one material as a structure of arrays; `shared` and `limit` are as in vndf_batch. The arrays of the
 * material's shape are read: those of `surface` (but its distribution; xx and yy together), or `mixture`. They are
 * shared if VNDF_SHARED_SURFACE is set, and NULL for what the material has. */
typedef struct vndf_bsdf_batch {
    const vndf_material *material;
    size_t count;
    unsigned shared;
    vndf_instructions limit;
    vndf_surface_batch surface;
    const vndf_mixture *mixture;
    const float *wi_x, *wi_y, *wi_z;
} vndf_bsdf_batch;

/* Results of sampling: arrays of `count` elements, and a weight for each wavelength of the material. All arrays of
 * wm may be NULL. */
typedef struct vndf_scattered_n {
    vndf_normals wo;
    float *weight[VNDF_WAVELENGTHS];
    float *density;
    uint8_t *lobe; /* vndf_lobe */
    vndf_normals wm;
} vndf_scattered_n;

/* Element i equals, to the bit, the result of the call for one element. No array of results may overlap an array
 * of inputs. `seed` may be NULL unless the material is a random walk; `value` or `pdf` for what is not asked. */
VNDF_API void vndf_bsdf_sample_n(const vndf_bsdf_batch *batch, const float *const u[3],
                                 vndf_scattered_n scattered);
VNDF_API void vndf_bsdf_eval_pdf_n(const vndf_bsdf_batch *batch, vndf_normals wo, const uint64_t *seed,
                                   float *const *value, float *pdf);

/* ---- Fresnel ------------------------------------------------------------------------------------ */

/* Reflectance of unpolarised light at a smooth interface, in [0, 1]; `cosine` is |cos| of the angle of incidence.
 * eta is the index beyond the interface over the index before it; in total reflection the result is 1. Relative
 * error below 1e-6. */
VNDF_API float vndf_fresnel_dielectric(float cosine, float eta);
VNDF_API float vndf_fresnel_conductor(float cosine, float eta, float k);
VNDF_API float vndf_fresnel_schlick(float cosine, float f0);

#ifdef __cplusplus
}
#endif
#endif
