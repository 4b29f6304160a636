/* Samples follow the density that is returned with them: chi-square over 130 x 65 bins at 1e6 samples, closed
 * forms and tables, isotropic, anisotropic and turned, at level 0.01 for all together, and the density integrates
 * to 1 within 2e-6 (measured: 3e-7). */
#include "measure/chi_square.h"
#include "oracle/oracle_validate.h"
#include "measure/statistics.h"
#include "harness/test.h"

typedef struct setting {
    float alpha_x, alpha_y;
    double theta, phi;
} setting;

static const setting SETTINGS[] = {
    {1, 1, 30, 0}, {0.05f, 0.4f, 80, 55}, {1e-3f, 1, 60, 0}, {0.5f, 0.5f, 120, 200}};
enum { SETTING_COUNT = 4, SUBJECT_COUNT = 5 };

static void test_subject(const vndf_distribution *d, const char *name, uint64_t seed, size_t first)
{
    double level = statistics_sidak(0.01, SETTING_COUNT * SUBJECT_COUNT);
    size_t samples = test_amount(200000, 1000000, 1000000);
    for (size_t i = first; TEST(d != NULL) && i < SETTING_COUNT; i += test_amount(1, 2, 1)) {
        chi_square result;
        vndf_surface surface = {d, SETTINGS[i].alpha_x, SETTINGS[i].alpha_y};
        vndf_vec3 wi = oracle_direction(SETTINGS[i].theta, SETTINGS[i].phi);
        TEST(chi_square_test(&surface, wi, samples, seed + i, &result));
        int good = TEST(result.p > level) & TEST(result.unclaimed == 0) &
                   TEST(result.blind || fabs(result.mass - 1) < 2e-6);
        if (!good)
            fprintf(stderr, "  %s, alpha %g %g, theta %g: p %.3g, mass %.9g, %lu unclaimed\n", name,
                    surface.alpha_x, surface.alpha_y, SETTINGS[i].theta, result.p, result.mass,
                    (unsigned long)result.unclaimed);
    }
}

int main(int arguments, char **argument)
{
    const size_t kinds[] = {ORACLE_STUDENT, ORACLE_HAZE, ORACLE_RING};
    if (oracle_wanted(arguments, argument, 0, "ggx"))
        test_subject(vndf_ggx(), "closed ggx", 100, 0);
    if (oracle_wanted(arguments, argument, 1, "beckmann"))
        test_subject(vndf_beckmann(), "closed beckmann", 200, test_amount(0, 1, 0));
    for (size_t i = 0; i < 3; i++) {
        oracle o = oracle_get(kinds[i]);
        if (!oracle_wanted(arguments, argument, i + 2, oracle_name(&o)))
            continue;
        vndf_distribution *table = oracle_build(&o, i == 1 ? 2048 : 0, NULL);
        test_subject(table, oracle_name(&o), 300 + 100 * i, test_amount(0, i % 2, 0));
        vndf_free(table);
    }
    return test_done();
}
