/* Multiple scattering: Smith's random walk on any distribution of normals (Heitz, Hanika, d'Eon & Dachsbacher,
 * "Multiple-Scattering Microfacet BSDFs with the Smith Model", SIGGRAPH 2016).
 *
 * The microsurface is taken for a volume of independent facets. A ray in direction w at a height where the part
 * C1 of the surface lies below passes the facets above it with probability C1^Lambda(w) (eq. 24 there). So with
 *
 *     depth = -log C1,      0 at the top, infinite at the bottom,
 *
 * the way of a ray is exponential in depth: it goes on for E w.z/A(-w) of it towards the top, E of density
 * exp(-E) and A the projected area, since Lambda(w) = A(-w)/w.z for both signs of w.z (a ray that goes down has
 * Lambda(w) < -1 and A(-w) = |w.z| (1 + Lambda(-w))). It has left where depth is no longer positive. Heights
 * and their distribution do not occur: the result does not depend on them.
 *
 * Where it meets the surface it sees the normals that are visible along -w, above the horizon or below: drawn
 * from vndf_sample, mirrored or refracted there, and on. A table draws with a density that is not quite the
 * visible one; the ratio goes into the weight, so the walk is exact for the distribution's own D.
 *
 * Sides. A refracted ray goes on beneath the surface. Seen from there, all of space turned about the origin (w
 * to -w, normals too), the same distribution stands there with its heights upside down, C1 to 1 - C1; the index
 * ratio is inverted. So a walk has one frame, that of the side it is on, in which normals have wm.z >= 0, and it
 * leaves upwards.
 *
 * Throughout, `view` is that of wi (vndf_view_from), valid and with wi.z > 0: the caller has turned wi up. */
#ifndef VNDF_BSDF_WALK_WALK_H
#define VNDF_BSDF_WALK_WALK_H

#include "core/inline.h"
#include "vndf_bsdf.h"

/* Reflectances at a microfacet, `cosine` = wi.wm > 0, eta the index beyond over that before. */
typedef void vndf_walk_reflectance(const vndf_description *is, double cosine, double eta,
                                   double f[VNDF_WAVELENGTHS]);

/* The material, as a walk sees it. Total reflection is total whatever `reflectance` says. */
typedef struct vndf_walk {
    vndf_walk_reflectance *reflectance;
    const vndf_description *is; /* handed to it */
    int wavelengths;            /* 1 to VNDF_WAVELENGTHS; of values and weights the first so many are written */
    double eta;                 /* index on the other side over that on the side of wi; not 1 if it transmits */
    int transmits;              /* else light that is not reflected is lost */
    vndf_transport transport;
    unsigned order_limit; /* scattering events at most, >= 1; a walk that has not left by then is lost */
} vndf_walk;

typedef struct vndf_walked {
    vndf_vec3 wo;                   /* unit within 4 ulps of 2^-23; wo.z > 0 for reflection, else < 0 */
    float weight[VNDF_WAVELENGTHS]; /* throughput */
    unsigned order;                 /* scattering events */
    vndf_lobe lobe;                 /* none: lost, weight 0 */
} vndf_walked;

/* One walk. The first normal is drawn with u[0] and u[1], its lobe with u[2]; all other numbers are a hash of the
 * three. */
void vndf_walk_sample(const vndf_walk *walk, const vndf_view *view, const float u[3], vndf_walked *walked);

/* f |cos_o|: a random number of that mean. The first order is exact, the model of single scattering with
 * height-correlated masking; the others are those of two walks, one from either end (eval.c). For any function
 * g of directions the mean of weight g(wo) over what vndf_walk_sample draws is the integral of eval(wo) g(wo). */
void vndf_walk_eval(const vndf_walk *walk, const vndf_view *view, vndf_vec3 wo, uint64_t seed, double *value);

/* A density near that of vndf_walk_sample's directions, closed and of integral 1: over the upper half of the
 * sphere, or over all of it if the walk transmits. Positive everywhere there but where wo.z = 0. */
float vndf_walk_pdf(const vndf_walk *walk, const vndf_view *view, vndf_vec3 wo);

#endif
