/* Reads a scene: the words of the file, statement after statement by the table of keys, then a look at the whole.
 *
 * Blanks, tabs and ends of lines separate the words; # outside quotes begins a comment; "quotes" hold blanks. A word
 * in the first column of a line begins a statement; a line that begins with a blank continues it. Everything that
 * reads returns 1, or 0 after a refusal that names the place. */
#include "render/scene.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/files.h"
#include "render/light.h"
#include "vndf_build.h"

/* Against hostile files. */
enum {
    BYTES_MAX = 1 << 22,
    MATERIALS_MAX = 4096,
    PIXELS_MAX = 2 * IMAGE_PIXELS_MAX /* of all images together */
};

static const double least_size = 1e-6;

typedef struct word {
    char *text;            /* without its quotes; into the text of the file */
    unsigned line, column; /* from 1 */
    int is_quoted, begins; /* begins: a statement */
} word;

typedef enum key_kind { WORDS, NUMBERS, WHOLE } key_kind;
/* OR: one of it and `other`; BESIDE: only with that. */
typedef enum key_rule { MAY_BE, NEEDED, OR, BESIDE } key_rule;

/* A keyword of a statement, with `least` to `most` words, or up to three numbers from `low` to `high`, behind it. */
typedef struct key {
    const char *of, *name, *takes;
    key_kind kind;
    size_t least, most;
    double low, high;
    key_rule rule;
    const char *other;
} key;

typedef struct clause {
    const key *is;
    const word *at, *value; /* the keyword and what is behind it; NULL if it is not there */
    size_t count;
    double number[3];
} clause;

enum { CLAUSES_MAX = 16 };

#define PLACE "X Y Z", NUMBERS, 3, 3, -1e6, 1e6
#define NAME WORDS, 1, 1, 0, 0

/* Of every statement, or of its kind; those of the three kinds of rough materials are of "rough", that of all shapes
 * of "body". */
static const key keys[] = {
    {"film", "width", "PIXELS", WHOLE, 1, 1, 1, IMAGE_SIDE_MAX, NEEDED, NULL},
    {"film", "height", "PIXELS", WHOLE, 1, 1, 1, IMAGE_SIDE_MAX, NEEDED, NULL},
    {"camera", "from", PLACE, NEEDED, NULL},
    {"camera", "to", PLACE, NEEDED, NULL},
    {"camera", "up", PLACE, MAY_BE, NULL},
    {"camera", "field", "DEGREES", NUMBERS, 1, 1, 1, 170, MAY_BE, NULL},
    {"integrator", "depth", "N", WHOLE, 1, 1, 1, 10000, MAY_BE, NULL},
    {"integrator", "samples", "N", WHOLE, 1, 1, 1, 1e9, MAY_BE, NULL},
    {"integrator", "exposure", "F", NUMBERS, 1, 1, 1e-6, 1e6, MAY_BE, NULL},
    {"environment", "constant", "R G B", NUMBERS, 3, 3, 0, 1e6, OR, "image"},
    {"environment", "image", "NAME", NAME, MAY_BE, NULL},
    {"environment", "scale", "F", NUMBERS, 1, 1, 0, 1e6, BESIDE, "image"},
    {"environment", "turn", "DEGREES", NUMBERS, 1, 1, -360, 360, BESIDE, "image"},
    {"image", "file", "PATH", NAME, OR, "pattern"},
    {"image", "pattern", "NAME", NAME, MAY_BE, NULL},
    {"image", "width", "PIXELS", WHOLE, 1, 1, 1, IMAGE_SIDE_MAX, BESIDE, "pattern"},
    {"image", "height", "PIXELS", WHOLE, 1, 1, 1, IMAGE_SIDE_MAX, BESIDE, "pattern"},
    {"conductor", "of", "METAL", NAME, OR, "eta"},
    {"conductor", "eta", "R G B", NUMBERS, 3, 3, 0, 1000, MAY_BE, NULL},
    {"conductor", "k", "R G B", NUMBERS, 3, 3, 0, 1000, OR, "of"},
    {"dielectric", "index", "N", NUMBERS, 1, 1, 0.01, 100, NEEDED, NULL},
    {"rough", "distribution", "ggx|beckmann|table FILE|family NAME|slope FORMULA|ndf FORMULA", WORDS, 1, 2, 0, 0,
     NEEDED, NULL},
    {"rough", "bytes", "COUNT", WHOLE, 1, 1, 2048, 1 << 20, MAY_BE, NULL},
    {"rough", "alpha", "A or AX AY", NUMBERS, 1, 2, 1e-6, 1e3, MAY_BE, NULL},
    {"rough", "alpha-map", "IMAGE", NAME, MAY_BE, NULL},
    {"rough", "scattering", "single|multiple", NAME, MAY_BE, NULL},
    {"rough", "colour", "R G B", NUMBERS, 3, 3, 0, 1, MAY_BE, NULL},
    {"rough", "colour-map", "IMAGE", NAME, MAY_BE, NULL},
    {"matte", "colour", "R G B", NUMBERS, 3, 3, 0, 1, NEEDED, NULL},
    {"matte", "colour-map", "IMAGE", NAME, MAY_BE, NULL},
    {"light", "radiance", "R G B", NUMBERS, 3, 3, 0, 1e6, NEEDED, NULL},
    {"sphere", "centre", PLACE, NEEDED, NULL},
    {"sphere", "radius", "R", NUMBERS, 1, 1, 1e-6, 1e6, NEEDED, NULL},
    {"rectangle", "corner", PLACE, NEEDED, NULL},
    {"rectangle", "edge-u", PLACE, NEEDED, NULL},
    {"rectangle", "edge-v", PLACE, NEEDED, NULL},
    {"mesh", "file", "PATH", NAME, OR, "pattern"},
    {"mesh", "pattern", "knot", NAME, MAY_BE, NULL},
    {"mesh", "scale", "FACTOR", NUMBERS, 1, 1, 1e-6, 1e6, MAY_BE, NULL},
    {"mesh", "turn", "DEGREES", NUMBERS, 1, 1, -360, 360, MAY_BE, NULL},
    {"mesh", "move", PLACE, MAY_BE, NULL},
    {"body", "material", "NAME", NAME, NEEDED, NULL},
};

