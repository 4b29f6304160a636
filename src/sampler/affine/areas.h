/* Both projected areas of an affine surface along one line, which a mixture adds up; for one or for lanes. */
#ifndef VNDF_SAMPLER_AFFINE_AREAS_H
#define VNDF_SAMPLER_AFFINE_AREAS_H

#include "sampler/affine/principal.h"

/* A(w) and A(-w), and their difference, the projection of the mean plane; all times the length of w. */
typedef struct vndf_areas {
    doubles toward, away, up;
} vndf_areas;

/* Roughness is times the distribution's scale; wi' counts before it is rounded. */
VNDF_INLINE vndf_areas vndf_areas_of(const vndf_distribution *d, doubles ax, doubles ay, const vndf_toward *to,
                                     doubles_m valid)
{
    vndf_direction w = {ax, ay, to->x, to->y, to->z};
    doubles below = vndf_law_area_below(d, &w, valid), per = 1.0 / to->factor;
    vndf_areas areas = {(below + doubles_positive(w.z)) * per,
                        (below + doubles_positive(doubles_set(0.0) - w.z)) * per, w.z * per};
    return areas;
}

/* The area for a unit w from the area along w. */
VNDF_INLINE doubles_f vndf_unit_area_of(doubles toward, vndf_normal w, doubles_m valid)
{
    doubles length = doubles_root(w.x * w.x + w.y * w.y + w.z * w.z);
    return doubles_narrow(doubles_pick(valid, toward / length, doubles_set(0.0)));
}

#if VNDF_LANES == 1

/* A(-w)/up above the mean plane, so that nothing cancels; below it -1 - Lambda(-w). */
VNDF_INLINE float vndf_areas_lambda(const vndf_areas *areas)
{
    double lambda = areas->up < 0.0 ? -1.0 - areas->toward / -areas->up : areas->away / areas->up;
    return lambda < (double)FLT_MAX ? (lambda > -(double)FLT_MAX ? (float)lambda : -FLT_MAX) : FLT_MAX;
}

VNDF_INLINE float vndf_areas_g1(const vndf_areas *areas)
{
    double g1 = areas->up > 0.0 ? areas->up / areas->toward : 0.0;
    return g1 < 1.0 ? (float)g1 : 1.0f;
}

/* 0 where the surface or the direction is invalid. */
int vndf_affine_areas(const vndf_affine *surface, vndf_vec3 w, vndf_areas *areas);

/* The view with its areas, without which it is not filled. */
vndf_affine_view vndf_affine_lobe(const vndf_affine *surface, vndf_vec3 wi, vndf_areas *areas, int *valid);

#endif
#endif
