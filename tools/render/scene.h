/* A scene: the contents of a scene file, ready for rendering. scene_print_manual says how they are written. */
#pragma once

#include "render/geometry.h"
#include "render/image.h"
#include "vndf_bsdf.h"

enum { SCENE_MATERIALS_MAX = 1024, SCENE_LIGHTS_MAX = 64, SCENE_IMAGES_MAX = 64, SCENE_TABLES_MAX = 64 };

typedef enum material_kind {
    MATERIAL_ROUGH, /* vndf_bsdf.h */
    MATERIAL_MATTE, /* Lambert's */
    MATERIAL_LIGHT  /* emits, reflects nothing */
} material_kind;

typedef struct material {
    const char *name;
    material_kind kind;
    vndf_description is;                 /* ROUGH: the library takes it */
    float colour[3];                     /* LIGHT: radiance; others: multiplies what is scattered */
    const image *colour_map, *alpha_map; /* multiply colour and alpha, by their red; NULL: none */
} material;

/* Light from far away: a constant, or an image of longitude over latitude, y up, turned about y. Directions are
 * drawn from its pixels, by their light, of which `sums` has the sum up to each. */
typedef struct environment {
    float constant[3];
    const image *map;   /* NULL: the constant */
    double scale, turn; /* turn: a part of a full turn */
    double *sums;       /* owned */
    int is_drawn;       /* not if every direction finds its light */
} environment;

typedef struct scene {
    vec3 from, to, up;      /* of the camera */
    double field, exposure; /* of view, radians, across the height of the film; of the PNG */
    int width, height;
    int depth, samples; /* the most surfaces on a path; a pixel */
    environment environment;
    geometry geometry;                     /* owned, as are all below */
    const shape *lights[SCENE_LIGHTS_MAX]; /* which emit from their fronts: spheres and rectangles */
    size_t light_count;
    material materials[SCENE_MATERIALS_MAX];
    size_t material_count;
    image images[SCENE_IMAGES_MAX];
    vndf_distribution *tables[SCENE_TABLES_MAX];
    char *text; /* of the file, where the names are */
} scene;

/* Reads a scene file; paths in it are relative to its folder. NULL after a complaint. Files that are not trusted
 * are safe. */
scene *scene_read(const char *path);
void scene_free(scene *s);

/* The same from `length` bytes with a 0 behind them, which it takes over and frees; complaints call them `name`.
 */
scene *scene_read_text(const char *name, char *text, size_t length);

/* Sets the pixels across; the height follows. 0 after a complaint if no row is left, or they are too many. */
int scene_resize(scene *s, int width);

/* How scenes are written, to stdout. */
void scene_print_manual(void);

/* ---- light that is drawn ---- */

/* Lists the lights of a scene. 0 if there are more than SCENE_LIGHTS_MAX, or there is no memory. */
int lights_make(scene *s);

typedef struct light_sample {
    vec3 direction; /* towards the light, unit */
    double distance;
    double density; /* per steradian */
    float radiance[3];
} light_sample;

/* Whether there is light to draw. */
int lights_any(const scene *s);

/* Draws light, which is there, from a place, by three uniform numbers in [0, 1). 0: the place does not see what was
 * drawn. */
int lights_draw(const scene *s, vec3 place, const double u[3], light_sample *sample);

/* The density with which lights_draw finds, from a place, what a ray has met: a light, or (NULL) the environment. */
double lights_density(const scene *s, vec3 place, vec3 direction, const hit *h);

/* The light that comes from far away. */
void environment_radiance(const environment *e, vec3 direction, float rgb[3]);
