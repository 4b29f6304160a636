/* A table of any size is unbiased at 1e8 samples: averages of true density over returned density times test
 * functions agree with quadrature within 4 standard errors, plus 2e-6 for the quadrature and the rounding of
 * normals. One such test fails by chance with probability 6e-5; there are 54. */
#include "oracle/oracle_unbiased.h"
#include "harness/test.h"

static const size_t KINDS[] = {ORACLE_GGX, ORACLE_LAPLACE, ORACLE_RING};
static const size_t SIZES[] = {2048, 16384, 65536};

static void test_table(const oracle *o, size_t bytes, unsigned long long *state)
{
    vndf_distribution *table = oracle_build(o, bytes, NULL);
    vndf_surface surface = {table, 1.0f, 0.7f};
    oracle_average average[ORACLE_FUNCTIONS];
    if (!TEST(table != NULL))
        return;
    oracle_expected expected = oracle_expect(o, &surface, oracle_direction(75, 33));
    oracle_averages(o, table, &expected, test_quick() ? 1000000 : 100000000, state, average);
    for (int i = 0; i < ORACLE_FUNCTIONS; i++) {
        int good = TEST_NEAR(average[i].mean, expected.reference[i], 4 * average[i].error + 2e-6);
        fprintf(stderr, "%s %s, %lu bytes, function %d: %.3g standard errors of %.3g\n", good ? " " : "!",
                oracle_name(o), (unsigned long)bytes, i,
                (average[i].mean - expected.reference[i]) / average[i].error, average[i].error);
    }
    vndf_free(table);
}

int main(void)
{
    unsigned long long state = 13;
    for (size_t i = 0; i < 9; i++) {
        oracle o = oracle_get(KINDS[i / 3]);
        test_table(&o, SIZES[i % 3], &state);
    }
    return test_done();
}
