/* Reads a scene: a line is written as a command with options, and is read as those of the program are. One table has
 * the options of all lines, what they take and where that is put. What reads returns 1, or 0 after a complaint that
 * names the line. */
#include "render/scene.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "cli/files.h"
#include "cli/subject.h"
#include "render/lines.h"

/* Against hostile files. */
enum { PIXELS_MAX = 2 * IMAGE_PIXELS_MAX /* of all images together */ };

#define FAR_AWAY 1e6
#define LEAST_SIZE 1e-6
#define BRIGHTEST 1e6

enum { CAMERA, ENVIRONMENT, MATERIAL, SPHERE, RECTANGLE, MESH, STATEMENTS };
static const char *const statements[] = {"camera", "environment", "material", "sphere", "rectangle", "mesh", NULL};

static const char preface[] =
    "A scene is text. A line is written as a command with options, whose values have no blanks; # begins a\n"
    "comment. Materials are defined before they are used. Colours are linear, +y is the zenith, paths are\n"
    "relative to the file. Places and sizes are up to 1e6. A camera and some light are needed. Shapes of\n"
    "dielectrics are to be closed; of others, lights too, the back is black. A distribution is ggx, beckmann,\n"
    "FILE.vndf, or slope=EXPR, which is built here as by `vndf build --slope`. An image is FILE.pfm, or one of\n"
    "these, with :WIDTH,HEIGHT behind it or of 512,512 pixels: tiles, checks; grid, lines; studio, soft boxes in\n"
    "a grey room, an environment. An environment has the zenith in its top row, -z in its middle column, +x at\n"
    "its right; an image stands upright on rectangles, along edge-u and edge-v, and goes around spheres from +z\n"
    "by way of +x, its top at +y. From the front of a rectangle edge-v is left of edge-u.\n"
    "\n"
    "camera --from 0,1,5 --to 0,0.5,0 --field 35\n"
    "environment --constant 1,1,1\n"
    "material red-gold --conductor gold --distribution ggx --alpha 0.2\n"
    "sphere --centre 0,0.5,0 --radius 0.5 --material red-gold\n";

/* What a line says, until it is part of the scene. */
typedef struct content {
    material material;
    shape shape;
    double size, turn;
    vec3 move;
} content;

/* What an option takes: so many numbers, the second of two may be left out; an image, so many of whose channels are
 * in the range; of count 0 something else. */
typedef enum option_kind { DOUBLES, FLOATS, WHOLE, IMAGE } option_kind;

