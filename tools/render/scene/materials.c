/* material NAME KIND ...: which clauses go with which kind, and the material that they make. */
#include "render/scene/reader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- clauses ---- */

enum { CONDUCTOR, DIELECTRIC, REFLECTOR, SHAPE, MATTE, MIRROR, GLASS, LIGHT, KINDS };
static const char *const kinds[KINDS] = {"conductor", "dielectric", "reflector", "shape",
                                         "matte",     "mirror",     "glass",     "light"};
/* clang-format off */
enum {
    OF, ETA, K, F0, INDEX, LOBES, DISTRIBUTION, BYTES, ALPHA, ALPHA_MAP, ALPHA_X_MAP, ALPHA_Y_MAP, ROTATION,
    MASKING, NORMALS, SCATTERING, ORDER, ABSORB, COLOUR, COLOUR_MAP, RADIANCE, CLAUSES
};
/* clang-format on */

/* A bit for each kind. */
enum {
    ROUGH = 1 << CONDUCTOR | 1 << DIELECTRIC | 1 << REFLECTOR | 1 << SHAPE,
    THROUGH = 1 << DIELECTRIC | 1 << REFLECTOR | 1 << SHAPE,
    COLOURED = ROUGH | 1 << MATTE | 1 << MIRROR
};

typedef struct rule {
    const char *keyword, *takes;
    unsigned char least, most;
    unsigned kinds, needed; /* bits of the kinds that it goes with, and of the kinds that need it */
} rule;

static const rule rules[CLAUSES] = {
    [OF] = {"of", "METAL", 1, 1, 1 << CONDUCTOR, 0},
    [ETA] = {"eta", "R G B", 3, 3, 1 << CONDUCTOR, 0},
    [K] = {"k", "R G B", 3, 3, 1 << CONDUCTOR, 0},
    [F0] = {"f0", "R G B", 3, 3, 1 << REFLECTOR, 1 << REFLECTOR},
    [INDEX] = {"index", "N", 1, 1, THROUGH | 1 << GLASS, 1 << DIELECTRIC | 1 << GLASS},
    [LOBES] = {"lobes", "reflection|transmission|both", 1, 1, THROUGH, 0},
    [DISTRIBUTION] = {"distribution", "ggx|beckmann|table FILE|family NAME|slope FORMULA|ndf FORMULA", 1, 2, ROUGH,
                      ROUGH},
    [BYTES] = {"bytes", "COUNT", 1, 1, ROUGH, 0},
    [ALPHA] = {"alpha", "A or AX AY", 1, 2, ROUGH, 0},
    [ALPHA_MAP] = {"alpha-map", "IMAGE", 1, 1, ROUGH, 0},
    [ALPHA_X_MAP] = {"alpha-x-map", "IMAGE", 1, 1, ROUGH, 0},
    [ALPHA_Y_MAP] = {"alpha-y-map", "IMAGE", 1, 1, ROUGH, 0},
    [ROTATION] = {"rotation", "DEGREES", 1, 1, ROUGH, 0},
    [MASKING] = {"masking", "height-correlated|separable|v-cavities|none", 1, 1, ROUGH, 0},
    [NORMALS] = {"normals", "visible|bounded|all|v-cavity", 1, 1, ROUGH, 0},
    [SCATTERING] = {"scattering", "single|multiple", 1, 1, ROUGH, 0},
    [ORDER] = {"order", "COUNT", 1, 1, ROUGH, 0},
    [ABSORB] = {"absorb", "R G B", 3, 3, THROUGH | 1 << GLASS, 0},
    [COLOUR] = {"colour", "R G B", 3, 3, COLOURED, 1 << MATTE},
    [COLOUR_MAP] = {"colour-map", "IMAGE", 1, 1, COLOURED, 0},
    [RADIANCE] = {"radiance", "R G B", 3, 3, 1 << LIGHT, 1 << LIGHT},
};

static int refuse_clause(scene_reader *r, const clause *c, unsigned kind, unsigned fits)
{
    char list[128] = "";
    for (unsigned i = 0; i < KINDS; i++)
        if (fits >> i & 1u) {
            strcat(list, list[0] ? ", " : ""); /* all kinds together have 70 letters */
            strcat(list, kinds[i]);
        }
    return reader_refuse(r, c->at, "'%s' does not go with '%s'; it goes with: %s", c->keyword, kinds[kind], list);
}

static int find_clauses(scene_reader *r, const statement *s, unsigned kind, clause c[CLAUSES])
{
    for (size_t i = 0; i < CLAUSES; i++)
        c[i] = (clause){
            .keyword = rules[i].keyword, .takes = rules[i].takes, .least = rules[i].least, .most = rules[i].most};
    if (!reader_clauses(r, s, 3, c, CLAUSES))
        return 0;
    for (size_t i = 0; i < CLAUSES; i++) {
        if (c[i].at && !(rules[i].kinds >> kind & 1u))
            return refuse_clause(r, &c[i], kind, rules[i].kinds);
        if (!c[i].at && rules[i].needed >> kind & 1u)
            return reader_refuse(r, &s->words[2], "'%s' needs '%s %s'", kinds[kind], c[i].keyword, c[i].takes);
    }
    return 1;
}

