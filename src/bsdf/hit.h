/* What a hit sees: one surface or a mixture. This is the one place where they are told apart. */
#ifndef VNDF_BSDF_HIT_H
#define VNDF_BSDF_HIT_H

#include "bsdf/routines.h"

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

/* Ways to draw normals, by vndf_normals_drawn. Mixtures have visible normals alone. */
extern const vndf_normals_routine vndf_normals_routines[VNDF_NORMALS_V_CAVITY + 1];

/* One surface and one mixture: 0 if nothing is scattered from there. */
int vndf_hit_surface(vndf_bsdf *bsdf, const vndf_material *material, const vndf_affine *surface, vndf_vec3 wi);
int vndf_hit_mixture(vndf_bsdf *bsdf, const vndf_material *material, const vndf_mixture *mixture, vndf_vec3 wi);

/* The surface of a roughness; 0 if it is none. */
int vndf_hit_surface_of(const vndf_material *material, const vndf_roughness *roughness, vndf_affine *surface);

#endif
