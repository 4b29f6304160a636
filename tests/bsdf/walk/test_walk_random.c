/* The numbers of a walk are uniform and independent, within a walk and from walk to walk, also where seeds
 * follow each other or uniform numbers differ in their last bit: chi-square over 64 x 64 cells of pairs, 1e-4
 * each; and the exponential has its mean and variance. */
#include "bsdf/walk/random.h"
#include "statistics/grid.h"
#include "harness/test.h"

enum { CELLS = 64, PAIRS = 400000 };

static void put(grid *g, double x, double y)
{
    g->observed[grid_bin(g, x, y)] += 1.0;
}

static void begin(grid *g)
{
    grid_even(g, CELLS, 0, 1, CELLS, 0, 1);
    for (size_t i = 0; i < grid_elsewhere(g); i++)
        g->expected[i] = (double)PAIRS / (CELLS * CELLS);
}

static void check(const grid *g)
{
    double p = grid_test(g).p;
    TEST(p > 1e-4 && p < 1.0 - 1e-4);
}

static void test_within(void)
{
    static grid numbers, floats;
    vndf_walk_random random = vndf_walk_random_from(1), other = vndf_walk_random_from(2);
    begin(&numbers);
    begin(&floats);
    for (int i = 0; i < PAIRS; i++) {
        float u[2];
        double x = vndf_walk_uniform(&random);
        put(&numbers, x, vndf_walk_uniform(&random));
        vndf_walk_pair(&other, u);
        put(&floats, u[0], u[1]);
    }
    check(&numbers);
    check(&floats);
}

/* The same number of neighbouring walks. */
static void test_between(void)
{
    static grid seeds, numbers;
    begin(&seeds);
    begin(&numbers);
    for (uint64_t i = 0; i < PAIRS; i++) {
        vndf_walk_random a = vndf_walk_random_from(i), b = vndf_walk_random_from(i + 1);
        put(&seeds, vndf_walk_uniform(&a), vndf_walk_uniform(&b));
        float u[3] = {0.25f, (float)(i % 1000) / 1000, (float)(i / 1000) / 1000}, v[3] = {u[0], u[1], u[2]};
        v[i % 3] += 0x1p-24f;
        a = vndf_walk_random_from(vndf_walk_seed_of(u)), b = vndf_walk_random_from(vndf_walk_seed_of(v));
        put(&numbers, vndf_walk_uniform(&a), vndf_walk_uniform(&b));
    }
    check(&seeds);
    check(&numbers);
}

/* Mean, variance and a tail, at 4.5 sigmas. */
static void test_exponential(void)
{
    vndf_walk_random random = vndf_walk_random_from(3);
    double sum = 0.0, squares = 0.0, beyond = 0.0, n = PAIRS;
    for (int i = 0; i < PAIRS; i++) {
        double x = vndf_walk_exponential(&random);
        TEST(x > 0.0 && x < 40.0);
        sum += x, squares += x * x, beyond += x > 5.0;
    }
    TEST_NEAR(sum / n, 1.0, 4.5 / sqrt(n));
    TEST_NEAR(squares / n, 2.0, 4.5 * sqrt(20.0 / n));
    TEST_NEAR(beyond / n, exp(-5.0), 4.5 * sqrt(exp(-5.0) / n));
}

int main(void)
{
    test_within();
    test_between();
    test_exponential();
    return test_done();
}
