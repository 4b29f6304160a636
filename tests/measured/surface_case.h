/* Surfaces whose law of slopes is known: Gaussian height fields, whose slopes are Gaussian, so that P22 is Beckmann's
 * with alpha = sqrt 2 times the rms of the slope along one axis. */
#ifndef TESTS_MEASURED_SURFACE_CASE_H
#define TESTS_MEASURED_SURFACE_CASE_H

#include "harness/constants.h"
#include "harness/test.h"
#include "measured/surface/heights.h"

static inline double surface_normal(unsigned long long *state)
{
    double u = test_uniform_double(state), v = test_uniform_double(state);
    return sqrt(-2 * log(1 - u)) * cos(2 * PI * v);
}

static inline void surface_blur(float *line, size_t stride, int count, double sigma)
{
    enum { REACH = 40 };
    float *copy = malloc((size_t)count * sizeof *copy);
    for (int i = 0; i < count; i++) {
        double sum = 0;
        for (int k = -REACH; k <= REACH; k++)
            sum += (double)line[(size_t)((i + k + count) % count) * stride] * exp(-k * k / (2 * sigma * sigma));
        copy[i] = (float)sum;
    }
    for (int i = 0; i < count; i++)
        line[(size_t)i * stride] = copy[i];
    free(copy);
}

/* White noise blurred along x and y, periodic, scaled to a slope along x of that rms. */
static inline height_field surface_gaussian(int side, double sigma_x, double sigma_y, double rms)
{
    height_field made;
    refusal why = {""};
    unsigned long long state = 9;
    double square = 0;
    size_t n = (size_t)side;
    if (!TEST(heights_make(&made, side, side, "made", &why)))
        exit(1);
    for (size_t i = 0; i < n * n; i++)
        made.z[i] = (float)surface_normal(&state);
    for (size_t i = 0; i < n; i++)
        surface_blur(made.z + i * n, 1, side, sigma_x);
    for (size_t i = 0; i < n; i++)
        surface_blur(made.z + i, n, side, sigma_y);
    for (size_t y = 0; y < n; y++)
        for (size_t x = 1; x + 1 < n; x++) {
            double s = ((double)made.z[y * n + x + 1] - (double)made.z[y * n + x - 1]) / 2;
            square += s * s / (double)(n * (n - 2));
        }
    for (size_t i = 0; i < n * n; i++)
        made.z[i] = (float)((double)made.z[i] * rms / sqrt(square));
    return made;
}

/* Total variation between the slopes of a source and those of Beckmann's distribution, both scaled to mass 1. */
static inline double surface_from_beckmann(const vndf_source *source, double alpha)
{
    double mass = profile_mass(source, 0, alpha) + profile_mass(source, alpha, INFINITY), off = 0;
    const double step = alpha / 200;
    for (double r = step / 2; r < 12 * alpha; r += step) {
        double beckmann = exp(-r * r / (alpha * alpha)) / (PI * alpha * alpha);
        off += fabs(vndf_source_p22(source, r) / mass - beckmann) * 2 * PI * r * step / 2;
    }
    return off;
}

#endif
