/* The azimuth drawn in front of wi solves Kepler's equation to float precision: with the density A + B cos a the
 * mass beyond it, A b + B (1 - cos b) for b = pi/2 - a, is in double what was asked for within 3e-7 of the whole
 * (measured: 2.0e-7), whatever the ratio of A and B; and its density is that at the azimuth. */
#include "sampler/tabulated/front.h"
#include "harness/constants.h"
#include "harness/test.h"

/* Error of the mass, with the angle (A, B) = (cos, sin). */
static double error_at(vndf_front front, double u)
{
    double even = (double)front.even, odd = (double)front.odd, whole = even * PI / 2 + odd;
    float rest = (float)(u * whole);
    float near;
    vndf_azimuth at = vndf_front_draw(front, rest, (float)whole, &near);
    double b = atan2((double)at.c, (double)at.s), half = sin(b / 2);
    TEST(at.c >= 0 && at.s >= 0 && at.n == 1);
    TEST_NEAR((double)near, (double)at.c, 0.006 * (double)at.c + 1e-7);
    TEST_NEAR(at.c * (double)at.c + at.s * (double)at.s, 1, 1e-6);
    TEST_NEAR((double)at.density, even + odd * cos(PI / 2 - b), 5e-7 * (even + odd));
    return fabs(even * b + 2 * odd * half * half - (double)rest) / whole;
}

int main(void)
{
    enum { RATIOS = 200, STEPS = 1000 };
    double worst = 0;
    for (int i = 0; i <= RATIOS; i++) {
        double t = PI / 2 * i / RATIOS;
        vndf_front front = {i < RATIOS ? (float)cos(t) : 0, (float)sin(t)};
        for (int j = 0; j <= STEPS; j++)
            worst = fmax(worst, error_at(front, (double)j / STEPS));
    }
    TEST(worst <= 3e-7);
    fprintf(stderr, "mass beyond the azimuth within %.2g\n", worst);
    return test_done();
}
