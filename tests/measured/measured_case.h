/* What tests of measured files share: files in memory, what is noted of them, why they are refused, and surfaces
 * whose law of slopes is known. */
#pragma once

#include "harness/test.h"
#include "measured/measured.h"

/* A file that is exactly as long as its bytes and a 0 are, for sanitizers. */
static inline data_file case_file(const void *bytes, size_t size)
{
    unsigned char *exact = calloc(size + 1, 1);
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
        fprintf(stderr, "  %s\n", file->error.message);
    return good;
}

/* A reader refused a file with this reason, and frees it. */
static inline void case_refused(int good, data_file *file, const char *reason)
{
    if (!(TEST(!good) & TEST(strncmp(file->error.message, "made: ", 6) == 0) &
          TEST_HAS(file->error.message, reason)))
        fprintf(stderr, "  '%s' in the place of '%s'\n", file->error.message, reason);
    case_free(file);
}

static inline double case_normal(unsigned long long *state)
{
    double u = test_uniform_double(state), v = test_uniform_double(state);
    return sqrt(-2 * log(1 - u)) * cos(2 * PI * v);
}

/* P22 of GGX. */
static inline double case_ggx(double r, double alpha)
{
    double q = 1 + r * r / (alpha * alpha);
    return 1 / (PI * alpha * alpha * q * q);
}
