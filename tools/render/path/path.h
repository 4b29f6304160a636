/* Light along paths from the eye: next-event estimation and multiple importance sampling where the scene calls
 * for them. What it calls for is found out once (plan), and nothing else runs. */
#ifndef TOOLS_RENDER_PATH_PATH_H
#define TOOLS_RENDER_PATH_PATH_H

#include <stdint.h>

#include "render/scene/scene.h"

/* How normals are drawn by all microfacet materials of a scene; MATERIAL: as each says. PERFECT: directions are,
 * by tables made for the whole BSDF of each (perfect.h). */
typedef enum path_sampler {
    SAMPLER_MATERIAL,
    SAMPLER_ALL,
    SAMPLER_VISIBLE,
    SAMPLER_BOUNDED,
    SAMPLER_PERFECT
} path_sampler;

enum { SAMPLERS = SAMPLER_PERFECT + 1 };
extern const char *const path_sampler_names[SAMPLERS];

/* Effects of a scene, a bit each: what has to run. --explain lists them. */
enum {
    EFFECT_MICROFACETS = 1,
    EFFECT_REFRACTION = 2,
    EFFECT_MULTIPLE = 4,
    EFFECT_TEXTURED_ALPHA = 8,
    EFFECT_LIGHTS = 16,          /* emitting shapes, sampled */
    EFFECT_ENVIRONMENT = 32,     /* any light from far away */
    EFFECT_ENVIRONMENT_MAP = 64, /* an image, sampled */
    EFFECT_ABSORPTION = 128,
    EFFECT_MATTE = 256,
    EFFECT_SPECULAR = 512,
    EFFECT_COLOUR_MAPS = 1024,
    EFFECT_MESHES = 2048,
    EFFECT_ROTATED_AXES = 4096
};

typedef struct path_plan path_plan;

/* Lights, distributions over them, materials with the sampler asked for; NULL and a message if something refuses
 * (a sampler that a material cannot have). Effects in `without` are left out, for measurements. The scene must
 * outlive it. */
path_plan *path_prepare(const scene *s, path_sampler sampler, unsigned without, char *message, size_t size);
void path_free(path_plan *plan);
unsigned path_effects(const path_plan *plan);

/* What perfect sampling took to prepare; all 0 with other samplers. */
typedef struct path_precomputed {
    size_t count, bytes; /* BSDFs: materials that share one count once */
    double seconds;
} path_precomputed;

path_precomputed path_perfect_cost(const path_plan *plan);

/* Counters of one thread. */
typedef struct path_counts {
    uint64_t paths, segments, shadow_rays, samples_lost;
} path_counts;

/* One path through pixel (x, y): the radiance it brings. Number `index` of the pixel under `seed`: the same for
 * any number of threads. */
void path_trace(const path_plan *plan, int x, int y, uint64_t index, uint64_t seed, path_counts *counts,
                float rgb[3]);

#endif
