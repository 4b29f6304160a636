/* Effect by effect: the sets, from bare reflection upward, the materials made of them, and the loops over
 * vndf_bsdf.h, which do the work of a renderer at a hit. The line of a set says how it differs from bare
 * reflection. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "evidence/methods/vector.h"

static const float index_ratio = 1.5f; /* of surfaces that transmit */

static const char bare[] = "bare reflection";

/* Fresnel terms: gold at 650, 550 and 450 nm, and a dielectric under Schlick's approximation. */
static const float gold_eta[3] = {0.16f, 0.42f, 1.35f};
static const float gold_k[3] = {3.5f, 2.35f, 1.9f};
static const float schlick_f0[3] = {0.04f, 0.04f, 0.04f};

const effect_set effect_sets[] = {
    {.name = bare},
    {.name = "by hand, over vndf.h", .kind = EFFECT_BY_HAND},
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
    {.name = "roughness per hit", .kind = EFFECT_ROUGH},
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
    {.name = "batch: bare reflection", .kind = EFFECT_BATCH},
    {.name = "batch: conductor Fresnel", .kind = EFFECT_BATCH, .effects = {.fresnel = VNDF_FRESNEL_CONDUCTOR}},
    {.name = "batch: both lobes",
     .kind = EFFECT_BATCH,
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

const size_t effect_set_count = sizeof effect_sets / sizeof effect_sets[0];

const effect_set *effect_find(const char *name)
{
    for (size_t i = 0; i < effect_set_count; i++)
        if (strcmp(effect_sets[i].name, name) == 0)
            return &effect_sets[i];
    return NULL;
}

/* Directions wo are on the side that the set scatters to. */
block_law effect_law(const effect_set *set, double theta)
{
    return (block_law){.low = 0.5f, .high = 1.5f, .theta = theta, .lobes = set->effects.lobes};
}

/* ---- hits one by one ----------------------------------------------------------------------------- */

static inline void hit(const effect_case *of, const method_input *in, vndf_bsdf *bsdf)
{
    if (of->set->kind == EFFECT_ROUGH) {
        const vndf_roughness r = {in->alpha * of->surface.alpha_x, in->alpha * of->surface.alpha_y, 1.0f, 0.0f};
        vndf_bsdf_rough(bsdf, &of->material, &r, in->wi);
    } else {
        vndf_bsdf_at(bsdf, &of->material, in->wi);
    }
}

static void shared(const method *m, block *b, size_t first, size_t count)
{
    vndf_bsdf bsdf;
    hit(m->state, &b->in[first], &bsdf);
    for (size_t i = first; i < first + count; i++)
        vndf_bsdf_sample(&bsdf, b->in[i].u, &b->out[i]);
}

static void each(const method *m, block *b, size_t first, size_t count)
{
    for (size_t i = first; i < first + count; i++)
        shared(m, b, i, 1);
}

static void eval(const method *m, block *b, size_t first, size_t count)
{
    vndf_bsdf bsdf;
    hit(m->state, &b->in[first], &bsdf);
    for (size_t i = first; i < first + count; i++)
        vndf_bsdf_eval(&bsdf, b->in[i].given, i, b->out[i].weight);
}

static void density(const method *m, block *b, size_t first, size_t count)
{
    vndf_bsdf bsdf;
    hit(m->state, &b->in[first], &bsdf);
    for (size_t i = first; i < first + count; i++)
        b->out[i].density = vndf_bsdf_pdf(&bsdf, b->in[i].given);
}

/* ---- batches, with the best instructions of this machine ------------------------------------------ */

static const unsigned one_hit = VNDF_SHARED_WI | VNDF_SHARED_ALPHA;

static vndf_bsdf_batch batch_of(const method *m, const block *b, size_t i, size_t count, unsigned is_shared)
{
    return (vndf_bsdf_batch){.material = &((const effect_case *)m->state)->material,
                             .count = count,
                             .shared = is_shared,
                             .wi_x = b->wi[0] + i,
                             .wi_y = b->wi[1] + i,
                             .wi_z = b->wi[2] + i};
}

static void sample_n(const method *m, block *b, size_t i, size_t count, unsigned is_shared)
{
    const vndf_bsdf_batch batch = batch_of(m, b, i, count, is_shared);
    const float *const u[3] = {b->u[0] + i, b->u[1] + i, b->u[2] + i};
    const vndf_scattered_n to = {{b->x + i, b->y + i, b->z + i},
                                 {b->value[0] + i, b->value[1] + i, b->value[2] + i},
                                 b->pdf + i,
                                 b->lobe + i,
                                 {b->half[0] + i, b->half[1] + i, b->half[2] + i}};
    vndf_bsdf_sample_n(&batch, u, to);
}

static void batch_each(const method *m, block *b, size_t first, size_t count)
{
    sample_n(m, b, first, count, 0);
}

static void batch_shared(const method *m, block *b, size_t first, size_t count)
{
    sample_n(m, b, first, count, one_hit);
}

static void batch_eval(const method *m, block *b, size_t i, size_t count)
{
    const vndf_bsdf_batch batch = batch_of(m, b, i, count, one_hit);
    const vndf_normals wo = {b->given[0] + i, b->given[1] + i, b->given[2] + i};
    float *const value[3] = {b->value[0] + i, b->value[1] + i, b->value[2] + i};
    vndf_bsdf_eval_n(&batch, wo, NULL, value);
}

static void batch_density(const method *m, block *b, size_t i, size_t count)
{
    const vndf_bsdf_batch batch = batch_of(m, b, i, count, one_hit);
    const vndf_normals wo = {b->given[0] + i, b->given[1] + i, b->given[2] + i};
    vndf_bsdf_pdf_n(&batch, wo, b->pdf + i);
}

/* ---- by hand ------------------------------------------------------------------------------------- */

/* Bare reflection over vndf.h, as someone would write it who wants nothing else: a visible normal, wi mirrored at
 * it, and G2/G1 of height-correlated masking; with A the projected area, cosines of wi and wo and `true` over
 * drawn density,
 *
 *     weight = true/drawn A(wi) cos_o/(cos_o A(wi) + cos_i (A(wo) - cos_o)).
 *
 * vndf_bsdf.h handles special cases that this does not, above all smooth surfaces, whose roughness is below the
 * rounding of a direction. */

/* G2/(cos_i cos_o). */
static inline float masking(const vndf_surface *s, vndf_vec3 wi, float area, vndf_vec3 wo)
{
    return 1.0f / (wo.z * area + wi.z * (vndf_projected_area(s, wo) - wo.z));
}

static inline vndf_vec3 half_of(vndf_vec3 wi, vndf_vec3 wo)
{
    return method_unit(wi.x + wo.x, wi.y + wo.y, wi.z + wo.z);
}

/* The view is not part of a struct with wi and the area: the processor would wait for the copy. */
static inline void sample_by_hand(const vndf_surface *s, const vndf_view *view, vndf_vec3 wi, float area,
                                  const float u[3], vndf_scattered *out)
{
    float pdf, weight;
    vndf_vec3 wm = vndf_sample_weight(view, u[0], u[1], &pdf, &weight);
    float facing = method_dot(wi, wm), twice = 2.0f * facing;
    vndf_vec3 wo = {twice * wm.x - wi.x, twice * wm.y - wi.y, twice * wm.z - wi.z};
    if (!(wo.z > 0.0f)) {
        *out = (vndf_scattered){.wo = {0, 0, 1}};
        return;
    }
    weight *= area * wo.z * masking(s, wi, area, wo);
    *out = (vndf_scattered){wo, {weight, weight, weight}, pdf / (4.0f * facing), VNDF_LOBE_REFLECTION, wm};
}

static const vndf_surface *surface_of(const method *m)
{
    return &((const effect_case *)m->state)->surface;
}

/* (A copy of wi would be stored by floats and loaded whole, for which the processor waits: method.h.) */
static void hand_shared(const method *m, block *b, size_t first, size_t count)
{
    const vndf_surface *s = surface_of(m);
    const vndf_vec3 *wi = &b->in[first].wi;
    vndf_view view = vndf_view_from(s, *wi);
    float area = vndf_projected_area(s, *wi);
    for (size_t i = first; i < first + count; i++)
        sample_by_hand(s, &view, *wi, area, b->in[i].u, &b->out[i]);
}

static void hand_each(const method *m, block *b, size_t first, size_t count)
{
    for (size_t i = first; i < first + count; i++)
        hand_shared(m, b, i, 1);
}

static void hand_eval(const method *m, block *b, size_t first, size_t count)
{
    const vndf_surface *s = surface_of(m);
    vndf_vec3 wi = b->in[first].wi;
    float area = vndf_projected_area(s, wi);
    for (size_t i = first; i < first + count; i++) {
        vndf_vec3 wo = b->in[i].given;
        float f = 0.25f * vndf_ndf(s, half_of(wi, wo)) * masking(s, wi, area, wo);
        b->out[i].weight[0] = b->out[i].weight[1] = b->out[i].weight[2] = f;
    }
}

static void hand_density(const method *m, block *b, size_t first, size_t count)
{
    vndf_vec3 wi = b->in[first].wi;
    vndf_view view = vndf_view_from(surface_of(m), wi);
    for (size_t i = first; i < first + count; i++) {
        vndf_vec3 wm = half_of(wi, b->in[i].given);
        b->out[i].density = vndf_pdf(&view, wm) / (4.0f * method_dot(wi, wm));
    }
}

/* ---- materials ----------------------------------------------------------------------------------- */

/* The roughness of the surface at an angle, with a mean slope, and a second lobe three times as wide. */
static void lobes_of(vndf_mixture *mixture, const vndf_surface *surface, int leans)
{
    const float c = 0.8776f, s = 0.4794f, ax = surface->alpha_x, ay = surface->alpha_y;
    const vndf_affine core = {surface->distribution, c * ax, -s * ay, s * ax, c * ay, leans ? 0.2f : 0.0f,
                              leans ? -0.1f : 0.0f};
    const vndf_affine haze = {surface->distribution, 3 * ax, 0, 0, 3 * ay, 0, 0};
    *mixture = (vndf_mixture){.count = 2, .lobe = {{core, 0.7f}, {haze, 0.3f}}};
}

double effect_cosine(const effect_case *of, vndf_vec3 w)
{
    const vndf_affine *a = &of->mixture.lobe[0].surface;
    double x = (double)a->mean_x, y = (double)a->mean_y;
    return ((double)w.z - (double)w.x * x - (double)w.y * y) / sqrt(1 + x * x + y * y);
}

static vndf_status make(effect_case *of, const effect_set *set, const vndf_surface *surface, vndf_error *error)
{
    vndf_description is = {.distribution = surface->distribution, .effects = set->effects, .eta = index_ratio};
    of->set = set;
    of->surface = *surface;
    if (set->stretched)
        of->surface.alpha_y = of->surface.alpha_x / 4;
    is.alpha_x = of->surface.alpha_x;
    is.alpha_y = of->surface.alpha_y;
    is.rotation = 0.5f;
    lobes_of(&of->mixture, &of->surface, set->effects.shape == VNDF_SHAPE_AFFINE);
    is.affine = of->mixture.lobe[0].surface;
    if (set->effects.scattering >= VNDF_SCATTERING_TURQUIN)
        is.albedo = of->albedo = vndf_albedo_build(surface->distribution, 0.0f, error);
    is.mixture = &of->mixture;
    memcpy(is.f0, schlick_f0, sizeof schlick_f0);
    memcpy(is.conductor_eta, gold_eta, sizeof gold_eta);
    memcpy(is.conductor_k, gold_k, sizeof gold_k);
    return vndf_material_resolve(&is, &of->material, error);
}

static void release(void *state)
{
    effect_case *of = state;
    vndf_albedo_free(of->albedo);
    free(of);
}

method method_effect(const effect_set *set, const vndf_surface *surface, vndf_error *error)
{
    static const struct {
        method_run *each, *shared, *eval, *density;
    } loops[] = {{each, shared, eval, density},
                 {each, shared, eval, density},
                 {batch_each, batch_shared, batch_eval, batch_density},
                 {hand_each, hand_shared, hand_eval, hand_density}};
    effect_case *of = calloc(1, sizeof *of);
    method m = {.instructions = "scalar", .kind = ROW_EFFECT, .state = of, .release = release};
    snprintf(m.name, sizeof m.name, "%s", set->name);
    if (!of)
        *error = (vndf_error){VNDF_ERROR_MEMORY, "no memory"};
    if (!of || make(of, set, surface, error) != VNDF_OK) {
        method_release(&m);
        return m;
    }
    if (set->kind == EFFECT_BATCH) {
        m.limit = vndf_instructions_used(VNDF_INSTRUCTIONS_BEST);
        m.instructions = method_instructions_name(m.limit);
    }
    m.each = loops[set->kind].each;
    m.shared = loops[set->kind].shared;
    m.eval = loops[set->kind].eval;
    m.density = loops[set->kind].density;
    return m;
}