typedef struct reader {
    const char *name; /* of the file */
    char *message;    /* room of `size` for a refusal */
    size_t size;
    word *words; /* owned */
    size_t word_count, room;
    scene *made;
    const word *list; /* the statement at hand; list[0] names it */
    size_t count;
    clause clause[CLAUSES_MAX]; /* of all its keys */
    size_t clauses;
    size_t folder; /* the length of the folder in the name of the file, with its slash */
    unsigned seen; /* a bit for each statement */
    const char *images[SCENE_IMAGES_MAX], *materials[MATERIALS_MAX]; /* their names */
    size_t pixels;                                                   /* of all images so far */
    struct made_table {
        size_t form;
        unsigned bytes;
        const char *text;
    } tables[SCENE_TABLES_MAX]; /* what those of the scene are made from */
} reader;

/* "NAME:LINE:COLUMN: ..."; returns 0. */
PRINTF_LIKE(3, 4) static int refuse(reader *r, const word *at, const char *format, ...)
{
    int head = snprintf(r->message, r->size, "%s:%u:%u: ", r->name, at->line, at->column);
    va_list list;
    va_start(list, format);
    if (head >= 0 && (size_t)head < r->size)
        vsnprintf(r->message + head, r->size - (size_t)head, format, list);
    va_end(list);
    return 0;
}

/* Which of the names a word is; a refusal offers the nearest one, or all of them. `what`: "pattern". */
static int read_choice(reader *r, const word *at, const char *what, const char *const *names, size_t count,
                       size_t *chosen)
{
    char all[512] = "";
    size_t used = 0;
    for (*chosen = 0; *chosen < count; ++*chosen)
        if (strcmp(at->text, names[*chosen]) == 0)
            return 1;
    const char *near = nearest_word(at->text, names, count);
    if (near)
        return refuse(r, at, "'%.64s' is no %s; did you mean '%s'?", at->text, what, near);
    for (size_t i = 0; i < count && used < sizeof all; i++)
        used += (size_t)snprintf(all + used, sizeof all - used, "%s%s", i ? ", " : "", names[i]);
    return refuse(r, at, "'%.64s' is no %s; it must be one of: %s", at->text, what, count ? all : "(none yet)");
}

/* ---- words ---- */

static int add_word(reader *r, const word *added)
{
    if (r->word_count == r->room) {
        const size_t room = 256 + 2 * r->room;
        word *larger = realloc(r->words, room * sizeof *larger);
        if (!larger)
            return refuse(r, added, "there is no memory for the words of this file");
        r->words = larger;
        r->room = room;
    }
    r->words[r->word_count++] = *added;
    return r->words[0].begins ||
           refuse(r, added,
                  "a statement begins in the first column; lines that begin with a blank go on with the one "
                  "before");
}

