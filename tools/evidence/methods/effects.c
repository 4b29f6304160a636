/* Effect by effect: the sets, from bare reflection upward, the materials made of them, and the loops over vndf_bsdf.h,
 * which do the work of a renderer at a hit. The line of a set says how it differs from bare reflection. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "evidence/method.h"

static const char bare[] = "bare reflection";

const effect_set effect_sets[] = {
    {.name = bare},
    {.name = "bare reflection, by hand", .by_hand = 1},
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
    {.name = "roughness per hit", .is_rough = 1},
    {.name = "matrix", .stretched = 1, .turned = 1},
    {.name = "matrix and mean slope", .effects = {.shape = VNDF_SHAPE_TILTED}, .stretched = 1, .turned = 1},
    {.name = "two lobes", .effects = {.shape = VNDF_SHAPE_MIXTURE}},
    {.name = "retroreflection", .effects = {.reflection = VNDF_REFLECTION_RETRO}},
    {.name = "transmission alone",
     .effects = {.lobes = VNDF_LOBES_TRANSMISSION, .fresnel = VNDF_FRESNEL_DIELECTRIC}},
    {.name = "both lobes", .effects = {.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_DIELECTRIC}},
    {.name = "both lobes, separable",
     .effects = {.lobes = VNDF_LOBES_BOTH, .fresnel = VNDF_FRESNEL_DIELECTRIC, .masking = VNDF_MASKING_SEPARABLE}},
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

/* Directions wo are on the side that the set scatters to. */
block_law effect_law(const effect_set *set)
{
    return (block_law){.low = 0.5f, .high = 1.5f, .theta = NAN, .lobes = set->effects.lobes};
}

static inline void hit(const effect_case *of, const method_input *in, vndf_bsdf *bsdf)
{
    if (of->set->is_rough) {
        const vndf_surface *s = &of->material.is.surface,
                           rough = vndf_rough(NULL, in->alpha * s->xx, in->alpha * s->yy);
        vndf_bsdf_on(bsdf, &of->material, &rough, in->wi);
    } else {
        vndf_bsdf_at(bsdf, &of->material, in->wi);
    }
}

/* What is done with each hit and those that share it; constants where it is inlined. */
enum { SAMPLES, VALUES, DENSITIES };

static inline void run(const method *m, block *b, size_t share, int what)
{
    for (size_t first = 0; first < b->count; first += share) {
        vndf_bsdf bsdf;
        hit(m->state, &b->in[first], &bsdf);
        for (size_t i = first; i < first + share; i++)
            if (what == SAMPLES)
                vndf_bsdf_sample(&bsdf, b->in[i].u, &b->out[i]);
            else if (what == VALUES)
                vndf_bsdf_eval(&bsdf, b->in[i].given, i, b->out[i].weight);
            else
                b->out[i].density = vndf_bsdf_pdf(&bsdf, b->in[i].given);
    }
}

static void each(const method *m, block *b)
{
    run(m, b, 1, SAMPLES);
}

static void shared(const method *m, block *b)
{
    run(m, b, SHARE, SAMPLES);
}

static void eval(const method *m, block *b)
{
    run(m, b, SHARE, VALUES);
}

static void density(const method *m, block *b)
{
    run(m, b, SHARE, DENSITIES);
}

/* The projected area of GGX, (cos + |stretched w|)/2. */
static inline float ggx_area(const vndf_surface *s, vndf_vec3 w)
{
    const float x = s->xx * w.x, y = s->yy * w.y;
    return 0.5f * (w.z + sqrtf(x * x + y * y + w.z * w.z));
}

