/* Knots that are moved make all intervals err alike where that is possible, never make the error larger, and leave the
 * knots that are held where they are. The errors here are exact: the interval from a to b errs by (b^n - a^n)^3, or
 * that to the fourth power as its share, so that even knots are known. */
#include <stdio.h>
#include <string.h>

#include "fit/even.h"
#include "harness/test.h"

enum { COUNT = 9 };

/* The power n; and the width below which an interval may not be moved. */
typedef struct law {
    double power, narrow;
    int shared;
} law;

static vndf_interval_miss error_of(double a, double b, void *user)
{
    const law *l = user;
    double size = pow(b, l->power) - pow(a, l->power);
    vndf_interval_miss miss = {l->shared ? pow(size, 4) : 0, l->shared ? 0 : pow(size, 3)};
    miss.alone = b - a < l->narrow ? HUGE_VAL : miss.alone;
    return miss;
}

static double error_of_all(const double *knot, law *l)
{
    double share = 0, alone = 0;
    for (int i = 0; i + 1 < COUNT; i++) {
        vndf_interval_miss miss = error_of(knot[i], knot[i + 1], l);
        share += miss.share;
        alone = fmax(alone, miss.alone);
    }
    return share + alone;
}

static void fill(double *knot)
{
    for (int i = 0; i < COUNT; i++)
        knot[i] = (double)i / (COUNT - 1);
}

static void test_known(void)
{
    const double powers[] = {0.3, 1, 2, 4};
    for (size_t i = 0; i < 8; i++) {
        law l = {powers[i / 2], 0, i % 2};
        double knot[COUNT], start[COUNT], known = 1.0 / (COUNT - 1);
        const vndf_even even = {NULL, 0, 20, error_of, &l};
        fill(knot);
        fill(start);
        TEST(vndf_even_knots(knot, COUNT, &even));
        double least = l.shared ? (COUNT - 1) * pow(known, 4) : pow(known, 3);
        if (!TEST(error_of_all(knot, &l) <= 1.1 * least))
            fprintf(stderr, "  power %g, shared %d: %g, at least %g, %g before\n", l.power, l.shared,
                    error_of_all(knot, &l), least, error_of_all(start, &l));
        TEST(error_of_all(knot, &l) <= error_of_all(start, &l));
        TEST(knot[0] == 0 && knot[COUNT - 1] == 1);
        for (int j = 0; j + 1 < COUNT; j++)
            TEST(knot[j] < knot[j + 1]);
    }
}

/* Held are a knot of the list, and one that is none. */
static void test_held(void)
{
    law l = {4, 0, 0};
    double knot[COUNT];
    const double held[] = {0.2, 0.5};
    const vndf_even even = {held, 2, 3, error_of, &l};
    fill(knot);
    double before = error_of_all(knot, &l);
    TEST(vndf_even_knots(knot, COUNT, &even));
    TEST(knot[4] == 0.5 && knot[5] > 0.626 && knot[1] > 0.126);
    TEST(error_of_all(knot, &l) < 0.7 * before);
}

/* Where an interval is too narrow, at the start or after a round, its knots are as they were before. */
static void test_narrow(void)
{
    law stays = {4, 0.2, 0}, returns = {4, 0.08, 0};
    double knot[COUNT], start[COUNT];
    vndf_even even = {NULL, 0, 12, error_of, &stays};
    fill(knot);
    fill(start);
    TEST(vndf_even_knots(knot, COUNT, &even));
    TEST(memcmp(knot, start, sizeof knot) == 0);
    even.user = &returns;
    TEST(vndf_even_knots(knot, COUNT, &even));
    TEST(error_of_all(knot, &returns) <= error_of_all(start, &returns));
    even.rounds = 0;
    fill(knot);
    TEST(vndf_even_knots(knot, COUNT, &even) && memcmp(knot, start, sizeof knot) == 0);
}

int main(void)
{
    test_known();
    test_held();
    test_narrow();
    return test_done();
}
