/* Reads a scene: statement after statement, its clauses by the table of keys, then a look at the whole.
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
#include "vndf_build.h"

const char scene_grammar[] =
    "A scene file is text: statements, each a word and then clauses - a keyword and what it takes.\n"
    "\n"
    "  camera from 0 1 5 to 0 0.5 0 field 35\n"
    "  environment constant 1 1 1\n"
    "  material red-gold conductor of gold\n"
    "      distribution ggx alpha 0.2   # a line that begins with a blank goes on with the statement\n"
    "  sphere centre 0 0.5 0 radius 0.5 material red-gold\n"
    "\n"
    "(Its lines begin two columns further left.) Clauses stand in any order, each at most once; those in\n"
    "[ ] may be left out and have what stands in ( ) then. \"Quotes\" hold blanks, # begins a comment.\n"
    "Images and materials are defined before they are used. Colours are linear red, green and blue; +y is\n"
    "the zenith. Paths are relative to the scene file.\n"
    "\n"
    "Once in a scene; a camera and some light are needed:\n"
    "  film width PIXELS height PIXELS (640 360)\n"
    "  camera from X Y Z to X Y Z [up X Y Z] [field DEGREES]    of view, of the height (0 1 0, 40)\n"
    "  integrator [depth N] [samples N] [exposure F]\n"
    "                          surfaces on a path at most, samples a pixel, brightness of PNG (12, 64, 1)\n"
    "  environment constant R G B | image NAME [scale F] [turn DEGREES]\n"
    "                          light from far away; the image is longitude over latitude as seen from\n"
    "                          inside: its top row the zenith, its middle column -z, +x at its right;\n"
    "                          turned about y (1, 0)\n"
    "\n"
    "Images:\n"
    "  image NAME file FILE.pfm\n"
    "  image NAME pattern PATTERN [width PIXELS] [height PIXELS] (512 512)\n"
    "      tiles, grid      16 x 16 checks, two greys; 48 x 24 black lines on white, some red\n"
    "      studio           an environment: soft boxes in a grey room\n"
    "\n"
    "Materials:\n"
    "  material NAME conductor of gold|silver|copper|aluminium ROUGH    or: eta R G B k R G B\n"
    "  material NAME dielectric index N ROUGH           inside over outside\n"
    "  material NAME shape ROUGH                        the microsurface alone: all is reflected\n"
    "  material NAME matte colour R G B [colour-map IMAGE]\n"
    "  material NAME light radiance R G B               from the front of a sphere or a rectangle\n"
    "with for ROUGH:\n"
    "  distribution ggx | beckmann | table FILE.vndf | family NAME:PARAMETERS | slope \"P22(r)\"\n"
    "               | ndf \"D(c, theta, t)\"    the last three are built here, see `vndf build --help`\n"
    "  [alpha A | alpha AX AY]                stretches the slopes; ggx and beckmann need it (1)\n"
    "  [alpha-map IMAGE]                      alpha times the image's red, which is above 0\n"
    "  [scattering single|multiple]           multiple: light goes on between microfacets (single)\n"
    "  [colour R G B] [colour-map IMAGE]      multiply (1 1 1)\n"
    "\n"
    "Shapes. Those of dielectrics are to be closed; of others, lights too, the back is black. An image\n"
    "stands upright on rectangles, along edge-u and edge-v; goes around spheres from +z by way of +x, its\n"
    "top at +y; lies on meshes as vt say:\n"
    "  sphere centre X Y Z radius R material NAME\n"
    "  rectangle corner X Y Z edge-u X Y Z edge-v X Y Z material NAME\n"
    "                          edges at right angles; from the front, edge-v is left of edge-u\n"
    "  mesh file FILE.obj [scale F] [turn DEGREES] [move X Y Z] material NAME\n"
    "                          scaled, then turned about y, then moved (1, 0, 0 0 0)\n"
    "\n"
    "Numbers: places and sizes up to 1e6, sizes from 1e-6; alpha 1e-6 to 1e3, with its map; colours 0 to\n"
    "1, maps of them too; radiance 0 to 1e6; index 0.01 to 100; field 1 to 170; depth 1 to 10000.\n";

/* Against hostile files. */
enum {
    BYTES_MAX = 1 << 22,
    PATH_BYTES = 4096,
    STATEMENT_MAX = 64,               /* words */
    PIXELS_MAX = 2 * IMAGE_PIXELS_MAX /* of all images together */
};