static const struct scene_option {
    int of, is_needed;
    const char *form, *help; /* form: as the help of a command has it */
    option_kind kind;
    size_t count;
    double low, high;
    size_t at; /* of camera and environment in the scene, of others in the content of the line */
} options[] = {
#define SCENE(member) offsetof(scene, member)
#define LINE(member) offsetof(content, member)
    {CAMERA, 1, "  --from X,Y,Z", "the eye", DOUBLES, 3, -FAR_AWAY, FAR_AWAY, SCENE(from)},
    {CAMERA, 1, "  --to X,Y,Z", "what it looks at", DOUBLES, 3, -FAR_AWAY, FAR_AWAY, SCENE(to)},
    {CAMERA, 0, "  --up X,Y,Z", "(0,1,0)", DOUBLES, 3, -FAR_AWAY, FAR_AWAY, SCENE(up)},
    {CAMERA, 0, "  --field DEGREES", "of view, across the height (40)", DOUBLES, 1, 1, 170, SCENE(field)},
    {CAMERA, 0, "  --width PIXELS", "across (640)", WHOLE, 1, 1, IMAGE_SIDE_MAX, SCENE(width)},
    {CAMERA, 0, "  --height PIXELS", "down (360)", WHOLE, 1, 1, IMAGE_SIDE_MAX, SCENE(height)},
    {CAMERA, 0, "  --depth N", "surfaces on a path at most (12)", WHOLE, 1, 1, 10000, SCENE(depth)},
    {CAMERA, 0, "  --samples N", "a pixel (64)", WHOLE, 1, 1, 1e9, SCENE(samples)},
    {CAMERA, 0, "  --exposure F", "brightness of a PNG (1)", DOUBLES, 1, 1e-6, 1e6, SCENE(exposure)},
    {ENVIRONMENT, 0, "  --constant R,G,B", "the same everywhere", FLOATS, 3, 0, BRIGHTEST,
     SCENE(environment.constant)},
    {ENVIRONMENT, 0, "  --image IMAGE", "longitude over latitude", IMAGE, 3, 0, BRIGHTEST, SCENE(environment.map)},
    {ENVIRONMENT, 0, "    --scale F", "times F (1)", DOUBLES, 1, 0, 1e6, SCENE(environment.scale)},
    {ENVIRONMENT, 0, "    --turn DEGREES", "about y (0)", DOUBLES, 1, -360, 360, SCENE(environment.turn)},
    {MATERIAL, 0, "  --conductor gold|silver|copper|aluminium", "a metal", DOUBLES, 0, 0, 0, 0},
    {MATERIAL, 0, "  --eta R,G,B", "another conductor", FLOATS, 3, 0, 1000, LINE(material.is.conductor_eta)},
    {MATERIAL, 0, "    --k R,G,B", "the imaginary part (0,0,0)", FLOATS, 3, 0, 1000,
     LINE(material.is.conductor_k)},
    {MATERIAL, 0, "  --dielectric N", "index inside over outside", FLOATS, 1, 0.01, 100, LINE(material.is.eta)},
    {MATERIAL, 0, "  --shape", "the microsurface alone: all is reflected", DOUBLES, 0, 0, 0, 0},
    {MATERIAL, 0, "  --matte R,G,B", "Lambert's", FLOATS, 3, 0, 1, LINE(material.colour)},
    {MATERIAL, 0, "  --light R,G,B", "of a sphere or rectangle", FLOATS, 3, 0, BRIGHTEST, LINE(material.colour)},
    {MATERIAL, 0, "  --distribution D", "of the first four", DOUBLES, 0, 0, 0, 0},
    {MATERIAL, 0, "    --alpha A[,AY]", "stretches its slopes (1)", DOUBLES, 0, 0, 0, 0},
    {MATERIAL, 0, "    --alpha-map IMAGE", "alpha times its red", IMAGE, 1, 1e-6, 1e3, LINE(material.alpha_map)},
    {MATERIAL, 0, "    --scattering single|multiple", "(single)", DOUBLES, 0, 0, 0, 0},
    {MATERIAL, 0, "    --colour R,G,B", "multiplies (1,1,1)", FLOATS, 3, 0, 1, LINE(material.colour)},
    {MATERIAL, 0, "  --colour-map IMAGE", "multiplies", IMAGE, 3, 0, 1, LINE(material.colour_map)},
    {SPHERE, 1, "  --centre X,Y,Z", "its middle", DOUBLES, 3, -FAR_AWAY, FAR_AWAY, LINE(shape.corner)},
    {SPHERE, 1, "  --radius R", "its size", DOUBLES, 1, LEAST_SIZE, FAR_AWAY, LINE(shape.radius)},
    {SPHERE, 1, "  --material NAME", "defined before", DOUBLES, 0, 0, 0, 0},
    {RECTANGLE, 1, "  --corner X,Y,Z", "of it", DOUBLES, 3, -FAR_AWAY, FAR_AWAY, LINE(shape.corner)},
    {RECTANGLE, 1, "  --edge-u X,Y,Z", "from there", DOUBLES, 3, -FAR_AWAY, FAR_AWAY, LINE(shape.edge_u)},
    {RECTANGLE, 1, "  --edge-v X,Y,Z", "from there", DOUBLES, 3, -FAR_AWAY, FAR_AWAY, LINE(shape.edge_v)},
    {RECTANGLE, 1, "  --material NAME", "defined before", DOUBLES, 0, 0, 0, 0},
    {MESH, 1, "  --file FILE.obj", "triangles", DOUBLES, 0, 0, 0, 0},
    {MESH, 1, "  --material NAME", "defined before", DOUBLES, 0, 0, 0, 0},
    {MESH, 0, "  --scale F", "its size, (1)", DOUBLES, 1, LEAST_SIZE, 1e6, LINE(size)},
    {MESH, 0, "  --turn DEGREES", "then about y (0)", DOUBLES, 1, -360, 360, LINE(turn)},
    {MESH, 0, "  --move X,Y,Z", "then (0,0,0)", DOUBLES, 3, -FAR_AWAY, FAR_AWAY, LINE(move)},
};
enum { OPTIONS = sizeof options / sizeof *options };

