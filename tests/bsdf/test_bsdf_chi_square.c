/* Sampled directions follow vndf_bsdf_pdf, and its integral is what is not lost: chi-square over the sphere for
 * every choice of lobes and of normals, GGX, Beckmann and a table, smooth and rough, anisotropic and turned,
 * steep and grazing, from both sides and for all index ratios, and of sheared surfaces, mean slopes, mixtures and
 * retroreflection; level 1e-3 for all together. With the mean weight it makes the estimator: the weight
 * is f cos/pdf (test_bsdf_values), and that pdf is the one of the samples. */
#include <stdlib.h>

#include "bsdf/bsdf_case.h"
#include "harness/constants.h"
#include "evidence/measure/statistics.h"
#include "statistics/grid.h"

/* ---- bins of the sphere ---- */

/* 65 of the cosine by 130 of the azimuth from that of the mirrored wi; lost samples (and those that go straight on)
 * are elsewhere. What the integral of the pdf leaves of 1 is what has to be lost. */
enum { SPHERE_PILOTS = 20001 };

typedef struct sphere_map {
    const vndf_bsdf *bsdf;
    double centre;
    double x[3], y[3], z[3]; /* the frame of the mean plane, where densities have an edge */
} sphere_map;

typedef struct sphere_result {
    double p, mass, lost; /* mass: the integral of the pdf; lost: part of the samples */
    size_t classes;
} sphere_result;

static double along(const double axis[3], vndf_vec3 w)
{
    return axis[0] * (double)w.x + axis[1] * (double)w.y + axis[2] * (double)w.z;
}

/* A frame about the mean normal, whose parts are the cosines of the axes. */
static sphere_map sphere_map_of(const vndf_bsdf *bsdf, vndf_vec3 wi)
{
    sphere_map map = {.bsdf = bsdf};
    for (int i = 0; i < 3; i++)
        map.z[i] = (double)vndf_bsdf_cosine(bsdf, (vndf_vec3){(float)(i == 0), (float)(i == 1), (float)(i == 2)});
    double per = 1 / hypot(map.z[0], map.z[2]);
    map.x[0] = map.z[2] * per;
    map.x[2] = -map.z[0] * per;
    for (int i = 0; i < 3; i++)
        map.y[i] = map.z[(i + 1) % 3] * map.x[(i + 2) % 3] - map.z[(i + 2) % 3] * map.x[(i + 1) % 3];
    map.centre = atan2(-along(map.y, wi), -along(map.x, wi));
    return map;
}

/* 0 if the sample is lost. */
static int sphere_draw(const sphere_map *map, unsigned long long *state, double *z, double *phi)
{
    vndf_scattered s;
    float u[3];
    bsdf_numbers(state, u);
    vndf_bsdf_sample(map->bsdf, u, &s);
    *z = fmax(fmin(along(map->z, s.wo), 1 - 1e-7), 1e-7 - 1); /* rounding may bring it to the pole */
    *phi = remainder(atan2(along(map->y, s.wo), along(map->x, s.wo)) - map->centre, 2 * PI);
    return s.lobe == VNDF_LOBE_REFLECTION || s.lobe == VNDF_LOBE_TRANSMISSION;
}

static double sphere_pdf(double z, double phi, const void *of)
{
    const sphere_map *map = of;
    double across = sqrt((1 - z) * (1 + z)), a = across * cos(map->centre + phi), w[3];
    for (int i = 0; i < 3; i++)
        w[i] = a * map->x[i] + across * sin(map->centre + phi) * map->y[i] + z * map->z[i];
    return (double)vndf_bsdf_pdf(map->bsdf, (vndf_vec3){(float)w[0], (float)w[1], (float)w[2]});
}

/* The surface itself is a border of z. */
static void sphere_place(grid *g, const sphere_map *map, unsigned long long *state)
{
    static double z[SPHERE_PILOTS], phi[SPHERE_PILOTS];
    size_t count = 0, nearest = 1;
    grid_even(g, GRID_ROWS, -1, 1, GRID_COLUMNS, -PI, PI);
    for (int i = 0; i < SPHERE_PILOTS; i++)
        count += (size_t)sphere_draw(map, state, &z[count], &phi[count]);
    grid_quantiles(g->x, g->rows, z, count);
    grid_quantiles(g->y, g->columns, phi, count);
    for (size_t i = 1; i < g->rows; i++) /* beside the pole rows would be as narrow as the rounding of z */
        g->x[i] = 1 - fabs(g->x[i]) < 1e-6 ? copysign(1, g->x[i]) : g->x[i];
    for (size_t i = 1; i < g->rows; i++)
        if (fabs(g->x[i]) < fabs(g->x[nearest]))
            nearest = i;
    g->x[nearest] = 0;
}

static sphere_result sphere_test(const vndf_bsdf *bsdf, vndf_vec3 wi, size_t samples, unsigned long long *state)
{
    static grid g;
    sphere_map map = sphere_map_of(bsdf, wi);
    sphere_place(&g, &map, state);
    double mass = grid_expect(&g, sphere_pdf, &map, (double)samples, 0.02 / (double)samples), z, phi;
    for (size_t i = 0; i < samples; i++)
        g.observed[sphere_draw(&map, state, &z, &phi) ? grid_bin(&g, z, phi) : grid_elsewhere(&g)] += 1;
    pearson found = grid_test(&g);
    double lost = g.observed[grid_elsewhere(&g)] / (double)samples;
    return (sphere_result){found.classes > 1 || lost == 1 ? found.p : 0, mass, lost, found.classes};
}

