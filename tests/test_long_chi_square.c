/* Samples follow the density that is returned with them at 64 Mi samples: chi-square over 130 x 65 bins, isotropic,
 * anisotropic and turned, above and below the horizon, at level 0.01 for all together. */
#include "chi_square.h"
#include "oracle_survey.h"
#include "statistics.h"
#include "test.h"

typedef struct setting {
    float alpha_x, alpha_y;
    double theta, phi;
} setting;

static const setting SETTINGS[] = {{1, 1, 0, 0}, {0.05f, 0.4f, 30, 55}, {1e-3f, 1, 80, 0},
                                   {0.5f, 0.5f, 89.9, 200}, {1, 1, 130, 77}};
enum { SETTING_COUNT = 5, KIND_COUNT = 4 };
static const size_t KINDS[KIND_COUNT] = {ORACLE_GGX, ORACLE_MEASURED, ORACLE_HAZE, ORACLE_RING};

static void test_table(const oracle *o, uint64_t seed)
{
    double level = statistics_sidak(0.01, SETTING_COUNT * KIND_COUNT);
    vndf_distribution *table = oracle_build(o, 0, NULL);
    for (size_t i = 0; TEST(table != NULL) && i < SETTING_COUNT; i++) {
        chi_square result;
        vndf_surface surface = {table, SETTINGS[i].alpha_x, SETTINGS[i].alpha_y};
        vndf_vec3 wi = oracle_direction(SETTINGS[i].theta, SETTINGS[i].phi);
        TEST(chi_square_test(&surface, wi, oracle_quick() ? 1 << 22 : 1 << 26, seed + i, &result));
        int good = TEST(result.p > level) & TEST(result.unclaimed == 0);
        fprintf(stderr, "%s %s, alpha %g %g, theta %g: p %.3g, mass %.9g\n", good ? " " : "!", oracle_name(o),
                surface.alpha_x,
                surface.alpha_y, SETTINGS[i].theta, result.p, result.mass);
    }
    vndf_free(table);
}

int main(void)
{
    for (size_t i = 0; i < KIND_COUNT; i++) {
        oracle o = oracle_get(KINDS[i]);
        test_table(&o, 1000 + 10 * i);
    }
    return test_done();
}