/* What a user writes for bare reflection: the weight is G2/G1(wi), heights correlated. */
static void by_hand(const method *m, block *b)
{
    const effect_case *e = m->state;
    const vndf_surface surface = e->material.is.surface;
    for (size_t i = 0; i < b->count; i++) {
        const vndf_vec3 wi = b->in[i].wi;
        const vndf_view view = vndf_view_from(&surface, wi);
        float pdf;
        const vndf_vec3 wm = vndf_sample(&view, b->in[i].u[0], b->in[i].u[1], &pdf);
        const float facing = wi.x * wm.x + wi.y * wm.y + wi.z * wm.z, twice = 2.0f * facing;
        const vndf_vec3 wo = {twice * wm.x - wi.x, twice * wm.y - wi.y, twice * wm.z - wi.z};
        vndf_scattered *to = &b->out[i];
        *to = (vndf_scattered){.lobe = VNDF_LOBE_NONE};
        if (!(wo.z > 0.0f))
            continue;
        const float seen = ggx_area(&surface, wi) * wo.z,
                    weight = seen / (seen + wi.z * (ggx_area(&surface, wo) - wo.z));
        *to = (vndf_scattered){.wo = wo, .wm = wm, .density = pdf / (4.0f * facing), .lobe = VNDF_LOBE_REFLECTION};
        to->weight[0] = to->weight[1] = to->weight[2] = weight;
    }
}

static void batch(const method *m, block *b)
{
    const effect_case *e = m->state;
    vndf_bsdf_batch of = {.material = &e->material, .count = b->count, .limit = b->limit};
    of.wi_x = b->wi[0], of.wi_y = b->wi[1], of.wi_z = b->wi[2];
    const float *const u[3] = {b->u[0], b->u[1], b->u[2]};
    const vndf_scattered_n to = {{b->x, b->y, b->z},
                                 {b->value[0], b->value[1], b->value[2]},
                                 b->pdf,
                                 b->lobe,
                                 {b->half[0], b->half[1], b->half[2]}};
    vndf_bsdf_sample_n(&of, u, to);
}

/* The roughness of the surface at an angle, with a mean slope, and a second lobe three times as wide. */
static void lobes_of(vndf_mixture *mixture, const vndf_surface *surface, int leans)
{
    vndf_surface core = vndf_rotated(*surface, 0.8776f, 0.4794f);
    const vndf_surface haze = vndf_rough(surface->distribution, 3 * surface->xx, 3 * surface->yy);
    core.mean_x = leans ? 0.2f : 0.0f;
    core.mean_y = leans ? -0.1f : 0.0f;
    *mixture = (vndf_mixture){.count = 2, .lobe = {{core, 0.7f}, {haze, 0.3f}}};
}

double effect_cosine(const effect_case *of, vndf_vec3 w)
{
    const vndf_surface *a = &of->mixture.lobe[0].surface;
    double x = (double)a->mean_x, y = (double)a->mean_y;
    return ((double)w.z - (double)w.x * x - (double)w.y * y) / sqrt(1 + x * x + y * y);
}

static vndf_status make(effect_case *of, const effect_set *set, const vndf_surface *surface, vndf_error *error)
{
    vndf_surface s = *surface;
    s.yy = set->stretched ? s.xx / 4 : s.yy;
    of->set = set;
    lobes_of(&of->mixture, &s, set->effects.shape == VNDF_SHAPE_TILTED);
    if (set->effects.scattering >= VNDF_SCATTERING_TURQUIN)
        of->albedo = vndf_albedo_build(surface->distribution, 0.0f, error);
    /* gold at 650, 550 and 450 nm for conductors; a dielectric under Schlick's approximation */
    vndf_description is = {.eta = 1.5f,
                           .f0 = {0.04f, 0.04f, 0.04f},
                           .conductor_eta = {0.16f, 0.42f, 1.35f},
                           .conductor_k = {3.5f, 2.35f, 1.9f}};
    is.effects = set->effects, is.albedo = of->albedo;
    is.surface = set->turned ? of->mixture.lobe[0].surface : s, is.mixture = &of->mixture;
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
    effect_case *of = calloc(1, sizeof *of);
    method m = {.kind = ROW_EFFECT, .state = of, .release = release};
    snprintf(m.name, sizeof m.name, "%s", set->name);
    if (!of)
        *error = (vndf_error){VNDF_ERROR_MEMORY, "no memory"};
    if (!of || make(of, set, surface, error) != VNDF_OK) {
        method_release(&m);
        return m;
    }
    m.each = set->by_hand ? by_hand : each;
    if (set->by_hand)
        return m;
    m.shared = shared, m.eval = eval, m.density = density;
    m.batch = set->is_rough ? NULL : batch; /* roughness of hits are arrays to it */
    m.same_bits = 1;
    return m;
}
