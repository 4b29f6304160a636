/* Reads a scene: a line is written as a command with options, and is read as those of the program are. Everything
 * that reads returns 1, or 0 after a complaint that names the line. */
#include "render/scene.h"

#include <stdlib.h>
#include <string.h>

#include "cli/files.h"
#include "cli/subject.h"
#include "render/lines.h"

/* Against hostile files. */
enum { BYTES_MAX = 1 << 22, PATH_BYTES = 4096, PIXELS_MAX = 2 * IMAGE_PIXELS_MAX /* of all images together */ };

static const double far_away = 1e6, least_size = 1e-6, brightest = 1e6;

enum { CAMERA, ENVIRONMENT, MATERIAL, SPHERE, RECTANGLE, MESH, STATEMENTS };
static const char *const statements[] = {"camera", "environment", "material", "sphere", "rectangle", "mesh", NULL};

static const char preface[] =
    "A scene is text. A line is written as a command with options, whose values have no blanks or are\n"
    "\"between quotes\"; # begins a comment. Materials are defined before they are used. Colours are\n"
    "linear, +y is the zenith, paths are relative to the file. Places and sizes are up to 1e6.\n"
    "A camera and some light are needed. Shapes of dielectrics are to be closed; of others, lights too, the\n"
    "back is black. An image is FILE.pfm, or one of these, with :WIDTH,HEIGHT behind it or of 512,512 pixels:\n"
    "tiles, checks; grid, lines; studio, soft boxes in a grey room, an environment. It stands upright on\n"
    "rectangles, along edge-u and edge-v; goes around spheres from +z by way of +x, its top at +y; lies on\n"
    "meshes as vt say.\n"
    "\n"
    "camera --from 0,1,5 --to 0,0.5,0 --field 35\n"
    "environment --constant 1,1,1\n"
    "material red-gold --conductor gold --distribution ggx --alpha 0.2\n"
    "sphere --centre 0,0.5,0 --radius 0.5 --material red-gold\n";

static const char *const manual[STATEMENTS] = {
    "camera                             once at most, as environment\n"
    "  --from X,Y,Z, --to X,Y,Z, --up X,Y,Z  (up: 0,1,0)\n"
    "  --field DEGREES                  of view, across the height, 1 to 170 (40)\n"
    "  --width PIXELS, --height PIXELS  of the film, 1 to 16384 (640, 360)\n"
    "  --depth N                        surfaces on a path at most, 1 to 10000 (12)\n"
    "  --samples N                      a pixel (64)\n"
    "  --exposure F                     brightness of a PNG (1)\n",
    "environment                        light from far away, 0 to 1e6\n"
    "  --constant R,G,B\n"
    "  --image IMAGE                    longitude over latitude as seen from inside: its top row the\n"
    "                                   zenith, its middle column -z, +x at its right\n"
    "    --scale F, --turn DEGREES      times F, turned about y (1, 0)\n",
    "material NAME\n"
    "  --conductor gold|silver|copper|aluminium\n"
    "  --eta R,G,B                      another conductor, 0 to 1000\n"
    "    --k R,G,B                      the imaginary part (0,0,0)\n"
    "  --dielectric N                   index of refraction inside over outside, 0.01 to 100\n"
    "  --shape                          the microsurface alone: all is reflected\n"
    "  --matte R,G,B                    0 to 1\n"
    "  --light R,G,B                    radiance from the front of a sphere or a rectangle, 0 to 1e6\n"
    "  --distribution D                 of the first four: ggx, beckmann, FILE.vndf, or built here as by\n"
    "                                   `vndf build`: family=NAME:PARAMETERS, slope=EXPR, ndf=EXPR\n"
    "    --alpha A[,AY]                 stretches its slopes, 1e-6 to 1e3; ggx and beckmann need it (1)\n"
    "    --alpha-map IMAGE              alpha times the image's red, which is above 0\n"
    "    --scattering single|multiple   multiple: light goes on between microfacets (single)\n"
    "    --colour R,G,B                 multiplies, 0 to 1 (1,1,1)\n"
    "  --colour-map IMAGE               multiplies, 0 to 1; not of lights\n",
    "sphere\n"
    "  --centre X,Y,Z, --radius R, --material NAME\n",
    "rectangle\n"
    "  --corner X,Y,Z, --edge-u X,Y,Z, --edge-v X,Y,Z, --material NAME\n"
    "                                   edges at right angles; from the front, edge-v is left of edge-u\n",
    "mesh\n"
    "  --file FILE.obj, --material NAME\n"
    "  --scale F, --turn DEGREES, --move X,Y,Z  scaled, then turned about y, then moved (1, 0, 0,0,0)\n"};

