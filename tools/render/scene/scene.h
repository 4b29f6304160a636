/* A scene: the contents of a scene file, resolved and ready for rendering. grammar.c has the language. */
#ifndef TOOLS_RENDER_SCENE_SCENE_H
#define TOOLS_RENDER_SCENE_SCENE_H

#include "render/geometry/geometry.h"
#include "render/image/relief.h"
#include "vndf_bsdf.h"

typedef struct camera {
    vndf_vec3 from, to, up;
    float field; /* of view, degrees, across the height of the film */
} camera;

typedef struct integrator {
    unsigned depth;    /* the most surfaces on a path */
    unsigned roulette; /* from this surface on paths end at random */
    unsigned samples;  /* a pixel */
    float exposure;    /* of the PNG */
} integrator;

/* A number that may vary by a map: value, times the map if there is one. */
typedef struct textured {
    float value;
    const image *map; /* an image of the scene; NULL: constant */
} textured;

/* The parameter of a family: `from` where the red of the map is 0, `to` where it is 1; without a map `from`. */
typedef struct scene_parameter {
    float from, to;
    const image *map;
} scene_parameter;

/* A lobe of a surface that more than alpha along two axes describes: its matrix of slopes is `axes` (xx xy yx yy), with
 * columns times alpha_x and alpha_y; the slopes of a map add to its mean slope and, filtered, to M M^T. */
typedef struct scene_lobe {
    const vndf_distribution *distribution; /* of a family: of its knot nearest to the middle of the parameter */
    const vndf_family *family;             /* one of the scene, which takes its place; NULL: none */
    scene_parameter parameter;
    textured alpha_x, alpha_y;
    float rotation, axes[4];
    int is_matrix; /* `axes` is a matrix that was said, and alpha is 1 */
    float mean_x, mean_y;
    const relief *relief; /* one of the scene; NULL: none */
    textured weight;      /* in a mixture */
} scene_lobe;

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
    int is_textured;   /* either has a map: vndf_bsdf_rough at each hit */
    scene_lobe *lobes; /* owned; they take the place of alpha and rotation; NULL: they say it all */
    int lobe_count;    /* 0, or 1 to VNDF_MIXTURE_LOBES */
    float colour[3];   /* MATTE, MIRROR: reflectance; LIGHT: radiance; MICROFACET: multiplies */
    const image *colour_map;
    float absorb[3]; /* inside, per unit of length; all 0: none */
} material;

typedef struct environment {
    float constant[3];
    const image *map;  /* longitude over latitude, y up; NULL: constant alone */
    float scale, turn; /* of the map; degrees about y */
} environment;

/* A table of albedos: of a distribution, for an index, or for a mirror (0). */
typedef struct scene_albedo {
    const vndf_distribution *of;
    float eta;
    vndf_albedo *is;
} scene_albedo;

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
    relief **reliefs; /* owned */
    size_t relief_count;
    vndf_distribution **tables; /* owned */
    char **table_names;
    size_t table_count;
    vndf_family **families; /* owned */
    char **family_names;
    size_t family_count;
    scene_albedo *albedos; /* owned */
    size_t albedo_count;
    double albedo_seconds; /* that they took */
    environment environment;
} scene;

/* Tables that replace the distributions of a scene, to show what tables change. Formulas and families are built in
 * so many bytes, whatever their materials say (0: as they say); with `closed_forms`, ggx and beckmann too. Tables
 * of files stay. */
typedef struct scene_tables {
    unsigned bytes;
    int closed_forms;
} scene_tables;

/* Reads a scene file; paths in it are relative to its folder. Returns 1, or 0 with a message "FILE:LINE:COLUMN:
 * what is wrong, and what would be right". Untrusted files are safe. */
int scene_read(scene *made, const char *path, char *message, size_t size);
int scene_read_with(scene *made, const char *path, const scene_tables *tables, char *message, size_t size);
/* The same from memory; messages call the file `name`. `text` has a 0 behind its `length` bytes; the call changes
 * it. */
int scene_read_text(scene *made, const char *name, char *text, size_t length, char *message, size_t size);
/* Sets the pixels across; the height follows. 0 and a message if no row is left, or a film cannot have as many
 * pixels. */
int scene_resize(scene *s, int width, char *message, size_t size);

void scene_free(scene *s);

/* Builds the albedos that materials with energy compensation need before a plan is prepared, one for all that share
 * the distribution (and, where light passes, the index). `show` may be NULL. 0 and a message if the library refuses,
 * or `show` stops it. Does nothing where no shape has such a material. */
int scene_make_albedos(scene *s, vndf_albedo_progress *show, void *user, char *message, size_t size);
size_t scene_albedo_bytes(const scene *s);
void scene_free_albedos(scene *s); /* scene_free does it */

/* The shape that lobes call for, and the first of them, or all, without maps. */
vndf_shape scene_shape_of(const scene_lobe *lobes, int count);
vndf_affine scene_affine_of(const scene_lobe *l);
void scene_mixture_of(const scene_lobe *lobes, int count, vndf_mixture *made);

/* Lobes of the mixture that a lobe takes; and puts them behind those that are there. A family takes two. */
int scene_lobe_width(const scene_lobe *l);
void scene_add_lobe(const scene_lobe *l, const vndf_affine *surface, float parameter, float weight,
                    vndf_mixture *made);

/* Turns a message of the library about a material into the words of the language. */
void scene_wording(const char *said, char *message, size_t size);

/* The language, for --grammar, in parts. */
enum { SCENE_GRAMMAR_PARTS = 3 };
extern const char *const scene_grammar[SCENE_GRAMMAR_PARTS];

#endif
