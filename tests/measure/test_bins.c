/* The bins of the chi-square test hold the whole density: their sum is 1 within 2e-6 where a lobe has parts of
 * very different width, an unbounded peak, a tail that barely has an area, a ring, or a jump, up to grazing. */
#include "measure/bins.h"
#include "oracle/oracle_validate.h"
#include "harness/test.h"

typedef struct view_case {
    const char *slope;
    float alpha_x, alpha_y;
    double theta, phi;
} view_case;

static const view_case CASES[] = {
    {"1e4*(1+1e4*r*r)^-2 + (1+r*r)^-2", 0.5f, 0.5f, 89.9, 0},
    {"r^-1.5*exp(-r)", 1, 1, 0, 0},
    {"(1+r*r)^-1.55", 1, 1, 80, 0},
    {"exp(-((r-1)/0.1)^2)", 0.05f, 0.4f, 89.9, 25},
    {"step(1-r)", 1e-3f, 1, 130, 25},
};
enum { CASE_COUNT = sizeof CASES / sizeof *CASES };

static double mass_of(const vndf_surface *surface, vndf_vec3 wi)
{
    static double probability[BINS_COUNT];
    double mass = 0;
    vndf_view view = vndf_view_from(surface, wi);
    bin_map map = bins_for(surface, wi, 7);
    bins_integrate(&map, &view, probability);
    for (size_t i = 0; i < BINS_COUNT; i++)
        mass += probability[i];
    return mass;
}

static void test_mass(const view_case *at)
{
    vndf_distribution *table = oracle_build_of(at->slope, 0, NULL, NULL);
    vndf_surface surface = {table, at->alpha_x, at->alpha_y};
    if (TEST(table != NULL) && !TEST_NEAR(mass_of(&surface, oracle_direction(at->theta, at->phi)), 1, 2e-6))
        fprintf(stderr, "  of %s\n", at->slope);
    vndf_free(table);
}

/* Normals at the pole and at the horizon, and slopes so large that an angle would not tell them from it. */
static void test_ends(void)
{
    vndf_surface surface = {vndf_ggx(), 1, 1};
    bin_map map = bins_for(&surface, oracle_direction(30, 0), 7);
    TEST(bins_place(&map, (vndf_vec3){0, 0, 1}) / BINS_PHI == 0);
    TEST(bins_place(&map, (vndf_vec3){1, 0, 0}) / BINS_PHI == BINS_THETA - 1);
    map.slope[BINS_THETA - 1] = 1e20 / map.stretch_x;
    TEST(bins_place(&map, (vndf_vec3){1, 0, 2e-20f}) / BINS_PHI == BINS_THETA - 2);
    TEST(bins_place(&map, (vndf_vec3){1, 0, 0.5e-20f}) / BINS_PHI == BINS_THETA - 1);
}

int main(void)
{
    test_ends();
    for (size_t i = 0; i < test_amount(1, CASE_COUNT, CASE_COUNT); i += test_amount(1, 4, 1))
        test_mass(&CASES[i]);
    return test_done();
}