/* Splits the text, which has a 0 behind its bytes and is changed, into words. The list is to be freed in any case. */
static int split_words(reader *r, char *text, size_t length)
{
    unsigned line = 1;
    for (char *at = text, *start = text; at < text + length;) { /* start: of the line */
        const word w = {at + (*at == '"'), line, (unsigned)(at - start) + 1, *at == '"', at == start};
        if (strchr(" \t\r\n#", *at) && *at) {
            line += *at == '\n';
            start = *at == '\n' ? at + 1 : start;
            at += *at == '#' ? strcspn(at, "\n") : 1;
            continue;
        }
        char *end = w.text;
        while (w.is_quoted ? *end && *end != '"' && *end != '\n'
                           : (unsigned char)*end > ' ' && *end != '"' && *end != '#' && *end != 127)
            end++;
        const word behind = {end + w.is_quoted, line, (unsigned)(end + w.is_quoted - start) + 1, 0, 0};
        if (w.is_quoted && *end != '"')
            return refuse(r, &w, "the quote that begins here does not end on its line");
        if (end == w.text && !w.is_quoted)
            return refuse(r, &w, "a byte %u, which is no text", (unsigned)(unsigned char)*end);
        if (*behind.text && !strchr(" \t\r\n#", *behind.text))
            return refuse(r, &behind, "a blank is missing before this");
        if (!add_word(r, &w))
            return 0;
        at = behind.text; /* read what ends the word before the 0 that takes its place */
        line += *at == '\n';
        start = *at == '\n' ? at + 1 : start;
        at += *at == '#' ? strcspn(at, "\n") : *at != '\0';
        *end = '\0';
    }
    return 1;
}

/* ---- clauses ---- */

/* The clause with this name, with at == NULL if it is not there. */
static const clause *clause_of(const reader *r, const char *name)
{
    static const clause none = {.at = NULL};
    for (size_t i = 0; i < r->clauses; i++)
        if (strcmp(r->clause[i].is->name, name) == 0)
            return &r->clause[i];
    return &none;
}

static int is_keyword(const reader *r, const word *at)
{
    return !at->is_quoted && clause_of(r, at->text)->is;
}

/* strtod alone would also accept nan, inf, hexadecimal numbers and leading blanks. */
static int read_number(reader *r, const key *k, const word *at, double *number)
{
    char *end = at->text;
    if (strspn(at->text, "+-.0123456789eE") == strlen(at->text))
        *number = strtod(at->text, &end);
    if (end == at->text || *end)
        return refuse(r, at, "'%.64s' is no number; it must be '%s %s'", at->text, k->name, k->takes);
    if (!(*number >= k->low && *number <= k->high))
        return refuse(r, at, "%s is %.9g, it must be from %.9g to %.9g", k->name, *number, k->low, k->high);
    return k->kind != WHOLE || *number == floor(*number) ||
           refuse(r, at, "%s is %.9g, it must be a whole number", k->name, *number);
}

/* The clause whose keyword is word *at, which moves behind its values. */
static int read_clause(reader *r, size_t *at)
{
    const char *names[CLAUSES_MAX];
    size_t chosen;
    for (size_t i = 0; i < r->clauses; i++)
        names[i] = r->clause[i].is->name;
    if (r->list[*at].is_quoted)
        return refuse(r, &r->list[*at], "'%.64s' is no clause here, since it has quotes", r->list[*at].text);
    if (!read_choice(r, &r->list[*at], "clause here", names, r->clauses, &chosen))
        return 0;
    clause *c = &r->clause[chosen];
    if (c->at)
        return refuse(r, &r->list[*at], "'%s' stands in this statement twice", c->is->name);
    c->at = &r->list[(*at)++];
    c->value = r->list + *at;
    /* required values are taken as they are, since a name may look like a keyword */
    for (; *at < r->count && c->count < c->is->most; ++*at, c->count++) {
        const word *value = &r->list[*at];
        if (c->count >= c->is->least && is_keyword(r, value))
            break;
        if (c->is->kind != WORDS && !read_number(r, c->is, value, &c->number[c->count]))
            return 0;
    }
    return c->count >= c->is->least ||
           refuse(r, c->at, "the statement ends before all of '%s %s' was there", c->is->name, c->is->takes);
}