void scene_print_manual(void)
{
    fputs(preface, stdout);
    for (size_t i = 0; i < STATEMENTS; i++)
        printf("\n%s", manual[i]);
}

typedef struct reader {
    const char *name; /* of the file */
    scene *made;
    char command[PATH_BYTES]; /* "vndf render: NAME:LINE", which opens every complaint */
    arguments given;          /* what the line says */
    unsigned seen;            /* a bit for each statement */
    size_t pixels;            /* of all images so far */
    /* names of materials, what tables and images are made from, NULL at the end */
    const char *materials[SCENE_MATERIALS_MAX + 1], *tables[SCENE_TABLES_MAX + 1], *images[SCENE_IMAGES_MAX + 1];
} reader;

#define wrong(r, ...) (complain((r)->command, __VA_ARGS__), 0)

/* ---- what options hold ---- */

/* Three numbers; what is not given stays. */
static int read_three(reader *r, const char *option, double low, double high, double *three)
{
    const char *text = option_value(&r->given, option);
    return !text || parse_numbers(r->command, option, text, low, high, 3, 3, three);
}

static int read_colour(reader *r, const char *option, double high, float rgb[3])
{
    double three[3] = {(double)rgb[0], (double)rgb[1], (double)rgb[2]};
    const int good = read_three(r, option, 0, high, three);
    for (int i = 0; i < 3; i++)
        rgb[i] = (float)three[i];
    return good;
}

/* A place or an edge, which has to be there. */
static int read_place(reader *r, const char *option, vec3 *place)
{
    return option_value(&r->given, option) ? read_three(r, option, -far_away, far_away, &place->x)
                                           : wrong(r, "%s X,Y,Z is missing", option);
}

static int read_whole(reader *r, const char *option, double high, int *number)
{
    unsigned long long whole = (unsigned long long)*number;
    const int good = option_count(&r->given, option, 1, high, &whole);
    *number = (int)whole;
    return good;
}

static size_t find(const char *const *list, const char *word)
{
    size_t i = 0;
    while (list[i] && strcmp(list[i], word) != 0)
        i++;
    return i;
}

/* The path relative to the working folder. */
static int path_of(reader *r, const char *file, char path[PATH_BYTES])
{
    const char *slash = strrchr(r->name, '/');
    const int folder = file[0] == '/' || !slash ? 0 : (int)(slash - r->name) + 1;
    return snprintf(path, PATH_BYTES, "%.*s%s", folder, r->name, file) < PATH_BYTES ||
           wrong(r, "a path has at most %d letters, with the folder of the scene", PATH_BYTES - 1);
}

/* All of a file of the scene, and its path, to be freed; NULL after a complaint. */
static char *read_file(reader *r, const char *file, size_t most, char path[PATH_BYTES], size_t *size)
{
    return path_of(r, file, path) ? input_read(r->command, path, most, size) : NULL;
}

/* ---- images -------------------------------------------------------------------------------------- */

/* From a file, whose numbers have to be floats: whole ones are no linear light. */
static int read_pfm(reader *r, const char *file, image *made)
{
    vndf_error error = {VNDF_OK, ""};
    char path[PATH_BYTES];
    size_t size;
    char *bytes = read_file(r, file, IMAGE_BYTES_MAX, path, &size);
    const int good = bytes && image_read_bytes(made, path, bytes, size, &error);
    free(bytes);
    if (error.message[0])
        return wrong(r, "%s", error.message);
    return good && (made->quantum == 0 || wrong(r, "%s holds whole numbers; a PFM is needed", path));
}

