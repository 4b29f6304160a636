/* Reads a scene: line after line, each by the one table of what can stand in it, then a look at the whole. Everything
 * that reads returns 1, or 0 after a refusal that names the line. */
#include "render/scene.h"

#include <stdlib.h>
#include <string.h>

#include "cli/files.h"
#include "render/lines.h"
#include "vndf_build.h"

/* Against hostile files. */
enum {
    BYTES_MAX = 1 << 22,
    PATH_BYTES = 4096,
    FIELDS_MAX = 16,                  /* of a line */
    PIXELS_MAX = 2 * IMAGE_PIXELS_MAX /* of all images together */
};

static const double least_size = 1e-6;

/* What lines say, and what stands there where they leave it out. */
typedef struct given {
    double width, height, field, depth, samples, exposure, columns, rows, scale, turn, radius, alpha[2], index;
    vec3 up, colour, from, to, eta, k, corner, edge_u, edge_v, move;
    const char *distribution[2], *file, *pattern, *image, *metal, *alpha_map, *colour_map, *scattering, *material;
} given;

static const given initial = {640, 360, 40, 12, 64, 1, 512, 512, 1, .up = {0, 1, 0}, .colour = {1, 1, 1}};

/* ---- what can stand in a line ---- */

/* What lines begin with, and the kinds of three of them; ONE_MORE is where a list of names ends. */
enum { FILM, CAMERA, INTEGRATOR, ENVIRONMENT, IMAGE, MATERIAL, SPHERE, RECTANGLE, MESH, ONE_MORE };
enum { CONSTANT = ONE_MORE + 1, SKY, FROM_FILE = SKY + 2, PATTERN, CONDUCTOR = PATTERN + 2 };
enum { DIELECTRIC = CONDUCTOR + 1, SHAPE, MATTE, LIGHT };

static const char *const names[] = {"film",   "camera",    "integrator", "environment", "image",     "material",
                                    "sphere", "rectangle", "mesh",       NULL,          "constant",  "image",
                                    NULL,     "file",      "pattern",    NULL,          "conductor", "dielectric",
                                    "shape",  "matte",     "light",      NULL};

/* The first of the kinds of a line, if it has kinds. */
static const size_t kinds[ONE_MORE] = {[ENVIRONMENT] = CONSTANT, [IMAGE] = FROM_FILE, [MATERIAL] = CONDUCTOR};

typedef enum field_kind { TEXT, NUMBER, WHOLE } field_kind;

typedef struct field {
    unsigned of;              /* a bit for each line or kind that has it */
    const char *name, *takes; /* a word for each value; what is in [ ] may be left out */
    field_kind kind;
    double low, high;
    int is_needed;
    size_t at; /* its values in `given` */
    const char *is;
} field;

enum { MAY_BE, NEEDED };
#define AT(member) offsetof(given, member)
#define PLACE "X Y Z", NUMBER, -1e6, 1e6
#define ROUGH (1u << CONDUCTOR | 1u << DIELECTRIC | 1u << SHAPE)
#define BODY (1u << SPHERE | 1u << RECTANGLE | 1u << MESH)

