/* Perfect sampling: precomputed for the whole BSDF of one material, so that all drawn directions have nearly the
 * same weight. A yardstick for samplers of normals, for toy scenes: each BSDF takes 0.5 to 19 MiB and up to 1.6 s
 * (a stretched table that reflects and transmits). Roughness from a map is not supported. */
#ifndef TOOLS_RENDER_PERFECT_PERFECT_H
#define TOOLS_RENDER_PERFECT_PERFECT_H

#include <stddef.h>

#include "render/perfect/table.h"
#include "vndf_bsdf.h"

typedef struct path_perfect {
    vndf_description is;    /* its axes along x and y */
    vndf_material material; /* the same, visible normals */
    perfect_table table;
} path_perfect;

/* A direction of light, and everything that depends on it: a plain value, valid while the sampler lives. */
typedef struct perfect_hit {
    const path_perfect *is;
    float xx, xy, yx, yy; /* the frame of the table: x' = xx x + xy y, y' = yx x + yy y */
    vndf_vec3 wi;         /* in that frame: x, y >= 0 */
    float eta;            /* index on the other side over that on the side of wi */
    vndf_bsdf bsdf;
    vndf_view view; /* of wi turned up */
    perfect_place place;
} perfect_hit;

/* Why a BSDF cannot be precomputed, as a text to follow "material 'x': "; NULL if it can. */
const char *path_perfect_refuses(const vndf_description *is);

/* The distribution must outlive the sampler. NULL, with the reason in *error, if there is no memory or the library
 * refuses. Ignores the rotation of the axes, which belongs to hits. */
path_perfect *path_perfect_make(const vndf_description *is, vndf_error *error);
void path_perfect_free(path_perfect *p);

/* Whether the sampler serves this description too. */
int path_perfect_is_of(const path_perfect *p, const vndf_description *is);

/* The bytes that it holds. */
size_t path_perfect_bytes(const path_perfect *p);

/* As the calls of vndf_bsdf.h do, in the frame of the hit, with the axes of the roughness turned in it (alpha of
 * `turned` is not read). begin: 0 if nothing is scattered; sample: u in [0, 1); eval: f. */
int path_perfect_begin(perfect_hit *h, const path_perfect *p, const vndf_roughness *turned, vndf_vec3 wi);
void path_perfect_sample(const perfect_hit *h, const float u[3], vndf_scattered *s);
void path_perfect_eval(const perfect_hit *h, vndf_vec3 wo, float value[3]);
float path_perfect_pdf(const perfect_hit *h, vndf_vec3 wo);

#endif
