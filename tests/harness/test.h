/* The harness: checks count, failures print where and what, test_done() is main's return value; random numbers, pi.
 * A test program states one property in its first sentence and ends with `return test_done();`. */
#pragma once

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

static int test_checks, test_failures;

static inline int test_report(int good, const char *file, int line, const char *what)
{
    test_checks++;
    if (good)
        return 1;
    if (++test_failures <= 20)
        fprintf(stderr, "%s:%d: failed: %s\n", file, line, what);
    if (getenv("VNDF_TEST_FIRST")) /* mutants.py asks no more */
        exit(1);
    return 0;
}

static inline int test_near(double got, double want, double tolerance, const char *file, int line,
                            const char *what)
{
    char text[256];
    if (fabs(got - want) <= tolerance) /* false for NaN */
        return test_report(1, file, line, what);
    snprintf(text, sizeof text, "%s: got %.17g, want %.17g, difference %.3g > %.3g", what, got, want,
             fabs(got - want), tolerance);
    return test_report(0, file, line, text);
}

#define TEST(condition) test_report((condition) ? 1 : 0, __FILE__, __LINE__, #condition)
#define TEST_NEAR(got, want, tolerance) test_near((got), (want), (tolerance), __FILE__, __LINE__, #got " ~ " #want)
#define TEST_RELATIVE(got, want, tolerance) \
  test_near((got), (want), (tolerance)*fabs(want), __FILE__, __LINE__, #got " ~ " #want)
#define TEST_HAS(text, part) test_report(strstr((text), (part)) != NULL, __FILE__, __LINE__, #text " has " #part)

static inline int test_done(void)
{
    fprintf(stderr, "%d checks, %d failed\n", test_checks, test_failures);
    return test_checks == 0 || test_failures != 0;
}

/* How much is asked for: VNDF_TEST_QUICK=1, as little as still sees the defects of tests/house/mutants.txt;
 * VNDF_TEST_LONG=1, everything, in the tests more_NAME; otherwise what a programmer waits for. */
static inline int test_quick(void)
{
    const char *quick = getenv("VNDF_TEST_QUICK");
    return quick && *quick;
}

static inline int test_long(void)
{
    const char *all = getenv("VNDF_TEST_LONG");
    return all && *all && !test_quick();
}

static inline size_t test_amount(size_t quick, size_t usual, size_t whole)
{
    return test_quick() ? quick : test_long() ? whole : usual;
}

/* The whole of a small file; its size, or 0. */
static inline size_t read_bytes(const char *path, unsigned char *bytes, size_t most)
{
    FILE *file = fopen(path, "rb");
    size_t size = file ? fread(bytes, 1, most, file) : 0;
    if (file)
        fclose(file);
    return size;
}

/* xorshift64*: reproducible uniform numbers on [0, 1) with 24 or 53 bits; the state must not be 0. */
static inline unsigned long long test_random_bits(unsigned long long *state)
{
    unsigned long long x = *state;
    x ^= x >> 12;
    x ^= x << 25;
    x ^= x >> 27;
    *state = x;
    return x * 2685821657736338717ULL;
}

static inline float test_uniform(unsigned long long *state)
{
    return (float)(test_random_bits(state) >> 40) * 0x1p-24f;
}

static inline double test_uniform_double(unsigned long long *state)
{
    return (double)(test_random_bits(state) >> 11) * 0x1p-53;
}
