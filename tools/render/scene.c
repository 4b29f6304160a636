/* Reads a scene: the words of the file, statement after statement, then a look at the whole. */
#include "render/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/files.h"
#include "render/light.h"
#include "render/words.h"
#include "vndf_build.h"

/* Against hostile files. */
enum {
    BYTES_MAX = 1 << 22,
    MATERIALS_MAX = 4096,
    PIXELS_MAX = 2 * IMAGE_PIXELS_MAX /* of all images together */
};

static const double near = 1e-6; /* the least size */

typedef struct reader {
    scene_words words;
    scene *made;
    const word *list; /* of the statement at hand; list[0] names it */
    size_t count;
    clause c[CLAUSES_MAX]; /* its clauses */
    size_t folder;         /* the length of the folder in the name of the file, with its slash */
    unsigned seen;         /* a bit for each statement */
    const char *images[SCENE_IMAGES_MAX], *materials[MATERIALS_MAX]; /* their names */
    size_t pixels;                                                   /* of all images so far */
    struct made_table {
        size_t form;
        unsigned bytes;
        const char *text;
    } tables[SCENE_TABLES_MAX]; /* what those of the scene are made from */
} reader;

#define FORMS(forms) forms, sizeof(forms) / sizeof *(forms)

static int clauses(reader *r, size_t from, const clause_form *forms, size_t n)
{
    return read_clauses(&r->words, r->list, r->count, from, forms, n, r->c);
}

static vec3 vector_of(const clause *c)
{
    return vec(c->number[0], c->number[1], c->number[2]);
}

static void set_three(float to[3], const clause *c)
{
    for (int i = 0; i < 3 && c->at; i++)
        to[i] = (float)c->number[i];
}

/* ---- names and paths ---- */

/* The path relative to the working folder, noted as an input; to be freed. NULL after a refusal. */
static char *path_of(reader *r, const word *at)
{
    size_t folder = at->text[0] == '/' ? 0 : r->folder, letters = strlen(at->text);
    char *path = letters ? malloc(folder + letters + 1) : NULL;
    if (!path)
        return refuse_word(&r->words, at, letters ? "there is no memory for this path" : "a path is empty"), NULL;
    memcpy(path, r->words.name, folder);
    memcpy(path + folder, at->text, letters + 1);
    const char *role = files_note(path, 0);
    if (!role)
        return path;
    refuse_word(&r->words, at, "this file is %s as well", role);
    free(path);
    return NULL;
}

/* The second word of a statement, a name that none of the `count` things before it has; there may be `most`. */
static int new_name(reader *r, const char **names, size_t count, size_t most)
{
    const char *what = r->list[0].text;
    const int is_image = strcmp(what, "image") == 0;
    if (r->count < 3)
        return refuse_word(&r->words, &r->list[0], "'%s' needs a name and what it is, as in '%s'", what,
                           is_image ? "image sky file sky.pfm" : "material wall matte colour 0.5 0.5 0.5");
    const word *name = &r->list[1];
    const size_t letters = strlen(name->text);
    if (!letters || letters >= SCENE_NAME)
        return refuse_word(&r->words, name, "a name has 1 to %d letters", SCENE_NAME - 1);
    for (size_t i = 0; i < count; i++)
        if (strcmp(names[i], name->text) == 0)
            return refuse_word(&r->words, name, "there is %s '%s' already", is_image ? "an image" : "a material",
                               name->text);
    if (count == most)
        return refuse_word(&r->words, name, "these are more than %zu %ss", most, what);
    names[count] = name->text;
    return 1;
}

/* ---- once in a scene ---- */

static int read_film(reader *r)
{
    static const clause_form forms[] = {{"width", "PIXELS", CLAUSE_WHOLE, 1, 1, 1, 1, IMAGE_SIDE_MAX},
                                        {"height", "PIXELS", CLAUSE_WHOLE, 1, 1, 1, 1, IMAGE_SIDE_MAX}};
    if (!clauses(r, 1, FORMS(forms)))
        return 0;
    r->made->width = (int)r->c[0].number[0];
    r->made->height = (int)r->c[1].number[0];
    return r->c[0].number[0] * r->c[1].number[0] <= IMAGE_PIXELS_MAX ||
           refuse_word(&r->words, r->c[0].at, "%d x %d pixels are more than %d", r->made->width, r->made->height,
                       IMAGE_PIXELS_MAX);
}

