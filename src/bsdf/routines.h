/* A material is resolved to functions made for its set of effects, called through pointers. At a hit no code asks
 * whether an effect is wanted.
 *
 * The frame of a hit is turned about the origin, w to -w, where wi is below the mean plane: facets are then seen from
 * their other side, and their slopes stay what they are. So wi is above that plane, and the normal of a microfacet, on
 * the side of wi, has wm.z >= 0. Light that goes to above the plane is reflected, to below it transmitted. With primes
 * for projections on the plane, w' = w.z - w.mean, A for projected areas and G = G2/(wi' wo'),
 *
 *     reflection      f n.z = F G D/4
 *     transmission    f n.z = (1 - F) G D (wi.wm) dwm/dwo, over r^2 for radiance.
 *
 * Below the plane the size of wo' counts, and the area is that of the surface from its other side, A(-wo). */
#ifndef VNDF_BSDF_ROUTINES_H
#define VNDF_BSDF_ROUTINES_H

#include "math/vector.h"
#include "sampler/sampler.h"
#include "vndf_bsdf.h"

typedef struct vndf_routines {
    /* completes a hit; NULL: nothing is missing */
    void (*prepare)(vndf_bsdf *bsdf);
    void (*sample)(const vndf_bsdf *bsdf, const float u[3], vndf_scattered *scattered);
    /* the value of each wavelength and the density; either may be NULL */
    void (*eval)(const vndf_bsdf *bsdf, vndf_vec3 wo, uint64_t seed, float *value, float *pdf);
    /* `sample` after a normal was drawn with u[0] and u[1]; NULL if it draws more than that */
    void (*scatter)(const vndf_bsdf *bsdf, const vndf_drawn_normal *normal, float u3, vndf_scattered *scattered);
} vndf_routines;

/* How normals are drawn. */
typedef struct vndf_normals_routine {
    vndf_drawn_normal (*draw)(const struct vndf_hit_view *view, float u1, float u2);
    float (*pdf)(const struct vndf_hit_view *view, vndf_vec3 wm);
} vndf_normals_routine;

/* Reflectances at a microfacet, `cosine` = wi.wm; in double, so that 1 - f keeps its digits. */
typedef struct vndf_fresnel_routine {
    void (*reflectance)(const vndf_description *is, double cosine, double eta, double f[VNDF_WAVELENGTHS]);
} vndf_fresnel_routine;

/* A microfacet between two directions. */
typedef struct vndf_event {
    vndf_vec3 wm;
    vndf_vec3 up;              /* wo, of transmission -wo */
    double cos_i, cos_o;       /* sizes of wi' and wo' */
    double facing_i, facing_o; /* sizes of cosines to wm */
    double jacobian;           /* dwm/dwo */
} vndf_event;

/* G, which stays finite where the cosines vanish. */
typedef struct vndf_masking_routine {
    double (*reflection)(const vndf_bsdf *bsdf, const vndf_event *event);
    double (*transmission)(const vndf_bsdf *bsdf, const vndf_event *event);
} vndf_masking_routine;

/* Lengths are not divided out and might overflow: a length far from 1 is invalid, as NaN is. */
VNDF_INLINE int vndf_is_near_unit(vndf_vec3 w)
{
    float square = vndf_dot(w, w);
    return 0.25f < square && square < 4.0f;
}

/* To the frame of the hit, and back. */
VNDF_INLINE vndf_vec3 vndf_turned(vndf_vec3 w, float side)
{
    return vndf_vec3_of(side * w.x, side * w.y, side * w.z);
}

VNDF_INLINE void vndf_reflectance(const vndf_bsdf *b, double cosine, double f[VNDF_WAVELENGTHS])
{
    b->material->fresnel->reflectance(&b->material->is, cosine, b->eta, f);
}

/* The part of the samples that is reflected: the mean over the wavelengths. */
VNDF_INLINE double vndf_mean_of(const vndf_material *m, const double f[VNDF_WAVELENGTHS])
{
    double sum = f[0];
    for (int i = 1; i < m->is.wavelengths; i++)
        sum += f[i];
    return sum * m->per_wavelength;
}

VNDF_INLINE void vndf_scatter_nothing(vndf_scattered *s)
{
    const vndf_scattered none = {{0.0f, 0.0f, 1.0f}, {0.0f}, 0.0f, VNDF_LOBE_NONE, {0.0f, 0.0f, 0.0f}};
    *s = none;
}

VNDF_INLINE void vndf_see_nothing(const vndf_bsdf *b, float *value, float *pdf)
{
    for (int i = 0; value && i < b->material->is.wavelengths; i++)
        value[i] = 0.0f;
    if (pdf)
        *pdf = 0.0f;
}

#endif
