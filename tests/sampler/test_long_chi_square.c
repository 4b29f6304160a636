/* Samples follow the density that is returned with them at 64 Mi samples and more, and it integrates to 1 within
 * 2e-6: chi-square over 130 x 65 bins at 0 to 130 degrees, isotropic, anisotropic and turned. One run is of one
 * subject, so that ctest can run several at once:
 *
 *     test_long_chi_square SUBJECT SAMPLES SUBJECTS
 *
 * SUBJECT is a table's file (NAME.vndf), ggx, beckmann, or P22 as an expression in r; the level of 0.01 is for
 * all SUBJECTS together. */
#include <stdlib.h>

#include "measure/chi_square.h"
#include "oracle/oracle_validate.h"
#include "measure/statistics.h"
#include "harness/test.h"

typedef struct setting {
    float alpha_x, alpha_y;
    double phi;
} setting;

static const setting SETTINGS[] = {{1, 1, 0}, {0.05f, 0.4f, 0}, {0.05f, 0.4f, 55}};
static const double ANGLES[] = {0, 30, 60, 80, 85, 89, 89.9, 130};
enum { SETTING_COUNT = 3, ANGLE_COUNT = 8 };

/* Where less than 1e-10 of the area at grazing incidence is left, tables are valid but promise no accuracy. */
static double mass_error(const vndf_surface *surface, double theta, double phi)
{
    float area = vndf_projected_area(surface, oracle_direction(theta, phi));
    return area > 1e-10f * vndf_projected_area(surface, oracle_direction(90, phi)) ? 2e-6 : 1e-4;
}

static void test_view(const vndf_distribution *d, setting with, double theta, size_t samples, uint64_t seed,
                      double level)
{
    chi_square result;
    vndf_surface surface = {d, with.alpha_x, with.alpha_y};
    TEST(chi_square_test(&surface, oracle_direction(theta, with.phi), samples, seed, &result));
    int good = TEST(result.p > level) & TEST(result.unclaimed == 0 || result.blind);
    good &= TEST(result.blind || fabs(result.mass - 1) < mass_error(&surface, theta, with.phi));
    fprintf(stderr, "%s alpha %g %g, theta %g, phi %g: p %.3g, mass - 1 %.2e%s\n", good ? " " : "!",
            (double)with.alpha_x, (double)with.alpha_y, theta, with.phi, result.p, result.mass - 1,
            result.blind ? ", sees nothing" : "");
}

static vndf_distribution *table_of(const char *subject, vndf_error *error)
{
    size_t n = strlen(subject);
    if (n > 5 && strcmp(subject + n - 5, ".vndf") == 0)
        return vndf_load(subject, error);
    return oracle_build_of(subject, 0, NULL, error);
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: test_long_chi_square FILE.vndf|ggx|beckmann|EXPRESSION SAMPLES SUBJECTS\n");
        return 2;
    }
    vndf_error error = {VNDF_OK, ""};
    int ggx = strcmp(argv[1], "ggx") == 0, closed = ggx || strcmp(argv[1], "beckmann") == 0;
    vndf_distribution *table = closed ? NULL : table_of(argv[1], &error);
    const vndf_distribution *d = closed ? ggx ? vndf_ggx() : vndf_beckmann() : table;
    double level = statistics_sidak(0.01, strtoul(argv[3], NULL, 10) * SETTING_COUNT * ANGLE_COUNT);
    size_t samples = strtoul(argv[2], NULL, 10);
    if (!TEST(d != NULL))
        fprintf(stderr, "%s: %s\n", argv[1], error.message);
    for (size_t i = 0; d && i < SETTING_COUNT * ANGLE_COUNT; i++)
        test_view(d, SETTINGS[i / ANGLE_COUNT], ANGLES[i % ANGLE_COUNT], samples, 1000 + i, level);
    vndf_free(table);
    return test_done();
}
