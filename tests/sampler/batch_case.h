/* What the tests of batches share: an argument avx2 or avx512 asks for one instruction set, and each distribution is
 * given to the test; plain batches over arrays, and what they say of one element. */
#ifndef TESTS_SAMPLER_BATCH_CASE_H
#define TESTS_SAMPLER_BATCH_CASE_H

#include <stdio.h>

#include "oracle/oracle.h"
#include "harness/test.h"
#include "vndf.h"

typedef void batch_test(const vndf_distribution *d, const char *name, vndf_instructions only);

/* BEST without an argument: all of them. */
static inline vndf_instructions batch_wanted(int arguments, char **argument)
{
    if (arguments < 2)
        return VNDF_INSTRUCTIONS_BEST;
    return strcmp(argument[1], "avx512") == 0 ? VNDF_INSTRUCTIONS_AVX512 : VNDF_INSTRUCTIONS_AVX2;
}

/* main's: the closed forms, no distribution, and tables of all sizes. */
static inline int batch_main(int arguments, char **argument, batch_test *test)
{
    static const char *const names[] = {
        "student-t-2.5-small", "student-t-2.5", "student-t-2.5-large", "hazy", "example", "sgd-nickel-g"};
    vndf_instructions only = batch_wanted(arguments, argument);
    if (only != VNDF_INSTRUCTIONS_BEST && vndf_instructions_used(only) != only) {
        printf("SKIPPED: no %s here\n", argument[1]);
        return 0;
    }
    test(vndf_ggx(), "ggx", only);
    test(vndf_beckmann(), "beckmann", only);
    test(NULL, "none", only);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        vndf_distribution *table = oracle_shipped(names[i]);
        if (TEST(table != NULL))
            test(table, names[i], only);
        vndf_free(table);
    }
    return test_done();
}

/* The limits to be tried, from the first to the last: those that `only` asks for. */
static inline int batch_first_limit(vndf_instructions only)
{
    return (int)only; /* BEST is the first of all */
}

static inline int batch_last_limit(vndf_instructions only)
{
    return only == VNDF_INSTRUCTIONS_BEST ? VNDF_INSTRUCTIONS_AVX512 : (int)only;
}

/* ---- plain batches ---- */

/* Over arrays of alpha_x, alpha_y, wi.x, wi.y and wi.z, from their second number on: no call may count on an
 * alignment. */
static inline vndf_batch batch_over(const vndf_distribution *d, const float *const from[5], size_t count,
                                    unsigned shared, vndf_instructions limit)
{
    vndf_batch b = {d, count, shared, limit, from[0] + 1, from[1] + 1, from[2] + 1, from[3] + 1, from[4] + 1};
    return b;
}

static inline vndf_surface batch_surface_at(const vndf_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_ALPHA ? 0 : i;
    vndf_surface surface = {b->distribution, b->alpha_x[at], b->alpha_y[at]};
    return surface;
}

static inline vndf_vec3 batch_wi_at(const vndf_batch *b, size_t i)
{
    size_t at = b->shared & VNDF_SHARED_WI ? 0 : i;
    vndf_vec3 wi = {b->wi_x[at], b->wi_y[at], b->wi_z[at]};
    return wi;
}

#endif
