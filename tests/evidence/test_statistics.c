/* The p-values that decide tests are right: chi-square and Sidak against values computed with 30 digits, and against a
 * closed form that holds for every statistic. */
#include "evidence/measure/measure.h"
#include "harness/test.h"

/* Statistic, degrees of freedom, p; the first three are the 5% points that tables print. */
static const double cases[][3] = {{3.841458820694124, 1, 0.05},
                                  {18.307038053275146, 10, 0.05},
                                  {124.34211340400407, 100, 0.05},
                                  {40, 10, 0.000016944743930067383904},
                                  {160, 200, 0.98289168696486688583},
                                  {9400, 8449, 8.1391804679296989983e-13},
                                  {18000, 20000, 1},
                                  {1200, 100, 6.3906803836821079648e-188},
                                  {0, 7, 1},
                                  {INFINITY, 7, 0},
                                  {5, 0, 1}};

int main(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        TEST_RELATIVE(statistics_chi_square_p(cases[i][0], (size_t)cases[i][1]), cases[i][2], 1e-10);
    for (double x = 0.01; x < 60; x *= 1.3)
        TEST_RELATIVE(statistics_chi_square_p(2 * x, 2), exp(-x), 1e-12);
    TEST(!(statistics_chi_square_p(NAN, 3) >= 0));
    TEST_RELATIVE(statistics_sidak(0.01, 1), 0.01, 1e-14);
    TEST_RELATIVE(statistics_sidak(0.01, 12), 0.00083717735912055952858, 1e-13);
    TEST_RELATIVE(statistics_sidak(0.05, 1000), 0.00005129197890901780815, 1e-13);
    TEST(statistics_sidak(0.01, 0) == 0.01);
    return test_done();
}
