/* The oracle itself is right: its areas agree with the closed forms of GGX, Beckmann and the disc, from both
 * sides of the horizon, and A(w) - A(-w) is the cosine for every distribution. */
#include "oracle/oracle.h"
#include "harness/constants.h"
#include "harness/test.h"

/* A = (c + sqrt(c^2 + s^2))/2 (Smith's Lambda of GGX, Walter et al. 2007); below the horizon by its conjugate. */
static double ggx_area(double s, double c)
{
    double l = sqrt(c * c + s * s);
    return c >= 0 ? (c + l) / 2 : s * s / (2 * (l - c));
}

static double beckmann_area(double s, double c)
{
    double v = c / s;
    return c * erfc(-v) / 2 + s * exp(-v * v) / (2 * sqrt(PI));
}

/* Slopes even over the unit disc: integral over x of (c + s x) 2 sqrt(1 - x^2)/pi from -c/s on. */
static double disc_area(double s, double c)
{
    double v = c / s;
    if (fabs(v) >= 1)
        return c > 0 ? c : 0;
    double chord = sqrt(1 - v * v);
    return (c * (PI / 2 + asin(v) + v * chord) + s * 2.0 / 3.0 * chord * chord * chord) / PI;
}

static void test_closed_forms(void)
{
    oracle ggx = oracle_get(ORACLE_GGX), beckmann = oracle_get(ORACLE_BECKMANN), disc = oracle_get(ORACLE_DISC);
    for (int degrees = 5; degrees <= 175; degrees += 5) {
        double s = sin(degrees * PI / 180), c = cos(degrees * PI / 180);
        TEST_RELATIVE(oracle_area(&ggx, s, c), ggx_area(s, c), 1e-9);
        if (degrees <= 100) /* beyond, the closed forms themselves are differences */
            TEST_RELATIVE(oracle_area(&beckmann, s, c), beckmann_area(s, c), 1e-9);
        if (degrees <= 120)
            TEST_RELATIVE(oracle_area(&disc, s, c), disc_area(s, c), 1e-9);
    }
}

static void test_both_sides(void)
{
    for (size_t i = 0; i < ORACLE_COUNT; i++) {
        oracle o = oracle_get(i);
        for (int degrees = 0; degrees <= 90; degrees += 10) {
            double s = sin(degrees * PI / 180), c = degrees == 90 ? 0 : cos(degrees * PI / 180);
            TEST_NEAR(oracle_area(&o, s, c) - oracle_area(&o, s, -c), c, 2e-10);
        }
    }
}

int main(void)
{
    test_closed_forms();
    test_both_sides();
    return test_done();
}
