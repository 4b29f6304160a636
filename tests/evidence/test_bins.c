/* The bins of the chi-square test hold the whole density: their sum is 1 within 4e-6 where a lobe has parts of
 * very different width, an unbounded peak, a tail that barely has an area, a ring, or a jump, up to grazing, and within
 * what it says it may err; in a ring of width 1e-4 floats hardly tell slopes apart. (A bin that is in another's place
 * fails chi_square.) */

#include "evidence/measure/measure.h"
#include "oracle/oracle.h"
#include "harness/test.h"

typedef struct view_case {
    const char *slope;
    float alpha_x, alpha_y;
    double theta, phi, off,
        error; /* of the tail r^-3.1 two thousandths lie beyond slope 1e26, where a table ends */
} view_case;

static const view_case CASES[] = {
    {"step(1-r)", 1, 1, 130, 25, 4e-6, 2e-5},
    {"r^-1.5*exp(-r)", 1, 1, 0, 0, 4e-6, 2e-5},
    {"(1+r*r)^-1.55", 1, 1, 80, 0, 3e-3, 2e-5},
    {"exp(-((r-1)/0.1)^2)", 0.05f, 0.4f, 89.9, 25, 4e-6, 2e-5},
    {"1e4*(1+1e4*r*r)^-2 + (1+r*r)^-2", 0.5f, 0.5f, 89.9, 0, 4e-6, 2e-5},
    {"step(1-r)", 1e-3f, 1, 130, 25, 4e-6, 2e-5},
    {"exp(-((r-1)/1e-4)^2)", 1, 1, 30, 0, 2e-3, 2e-3},
};

int main(void)
{
    for (const view_case *at = CASES; at < CASES + sizeof CASES / sizeof *CASES; at++) {
        vndf_distribution *table = oracle_build(at->slope, 0, NULL, NULL);
        const vndf_surface surface = vndf_rough(table, at->alpha_x, at->alpha_y);
        const vndf_vec3 wi = oracle_direction(at->theta, at->phi);
        const vndf_view view = vndf_view_from(&surface, wi);
        const bins_sampler of = bins_of_view(&view, &surface, wi);
        const bins_result found = bins_chi_square(&of, 0, 7);
        const double most = at->off > 1e-3 ? at->off : fmin(at->off, found.error);
        if (!(TEST(table != NULL) & TEST_NEAR(found.mass, 1, most) & TEST(found.error < at->error)))
            fprintf(stderr, "  of %s: error %g\n", at->slope, found.error);
        vndf_free(table);
    }
    return test_done();
}
