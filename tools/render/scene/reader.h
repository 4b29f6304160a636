/* What the parts of the reader of scenes share: words with their places, clauses of a statement, numbers,
 * refusals.
 *
 * A file is split into words (words.c), words into statements - a word in the first column begins one -,
 * and a statement into clauses: a keyword and what it takes (clauses.c). Each statement then has a
 * function of its own: settings.c, images.c, shapes.c, materials.c with metals.c
 * and tables.c. All of them return 1, or 0 after a refusal that names the place. */
#ifndef TOOLS_RENDER_SCENE_READER_H
#define TOOLS_RENDER_SCENE_READER_H

#include "cli/arguments.h"
#include "render/scene/scene.h"

/* Against files that mean harm. */
enum {
    SCENE_BYTES_MAX = 1 << 22,
    SCENE_MATERIALS_MAX = 4096,
    SCENE_IMAGES_MAX = 64,
    SCENE_TABLES_MAX = 64,
    SCENE_NAME_MAX = 64,                    /* letters of a name */
    SCENE_PIXELS_MAX = 2 * IMAGE_PIXELS_MAX /* of all images together */
};
#define SCENE_FAR 1e6   /* the largest coordinate or size */
#define SCENE_NEAR 1e-6 /* the smallest size */

typedef struct word {
    char *text;                 /* without its quotes; into the text of the file */
    unsigned line, column, end; /* from 1; end: the column after it */
    int quoted, begins;         /* begins: a statement */
} word;

typedef struct scene_reader {
    const char *name; /* of the file, for messages */
    size_t folder;    /* the first letters of the name that are the folder, its slash included */
    char *message;    /* room for `size`: where a refusal goes */
    size_t size;
    word *words; /* owned */
    size_t count, room;
    scene *made;
    unsigned seen;       /* a bit for each statement that may stand once */
    size_t pixels;       /* of all images so far */
    int gives_light;     /* a shape has a light for its material */
    scene_tables tables; /* in place of what materials say */
} scene_reader;

/* words[0] says what it is. */
typedef struct statement {
    const word *words;
    size_t count;
} statement;

/* A keyword with `least` to `most` words after it; `takes` says what they are. */
typedef struct clause {
    const char *keyword, *takes;
    size_t least, most;
    int needed;
    const word *at, *values; /* found: the keyword and what follows it; else NULL */
    size_t count;
} clause;

/* "NAME:LINE:COLUMN: ..."; returns 0. */
int reader_refuse(scene_reader *r, const word *at, const char *format, ...) PRINTF_LIKE(3, 4);

/* The same, of a word that is none of those that may stand there; the nearest one is offered, or all. `what`:
 * "statement". */
int reader_unknown(scene_reader *r, const word *at, const char *what, const char *const *names, size_t count);

/* Splits the text, which it changes. */
int reader_split(scene_reader *r, char *text, size_t size);

/* Finds the clauses of a statement in its words from `from` on. */
int reader_clauses(scene_reader *r, const statement *s, size_t from, clause *clauses, size_t count);

/* Value i of a clause that was found. */
int reader_number(scene_reader *r, const clause *c, size_t i, double low, double high, float *number);
int reader_whole(scene_reader *r, const clause *c, size_t i, double low, double high, unsigned *number);
int reader_three(scene_reader *r, const clause *c, double low, double high, float numbers[3]);
int reader_vector(scene_reader *r, const clause *c, vndf_vec3 *v);
int reader_choice(scene_reader *r, const clause *c, const char *const *names, size_t count, unsigned *choice);

/* The name that a statement gives: its second word. `what`: "material". */
int reader_name(scene_reader *r, const statement *s, const char *what, const word **name);

/* The image that a clause names. */
int reader_image(scene_reader *r, const clause *c, const image **found);

/* What the first channels of an image of something have to be. */
typedef struct image_range {
    const char *what; /* "colour" */
    int channels;
    double low, high;
} image_range;

int reader_within(scene_reader *r, const word *at, const image *map, const image_range *range);

/* A path of the scene file, as seen from here, noted as an input; the caller frees it. NULL after a refusal. */
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
int read_material(scene_reader *r, const statement *s);
int read_sphere(scene_reader *r, const statement *s);
int read_rectangle(scene_reader *r, const statement *s);
int read_box(scene_reader *r, const statement *s);
int read_mesh(scene_reader *r, const statement *s);

/* A distribution: ggx, beckmann, or a table that is loaded, or built in `bytes`, once for all materials that ask
 * for the same. */
int read_distribution(scene_reader *r, const clause *c, unsigned bytes, const vndf_distribution **found);

/* The clauses of a metal: `of` a named one, or its indices. */
int read_metal(scene_reader *r, const word *kind, const clause *of, const clause *eta, const clause *k,
               vndf_description *is);

#endif
