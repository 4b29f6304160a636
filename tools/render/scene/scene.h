/* A scene: what a scene file says, resolved and ready to be rendered. grammar.c has the
 * language. */
#ifndef TOOLS_RENDER_SCENE_SCENE_H
#define TOOLS_RENDER_SCENE_SCENE_H

#include "render/geometry/geometry.h"
#include "render/image/image.h"
#include "vndf_bsdf.h"

typedef struct camera {
    vndf_vec3 from, to, up;
    float field; /* of view, degrees, across the height of the film */
} camera;

typedef struct integrator {
    unsigned depth;    /* surfaces on a path at most */
    unsigned roulette; /* from this surface on paths are ended at random */
    unsigned samples;  /* a pixel */
    float exposure;    /* of the PNG */
} integrator;

/* A number that may be a map: value, times the map where there is one. */
typedef struct textured {
    float value;
    const image *map; /* of the scene's images; NULL: constant */
} textured;

typedef enum material_kind {
    MATERIAL_MICROFACET, /* conductor, dielectric, ...: vndf_bsdf.h */
    MATERIAL_MATTE,      /* Lambert */
    MATERIAL_MIRROR,     /* smooth, colour */
    MATERIAL_GLASS,      /* smooth dielectric, eta */
    MATERIAL_LIGHT       /* emits, reflects nothing */
} material_kind;

typedef struct material {
    char *name; /* owned */
    material_kind kind;
    vndf_description is; /* MICROFACET: the library takes it; GLASS: eta */
    textured alpha_x, alpha_y;
    int is_textured; /* either has a map: vndf_bsdf_rough at each hit */
    float colour[3]; /* MATTE, MIRROR: reflectance; LIGHT: radiance; MICROFACET: multiplies */
    const image *colour_map;
    float absorb[3]; /* inside, per unit of length; all 0: none */
} material;

typedef struct environment {
    float constant[3];
    const image *map;  /* longitude over latitude, y up; NULL: constant alone */
    float scale, turn; /* of the map; degrees about y */
} environment;

typedef struct scene {
    char *title; /* owned; may be NULL */
    camera camera;
    int width, height;
    integrator integrator;
    geometry geometry;
    material *materials;
    size_t material_count;
    image *images;
    char **image_names;
    size_t image_count;
    vndf_distribution **tables; /* owned */
    char **table_names;
    size_t table_count;
    environment environment;
} scene;

/* What takes the place of a scene's distributions, to see what tables change: those of formulas and families are
 * built in so many bytes, whatever their materials say (0: as they say), and ggx and beckmann too where
 * `closed_forms`. Tables of files stay. */
typedef struct scene_tables {
    unsigned bytes;
    int closed_forms;
} scene_tables;

/* Reads a scene file; paths in it are relative to its folder. 1, or 0 with a message "FILE:LINE:COLUMN: what is
 * wrong, and what would be right". Untrusted files are safe. */
int scene_read(scene *made, const char *path, char *message, size_t size);
int scene_read_with(scene *made, const char *path, const scene_tables *tables, char *message, size_t size);
/* The same from memory; `name` stands for the file. `text` has a 0 behind its `length` bytes, and is changed. */
int scene_read_text(scene *made, const char *name, char *text, size_t length, char *message, size_t size);
/* Pixels across; the height follows. 0 and a message if that leaves no row, or more pixels than a film has. */
int scene_resize(scene *s, int width, char *message, size_t size);

void scene_free(scene *s);

/* What the library says of a material, in the words of the language. */
void scene_wording(const char *said, char *message, size_t size);

/* The language, for --grammar: one part after the other. */
enum { SCENE_GRAMMAR_PARTS = 2 };
extern const char *const scene_grammar[SCENE_GRAMMAR_PARTS];

#endif
