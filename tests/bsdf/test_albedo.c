/* Albedos are right: look-ups are the mean weight of samples of the BSDF (test_bsdf_values has these against the
 * oracle) within 1e-3 for mirrors and 1.5e-2 for glass, over an even set of uniform numbers that is not the builder's,
 * for closed forms and tables, from both sides; and what is known exactly: E = 1 - log 2 for GGX of alpha 1 from
 * straight above (integral of u/(1 + u) from 0 to 1, u = cos_o), E = 1 at grazing incidence and in the limit of no
 * roughness. Averages are integrals of the look-ups; any numbers give results in [0, 1]. What cannot be built is
 * refused. Notices a missing shadow, F that is not that of the side, weights of nodes that do not add up to 1. */
#include "bsdf/bsdf_case.h"

/* Of each normal both lobes are looked at, the third number being 0 and 1. */
static double by_samples(const oracle_ndf *ndf, double cosine, double alpha, double eta)
{
    const int count = (int)test_amount(20000, 20000, 30000);
    const vndf_vec3 wi = oracle_toward(cosine, 0);
    vndf_description is = {.distribution = ndf->distribution, .eta = (float)eta, .wavelengths = 1};
    vndf_material material;
    vndf_bsdf bsdf;
    double sum = 0, index = cosine > 0 ? eta : 1 / eta;
    is.alpha_x = is.alpha_y = (float)alpha;
    is.effects.transport = VNDF_TRANSPORT_IMPORTANCE;
    is.effects.lobes = eta > 0 ? VNDF_LOBES_BOTH : VNDF_LOBES_REFLECTION;
    is.effects.fresnel = eta > 0 ? VNDF_FRESNEL_DIELECTRIC : VNDF_FRESNEL_NONE;
    TEST(vndf_material_resolve(&is, &material, NULL) == VNDF_OK && vndf_bsdf_at(&bsdf, &material, wi));
    for (int i = 0; i < count; i++)
        for (int lobe = 0; lobe < (eta > 0 ? 2 : 1); lobe++) {
            const double x = 0.7548776662466927 * i, y = 0.5698402909980532 * i; /* an even set: plastic number */
            const float u[3] = {(float)(x - floor(x)), (float)(y - floor(y)), (float)lobe};
            vndf_scattered s;
            vndf_bsdf_sample(&bsdf, u, &s);
            double facing = (double)wi.x * s.wm.x + (double)wi.y * s.wm.y + (double)wi.z * s.wm.z;
            double f = eta > 0 ? (double)oracle_fresnel((long double)facing, (long double)index, 0) : 1;
            if (s.lobe == (lobe ? VNDF_LOBE_TRANSMISSION : VNDF_LOBE_REFLECTION))
                sum += (double)s.weight[0] * (lobe ? 1 - f : f);
        }
    return sum / count;
}

/* By the midpoint rule over roots of the cosine. */
static double average_of(const vndf_albedo *albedo, float alpha, float side)
{
    const int cells = 20000;
    double sum = 0;
    for (int i = 0; i < cells; i++) {
        double root = (i + 0.5) / cells, cosine = root * root;
        sum += 4 * root * cosine / cells * (double)vndf_albedo_directional(albedo, side * (float)cosine, alpha);
    }
    return sum;
}

