/* The parts of a plan: path_prepare resolves them once, path_trace runs them.
 *
 *   plan.c         finds which effects a scene calls for; puts the parts below together
 *   material.c     a material as routines made for its kind: no test of a kind at a hit
 *   rough.c        rough materials: the routines of the library
 *   lobes.c        those with matrices, mean slopes, maps of slopes and several lobes
 *   perfect.c      or sampling precomputed for the whole BSDF
 *   lights.c       emitting shapes: drawing a point, and the density of a point that a ray meets
 *   environment.c  light from far away: its radiance, drawing a direction of its image
 *   alias.c        draws one of many, by its probability
 *   path.c         the path itself
 *   media.h        the bodies that hold the path
 *   repeat.c       the time that the library takes
 *
 * A direction may be drawn by the material or from a light; the squares of the two densities weigh both estimates
 * (Veach & Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", SIGGRAPH 1995). Lights are
 * drawn for directions to the outside of a surface only: inside a closed body its own surface hides them, and the
 * material alone finds their light. */
#ifndef TOOLS_RENDER_PATH_PARTS_H
#define TOOLS_RENDER_PATH_PARTS_H

#include "render/path/path.h"
#include "render/path/alias.h"
#include "render/perfect/perfect.h"

/* ---- materials ---- */

typedef struct path_material path_material;

/* A hit as its material sees it. */
typedef struct path_point {
    const path_material *material;
    const hit *hit;
    frame frame;  /* of shading; geometric where the two differ about the side of the ray */
    vndf_vec3 wi; /* in that frame */
    const float *colour;
    float mapped[3];     /* the colour of a map */
    vndf_bsdf bsdf;      /* of rough materials */
    perfect_hit perfect; /* takes its place in perfectly sampled materials */
} path_point;

typedef struct bounce {
    vndf_vec3 wo;    /* in the frame */
    float weight[3]; /* f |cos| / density */
    float density;   /* 0: a Dirac, which nothing else finds */
    float carried;   /* the factor of refraction in the weight: 1 or 1/eta^2 */
} bounce;

typedef struct path_routines {
    int (*begin)(path_point *p);       /* fills the rest of a point; 0: nothing is scattered */
    int (*begin_plain)(path_point *p); /* the same if the point has its colour already */
    int (*sample)(const path_point *p, const float u[3], bounce *b);
    /* f; returns the cosine that goes with it, at least 0 where wo.z > 0. NULL: a Dirac */
    float (*eval)(const path_point *p, vndf_vec3 wo, uint64_t seed, float value[3]);
    float (*pdf)(const path_point *p, vndf_vec3 wo);
} path_routines;

struct path_material {
    const material *is;
    vndf_material bsdf;
    float colour[3];
    float eta;                            /* of smooth dielectrics */
    vndf_roughness roughness;             /* its rotation, and alpha unless a map changes it */
    const path_perfect *perfect;          /* for perfectly sampled rough materials; else NULL */
    scene_lobe lobes[VNDF_MIXTURE_LOBES]; /* of materials that have some */
    int lobe_count;
    vndf_mixture mixture; /* of them, without maps */
    int emits, absorbs;
    path_routines run, once; /* once: see repeat.c */
};

/* Perfect sampling of all BSDFs of a scene. */
typedef struct path_perfects {
    path_perfect **list;
    size_t count;
    double seconds; /* to make them */
} path_perfects;

void path_perfects_free(path_perfects *all);

/* The arguments of a plan. */
typedef struct path_choice {
    path_sampler sampler;
    unsigned without;
    path_perfects *perfects; /* for the materials to share */
} path_choice;

/* Returns 0 and a message if the library or perfect sampling refuses. */
int path_material_prepare(path_material *made, const material *is, const path_choice *choice, char *message,
                          size_t size);
int path_rough_make(path_material *m, const path_choice *choice, char *message, size_t size);

/* Routines of rough materials that others build on; and a number at a hit. */
int path_rough_sample(const path_point *p, const float u[3], bounce *b);
float path_rough_eval(const path_point *p, vndf_vec3 wo, uint64_t seed, float value[3]);
float path_textured(const textured *t, const hit *h);