/* "studio", "grid:4096,2048" or a file. */
static int make_image(reader *r, const char *option, const char *text, image *made)
{
    static const char *const patterns[] = {"tiles", "grid", "studio", NULL};
    char name[16];
    double side[2] = {512, 512};
    const size_t length = strcspn(text, ":");
    snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : 0), text);
    const size_t of = find(patterns, name);
    if (!patterns[of])
        return read_pfm(r, text, made);
    if (text[length] && parse_numbers(r->command, option, text + length + 1, 1, IMAGE_SIDE_MAX, 2, 2, side) != 2)
        return 0;
    return image_make_pattern(made, (image_pattern)of, (int)side[0], (int)side[1]) ||
           wrong(r, "there is no memory for %.0f x %.0f pixels", side[0], side[1]);
}

/* The image that an option names, if it is there: its first channels have to be within a range. The same text is one
 * image. */
static int find_image(reader *r, const char *option, int channels, double low, double high, const image **found)
{
    const char *text = option_value(&r->given, option);
    const size_t i = text ? find(r->images, text) : 0;
    image *map = &r->made->images[i];
    if (!text)
        return 1;
    if (i == SCENE_IMAGES_MAX)
        return wrong(r, "these are more than %d images", SCENE_IMAGES_MAX);
    if (!map->rgb && !make_image(r, option, text, map))
        return 0;
    r->pixels += r->images[i] ? 0 : (size_t)map->width * (size_t)map->height;
    r->images[i] = text;
    *found = map;
    for (int k = 0; k < map->width * map->height * 3; k++) {
        const double value = (double)map->rgb[k];
        if (k % 3 < channels && !(value >= low && value <= high))
            return wrong(r, "as %s the image must be from %g to %g; it is %g in column %d of row %d", option, low,
                         high, value, k / 3 % map->width, k / 3 / map->width);
    }
    return r->pixels <= PIXELS_MAX || wrong(r, "all images together have more than %d pixels", PIXELS_MAX);
}

/* ---- once in a scene ---- */

static int read_camera(reader *r)
{
    scene *s = r->made;
    if (!read_place(r, "--from", &s->from) || !read_place(r, "--to", &s->to) ||
        !read_three(r, "--up", -far_away, far_away, &s->up.x) ||
        !option_number(&r->given, "--field", 1, 170, &s->field) ||
        !read_whole(r, "--width", IMAGE_SIDE_MAX, &s->width) ||
        !read_whole(r, "--height", IMAGE_SIDE_MAX, &s->height) || !read_whole(r, "--depth", 10000, &s->depth) ||
        !read_whole(r, "--samples", 1e9, &s->samples) ||
        !option_number(&r->given, "--exposure", 1e-6, 1e6, &s->exposure))
        return 0;
    const vec3 forward = subtract(s->to, s->from);
    s->field *= PI / 180;
    if ((int64_t)s->width * s->height > IMAGE_PIXELS_MAX)
        return wrong(r, "%d x %d pixels are more than %d", s->width, s->height, IMAGE_PIXELS_MAX);
    if (!(length(forward) >= least_size))
        return wrong(r, "--from and --to are the same place");
    return length(cross(forward, s->up)) >= 1e-6 * length(forward) * length(s->up) ||
           wrong(r, "--up is the direction of the view");
}

static int read_environment(reader *r)
{
    static const char *const ways[] = {"--constant", "--image", NULL};
    environment *e = &r->made->environment;
    const int good = option_alone(&r->given, ways) && read_colour(r, "--constant", brightest, e->constant) &&
                     option_number(&r->given, "--scale", 0, 1e6, &e->scale) &&
                     option_number(&r->given, "--turn", -360, 360, &e->turn) &&
                     find_image(r, "--image", 3, 0, brightest, &e->map);
    e->turn /= 360;
    return good;
}

/* ---- distributions ---- */

