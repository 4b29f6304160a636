/* Element i of a batch, as the calls for one take it. */
#ifndef VNDF_SAMPLER_ELEMENTS_H
#define VNDF_SAMPLER_ELEMENTS_H

#include "vndf.h"

vndf_affine vndf_batch_surface(const vndf_affine_batch *batch, size_t i);
vndf_vec3 vndf_batch_direction(const vndf_affine_batch *batch, size_t i);
vndf_mixture vndf_batch_mixture(const vndf_mixture_batch *batch, size_t i);
vndf_vec3 vndf_batch_mixture_direction(const vndf_mixture_batch *batch, size_t i);

#endif