static void test_places(const oracle_ndf *ndf, float eta, double most)
{
    const double set = 3e-4; /* the error of the even set */
    unsigned long long state = 31;
    vndf_albedo *albedo = vndf_albedo_build(ndf->distribution, eta, NULL);
    double worst = 0;
    if (!TEST(albedo != NULL))
        return;
    for (size_t i = 0; i < test_amount(20, 40, 80); i++) {
        double u = test_uniform_double(&state), v = test_uniform_double(&state);
        double alpha = eta > 0 ? 0.05 + 0.95 * u : 0.01 + 3.99 * u * u, cosine = i % 3 ? v : v * v * v;
        cosine = fmax(cosine, 1e-4 * alpha) * (eta > 0 && i % 2 ? -1 : 1);
        double want = by_samples(ndf, cosine, alpha, (double)eta);
        double off = fabs((double)vndf_albedo_directional(albedo, (float)cosine, (float)alpha) - want);
        if (!TEST(off <= most + set))
            fprintf(stderr, "  %s, cosine %g, alpha %g: off by %g\n", ndf->name, cosine, alpha, off);
        worst = fmax(worst, off);
    }
    for (float alpha = 0.01f; alpha < 4; alpha *= 2.3f) {
        TEST_NEAR((double)vndf_albedo_directional(albedo, 0, alpha), 1, eta > 0 ? 1 : 1e-4);
        for (int side = 1; side >= (eta > 0 ? -1 : 1); side -= 2)
            TEST_NEAR((double)vndf_albedo_average(albedo, alpha, side), average_of(albedo, alpha, (float)side),
                      2e-4);
    }
    TEST_NEAR((double)vndf_albedo_directional(albedo, 0.5f, 1e-5f), 1, 1e-3);
    if (ndf->distribution == vndf_ggx() && eta == 0)
        TEST_NEAR((double)vndf_albedo_directional(albedo, 1, 1), 1 - log(2), 3e-4);
    printf("%s, eta %g: at most %.2g from samples\n", ndf->name, (double)eta, worst);
    vndf_albedo_free(albedo);
}

static void test_any_numbers(float eta)
{
    static const float odd[] = {0,    -0.0f, 1e-45f, 1e-38f,   1e-7f,     0.3f,    1,   1.0000001f, 4,
                                4.5f, 1e30f, -1,     INFINITY, -INFINITY, -1e-30f, NAN, -0.5f};
    const int count = sizeof odd / sizeof *odd;
    vndf_albedo *albedo = vndf_albedo_build(vndf_beckmann(), eta, NULL);
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++) {
            float e = vndf_albedo_directional(albedo, odd[i], odd[j]),
                  mean = vndf_albedo_average(albedo, odd[j], i - 8);
            TEST(e >= 0 && e <= 1 && mean >= 0 && mean <= 1);
        }
    TEST(vndf_albedo_directional(albedo, 0.5f, 9) == vndf_albedo_directional(albedo, 0.5f, 4));
    TEST(vndf_albedo_directional(albedo, 7, -9) == vndf_albedo_directional(albedo, 1, 0));
    TEST(vndf_albedo_directional(albedo, NAN, 0.5f) == vndf_albedo_directional(albedo, 0, 0.5f));
    TEST((vndf_albedo_directional(albedo, -0.3f, 1) == vndf_albedo_directional(albedo, 0.3f, 1)) == (eta == 0));
    TEST_NEAR((double)vndf_albedo_directional(albedo, 0.7f, 0), 1, 1e-5);
    vndf_albedo_free(albedo);
}

static void test_refusals(void)
{
    static const float etas[] = {1, 1.0005f, -1.5f, 0.001f, 101, NAN, INFINITY};
    vndf_error error = {VNDF_OK, ""};
    for (int i = 0; i < 7; i++) {
        TEST(!vndf_albedo_build(vndf_ggx(), etas[i], &error) && !vndf_albedo_build(vndf_ggx(), etas[i], NULL));
        TEST_HAS(error.message, "farther than 0.001 from 1");
    }
    TEST(!vndf_albedo_build(NULL, 0, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST(vndf_albedo_directional(NULL, 0.5f, 0.5f) == 1 && vndf_albedo_average(NULL, 0.5f, 1) == 1);
    vndf_albedo_free(NULL);
}

int main(int arguments, char **argument)
{
    static const char *const names[] = {"ggx",      "hazy",    "student-t-1.8",
                                        "beckmann", "gtr-1.5", "student-t-2.5-small"};
    if (oracle_wanted(arguments, argument, 0, "numbers")) {
        test_any_numbers(0);
        test_any_numbers(1.5f);
        test_refusals();
    }
    for (size_t i = 0; i < test_amount(1, 3, 6); i++) {
        oracle_ndf ndf;
        if (!oracle_wanted(arguments, argument, i + 1, names[i]) || !TEST(oracle_ndf_open(&ndf, names[i])))
            continue;
        test_places(&ndf, 0, 1e-3);
        if (test_long() || i < 2)
            test_places(&ndf, 1.5f, 1.5e-2);
        oracle_ndf_close(&ndf);
    }
    return test_done();
}