static const field fields[] = {
    {1u << FILM, "width", "PIXELS", WHOLE, 1, IMAGE_SIDE_MAX, MAY_BE, AT(width), ""},
    {1u << FILM, "height", "PIXELS", WHOLE, 1, IMAGE_SIDE_MAX, MAY_BE, AT(height), ""},
    {1u << CAMERA, "from", PLACE, NEEDED, AT(from), ""},
    {1u << CAMERA, "to", PLACE, NEEDED, AT(to), ""},
    {1u << CAMERA, "up", PLACE, MAY_BE, AT(up), ""},
    {1u << CAMERA, "field", "DEGREES", NUMBER, 1, 170, MAY_BE, AT(field), "of view, across the height"},
    {1u << INTEGRATOR, "depth", "N", WHOLE, 1, 10000, MAY_BE, AT(depth), "surfaces on a path at most"},
    {1u << INTEGRATOR, "samples", "N", WHOLE, 1, 1e9, MAY_BE, AT(samples), "a pixel"},
    {1u << INTEGRATOR, "exposure", "F", NUMBER, 1e-6, 1e6, MAY_BE, AT(exposure), "brightness of a PNG"},
    {1u << CONSTANT, "constant", "R G B", NUMBER, 0, 1e6, NEEDED, AT(colour), "the same light from everywhere"},
    {1u << SKY, "image", "IMAGE", TEXT, 0, 0, NEEDED, AT(image), "longitude over latitude, see above"},
    {1u << SKY, "scale", "F", NUMBER, 0, 1e6, MAY_BE, AT(scale), ""},
    {1u << SKY, "turn", "DEGREES", NUMBER, -360, 360, MAY_BE, AT(turn), "about y"},
    {1u << FROM_FILE, "file", "FILE.pfm", TEXT, 0, 0, NEEDED, AT(file), ""},
    {1u << PATTERN, "pattern", "tiles|grid|studio", TEXT, 0, 0, NEEDED, AT(pattern), ""},
    {1u << PATTERN, "width", "PIXELS", WHOLE, 1, IMAGE_SIDE_MAX, MAY_BE, AT(columns), ""},
    {1u << PATTERN, "height", "PIXELS", WHOLE, 1, IMAGE_SIDE_MAX, MAY_BE, AT(rows), ""},
    {1u << CONDUCTOR, "of", "METAL", TEXT, 0, 0, MAY_BE, AT(metal), "gold, silver, copper, aluminium; or:"},
    {1u << CONDUCTOR, "eta", "R G B", NUMBER, 0, 1000, MAY_BE, AT(eta), "index of refraction, real part"},
    {1u << CONDUCTOR, "k", "R G B", NUMBER, 0, 1000, MAY_BE, AT(k), "and imaginary part"},
    {1u << DIELECTRIC, "index", "N", NUMBER, 0.01, 100, NEEDED, AT(index), "inside over outside"},
    {ROUGH, "distribution", "D [OF]", TEXT, 0, 0, NEEDED, AT(distribution), "see above"},
    {ROUGH, "alpha", "A [AY]", NUMBER, 1e-6, 1e3, MAY_BE, AT(alpha), "stretches slopes"},
    {ROUGH, "alpha-map", "IMAGE", TEXT, 0, 0, MAY_BE, AT(alpha_map), "its red multiplies alpha"},
    {ROUGH, "scattering", "single|multiple", TEXT, 0, 0, MAY_BE, AT(scattering), "between microfacets"},
    {ROUGH, "colour", "R G B", NUMBER, 0, 1, MAY_BE, AT(colour), "multiplies"},
    {ROUGH, "colour-map", "IMAGE", TEXT, 0, 0, MAY_BE, AT(colour_map), "multiplies"},
    {1u << MATTE, "colour", "R G B", NUMBER, 0, 1, NEEDED, AT(colour), ""},
    {1u << MATTE, "colour-map", "IMAGE", TEXT, 0, 0, MAY_BE, AT(colour_map), "multiplies"},
    {1u << LIGHT, "radiance", "R G B", NUMBER, 0, 1e6, NEEDED, AT(colour), "of the front"},
    {1u << SPHERE, "centre", PLACE, NEEDED, AT(corner), ""},
    {1u << SPHERE, "radius", "R", NUMBER, 1e-6, 1e6, NEEDED, AT(radius), ""},
    {1u << RECTANGLE, "corner", PLACE, NEEDED, AT(corner), ""},
    {1u << RECTANGLE, "edge-u", PLACE, NEEDED, AT(edge_u), "seen from the front to the right of edge-v,"},
    {1u << RECTANGLE, "edge-v", PLACE, NEEDED, AT(edge_v), "at right angles to it"},
    {1u << MESH, "file", "FILE.obj", TEXT, 0, 0, NEEDED, AT(file), "scaled, then turned, then moved"},
    {1u << MESH, "scale", "F", NUMBER, 1e-6, 1e6, MAY_BE, AT(scale), ""},
    {1u << MESH, "turn", "DEGREES", NUMBER, -360, 360, MAY_BE, AT(turn), "about y"},
    {1u << MESH, "move", PLACE, MAY_BE, AT(move), ""},
    {BODY, "material", "NAME", TEXT, 0, 0, NEEDED, AT(material), ""},
};

static const field *const fields_end = fields + sizeof fields / sizeof *fields;

/* How many values a field has at most. */
static size_t values_of(const field *f)
{
    size_t count = 1;
    for (const char *c = f->takes; *c; c++)
        count += *c == ' ';
    return count;
}