/* The options of a statement, as the help of a command has them. Until the next call. */
static const char *describe(int of)
{
    static char text[4096];
    size_t at = 0;
    for (const struct scene_option *o = options; o < options + OPTIONS; o++) {
        const int has_range = o->count > 0 && o->low > -FAR_AWAY;
        if (o->of == of)
            at +=
                (size_t)snprintf(text + at, sizeof text - at, has_range ? "%-40s  %s, %g to %g\n" : "%-40s  %s\n",
                                 o->form, o->help, o->low, o->high);
    }
    return text;
}

void scene_print_manual(void)
{
    fputs(preface, stdout);
    for (int i = 0; i < STATEMENTS; i++)
        printf("\n%s%s\n%s", statements[i], i == MATERIAL ? " NAME" : "", describe(i));
}

typedef struct reader {
    lines in;
    scene *made;
    arguments given; /* what the line says */
    content line;
    unsigned seen;             /* a bit for each statement */
    size_t pixels;             /* of all images so far */
    char path[2 * PATH_BYTES]; /* longer than a system allows: it is no other when it is cut */
    /* names of materials, what tables and images are made from, NULL at the end */
    const char *materials[SCENE_MATERIALS_MAX + 1], *tables[SCENE_FILES_MAX + 1], *images[SCENE_FILES_MAX + 1];
} reader;

static size_t find(const char *const *list, const char *word)
{
    size_t i = 0;
    while (list[i] && strcmp(list[i], word) != 0)
        i++;
    return i;
}

/* The path of a file of the scene, relative to the working folder. Until the next call. */
static const char *path_of(reader *r, const char *file)
{
    const char *slash = strrchr(r->in.name, '/');
    const int folder = file[0] == '/' || !slash ? 0 : (int)(slash - r->in.name) + 1;
    snprintf(r->path, sizeof r->path, "%.*s%s", folder, r->in.name, file);
    return r->path;
}

/* ---- images ---- */

/* "studio", "grid:4096,2048", or a file whose numbers are floats: whole ones are no linear light. */
static int make_image(reader *r, const char *option, const char *text, image *made)
{
    static const char *const patterns[] = {"tiles", "grid", "studio", NULL};
    const char *sides = strchr(text, ':');
    vndf_error error = {VNDF_OK, ""};
    double side[2] = {512, 512};
    char name[8] = "";
    size_t size, of = sscanf(text, "%7[^:]", name) == 1 ? find(patterns, name) : 3;
    if (patterns[of])
        return (!sides || parse_numbers(r->in.place, option, sides + 1, 1, IMAGE_SIDE_MAX, 2, 2, side)) &&
               (image_make_pattern(made, (image_pattern)of, (int)side[0], (int)side[1]) ||
                wrong(&r->in, "there is no memory for %.0f x %.0f pixels", side[0], side[1]));
    char *bytes = input_read(r->in.place, path_of(r, text), IMAGE_BYTES_MAX, &size);
    const int good =
        bytes && (image_read_bytes(made, r->path, bytes, size, &error) || wrong(&r->in, "%s", error.message));
    free(bytes);
    return good && (made->quantum == 0 || wrong(&r->in, "%s holds whole numbers; a PFM is needed", r->path));
}

/* The same text is one image. */
static int find_image(reader *r, const struct scene_option *o, const char *name, const char *text,
                      const image **found)
{
    const size_t i = find(r->images, text);
    image *map = &r->made->images[i];
    if (i == SCENE_FILES_MAX)
        return wrong(&r->in, "these are more than %d images", SCENE_FILES_MAX);
    if (!map->rgb && !make_image(r, name, text, map))
        return 0;
    r->pixels += r->images[i] ? 0 : (size_t)map->width * (size_t)map->height;
    r->images[i] = text;
    *found = map;
    for (int k = 0; k < map->width * map->height * 3; k++) {
        const double value = (double)map->rgb[k];
        if ((size_t)k % 3 < o->count && !(value >= o->low && value <= o->high))
            return wrong(&r->in, "as %s the image must be from %g to %g; it is %g in column %d of row %d", name,
                         o->low, o->high, value, k / 3 % map->width, k / 3 / map->width);
    }
    return r->pixels <= PIXELS_MAX || wrong(&r->in, "all images together have more than %d pixels", PIXELS_MAX);
}

