/* A table of 16 KiB is as close to the truth as promised: total variation at most 1e-3 (1e-2 for a ring and a
 * jump) and area error at most 2e-6 at every angle, and the certificate says the same within 20%.
 *
 * Promises hold where the area exceeds 1e-10 of its value at grazing incidence, as the header says. The sums of
 * the grid have an error of about 2% of the total variation, and the float direction is taken as it is, so the
 * area's error includes rounding of the direction by the library. */
#include "oracle_survey.h"
#include "test.h"

static const double ANGLES[] = {0, 30, 60, 80, 85, 89, 89.9, 90, 100, 130};

static int is_promised(const oracle *o, double theta)
{
    double t = theta * 3.14159265358979323846 / 180;
    return oracle_area(o, sin(t), cos(t)) > 1e-10 * oracle_area(o, 1, 0);
}

static void test_table(const oracle *o)
{
    vndf_certificate claim = {0, 0, 0, 0, 0, 0, 0};
    vndf_distribution *table = oracle_build(o, 0, &claim);
    vndf_surface surface = {table, 1.0f, 1.0f};
    double most = 0;
    if (!TEST(table != NULL))
        return;
    for (size_t i = 0; i < sizeof ANGLES / sizeof *ANGLES; i += oracle_quick() ? 5 : 1) {
        if (!is_promised(o, ANGLES[i]))
            continue;
        oracle_finding f = oracle_survey(o, &surface, oracle_direction(ANGLES[i], 0));
        most = fmax(most, f.tv);
        TEST_NEAR(f.truth, 1, 2e-6); /* the grid itself */
        if (!TEST(f.tv <= (o->rough ? 1e-2 : 1e-3)) || !TEST(f.area_error <= 2e-6))
            fprintf(stderr, "  %s at %g degrees: TV %.3g, area error %.3g\n", oracle_name(o), ANGLES[i], f.tv,
                    f.area_error);
    }
    double there = oracle_survey(o, &surface, oracle_direction(claim.tv_theta, 0)).tv;
    if (!TEST(claim.tv >= 0.8 * most) || !TEST(there >= 0.8 * claim.tv && there <= 1.25 * claim.tv))
        fprintf(stderr, "  %s claims TV %.3g at %g degrees; found %.3g there and %.3g elsewhere\n", oracle_name(o),
                claim.tv, claim.tv_theta, there, most);
    vndf_free(table);
}

int main(int arguments, char **argument)
{
    for (size_t i = 0; i < ORACLE_COUNT; i++) {
        oracle o = oracle_get(i);
        if (oracle_wanted(arguments, argument, i, oracle_name(&o)))
            test_table(&o);
    }
    return test_done();
}
