/* The sets of effects that are measured, from bare reflection upward: the line of a set says how it differs from bare
 * reflection. */
#include <math.h>
#include <string.h>

#include "bench/effects/effects.h"

static const float index_ratio = 1.5f; /* of surfaces that transmit */

static const char bare[] = "bare reflection";

/* Fresnel terms: gold at 650, 550 and 450 nm, and a dielectric under Schlick's approximation. */
static const float gold_eta[3] = {0.16f, 0.42f, 1.35f};
static const float gold_k[3] = {3.5f, 2.35f, 1.9f};
static const float schlick_f0[3] = {0.04f, 0.04f, 0.04f};

const effects_set effects_sets[] = {
    {.name = "by hand, without the library", .kind = EFFECTS_BY_CAPS},
    {.name = "by hand, over vndf.h", .kind = EFFECTS_BY_HAND},
    {.name = bare},
    {.name = "separable masking", .effects = {.masking = VNDF_MASKING_SEPARABLE}},
    {.name = "V-cavity masking", .effects = {.masking = VNDF_MASKING_V_CAVITIES}},
    {.name = "no masking", .effects = {.masking = VNDF_MASKING_NONE}},
    {.name = "Schlick", .effects = {.fresnel = VNDF_FRESNEL_SCHLICK}},
    {.name = "dielectric Fresnel", .effects = {.fresnel = VNDF_FRESNEL_DIELECTRIC}},
    {.name = "conductor Fresnel", .effects = {.fresnel = VNDF_FRESNEL_CONDUCTOR}},
    {.name = "bounded normals", .effects = {.normals = VNDF_NORMALS_BOUNDED}, .visible = bare},
    {.name = "all normals", .effects = {.normals = VNDF_NORMALS_ALL}, .visible = bare},
    {.name = "V-cavity normals",
     .effects = {.masking = VNDF_MASKING_V_CAVITIES, .normals = VNDF_NORMALS_V_CAVITY},
     .visible = "V-cavity masking"},
    {.name = "two roughnesses", .stretched = 1},
    {.name = "roughness per hit", .kind = EFFECTS_ROUGH},
    {.name = "rotated axes", .effects = {.shape = VNDF_SHAPE_ROTATED}, .stretched = 1},
    {.name = "matrix", .effects = {.shape = VNDF_SHAPE_MATRIX}, .stretched = 1},
    {.name = "matrix and mean slope", .effects = {.shape = VNDF_SHAPE_AFFINE}, .stretched = 1},
    {.name = "two lobes", .effects = {.shape = VNDF_SHAPE_MIXTURE}},
    {.name = "retroreflection", .effects = {.reflection = VNDF_REFLECTION_RETRO}},
    {.name = "transmission alone",
     .effects = {.lobes = VNDF_LOBES_TRANSMISSION, .fresnel = VNDF_FRESNEL_DIELECTRIC}},
    {.name = "both lobes", .effects = {.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_DIELECTRIC}},
    {.name = "both lobes, separable",
     .effects = {.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_DIELECTRIC, .masking = VNDF_MASKING_SEPARABLE}},
    {.name = "both lobes, from inside",
     .effects = {.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_DIELECTRIC},
     .inside = 1},
    {.name = "batch: bare reflection", .kind = EFFECTS_BATCH},
    {.name = "batch: conductor Fresnel", .kind = EFFECTS_BATCH, .effects = {.fresnel = VNDF_FRESNEL_CONDUCTOR}},
    {.name = "batch: both lobes",
     .kind = EFFECTS_BATCH,
     .effects = {.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_DIELECTRIC}},
    {.name = "Turquin", .effects = {.scattering = VNDF_SCATTERING_TURQUIN}},
    {.name = "Kulla & Conty", .effects = {.scattering = VNDF_SCATTERING_KULLA_CONTY}},
    {.name = "walk", .effects = {.scattering = VNDF_SCATTERING_MULTIPLE}},
    {.name = "walk on a conductor",
     .effects = {.fresnel = VNDF_FRESNEL_CONDUCTOR, .scattering = VNDF_SCATTERING_MULTIPLE}},
    {.name = "walk, both lobes",
     .effects = {.lobes = VNDF_LOBES_BOTH,
                 .fresnel = VNDF_FRESNEL_DIELECTRIC,
                 .scattering = VNDF_SCATTERING_MULTIPLE}},
};

const size_t effects_set_count = sizeof effects_sets / sizeof effects_sets[0];

const effects_set *effects_find(const char *name)
{
    for (size_t i = 0; i < effects_set_count; i++)
        if (strcmp(effects_sets[i].name, name) == 0)
            return &effects_sets[i];
    return NULL;
}

static const effects_loops *loops_of(const effects_set *set)
{
    static const effects_loops *const of[EFFECTS_KINDS] = {
        [EFFECTS_LIBRARY] = &effects_loops_library, [EFFECTS_ROUGH] = &effects_loops_rough,
        [EFFECTS_BATCH] = &effects_loops_batch,     [EFFECTS_BY_HAND] = &effects_loops_by_hand,
        [EFFECTS_BY_CAPS] = &effects_loops_by_caps,
    };
    return of[set->kind];
}

/* The roughness of the surface at an angle, with a mean slope, and a second lobe three times as wide. */
static void lobes_of(vndf_mixture *mixture, const vndf_surface *surface, int leans)
{
    const float c = 0.8776f, s = 0.4794f, ax = surface->alpha_x, ay = surface->alpha_y;
    const vndf_affine core = {surface->distribution, c * ax, -s * ay, s * ax, c * ay, leans ? 0.2f : 0.0f,
                              leans ? -0.1f : 0.0f};
    const vndf_affine haze = {surface->distribution, 3 * ax, 0, 0, 3 * ay, 0, 0};
    *mixture = (vndf_mixture){.count = 2, .lobe = {{core, 0.7f}, {haze, 0.3f}}};
}

double effects_cosine(const effects_subject *subject, vndf_vec3 w)
{
    const vndf_affine *a = &subject->mixture.lobe[0].surface;
    double x = (double)a->mean_x, y = (double)a->mean_y;
    return ((double)w.z - (double)w.x * x - (double)w.y * y) / sqrt(1 + x * x + y * y);
}

vndf_status effects_subject_make(effects_subject *subject, const effects_set *set, const vndf_surface *surface,
                                 vndf_error *error)
{
    vndf_description is = {.distribution = surface->distribution, .effects = set->effects, .eta = index_ratio};
    memset(subject, 0, sizeof *subject);
    subject->set = set;
    subject->loops = loops_of(set);
    subject->surface = *surface;
    if (set->stretched)
        subject->surface.alpha_y = subject->surface.alpha_x / 4;
    is.alpha_x = subject->surface.alpha_x;
    is.alpha_y = subject->surface.alpha_y;
    is.rotation = 0.5f;
    lobes_of(&subject->mixture, &subject->surface, set->effects.shape == VNDF_SHAPE_AFFINE);
    is.affine = subject->mixture.lobe[0].surface;
    if (set->effects.scattering >= VNDF_SCATTERING_TURQUIN)
        is.albedo = subject->albedo = vndf_albedo_build(surface->distribution, 0.0f, error);
    is.mixture = &subject->mixture;
    memcpy(is.f0, schlick_f0, sizeof schlick_f0);
    memcpy(is.conductor_eta, gold_eta, sizeof gold_eta);
    memcpy(is.conductor_k, gold_k, sizeof gold_k);
    return vndf_material_resolve(&is, &subject->material, error);
}