/* Finds the clauses of the keys of `of` and `also` in the words of the statement from `from` on. */
static int read_clauses(reader *r, size_t from, const char *of, const char *also)
{
    r->clauses = 0;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcmp(keys[i].of, of) == 0 || strcmp(keys[i].of, also) == 0)
            r->clause[r->clauses++] = (clause){.is = &keys[i]};
    for (size_t at = from; at < r->count;)
        if (!read_clause(r, &at))
            return 0;
    for (size_t i = 0; i < r->clauses; i++) {
        const key *k = r->clause[i].is;
        const word *at = r->clause[i].at;
        const clause *other = k->other ? clause_of(r, k->other) : NULL;
        if (k->rule == NEEDED && !at)
            return refuse(r, &r->list[from - 1], "'%s' needs '%s %s'", of, k->name, k->takes);
        if (k->rule == OR && !at == !other->at)
            return refuse(r, &r->list[from - 1], "'%s' needs one of '%s %s' and '%s %s'", of, k->name, k->takes,
                          k->other, other->is->takes);
        if (k->rule == BESIDE && at && !other->at)
            return refuse(r, at, "'%s' stands beside '%s' only", k->name, k->other);
    }
    return 1;
}

/* ---- what clauses hold ---- */

static double number_of(const reader *r, const char *name, double otherwise)
{
    const clause *c = clause_of(r, name);
    return c->at ? c->number[0] : otherwise;
}

static vec3 vector_of(const reader *r, const char *name)
{
    const double *n = clause_of(r, name)->number;
    return vec(n[0], n[1], n[2]);
}

static void set_three(const reader *r, const char *name, float to[3])
{
    const clause *c = clause_of(r, name);
    for (int i = 0; i < 3 && c->at; i++)
        to[i] = (float)c->number[i];
}

/* The path relative to the working folder, noted as an input; to be freed. NULL after a refusal. */
static char *path_of(reader *r, const word *at)
{
    size_t folder = at->text[0] == '/' ? 0 : r->folder, letters = strlen(at->text);
    char *path = letters ? malloc(folder + letters + 1) : NULL;
    if (!path)
        return refuse(r, at, letters ? "there is no memory for this path" : "a path is empty"), NULL;
    memcpy(path, r->name, folder);
    memcpy(path + folder, at->text, letters + 1);
    const char *role = files_note(path, 0);
    if (!role)
        return path;
    refuse(r, at, "this file is %s as well", role);
    free(path);
    return NULL;
}

/* The second word of a statement, a name that none of the `count` things before it has; there may be `most`. */
static int new_name(reader *r, const char **names, size_t count, size_t most, const char *example)
{
    const char *what = r->list[0].text;
    if (r->count < 3)
        return refuse(r, &r->list[0], "'%s' needs a name and what it is, as in '%s'", what, example);
    const word *name = &r->list[1];
    const size_t letters = strlen(name->text);
    if (!letters || letters >= SCENE_NAME)
        return refuse(r, name, "a name has 1 to %d letters", SCENE_NAME - 1);
    for (size_t i = 0; i < count; i++)
        if (strcmp(names[i], name->text) == 0)
            return refuse(r, name, "there is another %s '%s' already", what, name->text);
    if (count == most)
        return refuse(r, name, "these are more than %zu %ss", most, what);
    names[count] = name->text;
    return 1;
}

/* The image that a clause names, if it is there: its first channels have to be within a range, since it is used as
 * `what`. */
static int find_image(reader *r, const char *name, const char *what, int channels, double low, double high,
                      const image **found)
{
    const clause *c = clause_of(r, name);
    size_t chosen;
    if (!c->at)
        return 1;
    if (!read_choice(r, c->value, "image that is defined before this", r->images, r->made->image_count, &chosen))
        return 0;
    const image *map = *found = &r->made->images[chosen];
    for (int i = 0; i < map->width * map->height * 3; i++) {
        double value = (double)map->rgb[i];
        if (i % 3 < channels && !(value >= low && value <= high))
            return refuse(r, c->value,
                          "as %s the image must be from %g to %g; it is %g in column %d of row %d (from the top, "
                          "from 0)",
                          what, low, high, value, i / 3 % map->width, i / 3 / map->width);
    }
    return 1;
}

/* ---- once in a scene ---- */

static int read_film(reader *r)
{
    scene *s = r->made;
    s->width = (int)number_of(r, "width", 0);
    s->height = (int)number_of(r, "height", 0);
    return (int64_t)s->width * s->height <= IMAGE_PIXELS_MAX ||
           refuse(r, clause_of(r, "width")->at, "%d x %d pixels are more than %d", s->width, s->height,
                  IMAGE_PIXELS_MAX);
}

