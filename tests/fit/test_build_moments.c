/* The cells of a table hold the mass of D, whatever D is and however few they are. Tails just heavy enough,
 * peaks, rings and jumps are the hard ones: there a cell's cubic has to be bent to stay positive, which may shift
 * mass within the cell, from one moment of D (all normals) to the other (seen at grazing incidence): each is
 * right to 1e-3, their sum to 5e-6. */
#include "fit/profile/profile.h"
#include "oracle/oracle.h"
#include "table/table.h"
#include "harness/test.h"
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
                                  "exp(-((r-3)/0.1)^2)+0.1*exp(-r^2)",
                                  "exp(-r)*(1+0.9*cos(20*r))"};
static const size_t SIZES[] = {2048, 4096, 16384};

static void test_moments(const vndf_source *source, const char *text, size_t bytes)
{
    vndf_build_options options = {.max_bytes = bytes};
    vndf_error error = {VNDF_OK, ""};
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    vndf_profile *profile = vndf_profile_from(source, NULL, &guard, &error);
    vndf_distribution *table = vndf_build(source, &options, NULL, &error);
    if (TEST(profile && table)) {
        double f0 = (double)table->f0_total, f1 = (double)table->f1_total;
        int good = TEST_RELATIVE(f0, profile->f0, 1e-3) & TEST_RELATIVE(f1, profile->f1, 1e-3);
        if (!TEST_RELATIVE(f0 + f1, profile->f0 + profile->f1, 5e-6) || !good)
            fprintf(stderr, "  %s in %lu bytes\n", text, (unsigned long)bytes);
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
