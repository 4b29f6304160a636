/* A table of albedos keeps what it says of itself: at random places no look-up is farther from the quadrature than
 * 1.25 times the stated error and 2e-5, averages are integrals of the look-ups, parts add up to the whole, results
 * are in [0, 1] for any numbers, E falls with roughness from straight above, both sides of a dielectric pass the
 * same light; the bits of a table are the same with every compiler; errors stay within the figures that
 * vndf_albedo.h promises; and what cannot be built is refused. */
#include "bsdf/albedo/albedo.h"
#include "bsdf/albedo/quadrature.h"
#include "harness/hash.h"
#include "harness/test.h"
#include "oracle/oracle.h"

/* ---- against the quadrature ---------------------------------------------------------------------- */

static void test_random_places(const vndf_albedo *albedo, const vndf_distribution *d, const char *name)
{
    vndf_albedo_properties is = vndf_albedo_info(albedo);
    size_t places = test_amount(150, 400, 4000);
    unsigned long long state = 31;
    vndf_quadrature q;
    if (!TEST(vndf_quadrature_of(&q, d, 1)))
        return;
    double worst = 0;
    for (size_t i = 0; i < places; i++) {
        double u = test_uniform_double(&state), v = test_uniform_double(&state);
        float alpha = (float)(4 * u * u), cosine = (float)(i % 3 ? v : v * v * v);
        double side = is.eta > 0 && i % 2 ? -1 : 1, eta = side < 0 ? 1 / (double)is.eta : (double)is.eta;
        if (alpha < 1e-4f || cosine < 2e-5f * alpha)
            continue;
        vndf_parts p = vndf_quadrature_albedo(&q, (double)cosine, (double)alpha, eta);
        double got = (double)vndf_albedo_directional(albedo, (float)side * cosine, alpha);
        double off = fabs(got - p.reflected - p.transmitted);
        if (!TEST(off <= 1.25 * (double)is.error + 2e-5))
            fprintf(stderr, "  %s, cosine %g, alpha %g: off by %g, stated %g\n", name, side * (double)cosine,
                    (double)alpha, off, (double)is.error);
        worst = fmax(worst, off);
    }
    printf(
        "%s, eta %g: at most %.2g off, stated %.2g, %.2g for alpha 0.05 to 1; of a part %.2g there; averages %.1g; "
        "quadrature %.1g; %d values\n",
        name, (double)is.eta, worst, (double)is.error, (double)is.error_usual, (double)is.split_usual,
        (double)is.average_error, (double)is.quadrature_error, (int)is.values);
    vndf_quadrature_free(&q);
}

/* By the midpoint rule over roots of the cosine. */
static double average_of(const vndf_albedo *albedo, double alpha, double side)
{
    const int cells = 20000;
    double sum = 0;
    for (int i = 0; i < cells; i++) {
        double root = (i + 0.5) / cells, cosine = root * root;
        sum += 4 * root * cosine / cells *
               (double)vndf_albedo_directional(albedo, (float)(side * cosine), (float)alpha);
    }
    return sum;
}

static void test_averages(const vndf_albedo *albedo)
{
    vndf_albedo_properties is = vndf_albedo_info(albedo);
    for (double alpha = 0.01; alpha < 4; alpha *= 1.7)
        for (int side = 1; side >= (is.eta > 0 ? -1 : 1); side -= 2) {
            double average = (double)vndf_albedo_average(albedo, (float)alpha, side);
            TEST_NEAR(average, average_of(albedo, alpha, side), 1.5 * (double)is.average_error + 2e-6);
            vndf_albedo_parts parts = vndf_albedo_average_split(albedo, (float)alpha, side);
            TEST_NEAR((double)(parts.reflected + parts.transmitted), average, 2e-7);
        }
}

/* What passes from above is eta^2 times what passes from below, within the errors of the parts. */
static void test_reciprocity(const vndf_albedo *albedo)
{
    double eta = (double)vndf_albedo_info(albedo).eta;
    for (double alpha = 0.1; alpha < 2; alpha *= 1.5) {
        double above = (double)vndf_albedo_average_split(albedo, (float)alpha, 1).transmitted;
        double below = (double)vndf_albedo_average_split(albedo, (float)alpha, -1).transmitted;
        TEST_NEAR(above / eta, below * eta, 1e-4);
    }
}

/* ---- any numbers --------------------------------------------------------------------------------- */

static int is_part(float x)
{
    return x >= 0 && x <= 1;
}

static void test_any_numbers(const vndf_albedo *albedo)
{
    static const float odd[] = {0,    -0.0f, 1e-45f, 1e-38f,   1e-7f,     0.3f,    1,   1.0000001f, 4,
                                4.5f, 1e30f, -1,     INFINITY, -INFINITY, -1e-30f, NAN, -0.5f};
    const int count = sizeof odd / sizeof *odd;
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++) {
            float whole = vndf_albedo_directional(albedo, odd[i], odd[j]);
            vndf_albedo_parts parts = vndf_albedo_split(albedo, odd[i], odd[j]);
            TEST(is_part(whole) && is_part(parts.reflected) && is_part(parts.transmitted));
            TEST(fabsf(parts.reflected + parts.transmitted - whole) <= 2e-7f);
            TEST(is_part(vndf_albedo_average(albedo, odd[j], (int)i - 8)));
        }
    TEST(vndf_albedo_directional(albedo, 0.5f, 9) == vndf_albedo_directional(albedo, 0.5f, 4));
    TEST(vndf_albedo_directional(albedo, 0.5f, -9) == vndf_albedo_directional(albedo, 0.5f, 0));
    TEST(vndf_albedo_directional(albedo, 7, 0.5f) == vndf_albedo_directional(albedo, 1, 0.5f));
    TEST(vndf_albedo_directional(albedo, NAN, 0.5f) == vndf_albedo_directional(albedo, 0, 0.5f));
}