static int read_camera(reader *r)
{
    static const clause_form forms[] = {{"from", "X Y Z", CLAUSE_NUMBERS, 3, 3, 1, -1e6, 1e6},
                                        {"to", "X Y Z", CLAUSE_NUMBERS, 3, 3, 1, -1e6, 1e6},
                                        {"up", "X Y Z", CLAUSE_NUMBERS, 3, 3, 0, -1e6, 1e6},
                                        {"field", "DEGREES", CLAUSE_NUMBERS, 1, 1, 0, 1, 170}};
    scene *s = r->made;
    if (!clauses(r, 1, FORMS(forms)))
        return 0;
    s->from = vector_of(&r->c[0]);
    s->to = vector_of(&r->c[1]);
    if (r->c[2].at)
        s->up = vector_of(&r->c[2]);
    if (r->c[3].at)
        s->field = r->c[3].number[0] * (PI / 180);
    const vec3 forward = subtract(s->to, s->from), right = cross(forward, s->up);
    if (!(length(forward) >= near))
        return refuse_word(&r->words, r->c[1].at, "'from' and 'to' are the same place");
    return length(right) >= 1e-6 * length(forward) * length(s->up) ||
           refuse_word(&r->words, r->c[2].at ? r->c[2].at : &r->list[0], "'up' is the direction of the view");
}

static int read_integrator(reader *r)
{
    static const clause_form forms[] = {{"depth", "N", CLAUSE_WHOLE, 1, 1, 0, 1, 10000},
                                        {"samples", "N", CLAUSE_WHOLE, 1, 1, 0, 1, 1e9},
                                        {"exposure", "F", CLAUSE_NUMBERS, 1, 1, 0, 1e-6, 1e6}};
    scene *s = r->made;
    if (!clauses(r, 1, FORMS(forms)))
        return 0;
    s->depth = r->c[0].at ? (unsigned)r->c[0].number[0] : s->depth;
    s->samples = r->c[1].at ? (unsigned)r->c[1].number[0] : s->samples;
    s->exposure = r->c[2].at ? (float)r->c[2].number[0] : s->exposure;
    return 1;
}

/* ---- images ---- */

static int find_image(reader *r, const clause *c, const image **found)
{
    size_t i;
    if (!c->at)
        return 1;
    if (!read_choice(&r->words, c, "image that is defined before this", r->images, r->made->image_count, &i))
        return 0;
    *found = &r->made->images[i];
    return 1;
}

/* Whether the first channels of a map are within a range. */
static int check_map(reader *r, const clause *c, const image *map, const char *what, int channels, double low,
                     double high)
{
    for (int y = 0; map && y < map->height; y++)
        for (int x = 0; x < map->width; x++)
            for (int i = 0; i < channels; i++) {
                double value = (double)image_pixel(map, x, y)[i];
                if (!(value >= low && value <= high))
                    return refuse_word(
                        &r->words, c->value,
                        "as %s the image must be from %g to %g; it is %g in column %d of row %d (from "
                        "the top, from 0)",
                        what, low, high, value, x, y);
            }
    return 1;
}

static int read_environment(reader *r)
{
    static const clause_form forms[] = {{"constant", "R G B", CLAUSE_NUMBERS, 3, 3, 0, 0, 1e6},
                                        {"image", "NAME", CLAUSE_WORDS, 1, 1, 0, 0, 0},
                                        {"scale", "F", CLAUSE_NUMBERS, 1, 1, 0, 0, 1e6},
                                        {"turn", "DEGREES", CLAUSE_NUMBERS, 1, 1, 0, -360, 360}};
    environment *e = &r->made->environment;
    if (!clauses(r, 1, FORMS(forms)))
        return 0;
    if (!r->c[0].at == !r->c[1].at)
        return refuse_word(&r->words, &r->list[0], "'environment' needs one of 'constant R G B' and 'image NAME'");
    for (int i = 2; i < 4; i++)
        if (r->c[0].at && r->c[i].at)
            return refuse_word(&r->words, r->c[i].at, "'%s' is of an image", r->c[i].at->text);
    set_three(e->constant, &r->c[0]);
    e->scale = r->c[2].at ? (float)r->c[2].number[0] : 1.0f;
    e->turn = r->c[3].number[0] / 360;
    return find_image(r, &r->c[1], &e->map) && check_map(r, &r->c[1], e->map, "light from far away", 3, 0, 1e6);
}

