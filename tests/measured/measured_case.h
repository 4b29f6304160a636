/* What tests of measured files share: files in memory, what is noted of them, why they are refused, and surfaces whose
 * law of slopes is known. */
#ifndef TESTS_MEASURED_MEASURED_CASE_H
#define TESTS_MEASURED_MEASURED_CASE_H

#include "harness/constants.h"
#include "harness/test.h"
#include "measured/surface.h"

/* A file that is exactly as long as its bytes are, for sanitizers. */
static inline data_file case_file(const void *bytes, size_t size)
{
    unsigned char *exact = malloc(size ? size : 1);
    memcpy(exact, bytes, size);
    return (data_file){.name = "made", .bytes = exact, .size = size};
}

static inline void case_free(data_file *file)
{
    free((void *)(size_t)file->bytes);
}

/* The number behind a key, or NaN. */
static inline double case_number(const data_file *file, const char *key)
{
    const char *at = strstr(file->notes, key);
    return at ? strtod(at + strlen(key), NULL) : NAN;
}

/* Whether a reader read what it should have; prints why not. */
static inline int case_read(int good, const data_file *file)
{
    if (!TEST(good))
        fprintf(stderr, "  %s\n", file->refused);
    return good;
}

/* A reader refused a file with this reason, and frees it. */
static inline void case_refused(int good, data_file *file, const char *reason)
{
    if (!(TEST(!good) & TEST(strncmp(file->refused, "made: ", 6) == 0) & TEST_HAS(file->refused, reason)))
        fprintf(stderr, "  '%s' in the place of '%s'\n", file->refused, reason);
    case_free(file);
}

static inline double case_normal(unsigned long long *state)
{
    double u = test_uniform_double(state), v = test_uniform_double(state);
    return sqrt(-2 * log(1 - u)) * cos(2 * PI * v);
}

static inline void case_blur(float *line, size_t stride, int count, double sigma)
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

/* White noise blurred along x and y, periodic, scaled to a slope along x of that rms: slopes are Gaussian, so that P22
 * is Beckmann's with alpha = sqrt 2 times the rms of the slope along one axis. */
static inline height_field case_gaussian(int side, double sigma_x, double sigma_y, double rms)
{
    height_field made;
    data_file file = {.name = "made"};
    unsigned long long state = 9;
    double square = 0;
    size_t n = (size_t)side;
    if (!TEST(heights_make(&made, side, side, &file)))
        exit(1);
    for (size_t i = 0; i < n * n; i++)
        made.z[i] = (float)case_normal(&state);
    for (size_t i = 0; i < n; i++)
        case_blur(made.z + i * n, 1, side, sigma_x);
    for (size_t i = 0; i < n; i++)
        case_blur(made.z + i, n, side, sigma_y);
    for (size_t i = 0; i < n * n; i++)
        if (i % n > 0 && i % n < n - 1) {
            double s = ((double)made.z[i + 1] - (double)made.z[i - 1]) / 2;
            square += s * s / (double)(n * (n - 2));
        }
    for (size_t i = 0; i < n * n; i++)
        made.z[i] = (float)((double)made.z[i] * rms / sqrt(square));
    return made;
}

/* Total variation between the slopes of rows and those of Beckmann's distribution, both scaled to mass 1. */
static inline double case_from_beckmann(const profile *rows, double alpha)
{
    data_file file = {.name = "made"};
    vndf_source *source = profile_source(rows, &file);
    double mass = slope_mass(source, 0, alpha) + slope_mass(source, alpha, INFINITY), off = 0;
    const double step = alpha / 200;
    for (double r = step / 2; r < 12 * alpha; r += step) {
        double beckmann = exp(-r * r / (alpha * alpha)) / (PI * alpha * alpha);
        off += fabs(vndf_source_p22(source, r) / mass - beckmann) * 2 * PI * r * step / 2;
    }
    vndf_source_free(source);
    return off;
}

#endif