/* From the text of --distribution, which is no closed form. */
static vndf_distribution *make_table(reader *r, const char *text)
{
    static const char *const forms[] = {"family=", "slope=", "ndf="};
    chosen_distribution chosen;
    vndf_error error = {VNDF_OK, ""};
    char path[PATH_BYTES];
    size_t form = 0;
    while (form < 3 && strncmp(text, forms[form], strlen(forms[form])) != 0)
        form++;
    if (form == 3)
        return path_of(r, text, path) && distribution_open(&chosen, r->command, path, 0) ? chosen.owned : NULL;
    text += strlen(forms[form]);
    vndf_source *source = form == 0   ? vndf_source_family(text, &error)
                          : form == 1 ? vndf_source_slope_expression(text, NULL, 0, &error)
                                      : vndf_source_ndf_expression(text, NULL, 0, &error);
    vndf_distribution *built = source ? vndf_build(source, NULL, NULL, &error) : NULL;
    vndf_source_free(source);
    return built ? built : (complain(r->command, "%s", error.message), NULL);
}

/* Materials with the same text share a table. */
static int read_distribution(reader *r, vndf_description *is)
{
    const char *text = option_value(&r->given, "--distribution"), *alpha = option_value(&r->given, "--alpha");
    const int is_ggx = strcmp(text, "ggx") == 0, is_closed = is_ggx || strcmp(text, "beckmann") == 0;
    double both[2] = {1, 1};
    const size_t count = alpha ? parse_numbers(r->command, "--alpha", alpha, 1e-6, 1e3, 1, 2, both) : 1;
    is->surface = vndf_rough(is_ggx ? vndf_ggx() : vndf_beckmann(), (float)both[0], (float)both[count == 2]);
    if (!count)
        return 0;
    if (is_closed)
        return alpha || wrong(r, "%s needs --alpha A or --alpha AX,AY", text);
    const size_t i = find(r->tables, text);
    if (i == SCENE_TABLES_MAX)
        return wrong(r, "these are more than %d tables", SCENE_TABLES_MAX);
    if (!r->tables[i]) {
        if (!(r->made->tables[i] = make_table(r, text)))
            return 0;
        r->tables[i] = text;
    }
    is->surface.distribution = r->made->tables[i];
    return 1;
}

/* ---- materials ---- */

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

static int read_rough(reader *r, size_t kind, material *m)
{
    vndf_description *is = &m->is;
    vndf_material resolved;
    vndf_error error = {VNDF_OK, ""};
    const int metal = option_choice(&r->given, "--conductor", 0);
    double index = 0;
    memcpy(is->conductor_eta, metals[metal][0], sizeof metals[metal][0]);
    if (kind == METAL)
        memcpy(is->conductor_k, metals[metal][1], sizeof metals[metal][1]);
    if (!read_colour(r, "--eta", 1000, is->conductor_eta) || !read_colour(r, "--k", 1000, is->conductor_k) ||
        !option_number(&r->given, "--dielectric", 0.01, 100, &index) || !read_distribution(r, is))
        return 0;
    is->eta = (float)index;
    is->effects.fresnel = kind <= ETA          ? VNDF_FRESNEL_CONDUCTOR
                          : kind == DIELECTRIC ? VNDF_FRESNEL_DIELECTRIC
                                               : VNDF_FRESNEL_NONE;
    is->effects.lobes = kind == DIELECTRIC ? VNDF_LOBES_BOTH : VNDF_LOBES_REFLECTION;
    is->effects.scattering =
        option_choice(&r->given, "--scattering", 0) ? VNDF_SCATTERING_MULTIPLE : VNDF_SCATTERING_SINGLE;
    const double least = 1e-6 / fmin((double)is->surface.xx, (double)is->surface.yy);
    const double most = 1e3 / fmax((double)is->surface.xx, (double)is->surface.yy);
    return find_image(r, "--alpha-map", 1, least, most, &m->alpha_map) &&
           (vndf_material_resolve(is, &resolved, &error) == VNDF_OK || wrong(r, "%s", error.message));
}

