/* A material is resolved to functions made for its set of effects, called through pointers. At a hit no code asks
 * whether an effect is wanted.
 *
 * All of it works in the frame of the hit: turned to the principal axes, and mirrored at the surface if wi came from
 * below, so that wi.z > 0 and the microfacet normal, on the side of wi, has wm.z >= 0. wo.z > 0 is reflection, wo.z < 0
 * transmission. Mixtures have a frame of their own (lobes/mixture.c). */
#ifndef VNDF_BSDF_ROUTINES_H
#define VNDF_BSDF_ROUTINES_H

#include "core/inline.h"
#include "sampler/analytic_density.h"
#include "vndf_bsdf.h"

/* How lanes scatter a block of a batch (batch/lanes_scatter.h). */
typedef enum vndf_block_kind {
    VNDF_BLOCK_NONE, /* they do not */
    VNDF_BLOCK_BARE,
    VNDF_BLOCK_REFLECTION,
    VNDF_BLOCK_BOTH
} vndf_block_kind;

/* `prepare` finds material, eta, side and carried set, and sets the members that the other routines read; 0 if nothing
 * can be seen from there. */
typedef struct vndf_routines {
    int (*prepare)(vndf_bsdf *bsdf, const vndf_roughness *roughness, vndf_vec3 wi);
    void (*sample)(const vndf_bsdf *bsdf, const float u[3], vndf_scattered *scattered);
    /* the value of each wavelength, and, unless `pdf` is NULL, the density */
    void (*eval)(const vndf_bsdf *bsdf, vndf_vec3 wo, uint64_t seed, float *value, float *pdf);
    float (*pdf)(const vndf_bsdf *bsdf, vndf_vec3 wo);
    /* `sample` after vndf_sample_weight drew wm; NULL if it draws otherwise */
    void (*scatter)(const vndf_bsdf *bsdf, vndf_vec3 wm, float density, float weight, const float u[3],
                    vndf_scattered *scattered);
    vndf_block_kind kind;
} vndf_routines;

/* Lengths are not divided out and might overflow: a length far from 1 is invalid, as NaN is. */
VNDF_INLINE lanes_m vndf_is_near_unit_square(lanes_f square)
{
    return lanes_both(lanes_less(lanes_set(0.25f), square), lanes_less(square, lanes_set(4.0f)));
}

#if VNDF_LANES == 1

VNDF_INLINE int vndf_is_near_unit(vndf_vec3 w)
{
    return vndf_is_near_unit_square(w.x * w.x + w.y * w.y + w.z * w.z);
}

#endif

/* Of shapes with a roughness; 0 if nothing is scattered from there. */
int vndf_bsdf_hit(vndf_bsdf *bsdf, const vndf_material *material, const vndf_roughness *roughness, vndf_vec3 wi);

/* Reflectances at a microfacet, `cosine` = wi.wm; in double, so that 1 - f keeps its digits. */
typedef struct vndf_fresnel_routine {
    void (*reflectance)(const vndf_description *is, double cosine, double eta, double f[VNDF_WAVELENGTHS]);
} vndf_fresnel_routine;

/* A microfacet between two directions; sizes of cosines. */
typedef struct vndf_event {
    vndf_vec3 wo;              /* turned up */
    double cos_i, cos_o;       /* to the surface's normal */
    double facing_i, facing_o; /* to the microfacet's */
    double cos_m;              /* wm.z */
} vndf_event;

/* G2/(cos_i cos_o), which stays finite where the cosines vanish; of reflection and of transmission. */
typedef struct vndf_masking_routine {
    double (*reflection)(const vndf_bsdf *bsdf, const vndf_event *event);
    double (*transmission)(const vndf_bsdf *bsdf, const vndf_event *event);
} vndf_masking_routine;

#endif