static int make_image(reader *r, image *made)
{
    const clause *file = &r->c[0], *pattern = &r->c[1];
    const word *at = file->at ? file->value : pattern->value;
    int side[2] = {512, 512};
    image_error error;
    for (int i = 0; i < 2; i++)
        side[i] = r->c[2 + i].at ? (int)r->c[2 + i].number[0] : side[i];
    char *path = file->at ? path_of(r, at) : NULL;
    if (file->at && !path)
        return 0;
    int good =
        path ? image_read_pfm(made, path, &error) : image_make_pattern(made, at->text, side[0], side[1], &error);
    free(path);
    return good || refuse_word(&r->words, at, "%s", error.message);
}

static int read_image(reader *r)
{
    static const clause_form forms[] = {{"file", "PATH", CLAUSE_WORDS, 1, 1, 0, 0, 0},
                                        {"pattern", "NAME", CLAUSE_WORDS, 1, 1, 0, 0, 0},
                                        {"width", "PIXELS", CLAUSE_WHOLE, 1, 1, 0, 1, IMAGE_SIDE_MAX},
                                        {"height", "PIXELS", CLAUSE_WHOLE, 1, 1, 0, 1, IMAGE_SIDE_MAX}};
    scene *s = r->made;
    if (!new_name(r, r->images, s->image_count, SCENE_IMAGES_MAX) || !clauses(r, 2, FORMS(forms)))
        return 0;
    if (!r->c[0].at == !r->c[1].at)
        return refuse_word(&r->words, &r->list[0], "'image' needs one of 'file PATH' and 'pattern NAME'");
    for (int i = 2; i < 4; i++)
        if (r->c[0].at && r->c[i].at)
            return refuse_word(&r->words, r->c[i].at, "'%s' is of a pattern; a file has its own",
                               r->c[i].at->text);
    image *made = &s->images[s->image_count++];
    if (!make_image(r, made))
        return 0;
    r->pixels += (size_t)made->width * (size_t)made->height;
    return r->pixels <= PIXELS_MAX ||
           refuse_word(&r->words, &r->list[1], "all images together have more than %d pixels", PIXELS_MAX);
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
        return refuse_word(&r->words, text, "these are more than %d tables", SCENE_TABLES_MAX);
    if (i == s->table_count) {
        if (!(s->tables[i] = make_table(r, form, text, bytes, &error))) /* else path_of has refused */
            return error.message[0] ? refuse_word(&r->words, text, "%s", error.message) : 0;
        r->tables[s->table_count++] = (struct made_table){form, bytes, text->text};
    }
    *found = s->tables[i];
    return 1;
}

