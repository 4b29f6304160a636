/* material NAME KIND ...: which clauses go with which kind, and the material that they make. */
#include "render/scene/material_clauses.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- clauses ---- */

static const char *const kinds[KINDS + 1] = {"conductor", "dielectric", "reflector", "shape", "matte",
                                             "mirror",    "glass",      "light",     "lobe"};

/* A bit for each kind. */
enum {
    ROUGH = 1 << CONDUCTOR | 1 << DIELECTRIC | 1 << REFLECTOR | 1 << SHAPE,
    THROUGH = 1 << DIELECTRIC | 1 << REFLECTOR | 1 << SHAPE,
    COLOURED = ROUGH | 1 << MATTE | 1 << MIRROR,
    LAID = ROUGH | 1 << LOBE
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
    [DISTRIBUTION] = {"distribution", "ggx|beckmann|table FILE|family NAME or FILE|slope FORMULA|ndf FORMULA", 1,
                      2, LAID, LAID},
    [PARAMETER] = {"parameter", "P or FROM TO", 1, 2, LAID, 0},
    [PARAMETER_MAP] = {"parameter-map", "IMAGE", 1, 1, LAID, 0},
    [BYTES] = {"bytes", "COUNT", 1, 1, LAID, 0},
    [ALPHA] = {"alpha", "A or AX AY", 1, 2, LAID, 0},
    [ALPHA_MAP] = {"alpha-map", "IMAGE", 1, 1, LAID, 0},
    [ALPHA_X_MAP] = {"alpha-x-map", "IMAGE", 1, 1, LAID, 0},
    [ALPHA_Y_MAP] = {"alpha-y-map", "IMAGE", 1, 1, LAID, 0},
    [ROTATION] = {"rotation", "DEGREES", 1, 1, LAID, 0},
    [MATRIX] = {"matrix", "XX XY YX YY", 4, 4, LAID, 0},
    [MEAN] = {"mean", "X Y", 2, 2, LAID, 0},
    [HEIGHT_MAP] = {"height-map", "IMAGE", 1, 1, LAID, 0},
    [NORMAL_MAP] = {"normal-map", "IMAGE", 1, 1, LAID, 0},
    [SCALE] = {"scale", "S or SX SY", 1, 2, LAID, 0},
    [FILTERED] = {"filtered", "TEXELS", 1, 1, LAID, 0},
    [WEIGHT] = {"weight", "W", 1, 1, 1 << LOBE, 0},
    [WEIGHT_MAP] = {"weight-map", "IMAGE", 1, 1, 1 << LOBE, 0},
    [MIX] = {"mix", "LOBE ...", 1, VNDF_MIXTURE_LOBES, ROUGH, 0},
    [MASKING] = {"masking", "height-correlated|separable|v-cavities|none", 1, 1, ROUGH, 0},
    [NORMALS] = {"normals", "visible|bounded|all|v-cavity", 1, 1, ROUGH, 0},
    [SCATTERING] = {"scattering", "single|multiple|turquin|kulla-conty", 1, 1, ROUGH, 0},
    [ORDER] = {"order", "COUNT", 1, 1, ROUGH, 0},
    [RETRO] = {"retroreflective", "nothing", 0, 0, ROUGH, 0},
    [ABSORB] = {"absorb", "R G B", 3, 3, THROUGH | 1 << GLASS, 0},
    [COLOUR] = {"colour", "R G B", 3, 3, COLOURED, 1 << MATTE},
    [COLOUR_MAP] = {"colour-map", "IMAGE", 1, 1, COLOURED, 0},
    [RADIANCE] = {"radiance", "R G B", 3, 3, 1 << LIGHT, 1 << LIGHT},
};

static int refuse_clause(scene_reader *r, const clause *c, unsigned kind, unsigned fits)
{
    char list[128] = "";
    for (unsigned i = 0; i <= LOBE; i++)
        if (fits >> i & 1u) {
            strcat(list, list[0] ? ", " : ""); /* all kinds together have 76 letters */
            strcat(list, kinds[i]);
        }
    return reader_refuse(r, c->at, "'%s' does not go with '%s'; it goes with: %s", c->keyword, kinds[kind], list);
}

/* A material that mixes lobes needs no distribution. */
static int is_missing(const clause c[CLAUSES], size_t i, unsigned kind)
{
    return !c[i].at && rules[i].needed >> kind & 1u && !(i == DISTRIBUTION && c[MIX].at);
}