static int read_camera(reader *r)
{
    scene *s = r->made;
    const clause *up = clause_of(r, "up");
    s->from = vector_of(r, "from");
    s->to = vector_of(r, "to");
    s->up = up->at ? vector_of(r, "up") : s->up;
    s->field = number_of(r, "field", 40) * (PI / 180);
    const vec3 forward = subtract(s->to, s->from);
    if (!(length(forward) >= least_size))
        return refuse(r, clause_of(r, "to")->at, "'from' and 'to' are the same place");
    return length(cross(forward, s->up)) >= 1e-6 * length(forward) * length(s->up) ||
           refuse(r, up->at ? up->at : &r->list[0], "'up' is the direction of the view");
}

static int read_integrator(reader *r)
{
    scene *s = r->made;
    s->depth = (unsigned)number_of(r, "depth", s->depth);
    s->samples = (unsigned)number_of(r, "samples", s->samples);
    s->exposure = (float)number_of(r, "exposure", (double)s->exposure);
    return 1;
}

static int read_environment(reader *r)
{
    environment *e = &r->made->environment;
    set_three(r, "constant", e->constant);
    e->scale = (float)number_of(r, "scale", 1);
    e->turn = number_of(r, "turn", 0) / 360;
    return find_image(r, "image", "light from far away", 3, 0, 1e6, &e->map);
}

static int read_image(reader *r)
{
    scene *s = r->made;
    if (!new_name(r, r->images, s->image_count, SCENE_IMAGES_MAX, "image sky file sky.pfm") ||
        !read_clauses(r, 2, "image", ""))
        return 0;
    const word *file = clause_of(r, "file")->value, *pattern = clause_of(r, "pattern")->value;
    image *made = &s->images[s->image_count++];
    image_error error;
    char *path = file ? path_of(r, file) : NULL;
    if (file && !path)
        return 0;
    int good = path ? image_read_pfm(made, path, &error)
                    : image_make_pattern(made, pattern->text, (int)number_of(r, "width", 512),
                                         (int)number_of(r, "height", 512), &error);
    free(path);
    if (!good)
        return refuse(r, file ? file : pattern, "%s", error.message);
    r->pixels += (size_t)made->width * (size_t)made->height;
    return r->pixels <= PIXELS_MAX ||
           refuse(r, &r->list[1], "all images together have more than %d pixels", PIXELS_MAX);
}

/* ---- distributions ---- */

enum { GGX, BECKMANN, TABLE, FAMILY, SLOPE, NDF, FORMS_OF_DISTRIBUTION };

static vndf_distribution *make_table(reader *r, size_t form, const word *text, unsigned bytes, vndf_error *error)
{
    const vndf_build_options options = {.max_bytes = bytes};
    if (form == TABLE) {
        char *path = path_of(r, text);
        vndf_distribution *loaded = path ? vndf_load(path, error) : NULL;
        free(path);
        return loaded;
    }
    vndf_source *source = form == FAMILY  ? vndf_source_family(text->text, error)
                          : form == SLOPE ? vndf_source_slope_expression(text->text, NULL, 0, error)
                                          : vndf_source_ndf_expression(text->text, NULL, 0, error);
    vndf_distribution *built = source ? vndf_build(source, &options, NULL, error) : NULL;
    vndf_source_free(source);
    return built;
}

/* Materials with the same form, text and size share a table. */
static int find_table(reader *r, size_t form, const word *text, unsigned bytes, const vndf_distribution **found)
{
    scene *s = r->made;
    vndf_error error = {VNDF_OK, ""};
    size_t i = 0;
    while (i < s->table_count && (r->tables[i].form != form || r->tables[i].bytes != bytes ||
                                  strcmp(r->tables[i].text, text->text) != 0))
        i++;
    if (i == SCENE_TABLES_MAX)
        return refuse(r, text, "these are more than %d tables", SCENE_TABLES_MAX);
    if (i == s->table_count) {
        if (!(s->tables[i] = make_table(r, form, text, bytes, &error))) /* else path_of has refused */
            return error.message[0] ? refuse(r, text, "%s", error.message) : 0;
        r->tables[s->table_count++] = (struct made_table){form, bytes, text->text};
    }
    *found = s->tables[i];
    return 1;
}

