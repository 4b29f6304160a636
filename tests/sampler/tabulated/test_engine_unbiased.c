/* A table of any size is unbiased: averages of true density over returned density times test functions agree
 * with quadrature within 4 standard errors, plus 2e-6 for the quadrature and the rounding of normals.
 *
 * One such test fails by chance with probability 6e-5; of the some 400 here, 3 in a hundred suites would, were the
 * seed not fixed. */
#include "oracle/oracle_unbiased.h"
#include "harness/test.h"

typedef struct setting {
    float alpha_x, alpha_y;
    double theta;
} setting;

static const setting SETTINGS[] = {{1, 1, 0}, {1, 1, 60}, {0.05f, 0.4f, 60}, {0.05f, 0.4f, 89}, {1, 1, 110}};
static const size_t KINDS[] = {ORACLE_GGX, ORACLE_LAPLACE, ORACLE_MEASURED, ORACLE_HAZE, ORACLE_RING, ORACLE_DISC};
static const size_t SIZES[] = {2048, 16384, 65536};
enum { SIZE_COUNT = 3 };

static void test_table(const oracle *o, const vndf_distribution *table, const oracle_expected *expected)
{
    unsigned long long state = 11;
    oracle_average average[ORACLE_FUNCTIONS];
    oracle_averages(o, table, expected, test_amount(20000, 60000, 200000), &state, average);
    for (int i = 0; i < ORACLE_FUNCTIONS; i++)
        if (!TEST_NEAR(average[i].mean, expected->reference[i], 4 * average[i].error + 2e-6))
            fprintf(stderr, "  %s, %lu bytes, alpha %g %g, wi.z %g, function %d: standard error %.3g\n",
                    oracle_name(o), (unsigned long)vndf_distribution_info(table).bytes, expected->alpha_x,
                    expected->alpha_y, expected->wi.z, i, average[i].error);
}

static void test_distribution(const oracle *o, int sizes, size_t first)
{
    vndf_distribution *table[SIZE_COUNT] = {NULL, NULL, NULL};
    double grazing = oracle_area(o, 1, 0);
    int good = 1;
    for (int j = 0; j < sizes; j++)
        good &= TEST((table[j] = oracle_build(o, SIZES[j], NULL)) != NULL);
    for (size_t i = first; good && i < sizeof SETTINGS / sizeof *SETTINGS; i += test_amount(1, 2, 1)) {
        vndf_surface surface = {table[0], SETTINGS[i].alpha_x, SETTINGS[i].alpha_y};
        vndf_vec3 wi = oracle_direction(SETTINGS[i].theta, 33);
        if (!(oracle_surface_area(o, &surface, wi) > 1e-10 * grazing))
            continue;
        oracle_expected expected = oracle_expect(o, &surface, wi);
        for (int j = 0; j < sizes; j++)
            test_table(o, table[j], &expected);
    }
    for (int j = 0; j < sizes; j++)
        vndf_free(table[j]);
}

int main(void)
{
    for (size_t i = 0; i < sizeof KINDS / sizeof *KINDS; i += test_quick() ? 2 : 1) {
        oracle o = oracle_get(KINDS[i]);
        test_distribution(&o, !test_quick() && (KINDS[i] == ORACLE_GGX || KINDS[i] == ORACLE_DISC) ? 3 : 2,
                          test_amount(0, i % 2, 0));
    }
    return test_done();
}
