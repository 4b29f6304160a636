/* Both projected areas of an affine surface along one line, which a mixture adds up. */
#ifndef VNDF_SAMPLER_AFFINE_AREAS_H
#define VNDF_SAMPLER_AFFINE_AREAS_H

#include "vndf.h"

/* A(w) and A(-w), and their difference, the projection of the mean plane; all times the length of w. */
typedef struct vndf_areas {
    double toward, away, up;
} vndf_areas;

/* 0 where the surface or the direction is invalid. */
int vndf_affine_areas(const vndf_affine *surface, vndf_vec3 w, vndf_areas *areas);

#endif