static int read_material(reader *r)
{
    const char *name = r->given.positional.count == 1 ? r->given.positional.item[0] : NULL;
    if (!name)
        return wrong(r, "'material' needs one name");
    if (r->materials[find(r->materials, name)])
        return wrong(r, "there is another material '%s' already", name);
    if (r->made->material_count == SCENE_MATERIALS_MAX)
        return wrong(r, "these are more than %d materials", SCENE_MATERIALS_MAX);
    if (!option_alone(&r->given, kinds))
        return 0;
    const size_t kind = find(kinds, option_among(&r->given, kinds));
    r->materials[r->made->material_count] = name;
    material *made = &r->made->materials[r->made->material_count++];
    *made = (material){.name = name, .colour = {1.0f, 1.0f, 1.0f}};
    made->kind = kind <= SHAPE ? MATERIAL_ROUGH : kind == MATTE ? MATERIAL_MATTE : MATERIAL_LIGHT;
    if (!option_value(&r->given, "--distribution") != (kind > SHAPE))
        return wrong(r, "%s %s --distribution D", kinds[kind], kind > SHAPE ? "has no" : "needs");
    if (kind == LIGHT && option_value(&r->given, "--colour-map"))
        return wrong(r, "--light has no --colour-map");
    return read_colour(r, "--matte", 1, made->colour) && read_colour(r, "--light", brightest, made->colour) &&
           read_colour(r, "--colour", 1, made->colour) &&
           find_image(r, "--colour-map", 3, 0, 1, &made->colour_map) &&
           (kind > SHAPE || read_rough(r, kind, made));
}

/* ---- shapes ---- */

/* 0 after a complaint. */
static int read_its_material(reader *r, int *index)
{
    const char *name = option_value(&r->given, "--material");
    if (!name)
        return wrong(r, "--material NAME is missing");
    const size_t of = find(r->materials, name);
    *index = (int)of;
    return r->materials[of] || wrong(r, "--material '%s' is no material that is defined before this%s", name,
                                     did_you_mean(name, r->materials, of));
}

static int add_shape(reader *r, shape made)
{
    return read_its_material(r, &made.material) &&
           (geometry_add(&r->made->geometry, &made) || wrong(r, "there is no memory for this shape"));
}

static int read_sphere(reader *r)
{
    shape made = {.kind = SHAPE_SPHERE};
    if (!read_place(r, "--centre", &made.corner) ||
        !option_number(&r->given, "--radius", least_size, far_away, &made.radius))
        return 0;
    return made.radius > 0 ? add_shape(r, made) : wrong(r, "--radius R is missing");
}

/* The text has few digits, so that edges that are meant to be at right angles may be a little off: the second one
 * is corrected. */
static int read_rectangle(reader *r)
{
    shape made = {.kind = SHAPE_RECTANGLE};
    vec3 *u = &made.edge_u, *v = &made.edge_v;
    if (!read_place(r, "--corner", &made.corner) || !read_place(r, "--edge-u", u) || !read_place(r, "--edge-v", v))
        return 0;
    const double cosine = dot(*u, *v) / (length(*u) * length(*v));
    if (!(length(*u) >= least_size && length(*v) >= least_size))
        return wrong(r, "an edge has no length");
    if (!(fabs(cosine) < 2e-3))
        return wrong(r, "the edges of a rectangle must be at right angles; these are at %.4g degrees",
                     acos(fmin(fmax(cosine, -1), 1)) * (180 / PI));
    *v = along(*v, -dot(*u, *v) / dot(*u, *u), *u);
    return add_shape(r, made);
}

static int read_mesh(reader *r)
{
    geometry *g = &r->made->geometry;
    const size_t first = g->count;
    const char *file = option_value(&r->given, "--file");
    double by = 1, turn = 0;
    vec3 move = {0, 0, 0};
    vndf_error error = {VNDF_OK, ""};
    char path[PATH_BYTES];
    size_t size;
    int of;
    if (!read_its_material(r, &of) || !option_number(&r->given, "--scale", least_size, 1e6, &by) ||
        !option_number(&r->given, "--turn", -360, 360, &turn) ||
        !read_three(r, "--move", -far_away, far_away, &move.x))
        return 0;
    if (!file || r->made->materials[of].kind == MATERIAL_LIGHT)
        return wrong(r, file ? "a light is a sphere or a rectangle, not a mesh" : "--file FILE.obj is missing");
    char *text = read_file(r, file, OBJ_BYTES_MAX, path, &size);
    const int good = text && obj_read_text(g, path, text, size, of, &error);
    free(text);
    if (error.message[0])
        return wrong(r, "%s", error.message);
    geometry_place(g, first, by, turn * (PI / 180), move);
    return good;
}