/* ---- options ---- */

/* Puts what was given for an option to its place. */
static int put_option(reader *r, const struct scene_option *o, const char *name, const char *text, void *at)
{
    double x[3];
    if (o->kind == IMAGE)
        return find_image(r, o, name, text, at);
    if (!parse_numbers(r->in.place, name, text, o->low, o->high, o->count, o->count, x))
        return 0;
    for (size_t i = 0; i < o->count; i++)
        if (o->kind == WHOLE)
            *(int *)at = (int)x[i];
        else if (o->kind == DOUBLES)
            ((double *)at)[i] = x[i];
        else
            ((float *)at)[i] = (float)x[i];
    return o->kind != WHOLE || *x == floor(*x) || wrong(&r->in, "%s '%s' is not a whole number", name, text);
}

static int put_options(reader *r, int of)
{
    char *base = of <= ENVIRONMENT ? (char *)r->made : (char *)&r->line;
    for (const struct scene_option *o = options; o < options + OPTIONS; o++) {
        char name[24];
        const char *text = o->of == of && sscanf(o->form, "%23s", name) ? option_value(&r->given, name) : NULL;
        if (o->of == of && o->is_needed && !text)
            return wrong(&r->in, "%s is missing", o->form + 2);
        if (text && o->count && !put_option(r, o, name, text, base + o->at))
            return 0;
    }
    return 1;
}

static int read_camera(reader *r)
{
    scene *s = r->made;
    const vec3 forward = subtract(s->to, s->from);
    if (!(length(forward) >= LEAST_SIZE))
        return wrong(&r->in, "--from and --to are the same place");
    return length(cross(forward, s->up)) >= 1e-6 * length(forward) * length(s->up) ||
           wrong(&r->in, "--up is the direction of the view");
}

/* ---- materials ---- */

/* A file, or a formula over slopes. */
static vndf_distribution *make_table(reader *r, const char *text)
{
    chosen_distribution chosen;
    vndf_error error = {VNDF_OK, ""};
    if (strncmp(text, "slope=", 6) != 0)
        return distribution_open(&chosen, r->in.place, path_of(r, text), 0) ? chosen.owned : NULL;
    vndf_source *source = vndf_source_slope_expression(text + 6, NULL, 0, &error);
    vndf_distribution *built = source ? vndf_build(source, NULL, NULL, &error) : NULL;
    vndf_source_free(source);
    return built ? built : (complain(r->in.place, "%s", error.message), NULL);
}

/* The same text is one table. NULL after a complaint. */
static const vndf_distribution *find_distribution(reader *r, const char *text)
{
    const size_t i = find(r->tables, text);
    if (strcmp(text, "ggx") == 0)
        return vndf_ggx();
    if (strcmp(text, "beckmann") == 0)
        return vndf_beckmann();
    if (i == SCENE_FILES_MAX)
        return complain(r->in.place, "these are more than %d tables", SCENE_FILES_MAX), NULL;
    if (!r->tables[i])
        r->made->tables[i] = make_table(r, text);
    r->tables[i] = text;
    return r->made->tables[i];
}

/* Indices of refraction of the metals of --conductor for red, green and blue: measured spectra weighed by the
 * sensitivities of the three colours. They agree to three digits with the lists of the renderers Tungsten and
 * Yocto/GL for Au, Ag, Cu and Al. (Indices at single wavelengths fail: at 550 nm copper is on the slope of its
 * reflectance, and looks tan.) */
static const float metals[][2][3] = {
    {{0.143f, 0.375f, 1.442f}, {3.983f, 2.386f, 1.603f}},
    {{0.155f, 0.117f, 0.138f}, {4.828f, 3.122f, 2.147f}},
    {{0.200f, 0.924f, 1.102f}, {3.912f, 2.452f, 2.142f}},
    {{1.657f, 0.880f, 0.521f}, {9.224f, 6.270f, 4.837f}},
};

