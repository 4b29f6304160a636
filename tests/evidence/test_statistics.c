/* The p-values that decide tests are right: incomplete gamma, chi-square and Sidak
 * against values computed with 30 digits, and against closed forms that hold for every argument. */
#include "evidence/measure/statistics.h"
#include "harness/test.h"

typedef struct gamma_value {
    double a, x, q;
} gamma_value;

/* Both methods and both sides of their border x = a + 1; small, middle and large a; deep tails. */
static const gamma_value gamma_values[] = {
    {0.5, 0.5, 0.31731050786291410283},
    {1, 2, 0.13533528323661269189},
    {2.5, 0.1, 0.99911386121118755739},
    {5, 20, 0.000016944743930067383904},
    {0.0009765625, 0.0009765625, 0.0061878407358445855596},
    {19.9, 25, 0.12895435522699321498},
    {20.1, 25, 0.13829991427154918504},
    {100, 80, 0.98289168696486688583},
    {4224.5, 4300, 0.12304896728607267242},
    {4224.5, 4700, 8.1391804679296989983e-13},
    {10000, 9000, 1.0},
    {50, 600, 6.3906803836821079648e-188},
};

static void test_gamma_values(void)
{
    for (size_t i = 0; i < sizeof gamma_values / sizeof gamma_values[0]; i++)
        TEST_RELATIVE(statistics_gamma_q(gamma_values[i].a, gamma_values[i].x), gamma_values[i].q, 1e-11);
}

/* Q(1, x) = e^-x; and what has no value. */
static void test_gamma_borders(void)
{
    for (double x = 0.01; x < 60; x *= 1.3)
        TEST_RELATIVE(statistics_gamma_q(1, x), exp(-x), 1e-12);
    TEST(statistics_gamma_q(3, 0) == 1 && statistics_gamma_q(3, INFINITY) == 0);
    TEST(isnan(statistics_gamma_q(0, 1)) && isnan(statistics_gamma_q(1, -1)) && isnan(statistics_gamma_q(NAN, 1)));
}

/* The first three are the 5% points that tables print. */
static void test_chi_square(void)
{
    static const double cases[][3] = {{3.841458820694124, 1, 0.05},
                                      {18.307038053275146, 10, 0.05},
                                      {124.34211340400407, 100, 0.05},
                                      {8500, 8320, 0.082171579704439311121},
                                      {8900, 8320, 5.3883860246833240207e-6},
                                      {0, 7, 1},
                                      {5, 0, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        TEST_RELATIVE(statistics_chi_square_p(cases[i][0], (size_t)cases[i][1]), cases[i][2],
                      i < 3 ? 1e-11 : 1e-10);
    TEST_RELATIVE(statistics_sidak(0.01, 1), 0.01, 1e-14);
    TEST_RELATIVE(statistics_sidak(0.01, 12), 0.00083717735912055952858, 1e-13);
    TEST_RELATIVE(statistics_sidak(0.05, 1000), 0.00005129197890901780815, 1e-13);
    TEST(statistics_sidak(0.01, 0) == 0.01);
}

int main(void)
{
    test_gamma_values();
    test_gamma_borders();
    test_chi_square();
    return test_done();
}