static const double least_size = 1e-6;

typedef struct word {
    char *text;            /* without its quotes; into the text of the file */
    unsigned line, column; /* from 1; in the first column begins a statement */
    int is_quoted;
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
    {"mesh", "file", "PATH", NAME, NEEDED, NULL},
    {"mesh", "scale", "FACTOR", NUMBERS, 1, 1, 1e-6, 1e6, MAY_BE, NULL},
    {"mesh", "turn", "DEGREES", NUMBERS, 1, 1, -360, 360, MAY_BE, NULL},
    {"mesh", "move", PLACE, MAY_BE, NULL},
    {"body", "material", "NAME", NAME, NEEDED, NULL},
};

typedef struct reader {
    const char *name; /* of the file */
    vndf_error *error;
    scene *made;
    char *at, *start, *end; /* the rest of the text, its first line, and where it ends */
    unsigned line;
    word list[STATEMENT_MAX]; /* the statement at hand; list[0] names it */
    size_t count;
    clause clause[CLAUSES_MAX]; /* of all its keys */
    size_t clauses;
    unsigned seen;                                                         /* a bit for each statement */
    size_t material;                                                       /* of a shape */
    const char *images[SCENE_IMAGES_MAX], *materials[SCENE_MATERIALS_MAX]; /* their names */
    size_t pixels;                                                         /* of all images so far */
    struct made_table {
        size_t form;
        const char *text;
    } tables[SCENE_TABLES_MAX]; /* what those of the scene are made from */
} reader;

