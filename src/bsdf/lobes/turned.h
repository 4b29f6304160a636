/* Roughness with principal axes at an angle: directions are turned to the axes, and sampled ones back (scatter.h). */
#ifndef VNDF_BSDF_LOBES_TURNED_H
#define VNDF_BSDF_LOBES_TURNED_H

#include "bsdf/lobes/scatter.h"

/* The roughness and the axes of a matrix of slopes; 0 if it is invalid. */
int vndf_turned_roughness(const vndf_distribution *distribution, const vndf_affine *affine,
                          vndf_roughness *roughness);

/* The axes of a roughness; 0 if its cosine and sine are not those of an angle. */
int vndf_axes_of(const vndf_roughness *roughness, struct vndf_axes *axes);

/* Sets the axes of a hit, and turns wi to them. Those of the material are known. */
VNDF_INLINE int vndf_turn_hit(vndf_bsdf *b, const vndf_roughness *r, vndf_vec3 *wi)
{
    const struct vndf_axes *axes = &b->material->axes;
    if (r != &b->material->roughness) {
        if (!vndf_axes_of(r, &b->axes))
            return 0;
        axes = &b->axes;
    }
    *wi = vndf_vec3_from(vndf_turned_by(axes->cosine, -axes->sine, vndf_normal_of(*wi)));
    b->axes = *axes;
    return 1;
}

/* Prepares a hit in the axes of its roughness, as vndf_prepare_visible and others do. */
int vndf_prepare_turned_visible(vndf_bsdf *bsdf, const vndf_roughness *roughness, vndf_vec3 wi);
int vndf_prepare_turned_bounded(vndf_bsdf *bsdf, const vndf_roughness *roughness, vndf_vec3 wi);
int vndf_prepare_turned_all(vndf_bsdf *bsdf, const vndf_roughness *roughness, vndf_vec3 wi);

/* Random walks. Other routines turn directions themselves (vndf_choice). */
extern const vndf_routines vndf_routines_turned_walk;

#endif
