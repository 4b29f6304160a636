/* Light along paths from the eye, and how rough materials are sampled on the way. */
#ifndef TOOLS_RENDER_PATH_H
#define TOOLS_RENDER_PATH_H

#include "render/scene.h"

/* How rough materials draw directions: by normals of the library, or (perfect) as a yardstick by the BSDF itself.
 */
typedef enum path_sampler { SAMPLER_VISIBLE, SAMPLER_ALL, SAMPLER_PERFECT, SAMPLERS } path_sampler;

extern const char *const path_sampler_names[SAMPLERS + 1]; /* NULL at the end */

typedef struct path_plan path_plan;

/* Resolves the materials of a scene, which must outlive the plan, with a sampler; to be freed. NULL and an error if
 * one of them cannot have it. */
path_plan *path_prepare(const scene *s, path_sampler sampler, vndf_error *error);

/* Counters of one thread. */
typedef struct path_counts {
    uint64_t rays, lost; /* lost: paths whose light was not finite */
} path_counts;

/* The radiance of one path through pixel (x, y): path `index` of the pixel under `seed`, whichever thread asks. */
void path_trace(const path_plan *plan, int x, int y, uint64_t index, uint64_t seed, path_counts *counts,
                float rgb[3]);

#endif