static int read_distribution(reader *r, const vndf_distribution **found)
{
    static const char *const names[FORMS_OF_DISTRIBUTION] = {"ggx", "beckmann", "table", "family", "slope", "ndf"};
    static const char *const takes[FORMS_OF_DISTRIBUTION] = {
        "", "", "a file", "a family, as in student-t:2.5", "a formula between quotes", "a formula between quotes"};
    const clause *c = clause_of(r, "distribution"), *bytes = clause_of(r, "bytes");
    size_t form;
    if (!read_choice(r, c->value, "distribution", names, FORMS_OF_DISTRIBUTION, &form))
        return 0;
    if (bytes->at && form <= TABLE)
        return refuse(r, bytes->at, "'bytes' is of tables that are made here: family, slope or ndf");
    if (form > BECKMANN)
        return c->count > 1 ? find_table(r, form, &c->value[1], (unsigned)number_of(r, "bytes", 4096), found)
                            : refuse(r, c->value, "'distribution %s' needs %s", names[form], takes[form]);
    if (c->count > 1)
        return refuse(r, &c->value[1], "'distribution %s' takes nothing more", names[form]);
    *found = form == GGX ? vndf_ggx() : vndf_beckmann();
    return clause_of(r, "alpha")->at ||
           refuse(r, c->at, "'distribution %s' needs 'alpha A' or 'alpha AX AY'", names[form]);
}

/* ---- materials ---- */

/* Indices of refraction of metals for red, green and blue: measured spectra weighed by the sensitivities of the
 * three colours. They agree to three digits with the lists of the renderers Tungsten and Yocto/GL for Au, Ag, Cu
 * and Al. (Indices at single wavelengths fail: at 550 nm copper is on the slope of its reflectance, and looks
 * tan.) */
enum { METALS = 4 };
static const char *const metal_names[METALS] = {"gold", "silver", "copper", "aluminium"};
static const float metals[METALS][2][3] = {
    {{0.143f, 0.375f, 1.442f}, {3.983f, 2.386f, 1.603f}},
    {{0.155f, 0.117f, 0.138f}, {4.828f, 3.122f, 2.147f}},
    {{0.200f, 0.924f, 1.102f}, {3.912f, 2.452f, 2.142f}},
    {{1.657f, 0.880f, 0.521f}, {9.224f, 6.270f, 4.837f}},
};

enum { CONDUCTOR, DIELECTRIC, SHAPE, MATTE, LIGHT, KINDS };
static const char *const kinds[KINDS] = {"conductor", "dielectric", "shape", "matte", "light"};

static int read_rough(reader *r, size_t kind, material *m)
{
    static const char *const scatterings[] = {"single", "multiple"};
    static const vndf_fresnel fresnel[] = {VNDF_FRESNEL_CONDUCTOR, VNDF_FRESNEL_DIELECTRIC, VNDF_FRESNEL_NONE};
    const clause *of = clause_of(r, "of"), *alpha = clause_of(r, "alpha");
    const clause *scattering = clause_of(r, "scattering");
    vndf_description *is = &m->is;
    vndf_material resolved;
    vndf_error error = {VNDF_OK, ""};
    size_t metal = 0, order = 0;
    if ((of->at && !read_choice(r, of->value, "metal", metal_names, METALS, &metal)) ||
        (scattering->at && !read_choice(r, scattering->value, "scattering", scatterings, 2, &order)) ||
        !read_distribution(r, &is->distribution))
        return 0;
    memcpy(is->conductor_eta, metals[metal][0], sizeof is->conductor_eta[0] * 3);
    memcpy(is->conductor_k, metals[metal][1], sizeof is->conductor_k[0] * 3);
    set_three(r, "eta", is->conductor_eta);
    set_three(r, "k", is->conductor_k);
    is->alpha_x = (float)number_of(r, "alpha", 1);
    is->alpha_y = alpha->count > 1 ? (float)alpha->number[1] : is->alpha_x;
    is->eta = (float)number_of(r, "index", 0);
    is->effects.fresnel = fresnel[kind];
    is->effects.lobes = kind == DIELECTRIC ? VNDF_LOBES_BOTH : VNDF_LOBES_REFLECTION;
    is->effects.scattering = order ? VNDF_SCATTERING_MULTIPLE : VNDF_SCATTERING_SINGLE;
    const double least = 1e-6 / fmin((double)is->alpha_x, (double)is->alpha_y);
    const double most = 1e3 / fmax((double)is->alpha_x, (double)is->alpha_y);
    return find_image(r, "alpha-map", "roughness", 1, least, most, &m->alpha_map) &&
           (vndf_material_resolve(is, &resolved, &error) == VNDF_OK ||
            refuse(r, &r->list[1], "%s", error.message));
}