/* ---- subjects ---- */

typedef struct setting {
    float alpha_x, alpha_y, z, phi, eta;
} setting;

static const setting SETTINGS[] = {{0.3f, 0.3f, 0.8f, 0.4f, 1.5f},    {1, 1, -0.5f, 2, 1.33f},
                                   {0.5f, 0.15f, 0.1f, 1, 2.4f},      {0.1f, 0.1f, 1, 0, 1 / 1.5f},
                                   {1, 0.4f, -0.05f, 4, 1 / 2.4f},    {0.7f, 0.7f, 0.6f, 5, 1.001f},
                                   {0.05f, 0.05f, 0.5f, 3, 1 / 1.33f}};
enum { SETTING_COUNT = 7, KIND_COUNT = 3 };

/* Lobes, normals and shapes; Fresnel and masking do not change what is drawn but for the choice of the lobe. */
static int is_tried(const vndf_effects *e)
{
    int turned = e->shape == VNDF_SHAPE_ROTATED;
    vndf_fresnel fresnel = e->lobes == VNDF_LOBES_BOTH || (e->lobes == VNDF_LOBES_REFLECTION && turned)
                               ? VNDF_FRESNEL_DIELECTRIC
                               : VNDF_FRESNEL_NONE;
    vndf_masking masking =
        e->normals == VNDF_NORMALS_V_CAVITY ? VNDF_MASKING_V_CAVITIES : VNDF_MASKING_HEIGHT_CORRELATED;
    return oracle_effects_sensible(e) && e->scattering == VNDF_SCATTERING_SINGLE && e->fresnel == fresnel &&
           e->masking == masking && e->transport == VNDF_TRANSPORT_RADIANCE;
}

/* A sheared and mirrored matrix, a mean slope that leans towards wi, and a second lobe a tenth as wide. */
static void shape_of(vndf_description *is, vndf_vec3 wi, vndf_mixture *lobes)
{
    float lean = wi.z < 0 ? 0.4f : -0.4f;
    is->affine = (vndf_affine){is->distribution,    0.8f * is->alpha_x, 0.5f * is->alpha_y, 0.6f * is->alpha_x,
                               -0.9f * is->alpha_y, lean * wi.x,        lean * wi.y};
    lobes->count = 2;
    lobes->lobe[0] = (vndf_mixture_lobe){is->affine, 0.7f};
    lobes->lobe[1] = (vndf_mixture_lobe){{vndf_ggx(), 0.1f * is->alpha_x, 0, 0, 0.1f * is->alpha_y, 0, 0}, 0.2f};
    is->mixture = lobes;
}

static void test_one(const oracle_ndf *ndf, const vndf_effects *effects, const setting *at,
                     unsigned long long seed, size_t samples, double level)
{
    unsigned long long state = seed * 2654435761u + 99;
    vndf_description is = {.distribution = ndf->distribution,
                           .effects = *effects,
                           .alpha_x = at->alpha_x,
                           .alpha_y = at->alpha_y,
                           .rotation = 0.7f,
                           .eta = at->eta};
    vndf_vec3 wi = oracle_toward((double)at->z, (double)at->phi);
    vndf_mixture lobes;
    vndf_material material;
    vndf_bsdf bsdf;
    if (!oracle_bsdf_two_sided(effects))
        wi.z = fabsf(wi.z);
    shape_of(&is, wi, &lobes);
    TEST(vndf_material_resolve(&is, &material, NULL) == VNDF_OK && vndf_bsdf_at(&bsdf, &material, wi));
    sphere_result r = sphere_test(&bsdf, wi, samples, &state);
    double noise = 5 * sqrt(r.lost * (1 - r.lost) / (double)samples) + 2e-4;
    if (TEST(r.p > level) & TEST_NEAR(r.mass, 1 - r.lost, noise))
        return;
    bsdf_describe(&is, ndf->name, wi, wi);
    fprintf(stderr, "    p %.3g, %lu classes, mass %.7g, lost %.7g\n", r.p, (unsigned long)r.classes, r.mass,
            r.lost);
}

int main(int arguments, char **argument)
{
    static const char *const names[KIND_COUNT] = {"ggx", "beckmann", "student-t-2.5"};
    size_t every = arguments > 2 ? 1 : test_amount(17, 17, 1), done = 0, sets = 0; /* of the settings */
    size_t samples = arguments > 2 ? (size_t)strtoul(argument[2], NULL, 10) : test_amount(30000, 200000, 200000);
    for (size_t i = 0; i < ORACLE_EFFECT_SETS; i++) {
        vndf_effects e = oracle_effects(i);
        sets += (size_t)is_tried(&e);
    }
    double level = statistics_sidak(1e-3, KIND_COUNT * sets * SETTING_COUNT);
    for (size_t n = 0; n < KIND_COUNT; n++) {
        oracle_ndf ndf;
        size_t count = n;
        if (!oracle_wanted(arguments, argument, n, names[n]) || !TEST(oracle_ndf_open(&ndf, names[n])))
            continue;
        for (size_t i = 0; i < ORACLE_EFFECT_SETS; i++) {
            vndf_effects effects = oracle_effects(i);
            for (size_t k = 0; k < SETTING_COUNT && is_tried(&effects); k++)
                if (++count % every == 0)
                    test_one(&ndf, &effects, &SETTINGS[k], ++done + 1000 * n, samples, level);
        }
        oracle_ndf_close(&ndf);
    }
    printf("%lu tests, %lu sets of lobes, normals and shapes\n", (unsigned long)done, (unsigned long)sets);
    return test_done();
}