static const char manual[] =
    "A scene is text. A line is a word, then fields in any order: each a word and what it takes. # begins a\n"
    "comment, \"quotes\" hold blanks. Paths are relative to the file, colours linear, +y is the zenith.\n"
    "\n"
    "  camera from 0 1 5 to 0 0.5 0 field 35\n"
    "  environment constant 1 1 1\n"
    "  material red-gold conductor of gold distribution ggx alpha 0.2\n"
    "  sphere centre 0 0.5 0 radius 0.5 material red-gold\n"
    "\n"
    "One camera and some light are needed; film, integrator and environment stand once at most. Before their\n"
    "fields stand: image NAME file|pattern, material NAME KIND; both are defined before they are used.\n"
    "\n"
    "distribution is ggx, beckmann (both need alpha), table FILE.vndf, or built here, see `vndf build --help`:\n"
    "family NAME:PARAMETERS, slope \"P22(r)\", ndf \"D(c, theta, t)\". Kinds of materials: conductor, dielectric,\n"
    "shape (all is reflected), matte, light (a sphere or a rectangle). Dielectrics are to be closed; of others\n"
    "the back is black. An image lies on a rectangle upright; around a sphere from +z by way of +x; on a mesh as\n"
    "vt say. An environment is seen from inside: the zenith on top, -z in the middle, +x at its right. Maps of\n"
    "colour are 0 to 1, alpha with its map is 1e-6 to 1e3.\n";

void scene_print_grammar(FILE *file)
{
    fputs(manual, file);
    for (const field *f = fields; f < fields_end; f++) {
        const double *otherwise = (const double *)(const void *)((const char *)&initial + f->at);
        const int has_default = f->kind != TEXT && !f->is_needed && *otherwise >= f->low;
        char head[64], range[64] = "";
        for (unsigned of = 0, any = 0; of <= LIGHT && (f == fields || f->of != f[-1].of); of++)
            if (f->of >> of & 1u)
                fprintf(file, "%s%s", any++ ? ", " : "\n", of == SKY ? "environment image" : names[of]);
        snprintf(head, sizeof head, "%s %s", f->name, f->takes);
        if (f->kind != TEXT)
            snprintf(range, sizeof range, "%g to %g", f->low, f->high);
        fprintf(file, "\n  %-26s %-16s%s%s%s", head, range, f->is_needed ? "needed" : "",
                *f->is && f->is_needed ? "; " : "", f->is);
        for (size_t i = 0; i < values_of(f) && has_default; i++)
            fprintf(file, "%s%g%s", i ? " " : *f->is ? " (" : "(", otherwise[i], i + 1 < values_of(f) ? "" : ")");
    }
    fputs("\n", file);
}

/* ---- lines ---- */

typedef struct reader {
    lines in;
    scene *made;
    unsigned seen;                            /* a bit for each form */
    const char *images[SCENE_IMAGES_MAX + 1]; /* names, NULL at the end */
    const char *materials[SCENE_MATERIALS_MAX + 1];
    size_t pixels;                           /* of all images so far */
    const char *tables[SCENE_TABLES_MAX][2]; /* what those of the scene are made from */
} reader;

static size_t find(const char *const *list, const char *word)
{
    size_t i = 0;
    while (list[i] && strcmp(list[i], word) != 0)
        i++;
    return i;
}

/* Which of the names a word is; a refusal offers the nearest one, or all of them. `what`: "pattern". */
static int choose(reader *r, const char *word, const char *what, const char *const *list, size_t *chosen)
{
    *chosen = find(list, word);
    if (list[*chosen])
        return 1;
    const char *near = did_you_mean(word, list, *chosen);
    const char *all = *near ? near : *list ? list_words(list, "") : "defined before";
    return refuse(&r->in, "'%.64s' is no %s%s%s", word, what, *near ? "" : "; it must be ", all);
}

static int read_within(reader *r, const field *f, const char *word, double *number)
{
    if (!read_number(&r->in, word, number))
        return 0;
    if (!(*number >= f->low && *number <= f->high))
        return refuse(&r->in, "%s is %.9g, it must be from %.9g to %.9g", f->name, *number, f->low, f->high);
    return f->kind != WHOLE || *number == floor(*number) ||
           refuse(&r->in, "%s is %.9g, it must be a whole number", f->name, *number);
}

