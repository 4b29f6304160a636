/* Light along paths from the eye: next-event estimation and multiple importance sampling where the scene calls
 * for them. The plan finds out once which effects the scene calls for, and nothing else runs. */
#ifndef TOOLS_RENDER_PATH_PATH_H
#define TOOLS_RENDER_PATH_PATH_H

#include <stdint.h>

#include "render/scene/scene.h"

/* How all microfacet materials of a scene draw normals. MATERIAL: as each says. PERFECT: they draw directions, by
 * tables made for the whole BSDF of each (perfect.h). */
typedef enum path_sampler {
    SAMPLER_MATERIAL,
    SAMPLER_ALL,
    SAMPLER_VISIBLE,
    SAMPLER_BOUNDED,
    SAMPLER_PERFECT
} path_sampler;

enum { SAMPLERS = SAMPLER_PERFECT + 1 };
extern const char *const path_sampler_names[SAMPLERS];

/* The effects that a scene calls for, a bit each. --explain lists them. */
enum {
    EFFECT_MICROFACETS = 1,
    EFFECT_REFRACTION = 2,
    EFFECT_MULTIPLE = 4,
    EFFECT_TEXTURED_ALPHA = 8,
    EFFECT_LIGHTS = 16,          /* emitting shapes, drawn */
    EFFECT_ENVIRONMENT = 32,     /* any light from far away */
    EFFECT_ENVIRONMENT_MAP = 64, /* an image, drawn */
    EFFECT_ABSORPTION = 128,
    EFFECT_MATTE = 256,
    EFFECT_SPECULAR = 512,
    EFFECT_COLOUR_MAPS = 1024,
    EFFECT_MESHES = 2048,
    EFFECT_ROTATED_AXES = 4096,
    EFFECT_MATRICES = 8192,
    EFFECT_MEAN_SLOPES = 16384,
    EFFECT_RELIEFS = 32768, /* maps of slopes */
    EFFECT_MIXTURES = 65536,
    EFFECT_TEXTURED_WEIGHTS = 131072,
    EFFECT_RETROREFLECTION = 262144,
    EFFECT_COMPENSATION = 524288, /* turquin, kulla-conty */
    EFFECT_FAMILIES = 1048576
};

typedef struct path_plan path_plan;

/* Prepares lights, distributions over them, and materials with the given sampler. NULL and a message if a material
 * cannot have the sampler. Effects in `without` are left out, for measurements. The scene must outlive the
 * plan; materials with energy compensation need its albedos (scene_make_albedos). */
path_plan *path_prepare(const scene *s, path_sampler sampler, unsigned without, char *message, size_t size);
void path_free(path_plan *plan);
unsigned path_effects(const path_plan *plan);

/* The cost of preparing perfect sampling; all 0 with other samplers. */
typedef struct path_precomputed {
    size_t count, bytes; /* of BSDFs: materials that share one count once */
    double seconds;
} path_precomputed;

path_precomputed path_perfect_cost(const path_plan *plan);

/* Counters of one thread. */
typedef struct path_counts {
    uint64_t paths, segments, shadow_rays, samples_lost;
} path_counts;

/* Traces one path through pixel (x, y) and returns its radiance. Path `index` of the pixel under `seed` is the
 * same for any number of threads. */
void path_trace(const path_plan *plan, int x, int y, uint64_t index, uint64_t seed, path_counts *counts,
                float rgb[3]);

#endif
