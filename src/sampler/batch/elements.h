/* Element i of a batch, as the calls for one take it; a call one element after the other. */
#ifndef VNDF_SAMPLER_BATCH_ELEMENTS_H
#define VNDF_SAMPLER_BATCH_ELEMENTS_H

#include "sampler/batch/call.h"

vndf_lanes vndf_one_by_one;

vndf_mixture vndf_batch_mixture(const vndf_mixture_batch *batch, size_t i);
vndf_vec3 vndf_batch_mixture_direction(const vndf_mixture_batch *batch, size_t i);

#endif