/* "NAME:LINE:COLUMN: ..."; returns 0. */
PRINTF_LIKE(3, 4) static int refuse(reader *r, const word *at, const char *format, ...)
{
    char text[sizeof r->error->message];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    return refuse_at(r->error, r->name, at->line, at->column, "%s", text);
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

/* The next word, without text where there is no more. The 0 behind the word before is put only now, since its place
 * may be the end of a line. */
static int next_word(reader *r, word *w)
{
    char *behind = r->at;
    for (; *r->at && strchr(" \t\r\n#", *r->at); r->at++) {
        r->at += *r->at == '#' ? strcspn(r->at, "\n") : 0;
        if (*r->at == '\n') {
            r->line++;
            r->start = r->at + 1;
        } else if (!*r->at)
            break;
    }
    const int is_quoted = *r->at == '"';
    char *text = r->at + is_quoted, *end = text;
    *w = (word){text, r->line, (unsigned)(r->at - r->start) + 1, is_quoted};
    if (r->at > behind)
        *behind = '\0';
    if (r->at == r->end) {
        w->text = NULL;
        return 1;
    }
    while (is_quoted ? *end && !strchr("\"\n", *end) : (unsigned char)*end > ' ' && !strchr("\"#\177", *end))
        end++;
    if (is_quoted && *end != '"')
        return refuse(r, w, "the quote that begins here does not end on its line");
    if (end == text && !is_quoted)
        return refuse(r, w, "a byte %u, which is no text", (unsigned)(unsigned char)*end);
    r->at = end + is_quoted;
    if (*r->at && !strchr(" \t\r\n#", *r->at))
        return refuse(r, &(word){NULL, r->line, (unsigned)(r->at - r->start) + 1, 0},
                      "a blank is missing before this");
    if (is_quoted)
        *end = '\0';
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

/* Finds the clauses of the keys of `of` and `also` in the words of the statement from `at` on. A keyword ends what may
 * be left out; values that have to be there are taken as they are, since a name may look like a keyword. */
static int read_clauses(reader *r, size_t at, const char *of, const char *also)
{
    const word *const begin = &r->list[at - 1], *const end = &r->list[r->count];
    const char *names[CLAUSES_MAX];
    size_t chosen;
    r->clauses = 0;
    for (const key *k = keys; k < keys + sizeof keys / sizeof *keys; k++)
        if (strcmp(k->of, of) == 0 || strcmp(k->of, also) == 0) {
            names[r->clauses] = k->name;
            r->clause[r->clauses++] = (clause){.is = k};
        }
    for (const word *w = begin + 1; w < end;) {
        if (w->is_quoted)
            return refuse(r, w, "'%.64s' is no clause here, since it has quotes", w->text);
        if (!read_choice(r, w, "clause here", names, r->clauses, &chosen))
            return 0;
        clause *c = &r->clause[chosen];
        if (c->at)
            return refuse(r, w, "'%s' stands in this statement twice", c->is->name);
        c->at = w;
        c->value = ++w;
        for (; w < end && c->count < c->is->most; w++, c->count++) {
            if (c->count >= c->is->least && !w->is_quoted && clause_of(r, w->text)->is)
                break;
            if (c->is->kind != WORDS && !read_number(r, c->is, w, &c->number[c->count]))
                return 0;
        }
        if (c->count < c->is->least)
            return refuse(r, c->at, "the statement ends before all of '%s %s' was there", c->is->name,
                          c->is->takes);
    }
    for (const clause *c = r->clause; c < r->clause + r->clauses; c++) {
        const key *k = c->is;
        const clause *other = k->other ? clause_of(r, k->other) : NULL;
        if (k->rule == NEEDED && !c->at)
            return refuse(r, begin, "'%s' needs '%s %s'", of, k->name, k->takes);
        if (k->rule == OR && !c->at == !other->at)
            return refuse(r, begin, "'%s' needs one of '%s %s' and '%s %s'", of, k->name, k->takes, k->other,
                          other->is->takes);
        if (k->rule == BESIDE && c->at && !other->at)
            return refuse(r, c->at, "'%s' stands beside '%s' only", k->name, k->other);
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

/* The path relative to the working folder. */
static int path_of(reader *r, const word *at, char path[PATH_BYTES])
{
    const char *slash = strrchr(r->name, '/');
    const int folder = at->text[0] == '/' || !slash ? 0 : (int)(slash - r->name) + 1;
    const int letters = snprintf(path, PATH_BYTES, "%.*s%s", folder, r->name, at->text);
    return (at->text[0] && letters < PATH_BYTES) ||
           refuse(r, at, "a path has 1 to %d letters, with the folder of the scene", PATH_BYTES - 1);
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
        const double value = (double)map->rgb[i];
        if (i % 3 < channels && !(value >= low && value <= high))
            return refuse(r, c->value, "as %s the image must be from %g to %g; it is %g in column %d of row %d",
                          what, low, high, value, i / 3 % map->width, i / 3 / map->width);
    }
    return 1;
}

/* ---- once in a scene ---- */

/* The film, the camera or the integrator: what the others set stays. */
static int read_view(reader *r)
{
    scene *s = r->made;
    const clause *to = clause_of(r, "to"), *up = clause_of(r, "up");
    s->width = (int)number_of(r, "width", s->width);
    s->height = (int)number_of(r, "height", s->height);
    s->depth = (unsigned)number_of(r, "depth", s->depth);
    s->samples = (unsigned)number_of(r, "samples", s->samples);
    s->exposure = (float)number_of(r, "exposure", (double)s->exposure);
    if ((int64_t)s->width * s->height > IMAGE_PIXELS_MAX)
        return refuse(r, &r->list[0], "%d x %d pixels are more than %d", s->width, s->height, IMAGE_PIXELS_MAX);
    if (!to->at)
        return 1;
    s->from = vector_of(r, "from");
    s->to = vector_of(r, "to");
    s->up = up->at ? vector_of(r, "up") : s->up;
    s->field = number_of(r, "field", 40) * (PI / 180);
    const vec3 forward = subtract(s->to, s->from);
    if (!(length(forward) >= least_size))
        return refuse(r, to->at, "'from' and 'to' are the same place");
    return length(cross(forward, s->up)) >= 1e-6 * length(forward) * length(s->up) ||
           refuse(r, up->at ? up->at : &r->list[0], "'up' is the direction of the view");
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
    const int width = (int)number_of(r, "width", 512), height = (int)number_of(r, "height", 512);
    image *made = &s->images[s->image_count++];
    vndf_error error = {VNDF_OK, ""};
    char path[PATH_BYTES];
    if (file && !path_of(r, file, path))
        return 0;
    if (!(file ? image_read_pfm(made, path, &error)
               : image_make_pattern(made, pattern->text, width, height, &error)))
        return refuse(r, file ? file : pattern, "%s", error.message);
    r->pixels += (size_t)made->width * (size_t)made->height;
    return r->pixels <= PIXELS_MAX ||
           refuse(r, &r->list[1], "all images together have more than %d pixels", PIXELS_MAX);
}

/* ---- distributions ---- */

enum { GGX, BECKMANN, TABLE, FAMILY, SLOPE, NDF, FORMS };

static vndf_distribution *make_table(size_t form, const char *text, vndf_error *error)
{
    if (form == TABLE) {
        (void)files_note(text, 0); /* which no output replaces then */
        return vndf_load(text, error);
    }
    vndf_source *source = form == FAMILY  ? vndf_source_family(text, error)
                          : form == SLOPE ? vndf_source_slope_expression(text, NULL, 0, error)
                                          : vndf_source_ndf_expression(text, NULL, 0, error);
    vndf_distribution *built = source ? vndf_build(source, NULL, NULL, error) : NULL;
    vndf_source_free(source);
    return built;
}

/* Materials with the same form and text share a table. */
static int read_distribution(reader *r, const vndf_distribution **found)
{
    static const char *const names[FORMS] = {"ggx", "beckmann", "table", "family", "slope", "ndf"};
    static const char *const takes[FORMS] = {
        "", "", "a file", "a family, as in student-t:2.5", "a formula between quotes", "a formula between quotes"};
    const clause *c = clause_of(r, "distribution");
    const word *of = &c->value[1];
    scene *s = r->made;
    vndf_error error = {VNDF_OK, ""};
    char path[PATH_BYTES];
    size_t form, i = 0;
    if (!read_choice(r, c->value, "distribution", names, FORMS, &form))
        return 0;
    if (c->count > 1 && form <= BECKMANN)
        return refuse(r, of, "'distribution %s' takes nothing more", names[form]);
    if (c->count < 2 && form > BECKMANN)
        return refuse(r, c->value, "'distribution %s' needs %s", names[form], takes[form]);
    if (form <= BECKMANN) {
        *found = form == GGX ? vndf_ggx() : vndf_beckmann();
        return clause_of(r, "alpha")->at ||
               refuse(r, c->at, "'distribution %s' needs 'alpha A' or 'alpha AX AY'", names[form]);
    }
    while (i < s->table_count && (r->tables[i].form != form || strcmp(r->tables[i].text, of->text) != 0))
        i++;
    if (i == SCENE_TABLES_MAX)
        return refuse(r, of, "these are more than %d tables", SCENE_TABLES_MAX);
    if (i == s->table_count) {
        if (form == TABLE && !path_of(r, of, path))
            return 0;
        if (!(s->tables[i] = make_table(form, form == TABLE ? path : of->text, &error)))
            return refuse(r, of, "%s", error.message);
        r->tables[s->table_count++] = (struct made_table){form, of->text};
    }
    *found = s->tables[i];
    return 1;
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
    if (!new_name(r, r->materials, s->material_count, SCENE_MATERIALS_MAX,
                  "material wall matte colour 0.5 0.5 0.5") ||
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

/* Adds a shape of the material that the statement names. */
static int add_shape(reader *r, shape made)
{
    made.material = (int)r->material;
    return geometry_add(&r->made->geometry, &made) || refuse(r, &r->list[0], "there is no memory for this shape");
}

static int read_sphere(reader *r)
{
    return add_shape(r, (shape){.corner = vector_of(r, "centre"), .radius = number_of(r, "radius", 0)});
}

/* The text has few digits, so that edges that are meant to be at right angles may be a little off: the second one
 * is corrected. */
static int read_rectangle(reader *r)
{
    const vec3 corner = vector_of(r, "corner"), u = vector_of(r, "edge-u"), v = vector_of(r, "edge-v");
    const double cosine = dot(u, v) / (length(u) * length(v));
    for (int i = 0; i < 2; i++)
        if (!(length(i ? v : u) >= least_size))
            return refuse(r, clause_of(r, i ? "edge-v" : "edge-u")->at, "this edge has no length");
    if (!(fabs(cosine) < 2e-3))
        return refuse(r, clause_of(r, "edge-v")->at,
                      "the edges of a rectangle must be at right angles; these are at %.4g degrees",
                      acos(fmin(fmax(cosine, -1), 1)) * (180 / PI));
    return add_shape(r, (shape){SHAPE_RECTANGLE, 0, corner, u, along(v, -dot(u, v) / dot(u, u), u), .radius = 0});
}

static int read_mesh(reader *r)
{
    const word *file = clause_of(r, "file")->value;
    geometry *g = &r->made->geometry;
    const size_t first = g->count;
    vndf_error error = {VNDF_OK, ""};
    char path[PATH_BYTES];
    if (r->made->materials[r->material].kind == MATERIAL_LIGHT)
        return refuse(r, clause_of(r, "material")->value, "a light is a sphere or a rectangle, not a mesh");
    if (!path_of(r, file, path))
        return 0;
    if (!obj_read(g, path, (int)r->material, &error))
        return refuse(r, file, "%s", error.message);
    geometry_place(g, first, number_of(r, "scale", 1), number_of(r, "turn", 0) * (PI / 180), vector_of(r, "move"));
    return 1;
}

/* ---- statements ---- */

/* Those before ONCE stand once in a scene; those before NAMED are not, and read the words behind their name themselves;
 * those after it are shapes, which have a material. */
enum { CAMERA = 1, ONCE = 4, NAMED = 6, STATEMENTS = 9 };
static const char *const names[STATEMENTS] = {"film",     "camera", "integrator", "environment", "image",
                                              "material", "sphere", "rectangle",  "mesh"};
static int (*const readers[STATEMENTS])(reader *r) = {read_view,        read_view,      read_view,
                                                      read_environment, read_image,     read_material,
                                                      read_sphere,      read_rectangle, read_mesh};

static int read_statement(reader *r)
{
    const word *w = &r->list[0];
    size_t i;
    if (!read_choice(r, w, "statement", names, STATEMENTS, &i))
        return 0;
    const int is_shape = i >= NAMED;
    if (i < ONCE && r->seen >> i & 1u)
        return refuse(r, w, "'%s' stands in this scene twice", w->text);
    r->seen |= 1u << i;
    if ((i < ONCE || is_shape) && !read_clauses(r, 1, names[i], is_shape ? "body" : ""))
        return 0;
    if (is_shape && !read_choice(r, clause_of(r, "material")->value, "material that is defined before this",
                                 r->materials, r->made->material_count, &r->material))
        return 0;
    return readers[i](r);
}

static int read_statements(reader *r)
{
    word next;
    if (!next_word(r, &next))
        return 0;
    while (next.text) {
        if (next.column > 1)
            return refuse(
                r, &next,
                "a statement begins in the first column; lines that begin with a blank go on with the one "
                "before");
        for (r->count = 0; next.text && (r->count == 0 || next.column > 1);) {
            if (r->count == STATEMENT_MAX)
                return refuse(r, &next, "a statement has more than %d words", STATEMENT_MAX);
            r->list[r->count++] = next;
            if (!next_word(r, &next))
                return 0;
        }
        if (!read_statement(r))
            return 0;
    }
    return 1;
}

/* Without light a scene is black, which nobody means. */
static int finish(reader *r)
{
    scene *s = r->made;
    const word first = {NULL, 1, 1, 0}, *end = r->count ? &r->list[r->count - 1] : &first;
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

scene *scene_read_text(const char *name, char *text, size_t length, vndf_error *error)
{
    scene *s = calloc(1, sizeof *s);
    reader r = {
        .name = name, .error = error, .made = s, .at = text, .start = text, .end = text + length, .line = 1};
    if (!s)
        return refuse_at(error, name, 0, 0, "there is no memory"), NULL;
    s->up = vec(0, 1, 0);
    s->width = 640;
    s->height = 360;
    s->depth = 12;
    s->samples = 64;
    s->exposure = s->environment.scale = 1.0f;
    if (read_statements(&r) && finish(&r))
        return s;
    scene_free(s);
    return NULL;
}

scene *scene_read(const char *path, vndf_error *error)
{
    char reason[128];
    size_t length;
    char *text = files_read(path, BYTES_MAX, &length, reason, sizeof reason);
    if (!text)
        refuse_at(error, path, 0, 0, "%s", reason);
    scene *s = text ? scene_read_text(path, text, length, error) : NULL;
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
    free(s->environment.sums);
    geometry_free(&s->geometry);
    free(s);
}

int scene_resize(scene *s, int width, vndf_error *error)
{
    const double height = floor((double)width * s->height / s->width + 0.5);
    if (!(height >= 1 && height <= IMAGE_SIDE_MAX && height * width <= IMAGE_PIXELS_MAX))
        return refuse_at(error, "--width", 0, 0, "%d x %.0f pixels: a film has 1 to %d rows and at most %d pixels",
                         width, height, IMAGE_SIDE_MAX, IMAGE_PIXELS_MAX);
    s->width = width;
    s->height = (int)height;
    return 1;
}
