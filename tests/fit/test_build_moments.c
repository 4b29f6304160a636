/* The cells of a table hold the moments of D, whatever D is and however few they are: the integrals of f and of R f
 * that directions above the horizon are drawn from, to 1e-6. Tails just heavy enough, peaks, rings and jumps are the
 * hard ones. And knots stand as far apart as floats need. */
#include <stdlib.h>

#include "fit/profile/profile.h"
#include "harness/constants.h"
#include "harness/test.h"
#include "oracle/oracle.h"
#include "table/table.h"
#include "vndf_build.h"

static const char *const P22[] = {"(1+r^2)^-2",
                                  "exp(-r^2)",
                                  "(1+r^2)^-1.55",
                                  "(1+r)^-3.3",
                                  "r^-1.5*exp(-r)",
                                  "step(1-r)",
                                  "exp(-r^8)",
                                  "r^6*exp(-r^2)",
                                  "step(1-r)*step(r-0.8)",
                                  "exp(-((r-1)/0.05)^2)",
                                  "exp(-((r-1)/1e-8)^2)",
                                  "exp(-((r-3)/0.1)^2)+0.1*exp(-r^2)",
                                  "abs(r-0.5)^-0.3*exp(-2*r)",
                                  "exp(-r)*(1+0.9*cos(20*r))"};
static const size_t SIZES[] = {2048, 4096, 16384};

static int moments_hold(const vndf_table_draft *table, const vndf_profile *profile)
{
    double f0 = 0, f1 = 0;
    int good = 1;
    for (unsigned i = 0; i <= table->cells; i++) {
        double r = (double)table->knot[i], m0 = (double)table->m0[i], m1 = (double)table->m1[i],
               m2 = (double)table->m2[i];
        f0 += m1 + r * m0;
        f1 += m2 + 2 * r * m1 + r * r * m0;
        good &= i == table->cells || TEST(table->knot[i + 1] - table->knot[i] > 2e-7f * table->knot[i]);
    }
    return good & TEST_NEAR(f0, 1, 1e-6) & TEST_RELATIVE(f1, 2 * PI * profile->f1, 2e-6);
}

static void test_moments(const vndf_source *source, const char *text, size_t bytes)
{
    vndf_build_options options = {.max_bytes = bytes};
    vndf_error error = {VNDF_OK, ""};
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    vndf_profile *profile = vndf_profile_from(source, NULL, &guard, &error);
    vndf_distribution *table = vndf_build(source, &options, NULL, &error);
    vndf_table_draft draft;
    if (TEST(profile && table && vndf_table_draft_of(table, &draft))) {
        if (!moments_hold(&draft, profile))
            fprintf(stderr, "  %s in %lu bytes\n", text, (unsigned long)bytes);
        free(draft.knot);
    } else
        fprintf(stderr, "  %s: %s\n", text, error.message);
    vndf_profile_free(profile);
    vndf_free(table);
}

int main(void)
{
    for (unsigned i = 0; i < sizeof P22 / sizeof *P22; i++) {
        vndf_source *source = vndf_source_slope_expression(P22[i], NULL, 0, NULL);
        for (unsigned j = 0; TEST(source != NULL) && j < sizeof SIZES / sizeof *SIZES; j++)
            if (test_long() || j == (test_quick() ? 0 : i % 3))
                test_moments(source, P22[i], SIZES[j]);
        vndf_source_free(source);
    }
    return test_done();
}