/* The values of a field, from word `at` on: 0, or how many. The name of another field ends what may be left out; values
 * that have to be there are taken as they are, since a name may look like a field. */
static size_t read_values(reader *r, void *to, const field *f, const char *const *has, size_t at)
{
    const size_t most = values_of(f), least = most - (strchr(f->takes, '[') != NULL);
    size_t count = 0;
    for (; count < most && at < r->in.count && (count < least || !has[find(has, r->in.word[at])]); count++, at++)
        if (f->kind == TEXT)
            ((const char **)to)[count] = r->in.word[at];
        else if (!read_within(r, f, r->in.word[at], (double *)to + count))
            return 0;
    return count >= least ? count
                          : (size_t)refuse(&r->in, "the line ends before all of '%s %s'", f->name, f->takes);
}

/* Reads the fields of a line or kind from word `at` on. */
static int read_fields(reader *r, given *g, size_t of, size_t at)
{
    const char *has[FIELDS_MAX] = {NULL};
    const field *is[FIELDS_MAX];
    size_t count = 0, chosen, values;
    unsigned seen = 0;
    for (const field *f = fields; f < fields_end; f++)
        if (f->of >> of & 1u) {
            has[count] = f->name;
            is[count++] = f;
        }
    for (; at < r->in.count; at += 1 + values) {
        if (!choose(r, r->in.word[at], "field here", has, &chosen))
            return 0;
        if (seen >> chosen & 1u)
            return refuse(&r->in, "'%s' stands in this line twice", has[chosen]);
        seen |= 1u << chosen;
        if (!(values = read_values(r, (char *)g + is[chosen]->at, is[chosen], has, at + 1)))
            return 0;
    }
    for (size_t i = 0; i < count; i++)
        if (is[i]->is_needed && !(seen >> i & 1u))
            return refuse(&r->in, "'%s' needs '%s %s'", names[of], has[i], is[i]->takes);
    return 1;
}

/* ---- what fields hold ---- */

static void floats_of(vec3 v, float to[3])
{
    to[0] = (float)v.x;
    to[1] = (float)v.y;
    to[2] = (float)v.z;
}

/* The path relative to the working folder. */
static int path_of(reader *r, const char *file, char path[PATH_BYTES])
{
    const char *slash = strrchr(r->in.name, '/');
    const int folder = file[0] == '/' || !slash ? 0 : (int)(slash - r->in.name) + 1;
    const int letters = snprintf(path, PATH_BYTES, "%.*s%s", folder, r->in.name, file);
    return (file[0] && letters < PATH_BYTES) ||
           refuse(&r->in, "a path has 1 to %d letters, with the folder of the scene", PATH_BYTES - 1);
}

/* The image of this name, if there is a name: its first channels have to be within a range, since it is used as
 * `what`. */
static int find_image(reader *r, const char *name, const char *what, int channels, double low, double high,
                      const image **found)
{
    size_t chosen;
    if (!name)
        return 1;
    if (!choose(r, name, "image", r->images, &chosen))
        return 0;
    const image *map = *found = &r->made->images[chosen];
    for (int i = 0; i < map->width * map->height * 3; i++) {
        const double value = (double)map->rgb[i];
        if (i % 3 < channels && !(value >= low && value <= high))
            return refuse(&r->in, "as %s the image must be from %g to %g; it is %g in column %d of row %d", what,
                          low, high, value, i / 3 % map->width, i / 3 / map->width);
    }
    return 1;
}

/* ---- once in a scene ---- */

static int read_view(reader *r, const given *g, size_t of)
{
    scene *s = r->made;
    const vec3 forward = subtract(g->to, g->from);
    if (of == FILM) {
        s->width = (int)g->width;
        s->height = (int)g->height;
        return g->width * g->height <= IMAGE_PIXELS_MAX ||
               refuse(&r->in, "%d x %d pixels are more than %d", s->width, s->height, IMAGE_PIXELS_MAX);
    }
    if (of == INTEGRATOR) {
        s->depth = (unsigned)g->depth;
        s->samples = (unsigned)g->samples;
        s->exposure = (float)g->exposure;
        return 1;
    }
    s->from = g->from;
    s->to = g->to;
    s->up = g->up;
    s->field = g->field * (PI / 180);
    if (!(length(forward) >= least_size))
        return refuse(&r->in, "'from' and 'to' are the same place");
    return length(cross(forward, g->up)) >= 1e-6 * length(forward) * length(g->up) ||
           refuse(&r->in, "'up' is the direction of the view");
}