/* ---- effects ---- */

/* A word from the list of the rule, which separates words by bars and has the order of the library's
 * enumeration. */
static int read_choice(scene_reader *r, const clause *c, unsigned *choice)
{
    char list[64];
    const char *names[4];
    size_t count = 0;
    if (!c->at)
        return 1;
    strcpy(list, c->takes); /* 43 letters at most */
    for (char *at = list; at; at = strchr(at, '|'), count++) {
        if (count)
            *at++ = '\0';
        names[count] = at;
    }
    return reader_choice(r, c, names, count, choice);
}

static int read_effects(scene_reader *r, const clause c[CLAUSES], unsigned kind, vndf_effects *e)
{
    static const vndf_fresnel fresnel[] = {VNDF_FRESNEL_CONDUCTOR, VNDF_FRESNEL_DIELECTRIC, VNDF_FRESNEL_SCHLICK,
                                           VNDF_FRESNEL_NONE};
    unsigned lobes = kind == DIELECTRIC ? VNDF_LOBES_BOTH : VNDF_LOBES_REFLECTION;
    unsigned masking = 0, normals = 0, scattering = 0;
    if (!read_choice(r, &c[LOBES], &lobes) || !read_choice(r, &c[MASKING], &masking) ||
        !read_choice(r, &c[NORMALS], &normals) || !read_choice(r, &c[SCATTERING], &scattering))
        return 0;
    if (lobes != VNDF_LOBES_REFLECTION && !c[INDEX].at)
        return reader_refuse(r, c[LOBES].at, "'lobes %s' needs 'index N'", c[LOBES].values->text);
    if (lobes == VNDF_LOBES_REFLECTION && c[ABSORB].at)
        return reader_refuse(r, c[ABSORB].at, "'absorb' is of what light passes, this material only reflects");
    if (scattering == VNDF_SCATTERING_SINGLE && c[ORDER].at)
        return reader_refuse(r, c[ORDER].at, "'order' goes with 'scattering multiple'");
    *e = (vndf_effects){.lobes = (vndf_lobes)lobes,
                        .fresnel = fresnel[kind],
                        .masking = (vndf_masking)masking,
                        .normals = (vndf_normals_drawn)normals,
                        .scattering = (vndf_scattering)scattering};
    return 1;
}

/* ---- roughness ---- */

/* The first channel of a map, times alpha, is the roughness: the product must be a valid alpha. */
static int read_map(scene_reader *r, const clause *both, const clause *one, textured *made)
{
    const clause *c = one->at ? one : both;
    const image_range rough = {"roughness", 1, 1e-6 / (double)made->value, 1e3 / (double)made->value};
    return !c->at || (reader_image(r, c, &made->map) && reader_within(r, c->values, made->map, &rough));
}

static int read_roughness(scene_reader *r, const clause c[CLAUSES], material *m)
{
    const clause *alpha = &c[ALPHA], *both = &c[ALPHA_MAP];
    float degrees;
    m->alpha_x.value = m->alpha_y.value = 1.0f;
    if (alpha->at && !reader_number(r, alpha, 0, 1e-6, 1e3, &m->alpha_x.value))
        return 0;
    m->alpha_y = m->alpha_x;
    if (alpha->count == 2 && !reader_number(r, alpha, 1, 1e-6, 1e3, &m->alpha_y.value))
        return 0;
    if (both->at && (c[ALPHA_X_MAP].at || c[ALPHA_Y_MAP].at))
        return reader_refuse(r, both->at,
                             "'alpha-map' is of x and y; leave it out beside 'alpha-x-map' or "
                             "'alpha-y-map'");
    if (!read_map(r, both, &c[ALPHA_X_MAP], &m->alpha_x) || !read_map(r, both, &c[ALPHA_Y_MAP], &m->alpha_y))
        return 0;
    m->is_textured = m->alpha_x.map || m->alpha_y.map;
    m->is.alpha_x = m->alpha_x.value;
    m->is.alpha_y = m->alpha_y.value;
    if (!c[ROTATION].at)
        return 1;
    if (!reader_number(r, &c[ROTATION], 0, -360, 360, &degrees))
        return 0;
    m->is.effects.shape = degrees != 0.0f ? VNDF_SHAPE_ROTATED : VNDF_SHAPE_ALIGNED;
    m->is.rotation = degrees * 0.0174532925f;
    return 1;
}

