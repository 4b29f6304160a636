/* Sampled directions follow vndf_bsdf_pdf, and its integral is what is not lost: chi-square over the sphere for
 * every choice of lobes and of normals, GGX, Beckmann and a table, smooth and rough, anisotropic and turned,
 * steep and grazing, from both sides and for all index ratios, and of sheared surfaces, mean slopes, mixtures and
 * retroreflection; level 1e-3 for all together. With the mean weight it makes the estimator: the weight
 * is f cos/pdf (test_bsdf_values), and that pdf is the one of the samples. */
#include "bsdf/bsdf_case.h"
#include "bsdf/sphere.h"

/* ---- subjects ---- */

typedef struct setting {
    float alpha_x, alpha_y, z, phi, eta;
} setting;

static const setting SETTINGS[] = {{0.3f, 0.3f, 0.8f, 0.4f, 1.5f},    {1, 1, -0.5f, 2, 1.33f},
                                   {0.5f, 0.15f, 0.1f, 1, 2.4f},      {0.1f, 0.1f, 1, 0, 1 / 1.5f},
                                   {1, 0.4f, -0.05f, 4, 1 / 2.4f},    {0.7f, 0.7f, 0.6f, 5, 1.1f},
                                   {0.05f, 0.05f, 0.5f, 3, 1 / 1.33f}};
enum { SETTING_COUNT = 7, KIND_COUNT = 3 };

/* Lobes, normals and shapes; Fresnel and masking do not change what is drawn but for the choice of the lobe. */
static int is_tried(const vndf_effects *e)
{
    int leans = e->shape == VNDF_SHAPE_TILTED;
    vndf_fresnel fresnel = e->lobes == VNDF_LOBES_BOTH || (e->lobes == VNDF_LOBES_REFLECTION && leans)
                               ? VNDF_FRESNEL_DIELECTRIC
                               : VNDF_FRESNEL_NONE;
    vndf_masking masking =
        e->normals == VNDF_NORMALS_V_CAVITY ? VNDF_MASKING_V_CAVITIES : VNDF_MASKING_HEIGHT_CORRELATED;
    return oracle_effects_sensible(e) && e->scattering == VNDF_SCATTERING_SINGLE && e->fresnel == fresnel &&
           e->masking == masking && e->transport == VNDF_TRANSPORT_RADIANCE;
}

/* Roughness, every third time turned; else a sheared and mirrored matrix, with a mean slope that leans towards wi; and
 * a second lobe a tenth as wide. */
static void shape_of(vndf_description *is, const oracle_ndf *ndf, const setting *at, vndf_vec3 wi,
                     unsigned long long seed, vndf_mixture *lobes)
{
    const float lean = wi.z < 0 ? 0.4f : -0.4f, x = at->alpha_x, y = at->alpha_y;
    const vndf_surface rough = vndf_rough(ndf->distribution, x, y),
                       sheared = {rough.distribution, 0.8f * x,    0.5f * y,   0.6f * x,
                                  -0.9f * y,          lean * wi.x, lean * wi.y};
    const int kind = is->effects.shape == VNDF_SHAPE_LEVEL ? (int)(seed % 3) : 2;
    is->surface = kind == 0 ? rough : kind == 1 ? vndf_rotated(rough, cosf(0.7f), sinf(0.7f)) : sheared;
    *lobes = (vndf_mixture){2, {{sheared, 0.7f}, {vndf_rough(vndf_ggx(), 0.1f * x, 0.1f * y), 0.2f}}};
    is->mixture = lobes;
}

/* Lost samples, and those that go straight on, are elsewhere: what the integral of the pdf leaves of 1. */
static void test_hit(const vndf_bsdf *bsdf, vndf_vec3 wi, unsigned long long seed, double samples, double level)
{
    double expected[SPHERE_BINS + 1], observed[SPHERE_BINS + 1] = {0};
    unsigned long long state = seed * 2654435761u + 99;
    const double mass = sphere_integrate(bsdf, 0.02 / samples, expected);
    for (size_t i = 0; i <= SPHERE_BINS; i++)
        expected[i] *= samples;
    for (double i = 0; i < samples; i++) {
        vndf_scattered s;
        float u[3];
        bsdf_numbers(&state, u);
        vndf_bsdf_sample(bsdf, u, &s);
        int kept = s.lobe == VNDF_LOBE_REFLECTION || s.lobe == VNDF_LOBE_TRANSMISSION;
        observed[kept ? sphere_bin(s.wo) : SPHERE_BINS] += 1;
    }
    pearson found = pearson_of(expected, observed, SPHERE_BINS + 1);
    double lost = observed[SPHERE_BINS] / samples, noise = 5 * sqrt(lost * (1 - lost) / samples) + 2e-4;
    if (TEST(lost == 1 || (found.classes > 1 && found.p > level)) & TEST_NEAR(mass, 1 - lost, noise))
        return;
    bsdf_describe(&bsdf->material->is, "", wi, wi);
    fprintf(stderr, "    p %.3g, %lu classes, mass %.7g, lost %.7g\n", found.p, (unsigned long)found.classes, mass,
            lost);
}

static void test_one(const oracle_ndf *ndf, const vndf_effects *effects, const setting *at,
                     unsigned long long seed, double samples, double level)
{
    vndf_description is = {.effects = *effects, .eta = at->eta};
    vndf_vec3 wi = oracle_toward((double)at->z, (double)at->phi);
    vndf_mixture lobes;
    vndf_material material;
    vndf_bsdf bsdf;
    if (!oracle_bsdf_two_sided(effects))
        wi.z = fabsf(wi.z);
    shape_of(&is, ndf, at, wi, seed, &lobes);
    if (TEST(vndf_material_resolve(&is, &material, NULL) == VNDF_OK && vndf_bsdf_at(&bsdf, &material, wi)))
        test_hit(&bsdf, wi, seed, samples, level);
}

int main(int arguments, char **argument)
{
    static const char *const names[KIND_COUNT] = {"ggx", "beckmann", "student-t-2.5"};
    double samples = arguments > 2 ? strtod(argument[2], NULL) : (double)test_amount(30000, 50000, 200000);
    size_t every = arguments > 2 ? 1 : 17, done = 0, sets = 0; /* of the settings */
    for (size_t i = 0; i < ORACLE_EFFECT_SETS; i++) {
        vndf_effects e = oracle_effects(i);
        sets += (size_t)is_tried(&e);
    }
    double level = statistics_sidak(1e-3, KIND_COUNT * sets * SETTING_COUNT);
    oracle_ndf ndf;
    for (size_t n = 0; bsdf_next(&n, &ndf, names, KIND_COUNT, arguments, argument); n++) {
        size_t count = n;
        for (size_t i = 0; i < ORACLE_EFFECT_SETS; i++) {
            vndf_effects effects = oracle_effects(i);
            for (size_t k = 0; k < SETTING_COUNT && is_tried(&effects); k++)
                if (++count % every == 0 || (effects.normals == VNDF_NORMALS_BOUNDED && count % 3 == 0))
                    test_one(&ndf, &effects, &SETTINGS[k], ++done + 1000 * n, samples, level);
        }
        oracle_ndf_close(&ndf);
    }
    printf("%lu tests, %lu sets of lobes, normals and shapes\n", (unsigned long)done, (unsigned long)sets);
    return test_done();
}