static int read_environment(reader *r, const given *g, size_t kind)
{
    environment *e = &r->made->environment;
    floats_of(kind == CONSTANT ? g->colour : vec(0, 0, 0), e->constant);
    e->scale = (float)g->scale;
    e->turn = g->turn / 360;
    return kind == CONSTANT || find_image(r, g->image, "light from far away", 3, 0, 1e6, &e->map);
}

/* ---- images and distributions ---- */

static int read_image(reader *r, const given *g, size_t kind)
{
    image *made = &r->made->images[r->made->image_count++];
    vndf_error error = {VNDF_OK, ""};
    char path[PATH_BYTES];
    if (kind == FROM_FILE && !path_of(r, g->file, path))
        return 0;
    if (!(kind == FROM_FILE ? image_read_pfm(made, path, &error)
                            : image_make_pattern(made, g->pattern, (int)g->columns, (int)g->rows, &error)))
        return refuse(&r->in, "%s", error.message);
    r->pixels += (size_t)made->width * (size_t)made->height;
    return r->pixels <= PIXELS_MAX || refuse(&r->in, "all images together have more than %d pixels", PIXELS_MAX);
}

enum { GGX, BECKMANN, TABLE, FAMILY, SLOPE, NDF };

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

/* Materials with the same two words share a table. */
static int read_distribution(reader *r, const given *g, const vndf_distribution **found)
{
    static const char *const known[] = {"ggx", "beckmann", "table", "family", "slope", "ndf", NULL};
    const char *word = g->distribution[0], *of = g->distribution[1];
    scene *s = r->made;
    vndf_error error = {VNDF_OK, ""};
    char path[PATH_BYTES];
    size_t form, i = 0;
    if (!choose(r, word, "distribution", known, &form))
        return 0;
    if (!of != (form <= BECKMANN))
        return refuse(&r->in, "'distribution %s' %s", word,
                      of ? "takes nothing more" : "needs a file, family or formula");
    *found = form == GGX ? vndf_ggx() : vndf_beckmann();
    if (form <= BECKMANN)
        return g->alpha[0] > 0 || refuse(&r->in, "'distribution %s' needs 'alpha A [AY]'", word);
    while (i < s->table_count && (strcmp(r->tables[i][0], word) != 0 || strcmp(r->tables[i][1], of) != 0))
        i++;
    if (i == SCENE_TABLES_MAX)
        return refuse(&r->in, "these are more than %d tables", SCENE_TABLES_MAX);
    if (i == s->table_count) {
        if (form == TABLE && !path_of(r, of, path))
            return 0;
        if (!(s->tables[i] = make_table(form, form == TABLE ? path : of, &error)))
            return refuse(&r->in, "%s", error.message);
        r->tables[i][0] = word;
        r->tables[i][1] = of;
        s->table_count++;
    }
    *found = s->tables[i];
    return 1;
}

/* ---- materials ---- */

/* Indices of refraction of metals for red, green and blue: measured spectra weighed by the sensitivities of the
 * three colours. They agree to three digits with the lists of the renderers Tungsten and Yocto/GL for Au, Ag, Cu
 * and Al. (Indices at single wavelengths fail: at 550 nm copper is on the slope of its reflectance, and looks
 * tan.) */
static const char *const metal_names[] = {"gold", "silver", "copper", "aluminium", NULL};
static const vec3 metals[][2] = {
    {{0.143, 0.375, 1.442}, {3.983, 2.386, 1.603}},
    {{0.155, 0.117, 0.138}, {4.828, 3.122, 2.147}},
    {{0.200, 0.924, 1.102}, {3.912, 2.452, 2.142}},
    {{1.657, 0.880, 0.521}, {9.224, 6.270, 4.837}},
};

