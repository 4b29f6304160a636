/* Both projected areas of an affine surface along one line, which a mixture adds up; for one or for lanes. */
#ifndef VNDF_SAMPLER_AFFINE_AREAS_H
#define VNDF_SAMPLER_AFFINE_AREAS_H

#include "sampler/affine/principal.h"

/* A(w) and A(-w), and their difference, the projection of the mean plane; all times the length of w, and `factor`. */
typedef struct vndf_areas {
    doubles toward, away, up;
} vndf_areas;

/* For the roughness of the plain surface and wi' before it is rounded. */
VNDF_INLINE vndf_areas vndf_areas_of(const vndf_distribution *d, const vndf_direction *w, doubles_m valid)
{
    doubles below = vndf_law_area_below(d, w, valid);
    vndf_areas areas = {below + doubles_positive(w->z), below + doubles_positive(doubles_set(0.0) - w->z), w->z};
    return areas;
}

/* The area for a unit w from that along w. */
VNDF_INLINE doubles_f vndf_unit_area_of(doubles toward, vndf_normal w, doubles factor, doubles_m valid)
{
    doubles length = doubles_root(w.x * w.x + w.y * w.y + w.z * w.z);
    return doubles_narrow(doubles_pick(valid, toward / (length * factor), doubles_set(0.0)));
}

#if VNDF_LANES == 1

/* 0 where the surface or the direction is invalid. */
int vndf_affine_areas(const vndf_affine *surface, vndf_vec3 w, vndf_areas *areas);

/* The view with its areas, without which it is not filled. */
vndf_affine_view vndf_affine_lobe(const vndf_affine *surface, vndf_vec3 wi, vndf_areas *areas, int *valid);

#endif
#endif