static int read_distribution(reader *r, const clause *c, const clause *bytes, const clause *alpha,
                             const vndf_distribution **found)
{
    static const char *const names[FORMS_OF_DISTRIBUTION] = {"ggx", "beckmann", "table", "family", "slope", "ndf"};
    static const char *const takes[FORMS_OF_DISTRIBUTION] = {
        "", "", "a file", "a family, as in student-t:2.5", "a formula between quotes", "a formula between quotes"};
    size_t form;
    if (!read_choice(&r->words, c, "distribution", names, FORMS_OF_DISTRIBUTION, &form))
        return 0;
    if (bytes->at && form <= TABLE)
        return refuse_word(&r->words, bytes->at, "'bytes' is of tables that are made here: family, slope or ndf");
    if (form > BECKMANN)
        return c->count > 1
                   ? find_table(r, form, &c->value[1], bytes->at ? (unsigned)bytes->number[0] : 4096, found)
                   : refuse_word(&r->words, c->value, "'distribution %s' needs %s", names[form], takes[form]);
    if (c->count > 1)
        return refuse_word(&r->words, &c->value[1], "'distribution %s' takes nothing more", names[form]);
    if (!alpha->at)
        return refuse_word(&r->words, c->at, "'distribution %s' needs 'alpha A' or 'alpha AX AY'", names[form]);
    *found = form == GGX ? vndf_ggx() : vndf_beckmann();
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

enum {
    OF,
    ETA,
    K,
    INDEX,
    DISTRIBUTION,
    BYTES,
    ALPHA,
    ALPHA_MAP,
    SCATTERING,
    COLOUR,
    COLOUR_MAP,
    RADIANCE,
    CLAUSES
};

static const clause_form material_forms[CLAUSES] = {
    [OF] = {"of", "METAL", CLAUSE_WORDS, 1, 1, 0, 0, 0},
    [ETA] = {"eta", "R G B", CLAUSE_NUMBERS, 3, 3, 0, 0, 1000},
    [K] = {"k", "R G B", CLAUSE_NUMBERS, 3, 3, 0, 0, 1000},
    [INDEX] = {"index", "N", CLAUSE_NUMBERS, 1, 1, 0, 0.01, 100},
    [DISTRIBUTION] = {"distribution", "ggx|beckmann|table FILE|family NAME|slope FORMULA|ndf FORMULA",
                      CLAUSE_WORDS, 1, 2, 0, 0, 0},
    [BYTES] = {"bytes", "COUNT", CLAUSE_WHOLE, 1, 1, 0, 2048, 1 << 20},
    [ALPHA] = {"alpha", "A or AX AY", CLAUSE_NUMBERS, 1, 2, 0, 1e-6, 1e3},
    [ALPHA_MAP] = {"alpha-map", "IMAGE", CLAUSE_WORDS, 1, 1, 0, 0, 0},
    [SCATTERING] = {"scattering", "single|multiple", CLAUSE_WORDS, 1, 1, 0, 0, 0},
    [COLOUR] = {"colour", "R G B", CLAUSE_NUMBERS, 3, 3, 0, 0, 1},
    [COLOUR_MAP] = {"colour-map", "IMAGE", CLAUSE_WORDS, 1, 1, 0, 0, 0},
    [RADIANCE] = {"radiance", "R G B", CLAUSE_NUMBERS, 3, 3, 0, 0, 1e6},
};

/* Bits of the clauses that a kind takes, and of those that it needs. */
enum {
    ROUGH = 1 << DISTRIBUTION | 1 << BYTES | 1 << ALPHA | 1 << ALPHA_MAP | 1 << SCATTERING | 1 << COLOUR |
            1 << COLOUR_MAP
};
static const unsigned taken[KINDS] = {ROUGH | 1 << OF | 1 << ETA | 1 << K, ROUGH | 1 << INDEX, ROUGH,
                                      1 << COLOUR | 1 << COLOUR_MAP, 1 << RADIANCE};
static const unsigned needed[KINDS] = {1 << DISTRIBUTION, 1 << DISTRIBUTION | 1 << INDEX, 1 << DISTRIBUTION,
                                       1 << COLOUR, 1 << RADIANCE};

static int check_clauses(reader *r, size_t kind)
{
    for (int i = 0; i < CLAUSES; i++) {
        const clause_form *f = &material_forms[i];
        if (r->c[i].at && !(taken[kind] >> i & 1u))
            return refuse_word(&r->words, r->c[i].at, "'%s' does not go with '%s'", f->keyword, kinds[kind]);
        if (!r->c[i].at && needed[kind] >> i & 1u)
            return refuse_word(&r->words, &r->list[2], "'%s' needs '%s %s'", kinds[kind], f->keyword, f->takes);
    }
    return 1;
}

static int read_metal(reader *r, vndf_description *is)
{
    const clause *of = &r->c[OF];
    size_t chosen;
    if (!of->at == !(r->c[ETA].at && r->c[K].at) || (of->at && (r->c[ETA].at || r->c[K].at)))
        return refuse_word(&r->words, &r->list[2], "'conductor' needs 'of METAL', or 'eta R G B' and 'k R G B'");
    set_three(is->conductor_eta, &r->c[ETA]);
    set_three(is->conductor_k, &r->c[K]);
    if (!of->at)
        return 1;
    if (!read_choice(&r->words, of, "metal", metal_names, METALS, &chosen))
        return 0;
    memcpy(is->conductor_eta, metals[chosen][0], sizeof metals[chosen][0]);
    memcpy(is->conductor_k, metals[chosen][1], sizeof metals[chosen][1]);
    return 1;
}

static int read_rough(reader *r, size_t kind, material *m)
{
    static const char *const scatterings[] = {"single", "multiple"};
    static const vndf_fresnel fresnel[] = {VNDF_FRESNEL_CONDUCTOR, VNDF_FRESNEL_DIELECTRIC, VNDF_FRESNEL_NONE};
    const clause *c = r->c, *alpha = &c[ALPHA];
    vndf_description *is = &m->is;
    vndf_material resolved;
    vndf_error error = {VNDF_OK, ""};
    size_t scattering = 0;
    if ((kind == CONDUCTOR && !read_metal(r, is)) ||
        !read_distribution(r, &c[DISTRIBUTION], &c[BYTES], alpha, &is->distribution) ||
        !find_image(r, &c[ALPHA_MAP], &m->alpha_map) ||
        (c[SCATTERING].at && !read_choice(&r->words, &c[SCATTERING], "scattering", scatterings, 2, &scattering)))
        return 0;
    is->alpha_x = alpha->at ? (float)alpha->number[0] : 1.0f;
    is->alpha_y = alpha->count > 1 ? (float)alpha->number[1] : is->alpha_x;
    is->eta = (float)c[INDEX].number[0];
    is->effects.fresnel = fresnel[kind];
    is->effects.lobes = kind == DIELECTRIC ? VNDF_LOBES_BOTH : VNDF_LOBES_REFLECTION;
    is->effects.scattering = scattering ? VNDF_SCATTERING_MULTIPLE : VNDF_SCATTERING_SINGLE;
    const double least = fmin((double)is->alpha_x, (double)is->alpha_y);
    const double most = fmax((double)is->alpha_x, (double)is->alpha_y);
    if (!check_map(r, &c[ALPHA_MAP], m->alpha_map, "roughness", 1, 1e-6 / least, 1e3 / most))
        return 0;
    return vndf_material_resolve(is, &resolved, &error) == VNDF_OK ||
           refuse_word(&r->words, &r->list[1], "%s", error.message);
}

static int read_material(reader *r)
{
    static const material_kind made_of[KINDS] = {MATERIAL_ROUGH, MATERIAL_ROUGH, MATERIAL_ROUGH, MATERIAL_MATTE,
                                                 MATERIAL_LIGHT};
    scene *s = r->made;
    size_t kind;
    if (!new_name(r, r->materials, s->material_count, MATERIALS_MAX))
        return 0;
    const clause what = {.value = &r->list[2]};
    if (!read_choice(&r->words, &what, "kind of material", kinds, KINDS, &kind) ||
        !clauses(r, 3, material_forms, CLAUSES) || !check_clauses(r, kind))
        return 0;
    material made = {.kind = made_of[kind], .colour = {1.0f, 1.0f, 1.0f}};
    set_three(made.colour, &r->c[COLOUR]);
    set_three(made.colour, &r->c[RADIANCE]);
    if (!find_image(r, &r->c[COLOUR_MAP], &made.colour_map) ||
        !check_map(r, &r->c[COLOUR_MAP], made.colour_map, "colour", 3, 0, 1) ||
        (made.kind == MATERIAL_ROUGH && !read_rough(r, kind, &made)))
        return 0;
    strcpy(made.name, r->list[1].text);
    s->materials[s->material_count++] = made;
    return 1;
}

/* ---- shapes ---- */

static int find_material(reader *r, const clause *c, int *found)
{
    size_t chosen;
    const int is_known = read_choice(&r->words, c, "material that is defined before this", r->materials,
                                     r->made->material_count, &chosen);
    *found = (int)chosen;
    return is_known;
}

static int add_shape(reader *r, const shape *made)
{
    return geometry_add(&r->made->geometry, made) ||
           refuse_word(&r->words, &r->list[0], "there is no memory for this shape");
}

static int read_sphere(reader *r)
{
    static const clause_form forms[] = {{"centre", "X Y Z", CLAUSE_NUMBERS, 3, 3, 1, -1e6, 1e6},
                                        {"radius", "R", CLAUSE_NUMBERS, 1, 1, 1, 1e-6, 1e6},
                                        {"material", "NAME", CLAUSE_WORDS, 1, 1, 1, 0, 0}};
    shape made = {.kind = SHAPE_SPHERE};
    if (!clauses(r, 1, FORMS(forms)) || !find_material(r, &r->c[2], &made.material))
        return 0;
    made.corner = vector_of(&r->c[0]);
    made.radius = r->c[1].number[0];
    return add_shape(r, &made);
}

/* The text has few digits, so that edges that are meant to be at right angles may be a little off: the second one
 * is corrected. */
static int read_rectangle(reader *r)
{
    static const clause_form forms[] = {{"corner", "X Y Z", CLAUSE_NUMBERS, 3, 3, 1, -1e6, 1e6},
                                        {"edge-u", "X Y Z", CLAUSE_NUMBERS, 3, 3, 1, -1e6, 1e6},
                                        {"edge-v", "X Y Z", CLAUSE_NUMBERS, 3, 3, 1, -1e6, 1e6},
                                        {"material", "NAME", CLAUSE_WORDS, 1, 1, 1, 0, 0}};
    shape made = {.kind = SHAPE_RECTANGLE};
    if (!clauses(r, 1, FORMS(forms)) || !find_material(r, &r->c[3], &made.material))
        return 0;
    const vec3 u = vector_of(&r->c[1]), v = vector_of(&r->c[2]);
    for (int i = 1; i < 3; i++)
        if (!(length(vector_of(&r->c[i])) >= near))
            return refuse_word(&r->words, r->c[i].at, "'%s' has no length", r->c[i].at->text);
    const double cosine = dot(u, v) / (length(u) * length(v));
    if (!(fabs(cosine) < 2e-3))
        return refuse_word(&r->words, r->c[2].at,
                           "the edges of a rectangle must be at right angles; these are at %.4g degrees",
                           acos(fmin(fmax(cosine, -1), 1)) * (180 / PI));
    made.corner = vector_of(&r->c[0]);
    made.edge_u = u;
    made.edge_v = along(v, -dot(u, v) / dot(u, u), u);
    return add_shape(r, &made);
}

/* A file, or the knot. */
static int read_mesh(reader *r)
{
    static const char *const patterns[] = {"knot"};
    static const clause_form forms[] = {{"file", "PATH", CLAUSE_WORDS, 1, 1, 0, 0, 0},
                                        {"scale", "FACTOR", CLAUSE_NUMBERS, 1, 1, 0, 1e-6, 1e6},
                                        {"turn", "DEGREES", CLAUSE_NUMBERS, 1, 1, 0, -360, 360},
                                        {"move", "X Y Z", CLAUSE_NUMBERS, 3, 3, 0, -1e6, 1e6},
                                        {"material", "NAME", CLAUSE_WORDS, 1, 1, 1, 0, 0},
                                        {"pattern", "NAME", CLAUSE_WORDS, 1, 1, 0, 0, 0}};
    const clause *file = &r->c[0], *pattern = &r->c[5];
    char why[512];
    size_t which;
    int of;
    if (!clauses(r, 1, FORMS(forms)) || !find_material(r, &r->c[4], &of))
        return 0;
    if (r->made->materials[of].kind == MATERIAL_LIGHT)
        return refuse_word(&r->words, r->c[4].value, "a light is a sphere or a rectangle, not a mesh");
    if (!file->at == !pattern->at)
        return refuse_word(&r->words, &r->list[0], "'mesh' needs one of 'file PATH' and 'pattern knot'");
    const placement where = {r->c[1].at ? r->c[1].number[0] : 1, r->c[2].number[0], vector_of(&r->c[3])};
    if (pattern->at)
        return read_choice(&r->words, pattern, "pattern of a mesh", patterns, 1, &which) &&
               (knot_add(&r->made->geometry, &where, of) ||
                refuse_word(&r->words, &r->list[0], "there is no memory for this shape"));
    char *path = path_of(r, file->value);
    int good = path && (obj_read(&r->made->geometry, path, &where, of, why, sizeof why) ||
                        refuse_word(&r->words, file->value, "%s", why));
    free(path);
    return good;
}

/* ---- all of it ---- */

typedef struct statement {
    const char *name;
    int (*read)(reader *r);
    int once;
} statement;

enum { CAMERA = 1, STATEMENTS = 9 };
static const statement statements[STATEMENTS] = {
    {"film", read_film, 1},     {"camera", read_camera, 1},       {"integrator", read_integrator, 1},
    {"image", read_image, 0},   {"material", read_material, 0},   {"environment", read_environment, 1},
    {"sphere", read_sphere, 0}, {"rectangle", read_rectangle, 0}, {"mesh", read_mesh, 0},
};

static int read_statement(reader *r)
{
    const char *names[STATEMENTS];
    const word *w = &r->list[0];
    for (size_t i = 0; i < STATEMENTS; i++) {
        names[i] = statements[i].name;
        if (w->is_quoted || strcmp(w->text, names[i]) != 0)
            continue;
        if (statements[i].once && r->seen >> i & 1u)
            return refuse_word(&r->words, w, "'%s' stands in this scene twice", w->text);
        r->seen |= 1u << i;
        return statements[i].read(r);
    }
    return refuse_unknown(&r->words, w, "statement", names, STATEMENTS);
}

/* Without light a scene is black, which nobody means. */
static int finish(reader *r)
{
    scene *s = r->made;
    const word first = {NULL, 1, 1, 0, 0}, *end = r->words.count ? &r->words.list[r->words.count - 1] : &first;
    if (!(r->seen >> CAMERA & 1u))
        return refuse_word(&r->words, end, "the scene ends without a camera, as in 'camera from 0 1 5 to 0 0 0'");
    if (!geometry_build(&s->geometry))
        return refuse_word(&r->words, end, "there is no memory for a hierarchy of its shapes");
    if (!lights_make(s))
        return refuse_word(&r->words, end, "these are more than %d lights, or there is no memory",
                           SCENE_LIGHTS_MAX);
    const float *constant = s->environment.constant;
    return s->light_count > 0 || s->environment.map || constant[0] + constant[1] + constant[2] > 0.0f ||
           refuse_word(&r->words, end, "the scene ends without light: an environment, or a shape of a light");
}

static int read_statements(reader *r, char *text, size_t length)
{
    if (!split_words(&r->words, text, length))
        return 0;
    for (size_t at = 0; at < r->words.count; at += r->count) {
        r->list = r->words.list + at;
        for (r->count = 1; at + r->count < r->words.count && !r->list[r->count].begins;)
            r->count++;
        if (!read_statement(r))
            return 0;
    }
    return finish(r);
}

scene *scene_read_text(const char *name, char *text, size_t length, char *message, size_t size)
{
    const char *slash = strrchr(name, '/');
    scene *s = calloc(1, sizeof *s);
    reader r = {.words = {.name = name, .message = message, .size = size},
                .made = s,
                .folder = slash ? (size_t)(slash - name) + 1 : 0};
    if (s)
        s->materials = calloc(MATERIALS_MAX, sizeof *s->materials);
    if (!s || !s->materials) {
        snprintf(message, size, "%s: there is no memory", name);
        free(s);
        return NULL;
    }
    s->up = vec(0, 1, 0);
    s->field = 40 * (PI / 180);
    s->width = 640;
    s->height = 360;
    s->depth = 12;
    s->samples = 64;
    s->exposure = s->environment.scale = 1.0f;
    int good = read_statements(&r, text, length);
    free(r.words.list);
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