static int read_rough(reader *r, const given *g, size_t kind, material *m)
{
    static const char *const scatterings[] = {"single", "multiple", NULL};
    vndf_description *is = &m->is;
    vndf_material resolved;
    vndf_error error = {VNDF_OK, ""};
    size_t order = 0, metal = 0;
    if ((g->metal && !choose(r, g->metal, "metal", metal_names, &metal)) ||
        (g->scattering && !choose(r, g->scattering, "scattering", scatterings, &order)) ||
        !read_distribution(r, g, &is->distribution))
        return 0;
    if (kind == CONDUCTOR && !g->metal == !(length(g->eta) + length(g->k) > 0))
        return refuse(&r->in, "'conductor' needs either 'of METAL' or 'eta R G B k R G B'");
    floats_of(g->metal ? metals[metal][0] : g->eta, is->conductor_eta);
    floats_of(g->metal ? metals[metal][1] : g->k, is->conductor_k);
    is->alpha_x = g->alpha[0] > 0 ? (float)g->alpha[0] : 1.0f;
    is->alpha_y = g->alpha[1] > 0 ? (float)g->alpha[1] : is->alpha_x;
    is->eta = (float)g->index;
    is->effects.fresnel = kind == CONDUCTOR    ? VNDF_FRESNEL_CONDUCTOR
                          : kind == DIELECTRIC ? VNDF_FRESNEL_DIELECTRIC
                                               : VNDF_FRESNEL_NONE;
    is->effects.lobes = kind == DIELECTRIC ? VNDF_LOBES_BOTH : VNDF_LOBES_REFLECTION;
    is->effects.scattering = order ? VNDF_SCATTERING_MULTIPLE : VNDF_SCATTERING_SINGLE;
    const double least = 1e-6 / fmin((double)is->alpha_x, (double)is->alpha_y);
    const double most = 1e3 / fmax((double)is->alpha_x, (double)is->alpha_y);
    return find_image(r, g->alpha_map, "roughness", 1, least, most, &m->alpha_map) &&
           (vndf_material_resolve(is, &resolved, &error) == VNDF_OK || refuse(&r->in, "%s", error.message));
}

static int read_material(reader *r, const given *g, size_t kind)
{
    material *made = &r->made->materials[r->made->material_count++];
    made->name = r->in.word[1];
    made->kind = kind <= SHAPE ? MATERIAL_ROUGH : kind == MATTE ? MATERIAL_MATTE : MATERIAL_LIGHT;
    floats_of(g->colour, made->colour);
    return find_image(r, g->colour_map, "colour", 3, 0, 1, &made->colour_map) &&
           (kind > SHAPE || read_rough(r, g, kind, made));
}

/* ---- shapes ---- */

static int read_mesh(reader *r, const given *g, size_t of)
{
    geometry *to = &r->made->geometry;
    const size_t first = to->count;
    vndf_error error = {VNDF_OK, ""};
    char path[PATH_BYTES];
    if (r->made->materials[of].kind == MATERIAL_LIGHT)
        return refuse(&r->in, "a light is a sphere or a rectangle, not a mesh");
    if (!path_of(r, g->file, path))
        return 0;
    if (!obj_read(to, path, (int)of, &error))
        return refuse(&r->in, "%s", error.message);
    geometry_place(to, first, g->scale, g->turn * (PI / 180), g->move);
    return 1;
}

/* The text has few digits, so that edges that are meant to be at right angles may be a little off: the second one
 * is corrected. */
static int read_shape(reader *r, const given *g, size_t of)
{
    const vec3 u = g->edge_u, v = g->edge_v;
    shape made = {.kind = SHAPE_SPHERE, .corner = g->corner, .radius = g->radius};
    size_t which;
    if (!choose(r, g->material, "material", r->materials, &which))
        return 0;
    if (of == MESH)
        return read_mesh(r, g, which);
    if (of == RECTANGLE) {
        const double cosine = dot(u, v) / (length(u) * length(v));
        if (!(length(u) >= least_size && length(v) >= least_size))
            return refuse(&r->in, "an edge of the rectangle has no length");
        if (!(fabs(cosine) < 2e-3))
            return refuse(&r->in, "the edges of a rectangle must be at right angles; these are at %.4g degrees",
                          acos(fmin(fmax(cosine, -1), 1)) * (180 / PI));
        made.kind = SHAPE_RECTANGLE;
        made.edge_u = u;
        made.edge_v = along(v, -dot(u, v) / dot(u, u), u);
    }
    made.material = (int)which;
    return geometry_add(&r->made->geometry, &made) || refuse(&r->in, "there is no memory for this shape");
}

