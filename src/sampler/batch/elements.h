/* A call one element after the other. */
#ifndef VNDF_SAMPLER_BATCH_ELEMENTS_H
#define VNDF_SAMPLER_BATCH_ELEMENTS_H

#include "sampler/batch/call.h"

vndf_lanes vndf_one_by_one;
vndf_mixture_lanes vndf_mixture_one_by_one;

#endif
