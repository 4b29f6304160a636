/* What the tests of batches share: an argument avx2 or avx512 asks for one instruction set, and each distribution is
 * given to the test. */
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
    static const char *const names[] = {"student-t-2.5-small", "student-t-2.5", "student-t-2.5-large", "example",
                                        "sgd-nickel-g"};
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

#endif