enum { METAL, ETA, DIELECTRIC, SHAPE, MATTE, LIGHT };
static const char *const kinds[] = {"--conductor", "--eta", "--dielectric", "--shape", "--matte", "--light", NULL};

static int make_rough(reader *r, size_t kind, vndf_description *is)
{
    static const vndf_fresnel fresnel[] = {VNDF_FRESNEL_CONDUCTOR, VNDF_FRESNEL_CONDUCTOR, VNDF_FRESNEL_DIELECTRIC,
                                           VNDF_FRESNEL_NONE};
    const int metal = option_choice(&r->given, "--conductor", 0);
    vndf_material resolved;
    vndf_error error = {VNDF_OK, ""};
    if (!roughness_from(r->in.place, option_value(&r->given, "--alpha"), &is->surface) ||
        !(is->surface.distribution = find_distribution(r, option_value(&r->given, "--distribution"))))
        return 0;
    if (kind == METAL) {
        memcpy(is->conductor_eta, metals[metal][0], sizeof is->conductor_eta);
        memcpy(is->conductor_k, metals[metal][1], sizeof is->conductor_k);
    }
    is->effects.fresnel = fresnel[kind];
    is->effects.lobes = kind == DIELECTRIC ? VNDF_LOBES_BOTH : VNDF_LOBES_REFLECTION;
    is->effects.scattering =
        option_choice(&r->given, "--scattering", 0) ? VNDF_SCATTERING_MULTIPLE : VNDF_SCATTERING_SINGLE;
    return vndf_material_resolve(is, &resolved, &error) == VNDF_OK || wrong(&r->in, "%s", error.message);
}

static int read_material(reader *r)
{
    const char *name = r->given.positional.count == 1 ? r->given.positional.item[0] : NULL;
    material *made = &r->line.material;
    if (!name)
        return wrong(&r->in, "'material' needs one name");
    if (r->materials[find(r->materials, name)])
        return wrong(&r->in, "there is another material '%s' already", name);
    if (r->made->material_count == SCENE_MATERIALS_MAX)
        return wrong(&r->in, "these are more than %d materials", SCENE_MATERIALS_MAX);
    const char *is = option_alone(&r->given, kinds);
    const size_t kind = is ? find(kinds, is) : 0;
    if (!is)
        return 0;
    if (!option_value(&r->given, "--distribution") != (kind > SHAPE))
        return wrong(&r->in, "%s %s --distribution D", kinds[kind], kind > SHAPE ? "has no" : "needs");
    if (kind == LIGHT && made->colour_map)
        return wrong(&r->in, "--light has no --colour-map");
    made->name = name;
    made->kind = kind <= SHAPE ? MATERIAL_ROUGH : kind == MATTE ? MATERIAL_MATTE : MATERIAL_LIGHT;
    if (kind <= SHAPE && !make_rough(r, kind, &made->is))
        return 0;
    r->materials[r->made->material_count] = name;
    r->made->materials[r->made->material_count++] = *made;
    return 1;
}

/* ---- shapes ---- */

static int add_mesh(reader *r, int of)
{
    geometry *g = &r->made->geometry;
    const size_t first = g->count;
    const material *m = &r->made->materials[of];
    size_t size;
    if (m->kind == MATERIAL_LIGHT || m->colour_map || m->alpha_map)
        return wrong(&r->in, "'%s' is a light or has an image, and those are for spheres and rectangles", m->name);
    char *text = input_read(r->in.place, path_of(r, option_value(&r->given, "--file")), OBJ_BYTES_MAX, &size);
    const int good = text && obj_read_text(g, r->path, text, size, of);
    free(text);
    geometry_place(g, first, r->line.size, r->line.turn * (PI / 180), r->line.move);
    return good;
}