int material_clauses(scene_reader *r, const statement *s, size_t from, unsigned kind, clause c[CLAUSES])
{
    for (size_t i = 0; i < CLAUSES; i++)
        c[i] = (clause){
            .keyword = rules[i].keyword, .takes = rules[i].takes, .least = rules[i].least, .most = rules[i].most};
    if (!reader_clauses(r, s, from, c, CLAUSES))
        return 0;
    for (size_t i = 0; i < CLAUSES; i++) {
        if (c[i].at && !(rules[i].kinds >> kind & 1u))
            return refuse_clause(r, &c[i], kind, rules[i].kinds);
        if (is_missing(c, i, kind))
            return reader_refuse(r, &s->words[from - 1], "'%s' needs '%s %s'", kinds[kind], c[i].keyword,
                                 c[i].takes);
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
    if (scattering != VNDF_SCATTERING_MULTIPLE && c[ORDER].at)
        return reader_refuse(r, c[ORDER].at, "'order' goes with 'scattering multiple'");
    *e = (vndf_effects){.lobes = (vndf_lobes)lobes,
                        .fresnel = fresnel[kind],
                        .masking = (vndf_masking)masking,
                        .normals = (vndf_normals_drawn)normals,
                        .scattering = (vndf_scattering)scattering,
                        .reflection = c[RETRO].at ? VNDF_REFLECTION_RETRO : VNDF_REFLECTION_SPECULAR};
    return 1;
}

/* ---- roughness ---- */

/* Alpha and axes alone, which need no lobe. */
static void set_roughness(material *m, const scene_lobe *l)
{
    m->alpha_x = l->alpha_x;
    m->alpha_y = l->alpha_y;
    m->is_textured = m->alpha_x.map || m->alpha_y.map;
    m->is.distribution = l->distribution;
    m->is.alpha_x = m->alpha_x.value;
    m->is.alpha_y = m->alpha_y.value;
    m->is.rotation = l->rotation;
    m->is.effects.shape = l->rotation != 0.0f ? VNDF_SHAPE_ROTATED : VNDF_SHAPE_ALIGNED;
}

static int read_roughness(scene_reader *r, const clause c[CLAUSES], material *m)
{
    scene_lobe one;
    m->alpha_x.value = m->alpha_y.value = 1.0f;
    if (c[MIX].at)
        return read_mix(r, c, m);
    if (!read_slopes(r, c, &one))
        return 0;
    if (one.is_matrix || c[MEAN].at || one.relief || one.family)
        return set_lobes(r, c[DISTRIBUTION].at, m, &one, 1);
    set_roughness(m, &one);
    return 1;
}

/* ---- resolving ---- */

static int is_compensated(const vndf_effects *e)
{
    return e->scattering == VNDF_SCATTERING_TURQUIN || e->scattering == VNDF_SCATTERING_KULLA_CONTY;
}

/* The library looks for the albedos of a compensated material after its effects and before its optics. None are made
 * yet (albedos.c), so that refusal passes, and the optics are looked at without compensation. */
static int resolve_effects(const vndf_description *is, vndf_error *error)
{
    vndf_material made;
    return !is_compensated(&is->effects) || vndf_material_resolve(is, &made, error) == VNDF_OK ||
           strncmp(error->message, "albedo is NULL", 14) == 0;
}

/* Resolves the material, so that a refusal of the library names the place in the file. Plans resolve it again,
 * with their sampler. */
static int resolve(scene_reader *r, const statement *s, const material *m)
{
    vndf_material made;
    vndf_error error = {VNDF_OK, ""};
    char message[512];
    vndf_description is = m->is;
    if (is_compensated(&is.effects))
        is.effects.scattering = VNDF_SCATTERING_SINGLE;
    if (resolve_effects(&m->is, &error) && vndf_material_resolve(&is, &made, &error) == VNDF_OK)
        return 1;
    scene_wording(error.message, message, sizeof message);
    return reader_refuse(r, &s->words[1], "%s", message);
}

/* Albedos of light that passes are those of an index, which bends it. */
static int check_bending(scene_reader *r, const clause c[CLAUSES], const vndf_description *is)
{
    return !is_compensated(&is->effects) || is->effects.lobes != VNDF_LOBES_BOTH ||
           fabsf(is->eta - 1.0f) > 1.01e-3f ||
           reader_refuse(r, c[INDEX].values, "'scattering %s' needs an index farther than 0.001 from 1",
                         c[SCATTERING].values->text);
}

static int read_rough(scene_reader *r, const statement *s, const clause c[CLAUSES], unsigned kind, material *m)
{
    if (!read_effects(r, c, kind, &m->is.effects) ||
        (kind == CONDUCTOR && !read_metal(r, &s->words[2], &c[OF], &c[ETA], &c[K], &m->is)) ||
        (c[F0].at && !reader_three(r, &c[F0], 0, 1, m->is.f0)) || !read_roughness(r, c, m) ||
        (c[ORDER].at && !reader_whole(r, &c[ORDER], 0, 1, 1e6, &m->is.order_limit)) ||
        !check_bending(r, c, &m->is))
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
    if (!reader_choice(r, &all, kinds, KINDS, &kind) || !material_clauses(r, s, 3, kind, c) ||
        !read_colours(r, c, m))
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
    if (!read_kind(r, s, &made) || !(made.name = reader_copy(r, name))) {
        free(made.lobes);
        return 0;
    }
    to->materials[to->material_count++] = made;
    return 1;
}