static int read_material(reader *r)
{
    scene *s = r->made;
    material made = {.colour = {1.0f, 1.0f, 1.0f}};
    size_t kind;
    if (!new_name(r, r->materials, s->material_count, MATERIALS_MAX, "material wall matte colour 0.5 0.5 0.5") ||
        !read_choice(r, &r->list[2], "kind of material", kinds, KINDS, &kind) ||
        !read_clauses(r, 3, kinds[kind], kind <= SHAPE ? "rough" : ""))
        return 0;
    made.kind = kind <= SHAPE ? MATERIAL_ROUGH : kind == MATTE ? MATERIAL_MATTE : MATERIAL_LIGHT;
    set_three(r, kind == LIGHT ? "radiance" : "colour", made.colour);
    if (!find_image(r, "colour-map", "colour", 3, 0, 1, &made.colour_map) ||
        (kind <= SHAPE && !read_rough(r, kind, &made)))
        return 0;
    strcpy(made.name, r->list[1].text);
    s->materials[s->material_count++] = made;
    return 1;
}

/* ---- shapes ---- */

/* Every shape has a material; a mesh does not emit. */
static int find_material(reader *r, int *found)
{
    const clause *c = clause_of(r, "material");
    size_t chosen;
    if (!read_choice(r, c->value, "material that is defined before this", r->materials, r->made->material_count,
                     &chosen))
        return 0;
    *found = (int)chosen;
    return r->made->materials[chosen].kind != MATERIAL_LIGHT || strcmp(r->list[0].text, "mesh") != 0 ||
           refuse(r, c->value, "a light is a sphere or a rectangle, not a mesh");
}

static int no_memory_for_shape(reader *r)
{
    return refuse(r, &r->list[0], "there is no memory for this shape");
}

static int read_sphere(reader *r)
{
    shape made = {.kind = SHAPE_SPHERE, .corner = vector_of(r, "centre"), .radius = number_of(r, "radius", 0)};
    return find_material(r, &made.material) && (geometry_add(&r->made->geometry, &made) || no_memory_for_shape(r));
}

/* The text has few digits, so that edges that are meant to be at right angles may be a little off: the second one
 * is corrected. */
static int read_rectangle(reader *r)
{
    const vec3 u = vector_of(r, "edge-u"), v = vector_of(r, "edge-v");
    const double cosine = dot(u, v) / (length(u) * length(v));
    shape made = {.kind = SHAPE_RECTANGLE, .corner = vector_of(r, "corner"), .edge_u = u};
    for (int i = 0; i < 2; i++)
        if (!(length(i ? v : u) >= least_size))
            return refuse(r, clause_of(r, i ? "edge-v" : "edge-u")->at, "this edge has no length");
    if (!(fabs(cosine) < 2e-3))
        return refuse(r, clause_of(r, "edge-v")->at,
                      "the edges of a rectangle must be at right angles; these are at %.4g degrees",
                      acos(fmin(fmax(cosine, -1), 1)) * (180 / PI));
    made.edge_v = along(v, -dot(u, v) / dot(u, u), u);
    return find_material(r, &made.material) && (geometry_add(&r->made->geometry, &made) || no_memory_for_shape(r));
}

/* A file, or the knot. */
static int read_mesh(reader *r)
{
    static const char *const patterns[] = {"knot"};
    const word *file = clause_of(r, "file")->value, *pattern = clause_of(r, "pattern")->value;
    const placement where = {number_of(r, "scale", 1), number_of(r, "turn", 0), vector_of(r, "move")};
    char why[512];
    size_t which;
    int of;
    if (!find_material(r, &of))
        return 0;
    if (pattern)
        return read_choice(r, pattern, "pattern of a mesh", patterns, 1, &which) &&
               (knot_add(&r->made->geometry, &where, of) || no_memory_for_shape(r));
    char *path = path_of(r, file);
    int good =
        path && (obj_read(&r->made->geometry, path, &where, of, why, sizeof why) || refuse(r, file, "%s", why));
    free(path);
    return good;
}

/* ---- all of it ---- */

enum { CAMERA = 1, ONCE = 4, NAMED = 6, STATEMENTS = 9 };

/* Those before ONCE may be there once; those from there to NAMED have a name, and read their clauses themselves;
 * those after it are shapes. */
