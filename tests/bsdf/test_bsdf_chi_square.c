/* Sampled directions follow vndf_bsdf_pdf, and its integral is what is not lost: chi-square over the sphere for every
 * choice of lobes and of normals, GGX, Beckmann and a table, smooth and rough, anisotropic and turned, steep and
 * grazing, from both sides and for all index ratios, and of sheared surfaces, mean slopes, mixtures and
 * retroreflection; level 1e-3 for all together. With the mean weight it makes the estimator: the weight is f cos/pdf
 * (test_bsdf_values), and that pdf is the one of the samples. Of walks, whose density is another, the total variation
 * over the bins is below 0.42, and below 0.05 where alpha is at most 0.1. */
#include "bsdf/bsdf_case.h"
#include "evidence/measure/measure.h"

/* ---- bins of the sphere, even in the cosine and the azimuth, and one for what is in none of them ---- */

enum { SPHERE_ROWS = 24, SPHERE_COLUMNS = 40, SPHERE_BINS = SPHERE_ROWS * SPHERE_COLUMNS };

static size_t sphere_bin(vndf_vec3 w)
{
    const double row = 0.5 * ((double)w.z + 1), column = 0.5 * (atan2((double)w.y, (double)w.x) / PI + 1);
    return (size_t)fmin(fmax(row, 0) * SPHERE_ROWS, SPHERE_ROWS - 1) * SPHERE_COLUMNS +
           (size_t)fmin(column * SPHERE_COLUMNS, SPHERE_COLUMNS - 1);
}

static int sphere_answer(void *of, quadrature_point *at, size_t count)
{
    for (quadrature_point *p = at; p < at + count; p++)
        p->value[0] = (double)vndf_bsdf_pdf(of, oracle_toward(p->x, p->y));
    return 1;
}

/* The integral of the density over every bin, and what they leave of 1 for the last; returns that of all. A cell may
 * err by `allowed`. The first are quarters of bins, since a peak may be narrow; next to the horizon, where rough
 * grazing facets gather what they scatter, those in a narrow belt are apart. */
static double sphere_integrate(const vndf_bsdf *bsdf, double allowed, double probability[SPHERE_BINS + 1])
{
    enum { ROWS = 2 * SPHERE_ROWS, COLUMNS = 2 * SPHERE_COLUMNS, FINE = ROWS * COLUMNS, CELLS_MAX = 100000 };
    static const double BELT = 0.01;
    static quadrature_cell cells[CELLS_MAX];
    static quadrature_sum sum[FINE];
    const quadrature q = {sphere_answer, (void *)bsdf, FINE, CELLS_MAX, allowed, 0, 20, 1, NULL, 0};
    double mass = 0, z[ROWS + 1], phi[COLUMNS + 1];
    for (int i = 0; i <= ROWS; i++)
        z[i] = abs(i - SPHERE_ROWS) == 1 ? (i - SPHERE_ROWS) * BELT : 2.0 * i / ROWS - 1;
    for (int i = 0; i <= COLUMNS; i++)
        phi[i] = 2 * PI * i / COLUMNS - PI;
    memset(probability, 0, (SPHERE_BINS + 1) * sizeof *probability);
    if (!TEST(quadrature_run(&q, cells, bins_cells(z, ROWS, phi, COLUMNS, 0, cells), sum)))
        return NAN;
    for (size_t i = 0; i < FINE; i++) {
        probability[i / COLUMNS / 2 * SPHERE_COLUMNS + i % COLUMNS / 2] += sum[i].value;
        mass += sum[i].value;
    }
    probability[SPHERE_BINS] = fmax(1 - mass, 0);
    return mass;
}

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
    return oracle_effects_sensible(e) && e->fresnel == fresnel && e->masking == masking &&
           e->transport == VNDF_TRANSPORT_RADIANCE;
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
    double apart = 0, lost = observed[SPHERE_BINS] / samples, noise = 5 * sqrt(lost * (1 - lost) / samples) + 2e-4;
    for (size_t i = 0; i <= SPHERE_BINS; i++)
        apart += 0.5 * fabs(expected[i] - observed[i]) / samples;
    const int is_walk = bsdf->material->is.effects.scattering == VNDF_SCATTERING_MULTIPLE;
    if (TEST(is_walk ? apart < (bsdf->own.surface.xx > 0.1f ? 0.42 : 0.05)
                     : lost == 1 || (found.classes > 1 && found.p > level)) &
        TEST_NEAR(mass, 1 - lost, noise))
        return;
    bsdf_describe(&bsdf->material->is, "", wi, wi);
    fprintf(stderr, "    p %.3g, %lu classes, mass %.7g, lost %.7g, distance %.3g\n", found.p,
            (unsigned long)found.classes, mass, lost, apart);
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
                if (++count % every == 0 || (count % 3 == 0 && (effects.normals == VNDF_NORMALS_BOUNDED ||
                                                                effects.scattering == VNDF_SCATTERING_MULTIPLE)))
                    test_one(&ndf, &effects, &SETTINGS[k], ++done + 1000 * n, samples, level);
        }
        oracle_ndf_close(&ndf);
    }
    printf("%lu tests, %lu sets of lobes, normals and shapes\n", (unsigned long)done, (unsigned long)sets);
    return test_done();
}
