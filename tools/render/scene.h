/* A scene: the contents of a scene file, ready for rendering. scene_print_manual says how they are written. */
#pragma once

#include "render/geometry.h"
#include "render/image.h"
#include "vndf_bsdf.h"

enum { SCENE_MATERIALS_MAX = 1024, SCENE_LIGHTS_MAX = 64, SCENE_FILES_MAX = 64 /* images; tables */ };

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
    double scale, turn; /* turn: degrees */
    double *sums;       /* owned */
    double drawn;       /* the part of all draws that is of the image: 0 if every direction finds its light */
} environment;

typedef struct scene {
    vec3 from, to, up;      /* of the camera */
    double field, exposure; /* of view, degrees, across the height of the film; of the PNG */
    int width, height;
    int depth, samples; /* the most surfaces on a path; a pixel */
    environment environment;
    geometry geometry;                     /* owned, as are all below */
    const shape *lights[SCENE_LIGHTS_MAX]; /* which emit from their fronts: spheres and rectangles */
    size_t light_count;
    material materials[SCENE_MATERIALS_MAX];
    size_t material_count;
    image images[SCENE_FILES_MAX];
    vndf_distribution *tables[SCENE_FILES_MAX];
    char *text; /* of the file, where the names are */
} scene;

/* Reads `length` bytes of a scene file with a 0 behind them, which it takes over and frees; paths in it are relative
 * to the folder of `path`. `width`, unless it is 0, takes the place of the pixels across, and the height follows.
 * NULL after a complaint. Files that are not trusted are safe. */
enum { SCENE_BYTES_MAX = 1 << 22 };
scene *scene_read(const char *path, char *text, size_t length, int width);
void scene_free(scene *s);

/* How scenes are written, to stdout. */
void scene_print_manual(void);

/* Lists the lights of a scene (path.c). 0 if there are more than SCENE_LIGHTS_MAX, or there is no memory. */
int lights_make(scene *s);