/* Of a material with lobes: their effects; what the library is told of them; then, resolved, its routines. */
unsigned path_lobes_effects(const material *is);
void path_lobes_describe(path_material *m, unsigned without, vndf_description *is);
void path_lobes_make(path_material *m);

/* The effects that a material calls for, as bits. */
unsigned path_material_effects(const material *is);

/* ---- lights ---- */

typedef struct light_sample {
    vndf_vec3 direction; /* towards the light, unit */
    float distance;
    float density;         /* per steradian */
    const float *radiance; /* NULL: the radiance of the environment */
    uint32_t shape;        /* the shape of the light */
} light_sample;

typedef struct path_light {
    uint32_t shape;
    shape_kind kind;
    sphere sphere;
    rectangle rectangle; /* of a triangle: a corner and the edges from it */
    vndf_vec3 normal;    /* of rectangles and triangles */
    float area;
    float radiance[3];
    float power; /* radiance times the area that is visible from far away */
} path_light;

/* More lights than LIGHTS_SEEN are chosen by power alone, wherever they are. */
enum { LIGHTS_SEEN = 16 };

typedef struct path_lights {
    path_light *lights;
    uint32_t count;
    int32_t *of_shape;     /* index of a shape's light, -1 for other shapes; NULL if there are no lights */
    alias_place *by_power; /* for more lights than LIGHTS_SEEN */
} path_lights;

/* Light from a place: the probabilities with which each of its sources is chosen. */
typedef struct light_view {
    vndf_vec3 place;
    float environment, lights; /* of all lights together; both 0: none is visible */
    float part[LIGHTS_SEEN];   /* of each light; empty if there are more */
} light_view;

/* 0 if there is no memory. */
int path_lights_make(path_lights *made, const scene *s);
void path_lights_free(path_lights *lights);

/* Looks at the lights from the outside of a surface, with an environment of the power `far`. */
void path_lights_look(const path_lights *lights, float far, vndf_vec3 place, vndf_vec3 normal, light_view *v);

/* Draws from 64 random bits and three uniform numbers; the first is below v->lights and chooses a light. 0: the
 * place does not see it. */
int path_lights_draw(const path_lights *lights, const light_view *v, uint64_t choice, const float u[3],
                     light_sample *s);

/* The density with which path_lights_draw finds the point that a ray from the place has met. */
float path_lights_density(const path_lights *lights, const light_view *v, vndf_vec3 direction, const hit *h);

/* ---- the environment ---- */

/* Heights y of a row of cells, minus the height of the nearer pole: 1, -1, or 0 for a row across the equator. */
typedef struct environment_row {
    float top, bottom, pole;
} environment_row;

typedef struct path_environment {
    const environment *is;
    float turn;             /* a part of a full turn, [0, 1] */
    float power;            /* the image's luminance over all directions */
    unsigned shift;         /* cells have 2^shift pixels a side */
    uint32_t columns, rows; /* of cells */
    environment_row *limits;
    alias_place *cells; /* with densities per steradian; NULL: not drawn */
    /* The radiance, and, if `density` is not NULL, the density with which path_environment_draw finds the
     * direction. */
    void (*radiance)(const struct path_environment *e, vndf_vec3 direction, float rgb[3], float *density);
} path_environment;

/* Without cells to draw from if `drawn` is 0. Returns 0 if there is no memory. */
int path_environment_make(path_environment *made, const environment *is, int drawn);
void path_environment_free(path_environment *e);

/* Draws from 64 random bits and two uniform numbers. */
void path_environment_draw(const path_environment *e, uint64_t choice, const float u[2], light_sample *s);

/* ---- the plan ---- */

typedef struct path_walk path_walk;

struct path_plan {
    const scene *scene;
    unsigned effects;
    vndf_vec3 corner, right,
        down; /* the film, at distance 1 from the eye: pixels are at corner + x right + y down */
    path_material *materials;
    path_perfects perfects;
    path_lights lights;
    path_environment environment;
    void (*trace)(path_walk *w); /* the loop that this scene needs; see path.c */
};

/* For measurements: from now on every call of the library runs twice, with the same result. */
void path_repeat(path_plan *plan);

/* In path.c: the loop for a scene with or without lights to draw, and with or without absorption. */
void (*path_loop(int lit, int absorbing))(path_walk *w);

#endif
