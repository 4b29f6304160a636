/* The parts of the reader of scenes share this: words with their places, clauses of a statement, numbers,
 * refusals.
 *
 * words.c splits a file into words. A word in the first column begins a statement. clauses.c splits a statement
 * into clauses: a keyword and its values. Each statement then has a function of its own, in settings.c, images.c,
 * shapes.c, or materials.c and lobes.c with slopes.c, metals.c, tables.c and families.c. All of them return 1, or 0
 * after a refusal that names the place. */
#ifndef TOOLS_RENDER_SCENE_READER_H
#define TOOLS_RENDER_SCENE_READER_H

#include "cli/arguments.h"
#include "render/scene/scene.h"

/* Limits, against hostile files. */
enum {
    SCENE_BYTES_MAX = 1 << 22,
    SCENE_MATERIALS_MAX = 4096,
    SCENE_IMAGES_MAX = 64,
    SCENE_TABLES_MAX = 64,
    SCENE_FAMILIES_MAX = 16,
    SCENE_RELIEFS_MAX = 64,
    SCENE_LOBES_MAX = 256,
    SCENE_DISPLACED_MAX = 1 << 20,          /* pixels of heights that become triangles */
    SCENE_NAME_MAX = 64,                    /* letters of a name */
    SCENE_PIXELS_MAX = 2 * IMAGE_PIXELS_MAX /* of all images together */
};
#define SCENE_FAR 1e6   /* the largest coordinate or size */
#define SCENE_NEAR 1e-6 /* the smallest size */
#define SCENE_STEEP 1e3 /* the largest slope */

typedef struct word {
    char *text;                 /* without its quotes; into the text of the file */
    unsigned line, column, end; /* from 1; end: the column after it */
    int quoted, begins;         /* begins: a statement */
} word;

typedef struct scene_reader {
    const char *name; /* of the file, for messages */
    size_t folder;    /* the length of the folder in the name, with its slash */
    char *message;    /* room of `size` for a refusal */
    size_t size;
    word *words; /* owned */
    size_t count, room;
    scene *made;
    unsigned seen;            /* a bit for each statement that may stand once */
    size_t pixels;            /* of all images and maps of slopes so far */
    size_t displaced;         /* pixels of heights so far */
    int gives_light;          /* a shape has a light for its material */
    scene_tables tables;      /* they replace the distributions of materials */
    struct named_lobe *lobes; /* owned; those that 'mix' may name */
    size_t lobe_count;
} scene_reader;

/* words[0] names the statement. */
typedef struct statement {
    const word *words;
    size_t count;
} statement;

/* A keyword with `least` to `most` words after it; `takes` describes them. */
typedef struct clause {
    const char *keyword, *takes;
    size_t least, most;
    int needed;
    const word *at, *values; /* the keyword and the words after it, if found; else NULL */
    size_t count;
} clause;

/* "NAME:LINE:COLUMN: ..."; returns 0. */
int reader_refuse(scene_reader *r, const word *at, const char *format, ...) PRINTF_LIKE(3, 4);

/* The same for a word that may not stand there; offers the nearest valid word, or all. `what`: "statement". */
int reader_unknown(scene_reader *r, const word *at, const char *what, const char *const *names, size_t count);

/* Splits the text into words; changes the text. */
int reader_split(scene_reader *r, char *text, size_t size);

/* Finds the clauses of a statement in its words from `from` on. */
int reader_clauses(scene_reader *r, const statement *s, size_t from, clause *clauses, size_t count);

/* Reads value i of a clause that was found. */
int reader_number(scene_reader *r, const clause *c, size_t i, double low, double high, float *number);
int reader_whole(scene_reader *r, const clause *c, size_t i, double low, double high, unsigned *number);
int reader_three(scene_reader *r, const clause *c, double low, double high, float numbers[3]);
int reader_vector(scene_reader *r, const clause *c, vndf_vec3 *v);
int reader_choice(scene_reader *r, const clause *c, const char *const *names, size_t count, unsigned *choice);

/* The name that a statement defines: its second word. `what`: "material". */
int reader_name(scene_reader *r, const statement *s, const char *what, const word **name);

/* The image that a clause names. */
int reader_image(scene_reader *r, const clause *c, const image **found);

/* The range that the first channels of an image must keep. */
typedef struct image_range {
    const char *what; /* "colour" */
    int channels;
    double low, high;
} image_range;

int reader_within(scene_reader *r, const word *at, const image *map, const image_range *range);

/* A path in the scene file, made relative to the working folder and noted as an input. The caller frees it. NULL
 * after a refusal. */
char *reader_path(scene_reader *r, const word *at);

/* A copy that the caller frees; NULL after a refusal. */
char *reader_copy(scene_reader *r, const word *at);

/* Statements. */
int read_title(scene_reader *r, const statement *s);
int read_film(scene_reader *r, const statement *s);
int read_camera(scene_reader *r, const statement *s);
int read_integrator(scene_reader *r, const statement *s);
int read_environment(scene_reader *r, const statement *s);
int read_image(scene_reader *r, const statement *s);
int read_lobe(scene_reader *r, const statement *s);
int read_material(scene_reader *r, const statement *s);
int read_sphere(scene_reader *r, const statement *s);
int read_rectangle(scene_reader *r, const statement *s);
int read_box(scene_reader *r, const statement *s);
int read_mesh(scene_reader *r, const statement *s);

/* A distribution: ggx, beckmann, or a table that is loaded, or built in `bytes`. Materials with the same
 * distribution share it. */
int read_distribution(scene_reader *r, const clause *c, unsigned bytes, const vndf_distribution **found);

/* The clauses of a metal: `of` and its name, or its indices. */
int read_metal(scene_reader *r, const word *kind, const clause *of, const clause *eta, const clause *k,
               vndf_description *is);

#endif