static const char *const names[STATEMENTS] = {"film",     "camera", "integrator", "environment", "image",
                                              "material", "sphere", "rectangle",  "mesh"};
static int (*const readers[STATEMENTS])(reader *r) = {read_film,        read_camera,    read_integrator,
                                                      read_environment, read_image,     read_material,
                                                      read_sphere,      read_rectangle, read_mesh};

static int read_statement(reader *r)
{
    const word *w = &r->list[0];
    size_t i;
    if (!read_choice(r, w, "statement", names, STATEMENTS, &i))
        return 0;
    if (i < ONCE && r->seen >> i & 1u)
        return refuse(r, w, "'%s' stands in this scene twice", w->text);
    r->seen |= 1u << i;
    return ((i >= ONCE && i < NAMED) || read_clauses(r, 1, names[i], i >= NAMED ? "body" : "")) && readers[i](r);
}

/* Without light a scene is black, which nobody means. */
static int finish(reader *r)
{
    scene *s = r->made;
    const word first = {NULL, 1, 1, 0, 0}, *end = r->word_count ? &r->words[r->word_count - 1] : &first;
    if (!(r->seen >> CAMERA & 1u))
        return refuse(r, end, "the scene ends without a camera, as in 'camera from 0 1 5 to 0 0 0'");
    if (!geometry_build(&s->geometry))
        return refuse(r, end, "there is no memory for a hierarchy of its shapes");
    if (!lights_make(s))
        return refuse(r, end, "these are more than %d lights, or there is no memory", SCENE_LIGHTS_MAX);
    const float *constant = s->environment.constant;
    return s->light_count > 0 || s->environment.map || constant[0] + constant[1] + constant[2] > 0.0f ||
           refuse(r, end, "the scene ends without light: an environment, or a shape of a light");
}

static int read_statements(reader *r, char *text, size_t length)
{
    if (!split_words(r, text, length))
        return 0;
    for (size_t at = 0; at < r->word_count; at += r->count) {
        r->list = r->words + at;
        for (r->count = 1; at + r->count < r->word_count && !r->list[r->count].begins;)
            r->count++;
        if (!read_statement(r))
            return 0;
    }
    return finish(r);
}

scene *scene_read_text(const char *name, char *text, size_t length, char *message, size_t size)
{
    const char *slash = strrchr(name, '/');
    scene *s = malloc(sizeof *s);
    material *materials = calloc(MATERIALS_MAX, sizeof *materials);
    reader r = {.name = name,
                .message = message,
                .size = size,
                .made = s,
                .folder = slash ? (size_t)(slash - name) + 1 : 0};
    if (!s || !materials) {
        snprintf(message, size, "%s: there is no memory", name);
        free(materials);
        free(s);
        return NULL;
    }
    *s = (scene){.up = {0, 1, 0},
                 .width = 640,
                 .height = 360,
                 .depth = 12,
                 .samples = 64,
                 .exposure = 1.0f,
                 .environment = {.scale = 1.0f},
                 .materials = materials};
    int good = read_statements(&r, text, length);
    free(r.words);
    if (good)
        return s;
    scene_free(s);
    return NULL;
}

scene *scene_read(const char *path, char *message, size_t size)
{
    char reason[128];
    size_t length;
    char *text = files_read(path, BYTES_MAX, &length, reason, sizeof reason);
    if (!text) {
        snprintf(message, size, "%s: %s", path, reason);
        return NULL;
    }
    scene *s = scene_read_text(path, text, length, message, size);
    free(text);
    return s;
}

void scene_free(scene *s)
{
    if (!s)
        return;
    for (size_t i = 0; i < s->image_count; i++)
        image_free(&s->images[i]);
    for (size_t i = 0; i < s->table_count; i++)
        vndf_free(s->tables[i]);
    free(s->materials);
    free(s->environment.rows);
    free(s->environment.cells);
    geometry_free(&s->geometry);
    free(s);
}

int scene_resize(scene *s, int width, char *message, size_t size)
{
    const double height = floor((double)width * s->height / s->width + 0.5);
    if (!(height >= 1 && height <= IMAGE_SIDE_MAX && height * width <= IMAGE_PIXELS_MAX)) {
        snprintf(message, size, "%d x %.0f pixels: a film has 1 to %d rows and at most %d pixels", width, height,
                 IMAGE_SIDE_MAX, IMAGE_PIXELS_MAX);
        return 0;
    }
    s->width = width;
    s->height = (int)height;
    return 1;
}
