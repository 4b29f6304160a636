/* What the files of this room share. A material is resolved to the routines of its scattering, called through a
 * pointer; of Fresnel's terms, masking and normals one switch each takes the one that is wanted (single.c). The
 * mathematics is kernel/lobes.h and kernel/fresnel.h. From a hit that sees no surface, whose area is 0, nothing is
 * scattered; bsdf.c asks that before it calls a routine.
 *
 * The frame of a hit is turned about the origin, w to -w, where wi is below the mean plane: facets are then seen
 * from their other side, and their slopes stay what they are. So wi is above that plane, and the normal of a
 * microfacet, on the side of wi, has wm.z >= 0. Light that goes to above the plane is reflected, to below it
 * transmitted. With primes for projections on the plane, w' = w.z - w.mean, A for projected areas and G = G2/(wi'
 * wo'),
 *
 *     reflection      f n.z = F G D/4
 *     transmission    f n.z = (1 - F) G D (wi.wm) dwm/dwo, over r^2 for radiance.
 *
 * Below the plane the size of wo' counts, and the area is that of the surface from its other side, A(-wo). */
#ifndef VNDF_BSDF_BSDF_H
#define VNDF_BSDF_BSDF_H

#define VNDF_KERNEL_DOUBLE
#include "kernel/one.h"
#include "math/exp_log.h"
#include "math/vector.h"
#include "sampler/sampler.h"
#include "vndf_bsdf.h"

/* ---- the kernel for one double, with functions of src/math ---- */

/* x as the calls of vndf.h take it. */
KERNEL real narrow(real x)
{
    return (real)(float)x;
}

KERNEL real exp_of(real x)
{
    return vndf_exp(x);
}

KERNEL real log_of(real x)
{
    return vndf_log(x);
}

KERNEL real log_beyond(real x)
{
    return vndf_log1p(x);
}

#include "kernel/lobes.h"

/* ---- routines of a material ---- */

/* From a hit that sees the surface. They return 0 where nothing is scattered, and need not write then. */
typedef struct vndf_routines {
    int (*sample)(const vndf_bsdf *bsdf, const float u[3], vndf_scattered *scattered);
    /* the value of each wavelength and the density; either may be NULL */
    int (*eval)(const vndf_bsdf *bsdf, vndf_vec3 wo, uint64_t seed, float *value, float *pdf);
} vndf_routines;

/* One scattering event, without and with compensation for the energy that it loses, and many. */
extern const vndf_routines vndf_routines_single, vndf_routines_compensated, vndf_routines_walk;

/* single.c: `sample` after a normal was drawn with u[0] and u[1]; Fresnel's term. */
int vndf_scatter(const vndf_bsdf *bsdf, const vndf_drawn_normal *normal, float u3, vndf_scattered *scattered);
void vndf_reflectances(const vndf_material *material, seen_cosine c, double eta, double f[VNDF_WAVELENGTHS]);

/* compensated.c: what compensation takes of a material, and of a hit. */
void vndf_compensation_resolve(vndf_material *material);
void vndf_compensation_prepare(vndf_bsdf *bsdf);

/* Whether single scattering is compensated. */
VNDF_INLINE int vndf_compensates(const vndf_effects *e)
{
    return e->scattering == VNDF_SCATTERING_TURQUIN || e->scattering == VNDF_SCATTERING_KULLA_CONTY;
}

/* Whether a compensated material has the albedos of its distribution and eta; else an error (albedo.c). */
vndf_status vndf_albedo_check(const vndf_description *is, vndf_error *error);

/* bsdf.c: a lost sample. */
extern const vndf_scattered vndf_scattered_nothing;

/* ---- a hit: one surface, level or tilted, or a mixture ---- */

/* Kinds of vndf_hit_view. */
enum { VNDF_HIT_LEVEL, VNDF_HIT_TILTED, VNDF_HIT_MIXTURE };

VNDF_INLINE float vndf_hit_ndf(const struct vndf_hit_view *v, vndf_vec3 wm)
{
    return v->kind == VNDF_HIT_MIXTURE ? vndf_mixture_view_ndf(&v->of.mixture, wm) : vndf_view_ndf(&v->of.one, wm);
}

/* A(w). */
VNDF_INLINE float vndf_hit_area(const struct vndf_hit_view *v, vndf_vec3 w)
{
    return v->kind == VNDF_HIT_MIXTURE ? vndf_mixture_view_area(&v->of.mixture, w) : vndf_view_area(&v->of.one, w);
}

/* w'. */
VNDF_INLINE float vndf_hit_cosine(const struct vndf_hit_view *v, vndf_vec3 w)
{
    if (v->kind == VNDF_HIT_LEVEL)
        return w.z;
    return v->kind == VNDF_HIT_MIXTURE ? vndf_mixture_view_cosine(&v->of.mixture, w)
                                       : vndf_view_cosine(&v->of.one, w);
}

/* ---- small steps ---- */

VNDF_INLINE direction vndf_direction(vndf_vec3 w)
{
    const direction d = {(double)w.x, (double)w.y, (double)w.z};
    return d;
}

VNDF_INLINE vndf_vec3 vndf_rounded(direction d)
{
    return vndf_vec3_of((float)d.x, (float)d.y, (float)d.z);
}

/* To the frame of the hit, and back. */
VNDF_INLINE vndf_vec3 vndf_turned(vndf_vec3 w, float side)
{
    return vndf_vec3_of(side * w.x, side * w.y, side * w.z);
}

/* Lengths are not divided out and might overflow: a length far from 1 is invalid, as NaN is. */
VNDF_INLINE int vndf_is_near_unit(vndf_vec3 w)
{
    float square = vndf_dot(w, w);
    return 0.25f < square && square < 4.0f;
}

/* The part of the samples that is reflected: the mean over the wavelengths. */
VNDF_INLINE double vndf_mean_of(const vndf_material *m, const double f[VNDF_WAVELENGTHS])
{
    double sum = f[0];
    for (int i = 1; i < m->is.wavelengths; i++)
        sum += f[i];
    return sum * m->own.per_wavelength;
}

#endif