/* ---- all of it ---- */

static int (*const readers[STATEMENTS])(reader *r) = {read_camera, read_environment, read_material,
                                                      read_sphere, read_rectangle,   read_mesh};

static int read_statement(reader *r, lines *in)
{
    const size_t of = find(statements, in->word[0]);
    snprintf(r->command, sizeof r->command, "vndf render: %.3000s:%llu", r->name, in->line);
    if (of == STATEMENTS)
        return wrong(r, "'%s' is no statement, as are %s%s", in->word[0], list_words(statements, ""),
                     did_you_mean(in->word[0], statements, STATEMENTS));
    if (of <= ENVIRONMENT && r->seen >> of & 1u)
        return wrong(r, "'%s' stands in this scene twice", in->word[0]);
    r->seen |= 1u << of;
    if (!arguments_read(&r->given, r->command, manual[of], (int)in->count - 1, in->word + 1))
        return 0;
    if (r->given.positional.count && of != MATERIAL)
        return wrong(r, "'%s' is not expected", r->given.positional.item[0]);
    return readers[of](r);
}

/* Without light a scene is black, which nobody means. */
static int finish(reader *r)
{
    scene *s = r->made;
    if (!(r->seen >> CAMERA & 1u))
        return wrong(r, "the scene ends without a camera, as in 'camera --from 0,1,5 --to 0,0,0'");
    if (!geometry_build(&s->geometry))
        return wrong(r, "there is no memory for a hierarchy of its shapes");
    if (!lights_make(s))
        return wrong(r, "these are more than %d lights, or there is no memory", SCENE_LIGHTS_MAX);
    const float *constant = s->environment.constant;
    return s->light_count > 0 || s->environment.map || constant[0] + constant[1] + constant[2] > 0.0f ||
           wrong(r, "the scene ends without light: an environment, or a shape of a light");
}

scene *scene_read_text(const char *name, char *text, size_t length)
{
    scene *s = calloc(1, sizeof *s);
    reader r = {.name = name, .made = s};
    vndf_error error = {VNDF_OK, ""};
    lines in;
    int more, good = lines_begin(&in, name, text, length, &error);
    snprintf(r.command, sizeof r.command, "vndf render: %.3000s", name);
    if (!s)
        return free(text), complain(r.command, "there is no memory"), NULL;
    *s = (scene){
        .up = {0, 1, 0}, .field = 40, .exposure = 1, .width = 640, .height = 360, .depth = 12, .samples = 64};
    s->environment.scale = 1;
    s->text = text;
    while (good && (more = lines_next(&in)))
        good = more > 0 && read_statement(&r, &in);
    if (error.message[0])
        complain("vndf render", "%s", error.message);
    else if (good && finish(&r))
        return s;
    scene_free(s);
    return NULL;
}

scene *scene_read(const char *path)
{
    size_t length;
    char *text = input_read("vndf render", path, BYTES_MAX, &length);
    return text ? scene_read_text(path, text, length) : NULL;
}

void scene_free(scene *s)
{
    if (!s)
        return;
    for (size_t i = 0; i < SCENE_IMAGES_MAX; i++)
        image_free(&s->images[i]);
    for (size_t i = 0; i < SCENE_TABLES_MAX; i++)
        vndf_free(s->tables[i]);
    free(s->environment.sums);
    free(s->text);
    geometry_free(&s->geometry);
    free(s);
}

int scene_resize(scene *s, int width)
{
    const double height = floor((double)width * s->height / s->width + 0.5);
    if (!(height >= 1 && height <= IMAGE_SIDE_MAX && height * width <= IMAGE_PIXELS_MAX))
        return complain("vndf render", "--width: %d x %.0f pixels: a film has 1 to %d rows and at most %d pixels",
                        width, height, IMAGE_SIDE_MAX, IMAGE_PIXELS_MAX),
               0;
    s->width = width;
    s->height = (int)height;
    return 1;
}