static int read_table(scene_reader *r, const clause c[CLAUSES], material *m)
{
    const char *form = c[DISTRIBUTION].values->text;
    int closed = strcmp(form, "ggx") == 0 || strcmp(form, "beckmann") == 0;
    unsigned bytes = 4096;
    if (closed && !c[ALPHA].at)
        return reader_refuse(r, c[DISTRIBUTION].at, "'distribution %s' needs 'alpha A' or 'alpha AX AY'", form);
    if (c[BYTES].at && (closed || strcmp(form, "table") == 0))
        return reader_refuse(r, c[BYTES].at, "'bytes' is of tables that are made here: family, slope or ndf");
    return (!c[BYTES].at || reader_whole(r, &c[BYTES], 0, 2048, 1 << 20, &bytes)) &&
           read_distribution(r, &c[DISTRIBUTION], bytes, &m->is.distribution);
}

/* ---- resolving ---- */

/* Resolves the material, so that a refusal of the library names the place in the file. Plans resolve it again,
 * with their sampler. */
static int resolve(scene_reader *r, const statement *s, const material *m)
{
    vndf_material made;
    vndf_error error = {VNDF_OK, ""};
    char message[512];
    if (vndf_material_resolve(&m->is, &made, &error) == VNDF_OK)
        return 1;
    scene_wording(error.message, message, sizeof message);
    return reader_refuse(r, &s->words[1], "%s", message);
}

static int read_rough(scene_reader *r, const statement *s, const clause c[CLAUSES], unsigned kind, material *m)
{
    if (!read_effects(r, c, kind, &m->is.effects) ||
        (kind == CONDUCTOR && !read_metal(r, &s->words[2], &c[OF], &c[ETA], &c[K], &m->is)) ||
        (c[F0].at && !reader_three(r, &c[F0], 0, 1, m->is.f0)) || !read_roughness(r, c, m) ||
        !read_table(r, c, m) || (c[ORDER].at && !reader_whole(r, &c[ORDER], 0, 1, 1e6, &m->is.order_limit)))
        return 0;
    return resolve(r, s, m);
}

/* ---- the statement ---- */

static int read_colour_map(scene_reader *r, const clause *c, material *m)
{
    const image_range colour = {"colour", 3, 0, 1};
    return !c->at || (reader_image(r, c, &m->colour_map) && reader_within(r, c->values, m->colour_map, &colour));
}

static int read_colours(scene_reader *r, const clause c[CLAUSES], material *m)
{
    for (int i = 0; i < 3; i++)
        m->colour[i] = 1.0f;
    return (!c[COLOUR].at || reader_three(r, &c[COLOUR], 0, 1, m->colour)) &&
           (!c[RADIANCE].at || reader_three(r, &c[RADIANCE], 0, 1e6, m->colour)) &&
           read_colour_map(r, &c[COLOUR_MAP], m) &&
           (!c[ABSORB].at || reader_three(r, &c[ABSORB], 0, 1e6, m->absorb)) &&
           (!c[INDEX].at || reader_number(r, &c[INDEX], 0, 0.01, 100, &m->is.eta));
}

static int read_kind(scene_reader *r, const statement *s, material *m)
{
    static const material_kind made[KINDS] = {MATERIAL_MICROFACET, MATERIAL_MICROFACET, MATERIAL_MICROFACET,
                                              MATERIAL_MICROFACET, MATERIAL_MATTE,      MATERIAL_MIRROR,
                                              MATERIAL_GLASS,      MATERIAL_LIGHT};
    const clause all = {.keyword = "material", .at = &s->words[0], .values = &s->words[2], .count = 1};
    clause c[CLAUSES];
    unsigned kind;
    if (!reader_choice(r, &all, kinds, KINDS, &kind) || !find_clauses(r, s, kind, c) || !read_colours(r, c, m))
        return 0;
    m->kind = made[kind];
    return m->kind != MATERIAL_MICROFACET || read_rough(r, s, c, kind, m);
}

static int check_name(scene_reader *r, const word *name)
{
    const scene *s = r->made;
    for (size_t i = 0; i < s->material_count; i++)
        if (strcmp(s->materials[i].name, name->text) == 0)
            return reader_refuse(r, name, "there is a material '%s' already", name->text);
    return s->material_count < SCENE_MATERIALS_MAX ||
           reader_refuse(r, name, "these are more than %d materials", SCENE_MATERIALS_MAX);
}

int read_material(scene_reader *r, const statement *s)
{
    scene *to = r->made;
    const word *name;
    material made = {.name = NULL};
    if (!reader_name(r, s, "material", &name) || !check_name(r, name))
        return 0;
    if (s->count < 3)
        return reader_refuse(r, name, "what '%s' is must stand here, as in 'material %s matte colour 1 1 1'",
                             name->text, name->text);
    if (!to->materials)
        to->materials = calloc(SCENE_MATERIALS_MAX, sizeof *to->materials);
    if (!to->materials)
        return reader_refuse(r, name, "there is no memory for materials");
    if (!read_kind(r, s, &made) || !(made.name = reader_copy(r, name)))
        return 0;
    to->materials[to->material_count++] = made;
    return 1;
}