static void test_mirror(const vndf_albedo *albedo)
{
    float before = 1;
    for (float alpha = 0; alpha <= 4; alpha += 0.01f) {
        float straight = vndf_albedo_directional(albedo, 1, alpha);
        TEST(straight <= before + 1e-4f);
        TEST_NEAR((double)vndf_albedo_directional(albedo, 0, alpha), 1, 1e-4);
        TEST(vndf_albedo_directional(albedo, -0.3f, alpha) == vndf_albedo_directional(albedo, 0.3f, alpha));
        TEST(vndf_albedo_split(albedo, 0.3f, alpha).transmitted == 0);
        before = straight;
    }
    TEST_NEAR((double)vndf_albedo_directional(albedo, 0.7f, 0), 1, 5e-6); /* areas are floats */
}

/* ---- the whole ----------------------------------------------------------------------------------- */

static void test_subject(const char *name, float eta, float most)
{
    vndf_albedo_options options = {.eta = eta};
    vndf_distribution *table = NULL;
    const vndf_distribution *d = strcmp(name, "ggx") == 0 ? vndf_ggx() : vndf_beckmann();
    if (strcmp(name, "ggx") != 0 && strcmp(name, "beckmann") != 0)
        d = table = oracle_shipped(name);
    if (eta > 0 && !test_long()) {
        options.columns = 24;
        options.rows = 16;
    }
    vndf_albedo *albedo = vndf_albedo_build(d, &options, NULL);
    if (TEST(albedo)) {
        vndf_albedo_properties is = vndf_albedo_info(albedo);
        TEST(is.error_usual <= most && is.error_usual <= is.error && is.split_usual <= is.split_error);
        TEST(is.split_usual <= 8 * most);
        TEST(is.quadrature_error < 3e-4f && is.average_error < 1e-4f);
        TEST(strcmp(is.source, vndf_distribution_info(d).source) == 0);
        test_random_places(albedo, d, name);
        test_averages(albedo);
        test_any_numbers(albedo);
        if (eta > 0)
            test_reciprocity(albedo);
        else
            test_mirror(albedo);
    }
    vndf_albedo_free(albedo);
    vndf_free(table);
}

/* The builder has no function of the C library but sqrt: bits are the same wherever it was compiled. */
static void test_bits(void)
{
    vndf_albedo_options options = {.eta = 1.5f, .columns = 8, .rows = 8};
    vndf_albedo *albedo = vndf_albedo_build(vndf_beckmann(), &options, NULL);
    unsigned long long hash = hash_begin;
    if (!TEST(albedo))
        return;
    for (size_t i = 0; i < albedo->is.values; i++)
        hash = hash_float(hash, albedo->value[i]);
    hash = hash_float(hash, albedo->is.error);
    if (!TEST(hash == 0x668FCAE92E55F136ULL))
        fprintf(stderr, "  the hash is 0x%llX\n", hash);
    vndf_albedo_free(albedo);
}

/* ---- what is refused ----------------------------------------------------------------------------- */

static void refused(const vndf_distribution *d, vndf_albedo_options options, const char *why)
{
    vndf_error error = {VNDF_OK, ""};
    TEST(!vndf_albedo_build(d, &options, &error));
    TEST(error.status == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, why);
    TEST(!vndf_albedo_build(d, &options, NULL));
}

static int stop_late(double done, const char *what, void *user)
{
    (void)what;
    *(int *)user += 1;
    return done > 0.7;
}

static void test_refusals(void)
{
    static const float etas[] = {1, 1.0005f, -1.5f, 0.001f, 101, NAN, INFINITY};
    for (int i = 0; i < 7; i++)
        refused(vndf_ggx(), (vndf_albedo_options){.eta = etas[i]}, "eta");
    refused(vndf_ggx(), (vndf_albedo_options){.columns = 7}, "7 columns");
    refused(vndf_ggx(), (vndf_albedo_options){.rows = 129}, "129 rows");
    refused(NULL, (vndf_albedo_options){0}, "NULL");
    int calls = 0;
    refused(vndf_ggx(), (vndf_albedo_options){.progress = stop_late, .progress_user = &calls}, "interrupted");
    TEST(calls > 20);
    TEST(vndf_albedo_directional(NULL, 0.5f, 0.5f) == 1 && vndf_albedo_average(NULL, 0.5f, 1) == 1);
    TEST(vndf_albedo_info(NULL).values == 0 && vndf_albedo_info(NULL).source[0] == '\0');
    vndf_albedo_free(NULL);
}

int main(int arguments, char **argument)
{
    static const struct subject {
        const char *name;
        float eta, most;
    } subjects[] = {
        {"ggx", 0, 1e-3f},          {"beckmann", 0, 1e-3f}, {"student-t-1.8", 0, 1e-3f},
        {"sgd-nickel-g", 0, 1e-3f}, {"ggx", 1.5f, 8e-3f},   {"beckmann", 0.75f, 8e-3f},
    };
    if (oracle_wanted(arguments, argument, 0, "bits"))
        test_bits();
    if (oracle_wanted(arguments, argument, 1, "refusals"))
        test_refusals();
    for (size_t i = 0; i < sizeof subjects / sizeof *subjects; i++)
        if (oracle_wanted(arguments, argument, i + 2, subjects[i].name))
            test_subject(subjects[i].name, subjects[i].eta, subjects[i].most);
    return test_done();
}
