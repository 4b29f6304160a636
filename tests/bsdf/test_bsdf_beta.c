/* The Beta function is within 2e-8 of lgamma's, for arguments from 1 to 1e8 in any order, and goes to 0 without
 * a NaN as they go to infinity. */
#include "bsdf/wide.h"
#include "harness/test.h"

/* Arguments of lgamma are so large that its result has a relative error of 1e-16; of Beta this is as much times
 * the logarithm, hence long double. */
static double reference(double a, double b)
{
    long double x = a, y = b;
    return (double)expl(lgammal(x) + lgammal(y) - lgammal(x + y));
}

static void test_grid(void)
{
    double worst = 0;
    for (double x = 0; x <= 8; x += 0.0625)
        for (double y = 0; y <= 8; y += 0.0625) {
            double a = x == 0 ? 1 : 1 + pow(10, x - 4), b = y == 0 ? 1 : 1 + pow(10, y - 4),
                   want = reference(a, b);
            if (want < 1e-290)
                continue;
            worst = fmax(worst, fabs(beta_of(a, b) / want - 1));
            TEST(beta_of(a, b) == beta_of(b, a));
        }
    printf("largest error %g\n", worst);
    TEST(worst < 2e-8);
}

/* Beta(a, b) tends to Gamma(b) a^-b as a grows; and Beta(a, 1) = 1/a. */
static void test_large(void)
{
    for (double a = 1; a < 1e37; a *= 7) {
        TEST_RELATIVE(beta_of(a, 1) * a, 1.0, 2e-8);
        if (a > 1e10)
            TEST_RELATIVE(beta_of(a, 2.5) * pow(a, 2.5) / tgamma(2.5), 1.0, 2e-8);
    }
    TEST(beta_of(HUGE_VAL, 1) == 0 && beta_of(1, HUGE_VAL) == 0 && beta_of(HUGE_VAL, HUGE_VAL) == 0);
    TEST(beta_of(1e30, 1e30) == 0);
}

int main(void)
{
    test_grid();
    test_large();
    return test_done();
}
