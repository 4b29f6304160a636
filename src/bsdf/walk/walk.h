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
 * from vndf_sample_weight, mirrored or refracted there, and on. A table draws with a density that is not quite the
 * visible one; the ratio goes into the weight, so the walk is exact for the distribution's own D.
 *
 * Sides. A refracted ray goes on beneath the surface. Seen from there, all of space turned about the origin (w
 * to -w, normals too), the same distribution stands there with its heights upside down, C1 to 1 - C1; the index
 * ratio is inverted. So a walk has one frame, that of the side it is on, in which normals have wm.z >= 0, and it
 * leaves upwards. Surfaces have no mean slope.
 *
 * walk.c   samples, and the routines of a material
 * path.h   a ray on its way: travel and bounce; the density of scattering to a given direction
 * eval.c   f, estimated from both ends        pdf.c   a density near that of samples */
#ifndef VNDF_BSDF_WALK_WALK_H
#define VNDF_BSDF_WALK_WALK_H

#include "bsdf/bsdf.h"

/* With an index ratio of 1 light meets no surface and goes straight on. */
extern const vndf_routines vndf_routines_walk, vndf_routines_unbent;

/* A material and a surface, as a walk sees them from one end. */
typedef struct vndf_walk {
    const vndf_material *material;
    const vndf_affine *surface;
    double eta;    /* index on the other side over that on the side of the end; not 1 if it transmits */
    int transmits; /* else light that is not reflected is lost */
} vndf_walk;

VNDF_INLINE vndf_walk vndf_walk_of(const vndf_bsdf *b)
{
    const vndf_material *m = b->material;
    return (vndf_walk){m, &b->surface, b->eta, m->is.effects.lobes != VNDF_LOBES_REFLECTION};
}

/* f |cos_o| towards wo, in the frame of the hit: a random number of that mean. The first order is exact, the model of
 * single scattering with height-correlated masking; the others are those of two walks, one from either end. For any
 * function g of directions the mean of weight g(wo) over samples is the integral of this times g(wo). */
void vndf_walk_eval(const vndf_bsdf *bsdf, vndf_vec3 wo, uint64_t seed, double *value);

/* A density near that of samples, closed and of integral 1: over the upper half of the sphere, or over all of it if the
 * walk transmits. Positive everywhere there but where wo.z = 0. */
float vndf_walk_pdf(const vndf_bsdf *bsdf, vndf_vec3 wo);

#endif
