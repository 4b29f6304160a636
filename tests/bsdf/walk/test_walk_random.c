/* The numbers of a walk are uniform and independent, within a walk and from walk to walk, also where seeds
 * follow each other or uniform numbers differ in their last bit: chi-square over 64 x 64 cells of pairs, 1e-4
 * each; and the exponential has its mean and variance. */
#include "bsdf/walk/random.h"
#include "harness/test.h"
#include "statistics/grid.h"

enum { CELLS = 64, PAIRS = 400000 };

/* Two numbers of a walk, as doubles and as floats; of neighbouring seeds; of uniform numbers that differ in a bit. */
static void pair_of(int way, uint64_t i, double pair[2])
{
    static vndf_walk_random random, other;
    float u[3] = {0.25f, (float)(i % 1000) / 1000, (float)(i / 1000) / 1000}, v[3] = {u[0], u[1], u[2]};
    if (i == 0) {
        random = vndf_walk_random_from(1);
        other = vndf_walk_random_from(2);
    }
    v[i % 3] += 0x1p-24f;
    if (way == 1) {
        float drawn[2];
        vndf_walk_pair(&other, drawn);
        pair[0] = drawn[0];
        pair[1] = drawn[1];
        return;
    }
    vndf_walk_random a = way == 2 ? vndf_walk_random_from(i) : vndf_walk_random_from(vndf_walk_seed_of(u));
    vndf_walk_random b = way == 2 ? vndf_walk_random_from(i + 1) : vndf_walk_random_from(vndf_walk_seed_of(v));
    pair[0] = vndf_walk_uniform(way ? &a : &random);
    pair[1] = vndf_walk_uniform(way ? &b : &random);
}

static void test_pairs(int way)
{
    static grid g;
    grid_even(&g, CELLS, 0, 1, CELLS, 0, 1);
    for (size_t i = 0; i < grid_elsewhere(&g); i++)
        g.expected[i] = (double)PAIRS / (CELLS * CELLS);
    for (uint64_t i = 0; i < PAIRS; i++) {
        double pair[2];
        pair_of(way, i, pair);
        g.observed[grid_bin(&g, pair[0], pair[1])] += 1.0;
    }
    double p = grid_test(&g).p;
    TEST(p > 1e-4 && p < 1.0 - 1e-4);
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
    for (int way = 0; way < 4; way++)
        test_pairs(way);
    test_exponential();
    return test_done();
}