static int read_shape(reader *r, int statement)
{
    shape *made = &r->line.shape;
    const vec3 u = made->edge_u, v = made->edge_v;
    const double area = length(cross(u, v));
    const char *name = option_value(&r->given, "--material");
    const size_t of = find(r->materials, name);
    if (!r->materials[of])
        return wrong(&r->in, "--material '%s' is no material that is defined before this%s", name,
                     did_you_mean(name, r->materials, of));
    made->material = (int)of;
    made->kind = statement == SPHERE ? SHAPE_SPHERE : SHAPE_RECTANGLE;
    if (statement == MESH)
        return add_mesh(r, (int)of);
    if (statement == RECTANGLE && !(area >= LEAST_SIZE * LEAST_SIZE && area >= 1e-6 * length(u) * length(v)))
        return wrong(&r->in, "--edge-u and --edge-v have no area");
    return geometry_add(&r->made->geometry, made) || wrong(&r->in, "there is no memory for this shape");
}

/* ---- all of it ---- */

static int read_statement(reader *r)
{
    static const char *const lights[] = {"--constant", "--image", NULL};
    const char *word = r->in.word[0];
    const int of = (int)find(statements, word);
    if (of == STATEMENTS)
        return wrong(&r->in, "'%s' is no statement, as are %s%s", word, list_words(statements, ""),
                     did_you_mean(word, statements, STATEMENTS));
    if (of <= ENVIRONMENT && r->seen >> of & 1u)
        return wrong(&r->in, "'%s' stands in this scene twice", word);
    r->seen |= 1u << of;
    r->line = (content){.material.colour = {1.0f, 1.0f, 1.0f}, .size = 1};
    if (!arguments_read(&r->given, r->in.place, describe(of), (int)r->in.count - 1, r->in.word + 1))
        return 0;
    if (r->given.positional.count && of != MATERIAL)
        return wrong(&r->in, "'%s' is not expected", r->given.positional.item[0]);
    return put_options(r, of) && (of == CAMERA        ? read_camera(r)
                                  : of == ENVIRONMENT ? option_alone(&r->given, lights) != NULL
                                  : of == MATERIAL    ? read_material(r)
                                                      : read_shape(r, of));
}

/* Without light a scene is black, which nobody means. */
static int finish(reader *r, int width)
{
    scene *s = r->made;
    const float *constant = s->environment.constant;
    const double height = width ? floor((double)width * s->height / s->width + 0.5) : s->height;
    s->width = width ? width : s->width;
    s->height = (int)fmin(height, IMAGE_SIDE_MAX + 1);
    if (!(r->seen >> CAMERA & 1u))
        return wrong(&r->in, "the scene ends without a camera, as in 'camera --from 0,1,5 --to 0,0,0'");
    if (s->height < 1 || s->height > IMAGE_SIDE_MAX || (int64_t)s->width * s->height > IMAGE_PIXELS_MAX)
        return wrong(&r->in, "%d x %.0f pixels: a film has 1 to %d rows and at most %d pixels", s->width, height,
                     IMAGE_SIDE_MAX, IMAGE_PIXELS_MAX);
    if (!geometry_build(&s->geometry))
        return wrong(&r->in, "there is no memory for a hierarchy of its shapes");
    if (!lights_make(s))
        return wrong(&r->in, "these are more than %d lights, or there is no memory", SCENE_LIGHTS_MAX);
    return s->light_count > 0 || s->environment.map || constant[0] + constant[1] + constant[2] > 0.0f ||
           wrong(&r->in, "the scene ends without light: an environment, or a shape of a light");
}

scene *scene_read(const char *path, char *text, size_t length, int width)
{
    scene *s = calloc(1, sizeof *s);
    reader r = {.made = s};
    int more, good = lines_begin(&r.in, path, text, length);
    if (!s)
        return free(text), complain(r.in.place, "there is no memory"), NULL;
    *s = (scene){
        .up = {0, 1, 0}, .field = 40, .exposure = 1, .width = 640, .height = 360, .depth = 12, .samples = 64};
    s->environment.scale = 1;
    s->text = text;
    while (good && (more = lines_next(&r.in)))
        good = more > 0 && read_statement(&r);
    if (good && finish(&r, width))
        return s;
    return scene_free(s), NULL;
}

void scene_free(scene *s)
{
    if (!s)
        return;
    for (size_t i = 0; i < SCENE_FILES_MAX; i++) {
        image_free(&s->images[i]);
        vndf_free(s->tables[i]);
    }
    free(s->environment.sums);
    free(s->text);
    geometry_free(&s->geometry);
    free(s);
}