/* ---- all of it ---- */

/* The second word of a line, a name that none of the things before it has; there may be `most`. */
static int read_name(reader *r, const char **list, size_t most)
{
    const char *what = r->in.word[0], *name = r->in.word[1];
    const size_t count = find(list, name);
    if (list[count])
        return refuse(&r->in, "there is another %s '%.64s' already", what, name);
    if (count == most)
        return refuse(&r->in, "these are more than %zu %ss", most, what);
    list[count] = name;
    return 1;
}

static int (*const readers[ONE_MORE])(reader *r, const given *g, size_t of) = {
    read_view,     read_view,  read_view,  read_environment, read_image,
    read_material, read_shape, read_shape, read_shape};

static int read_line(reader *r)
{
    size_t of, kind = 0;
    given g = initial;
    if (!choose(r, r->in.word[0], "word that begins a line", names, &of))
        return 0;
    if (of <= ENVIRONMENT && r->seen >> of & 1u)
        return refuse(&r->in, "'%s' stands in this scene twice", names[of]);
    r->seen |= 1u << of;
    if (!kinds[of])
        return read_fields(r, &g, of, 1) && readers[of](r, &g, of);
    const char *const *list = names + kinds[of];
    const size_t kind_at = of == ENVIRONMENT ? 1 : 2;
    if (r->in.count <= kind_at)
        return refuse(&r->in, "'%s' needs %s%s", names[of], kind_at > 1 ? "a name and " : "",
                      list_words(list, ""));
    if (!choose(r, r->in.word[kind_at], "kind of it", list, &kind) ||
        (of == IMAGE && !read_name(r, r->images, SCENE_IMAGES_MAX)) ||
        (of == MATERIAL && !read_name(r, r->materials, SCENE_MATERIALS_MAX)))
        return 0;
    kind += kinds[of];
    return read_fields(r, &g, kind, of == MATERIAL ? 3 : kind_at) && readers[of](r, &g, kind);
}

/* Without light a scene is black, which nobody means. */
static int finish(reader *r)
{
    scene *s = r->made;
    if (!(r->seen >> CAMERA & 1u))
        return refuse(&r->in, "the scene ends without a camera, as in 'camera from 0 1 5 to 0 0 0'");
    if (!geometry_build(&s->geometry))
        return refuse(&r->in, "there is no memory for a hierarchy of its shapes");
    if (!lights_make(s))
        return refuse(&r->in, "these are more than %d lights, or there is no memory", SCENE_LIGHTS_MAX);
    const float *constant = s->environment.constant;
    return s->light_count > 0 || s->environment.map || constant[0] + constant[1] + constant[2] > 0.0f ||
           refuse(&r->in, "the scene ends without light: an environment, or a shape of a light");
}

scene *scene_read_text(const char *name, char *text, size_t length, vndf_error *error)
{
    scene *s = calloc(1, sizeof *s);
    reader r = {.made = s};
    int more, good = lines_begin(&r.in, name, text, length, error);
    good = good && (s || refuse(&r.in, "there is no memory"));
    good = good && read_view(&r, &initial, FILM) && read_view(&r, &initial, INTEGRATOR);
    while (good && (more = lines_next(&r.in)))
        good = more > 0 && read_line(&r);
    if (good && finish(&r))
        return s->text = text, s;
    free(text);
    scene_free(s);
    return NULL;
}

scene *scene_read(const char *path, vndf_error *error)
{
    size_t length;
    char *text = bytes_read(path, BYTES_MAX, &length, error);
    return text ? scene_read_text(path, text, length, error) : NULL;
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
    free(s->text);
    geometry_free(&s->geometry);
    free(s);
}

int scene_resize(scene *s, int width, vndf_error *error)
{
    const double height = floor((double)width * s->height / s->width + 0.5);
    if (!(height >= 1 && height <= IMAGE_SIDE_MAX && height * width <= IMAGE_PIXELS_MAX))
        return refuse_at(error, "--width", 0, "%d x %.0f pixels: a film has 1 to %d rows and at most %d pixels",
                         width, height, IMAGE_SIDE_MAX, IMAGE_PIXELS_MAX);
    s->width = width;
    s->height = (int)height;
    return 1;
}
